// Reading HDF5 files, of which nothing is believed: what is missing, of another type or damaged is an Hdf5Error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/hdf5_handle.h"

namespace scree {

class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& file);

  [[nodiscard]] bool has_attribute(const std::string& name) const;
  [[nodiscard]] std::string text_attribute(const std::string& name) const;
  [[nodiscard]] std::int64_t number_attribute(const std::string& name) const;

  // A table row by row. A damaged one may be longer than memory (std::bad_alloc) or than any list (std::length_error).
  [[nodiscard]] std::vector<double> doubles(const std::string& name) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;
  [[nodiscard]] bool holds_texts(const std::string& name) const;

 private:
  Hdf5Handle file_;
};

}  // namespace scree
