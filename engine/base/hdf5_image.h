// HDF5 files in memory: written there, so that a full disk meets plain writing and not HDF5's own clean-up,
// and without times, so that equal contents give equal files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/hdf5_handle.h"

namespace scree {

// Everything throws Hdf5Error where there is no memory for it.
class Hdf5Image {
  // Where HDF5 takes the file's memory from, and leaves it when it closes the file.
  struct Memory;

 public:
  // `expected`: about how large it will be; it grows in steps of that [bytes].
  explicit Hdf5Image(std::size_t expected);
  ~Hdf5Image();
  Hdf5Image(const Hdf5Image&) = delete;
  Hdf5Image& operator=(const Hdf5Image&) = delete;

  void put_attribute(const std::string& name, const std::string& text);
  void put_attribute(const std::string& name, std::int64_t number);
  // A table with rows of `width` entries.
  void put(const std::string& name, std::span<const double> values, std::size_t width = 1);
  void put(const std::string& name, std::span<const std::int64_t> values, std::size_t width = 1);
  // All as long as the longest: where they are of variable length, HDF5 follows what the file says of where they are and how
  // long, and a damaged one ends the program.
  void put(const std::string& name, const std::vector<std::string>& values);

  // Ends the file. Its bytes, which live as long as this.
  [[nodiscard]] std::string_view bytes();

 private:
  std::unique_ptr<Memory> memory_;
  Hdf5Handle file_;
};

}  // namespace scree
