#include "engine/packing/hdf5_image.h"

#include <algorithm>
#include <cstdlib>

namespace scree::packing {

struct Hdf5Image::Memory {
  void* bytes = nullptr;  // once the file is closed

  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { std::free(bytes); }

  static void* allocate(std::size_t size, H5FD_file_image_op_t, void*) { return std::malloc(size); }
  static void* grow(void* bytes, std::size_t size, H5FD_file_image_op_t, void*) { return std::realloc(bytes, size); }
  static herr_t release(void* bytes, H5FD_file_image_op_t why, void* memory) {
    if (why == H5FD_FILE_IMAGE_OP_FILE_CLOSE) {
      static_cast<Memory*>(memory)->bytes = bytes;
    } else {
      std::free(bytes);
    }
    return 0;
  }
  // HDF5 makes copies of what it is told, all of which are to be this one.
  static void* copy(void* memory) { return memory; }
  static herr_t forget(void*) { return 0; }
};

namespace {

H5::H5File in_memory(std::size_t growth, H5FD_file_image_callbacks_t memory) {
  H5::Exception::dontPrint();
  H5::FileAccPropList access;
  access.setCore(growth, false);
  H5Pset_file_image_callbacks(access.getId(), &memory);
  return {"image", H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access};
}

H5::DSetCreatPropList timeless() {
  H5::DSetCreatPropList creation;
  H5Pset_obj_track_times(creation.getId(), false);
  return creation;
}

H5::DataSpace rows_of(std::size_t size, std::size_t width) {
  const hsize_t extent[2] = {size / width, width};
  return {width == 1 ? 1 : 2, extent};
}

H5::StrType text_type() {
  return {H5::PredType::C_S1, H5T_VARIABLE};
}

template <class T>
std::vector<T> numbers(const H5::H5File& file, const std::string& name, const H5::PredType& type) {
  const H5::DataSet set = file.openDataSet(name);
  std::vector<T> values(static_cast<std::size_t>(set.getSpace().getSimpleExtentNpoints()));
  if (!values.empty()) set.read(values.data(), type);
  return values;
}

}  // namespace

Hdf5Image::Hdf5Image(std::size_t expected)
    : memory_(std::make_unique<Memory>()),
      file_(in_memory(expected + expected / 16 + (1 << 16), {Memory::allocate, nullptr, Memory::grow, Memory::release,
                                                             Memory::copy, Memory::forget, memory_.get()})) {}

Hdf5Image::~Hdf5Image() = default;

void Hdf5Image::put_attribute(const std::string& name, const std::string& text) {
  const H5::StrType type(H5::PredType::C_S1, text.size() + 1);
  file_.createAttribute(name, type, H5::DataSpace(H5S_SCALAR)).write(type, text);
}

void Hdf5Image::put_attribute(const std::string& name, std::int64_t number) {
  const auto& type = H5::PredType::NATIVE_INT64;
  file_.createAttribute(name, type, H5::DataSpace(H5S_SCALAR)).write(type, &number);
}

void Hdf5Image::put(const std::string& name, const std::vector<double>& values, std::size_t width) {
  const auto& type = H5::PredType::NATIVE_DOUBLE;
  const H5::DataSet set = file_.createDataSet(name, type, rows_of(values.size(), width), timeless());
  if (!values.empty()) set.write(values.data(), type);
}

void Hdf5Image::put(const std::string& name, const std::vector<std::int64_t>& values, std::size_t width) {
  const auto& type = H5::PredType::NATIVE_INT64;
  const H5::DataSet set = file_.createDataSet(name, type, rows_of(values.size(), width), timeless());
  if (!values.empty()) set.write(values.data(), type);
}

void Hdf5Image::put(const std::string& name, const std::vector<std::string>& values) {
  std::vector<const char*> starts;
  starts.reserve(values.size());
  for (const std::string& value : values) starts.push_back(value.c_str());
  const H5::DataSet set = file_.createDataSet(name, text_type(), rows_of(values.size(), 1), timeless());
  if (values.empty()) return;
  // Texts are converted on the way, in two buffers of 1 MB unless told otherwise, which are cleared for a name or two.
  H5::DSetMemXferPropList transfer;
  transfer.setBuffer(std::clamp<std::size_t>(16 * values.size(), 1 << 10, 1 << 20), nullptr, nullptr);
  set.write(starts.data(), text_type(), H5::DataSpace::ALL, H5::DataSpace::ALL, transfer);
}

std::string_view Hdf5Image::bytes() {
  file_.flush(H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file_.getId(), nullptr, 0);
  file_.close();
  if (size < 0 || memory_->bytes == nullptr) throw H5::FileIException("H5Fget_file_image", "no image");
  return {static_cast<const char*>(memory_->bytes), static_cast<std::size_t>(size)};
}

std::string text_attribute(const H5::H5File& file, const std::string& name) {
  const H5::Attribute attribute = file.openAttribute(name);
  std::string text;
  attribute.read(attribute.getStrType(), text);
  return text.substr(0, text.find('\0'));
}

std::int64_t number_attribute(const H5::H5File& file, const std::string& name) {
  std::int64_t number = 0;
  file.openAttribute(name).read(H5::PredType::NATIVE_INT64, &number);
  return number;
}

std::vector<double> doubles(const H5::H5File& file, const std::string& name) {
  return numbers<double>(file, name, H5::PredType::NATIVE_DOUBLE);
}

std::vector<std::int64_t> integers(const H5::H5File& file, const std::string& name) {
  return numbers<std::int64_t>(file, name, H5::PredType::NATIVE_INT64);
}

std::vector<std::string> texts(const H5::H5File& file, const std::string& name) {
  const H5::DataSet set = file.openDataSet(name);
  std::vector<char*> starts(static_cast<std::size_t>(set.getSpace().getSimpleExtentNpoints()));
  if (starts.empty()) return {};
  set.read(starts.data(), text_type());
  std::vector<std::string> values(starts.begin(), starts.end());
  H5::DataSet::vlenReclaim(starts.data(), text_type(), set.getSpace());
  return values;
}

}  // namespace scree::packing
