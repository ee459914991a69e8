#include "tools/run/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::run {

namespace {

// Whether a file is still the one that was opened, which whoever held it may have taken away.
bool still_there(const std::filesystem::path& file, int descriptor) {
  struct stat named {};
  struct stat opened {};
  return ::stat(file.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 && named.st_dev == opened.st_dev &&
         named.st_ino == opened.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::take(const std::filesystem::path& file, Kind kind, Heirs heirs) {
  const int inherited = heirs == Heirs::children ? 0 : O_CLOEXEC;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | inherited, 0644);
  if (descriptor < 0) throw RunError(fmt::format("{}: cannot be written ({})", file.string(), std::strerror(errno)));
  FileLock lock(descriptor);
  if (::flock(descriptor, (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) {
    return still_there(file, descriptor) ? std::move(lock) : take(file, kind, heirs);
  }
  if (errno == EWOULDBLOCK) return std::nullopt;
  throw RunError(fmt::format("{}: cannot be locked ({})", file.string(), std::strerror(errno)));
}

FileLock FileLock::of_command(const std::filesystem::path& file, Kind kind, const std::string& command) {
  auto lock = take(file, kind, Heirs::children);
  if (lock) return std::move(*lock);
  throw RunError(fmt::format("{}: another `scree {}`, or a run that one has left behind, is at work there. Wait for it",
                             file.parent_path().string(), command));
}

FileLock FileLock::wait(const std::filesystem::path& file) {
  constexpr auto pause = std::chrono::milliseconds(5);
  while (true) {
    if (auto lock = take(file, Kind::exclusive, Heirs::none)) return std::move(*lock);
    std::this_thread::sleep_for(pause);
  }
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace scree::run
