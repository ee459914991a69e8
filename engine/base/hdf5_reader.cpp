#include "engine/base/hdf5_reader.h"

#include <hdf5.h>

namespace scree {

namespace {

Hdf5Handle opened(const std::filesystem::path& file) {
  keep_hdf5_quiet();
  return {H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, file.string()};
}

// Of one value.
Hdf5Handle attribute_of(const Hdf5Handle& file, const std::string& name) {
  Hdf5Handle attribute(H5Aopen(file.id(), name.c_str(), H5P_DEFAULT), H5Aclose, name);
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose, name);
  hdf5_expect(H5Sget_simple_extent_npoints(space.id()) == 1, name);
  return attribute;
}

Hdf5Handle set_of(const Hdf5Handle& file, const std::string& name) {
  return {H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose, name};
}

Hdf5Handle space_of(const Hdf5Handle& set, const std::string& name) {
  return {H5Dget_space(set.id()), H5Sclose, name};
}

// That its bytes in the file can stand for.
double most_bytes(const Hdf5Handle& set) {
  constexpr double most_in_a_byte = 2048;  // zlib makes a thousandth of what is all alike
  return most_in_a_byte * static_cast<double>(H5Dget_storage_size(set.id()));
}

// How many values it has. A damaged one that claims more than its bytes in the file can hold is found before memory is asked
// for.
std::size_t size_of(const Hdf5Handle& set, const Hdf5Handle& space, const std::string& name) {
  const hssize_t size = H5Sget_simple_extent_npoints(space.id());
  hdf5_expect(size >= 0 && static_cast<double>(size) <= most_bytes(set), name);
  return static_cast<std::size_t>(size);
}

template <class T>
std::vector<T> numbers(const Hdf5Handle& file, const std::string& name, hid_t type) {
  const Hdf5Handle set = set_of(file, name);
  std::vector<T> values(size_of(set, space_of(set, name), name));
  if (!values.empty()) hdf5_expect(H5Dread(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, name);
  return values;
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : file_(opened(file)) {}

bool Hdf5Reader::has_attribute(const std::string& name) const {
  return H5Aexists(file_.id(), name.c_str()) > 0;
}

std::string Hdf5Reader::text_attribute(const std::string& name) const {
  const Hdf5Handle attribute = attribute_of(file_, name);
  const Hdf5Handle type(H5Aget_type(attribute.id()), H5Tclose, name);
  hdf5_expect(H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) == 0, name);
  std::string text(H5Tget_size(type.id()), '\0');
  hdf5_expect(H5Aread(attribute.id(), type.id(), text.data()) >= 0, name);
  return text.substr(0, text.find('\0'));
}

std::int64_t Hdf5Reader::number_attribute(const std::string& name) const {
  std::int64_t number = 0;
  hdf5_expect(H5Aread(attribute_of(file_, name).id(), H5T_NATIVE_INT64, &number) >= 0, name);
  return number;
}

std::vector<double> Hdf5Reader::doubles(const std::string& name) const {
  return numbers<double>(file_, name, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& name) const {
  return numbers<std::int64_t>(file_, name, H5T_NATIVE_INT64);
}

std::vector<std::string> Hdf5Reader::texts(const std::string& name) const {
  const Hdf5Handle set = set_of(file_, name);
  const std::size_t count = size_of(set, space_of(set, name), name);
  const Hdf5Handle type(H5Dget_type(set.id()), H5Tclose, name);
  hdf5_expect(H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) == 0, name);
  if (count == 0) return {};
  const std::size_t width = H5Tget_size(type.id());
  hdf5_expect(width > 0 && static_cast<double>(width) * static_cast<double>(count) <= most_bytes(set), name);
  std::string rows(width * count, '\0');
  hdf5_expect(H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()) >= 0, name);
  std::vector<std::string> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = rows.substr(width * i, width).c_str();
  return values;
}

bool Hdf5Reader::holds_texts(const std::string& name) const {
  const Hdf5Handle type(H5Dget_type(set_of(file_, name).id()), H5Tclose, name);
  return H5Tget_class(type.id()) == H5T_STRING;
}

}  // namespace scree
