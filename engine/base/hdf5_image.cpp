#include "engine/base/hdf5_image.h"

#include <algorithm>
#include <cstdlib>

#include <hdf5.h>

namespace scree {

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

Hdf5Handle properties(hid_t kind) {
  return {H5Pcreate(kind), H5Pclose, "properties"};
}

Hdf5Handle in_memory(std::size_t growth, H5FD_file_image_callbacks_t memory) {
  keep_hdf5_quiet();
  const Hdf5Handle access = properties(H5P_FILE_ACCESS);
  hdf5_expect(H5Pset_fapl_core(access.id(), growth, 0) >= 0, "a file in memory");
  hdf5_expect(H5Pset_file_image_callbacks(access.id(), &memory) >= 0, "a file in memory");
  return {H5Fcreate("image", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "a file in memory"};
}

Hdf5Handle scalar() {
  return {H5Screate(H5S_SCALAR), H5Sclose, "a scalar"};
}

void put_attribute_of(const Hdf5Handle& file, const std::string& name, hid_t type, const void* value) {
  const Hdf5Handle attribute(H5Acreate2(file.id(), name.c_str(), type, scalar().id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             name);
  hdf5_expect(H5Awrite(attribute.id(), type, value) >= 0, name);
}

void put_rows(const Hdf5Handle& file, const std::string& name, hid_t type, const void* values, std::size_t count,
              std::size_t width) {
  const hsize_t extent[2] = {count / width, width};
  const Hdf5Handle space(H5Screate_simple(width == 1 ? 1 : 2, extent, nullptr), H5Sclose, name);
  const Hdf5Handle timeless = properties(H5P_DATASET_CREATE);
  hdf5_expect(H5Pset_obj_track_times(timeless.id(), false) >= 0, name);
  const Hdf5Handle set(H5Dcreate2(file.id(), name.c_str(), type, space.id(), H5P_DEFAULT, timeless.id(), H5P_DEFAULT), H5Dclose,
                       name);
  if (count > 0) hdf5_expect(H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, name);
}

}  // namespace

Hdf5Image::Hdf5Image(std::size_t expected)
    : memory_(std::make_unique<Memory>()),
      file_(in_memory(expected + expected / 16 + (1 << 16), {Memory::allocate, nullptr, Memory::grow, Memory::release,
                                                             Memory::copy, Memory::forget, memory_.get()})) {}

Hdf5Image::~Hdf5Image() = default;

void Hdf5Image::put_attribute(const std::string& name, const std::string& text) {
  put_attribute_of(file_, name, hdf5_text_type(text.size() + 1).id(), text.c_str());
}

void Hdf5Image::put_attribute(const std::string& name, std::int64_t number) {
  put_attribute_of(file_, name, H5T_NATIVE_INT64, &number);
}

void Hdf5Image::put(const std::string& name, std::span<const double> values, std::size_t width) {
  put_rows(file_, name, H5T_NATIVE_DOUBLE, values.data(), values.size(), width);
}

void Hdf5Image::put(const std::string& name, std::span<const std::int64_t> values, std::size_t width) {
  put_rows(file_, name, H5T_NATIVE_INT64, values.data(), values.size(), width);
}

void Hdf5Image::put(const std::string& name, const std::vector<std::string>& values) {
  std::size_t length = 0;
  for (const std::string& value : values) length = std::max(length, value.size());
  const std::size_t width = length + 1;
  std::string rows(width * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(&rows[width * i], values[i].size());
  put_rows(file_, name, hdf5_text_type(width).id(), rows.data(), values.size(), 1);
}

std::string_view Hdf5Image::bytes() {
  hdf5_expect(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0, "an image");
  const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
  file_.close();
  if (size < 0 || memory_->bytes == nullptr) throw Hdf5Error("an image");
  return {static_cast<const char*>(memory_->bytes), static_cast<std::size_t>(size)};
}

}  // namespace scree
