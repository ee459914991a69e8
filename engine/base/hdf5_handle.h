// HDF5's identifiers in C++. Its own C++ interface makes a hundred objects and starts the library before main(), which takes a
// tenth of a small run, whether a file is read or not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace scree {

// What HDF5 could not do: an entry that is missing or of another type, a damaged file.
class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Closes what it stands for. Throws Hdf5Error if that could not be made or opened.
class Hdf5Handle {
 public:
  using Closer = int (*)(std::int64_t);

  Hdf5Handle(std::int64_t id, Closer closer, const std::string& what) : id_(id), closer_(closer) {
    if (id < 0) throw Hdf5Error(what);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  ~Hdf5Handle() { close(); }

  void close() {
    if (id_ >= 0) closer_(std::exchange(id_, -1));
  }

  [[nodiscard]] std::int64_t id() const { return id_; }

 private:
  std::int64_t id_;
  Closer closer_;
};

// Throws Hdf5Error unless it holds.
void hdf5_expect(bool holds, const std::string& what);

// HDF5 prints nothing from here on: what is wrong is thrown.
void keep_hdf5_quiet();

// The type of texts of so many characters.
Hdf5Handle hdf5_text_type(std::size_t size);

}  // namespace scree
