#include "engine/base/file_parts.h"

#include <cerrno>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

namespace scree {

namespace {

std::error_code last_error() {
  return {errno, std::generic_category()};
}

// Closed whatever happens.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags) : number_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (is_open()) ::close(number_);
  }

  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  [[nodiscard]] int number() const { return number_; }

  // Some file systems (NFS) tell only here that the disk is full.
  std::error_code close() {
    const int status = ::close(std::exchange(number_, -1));
    return status == 0 || errno == EINTR ? std::error_code() : last_error();
  }

 private:
  int number_;
};

// What is still to be written.
class Rest {
 public:
  explicit Rest(std::span<const std::string_view> parts) {
    for (const std::string_view part : parts) {
      if (!part.empty()) parts_.push_back({const_cast<char*>(part.data()), part.size()});  // for reading and writing alike
    }
  }

  [[nodiscard]] bool empty() const { return first_ == parts_.size(); }
  ssize_t write_to(int descriptor) { return ::writev(descriptor, &parts_[first_], static_cast<int>(parts_.size() - first_)); }

  void skip(std::size_t count) {
    for (; !empty() && count >= parts_[first_].iov_len; ++first_) count -= parts_[first_].iov_len;
    if (count == 0) return;
    parts_[first_].iov_base = static_cast<char*>(parts_[first_].iov_base) + count;
    parts_[first_].iov_len -= count;
  }

 private:
  std::vector<iovec> parts_;
  std::size_t first_ = 0;
};

// From now on the file is written through the cache. Whether it was not before.
bool leave_direct_way(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  return (flags & O_DIRECT) != 0 && ::fcntl(descriptor, F_SETFL, flags & ~O_DIRECT) == 0;
}

std::error_code write_all(int descriptor, Rest rest) {
  while (!rest.empty()) {
    const ssize_t count = rest.write_to(descriptor);
    if (count > 0) {
      rest.skip(static_cast<std::size_t>(count));
    } else if (count == 0) {
      return std::make_error_code(std::errc::io_error);
    } else if (errno == EINVAL) {  // no whole pages, or a file system that wants more than these
      if (!leave_direct_way(descriptor)) return std::make_error_code(std::errc::invalid_argument);
    } else if (errno != EINTR) {
      return last_error();
    }
  }
  return {};
}

std::error_code flush(int descriptor) {
  const std::error_code reason = ::fsync(descriptor) == 0 ? std::error_code() : last_error();
  // Its pages serve the next file, or the system would have to find new ones for every frame: half of what writing one cost.
  ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
  return reason;
}

std::error_code write_and_close(Descriptor& file, std::span<const std::string_view> parts) {
  if (!file.is_open()) return last_error();
  if (const std::error_code reason = write_all(file.number(), Rest(parts))) return reason;
  return file.close();
}

}  // namespace

std::error_code write_parts(const std::filesystem::path& name, std::span<const std::string_view> parts, Way way) {
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
  if (way == Way::direct) {
    Descriptor file(name, flags | O_DIRECT);
    if (file.is_open() || errno != EINVAL) return write_and_close(file, parts);
  }
  Descriptor file(name, flags);
  return write_and_close(file, parts);
}

void begin_to_flush(const std::filesystem::path& name) {
  const Descriptor file(name, O_RDONLY);
  if (file.is_open()) ::sync_file_range(file.number(), 0, 0, SYNC_FILE_RANGE_WRITE);
}

std::error_code flush_to_disk(const std::filesystem::path& name) {
  Descriptor file(name, O_RDONLY);
  if (!file.is_open()) return last_error();
  if (const std::error_code reason = flush(file.number())) return reason;
  return file.close();
}

}  // namespace scree
