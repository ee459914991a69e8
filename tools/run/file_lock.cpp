#include "tools/run/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::run {

std::optional<FileLock> FileLock::take(const std::filesystem::path& file, Kind kind, Heirs heirs) {
  const int inherited = heirs == Heirs::children ? 0 : O_CLOEXEC;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | inherited, 0644);
  if (descriptor < 0) throw RunError(fmt::format("{}: cannot be written ({})", file.string(), std::strerror(errno)));
  FileLock lock(descriptor);
  if (::flock(descriptor, (kind == Kind::shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) return lock;
  if (errno == EWOULDBLOCK) return std::nullopt;
  throw RunError(fmt::format("{}: cannot be locked ({})", file.string(), std::strerror(errno)));
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
