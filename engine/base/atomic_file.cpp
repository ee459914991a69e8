#include "engine/base/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw RunError(fmt::format("{}: could not be written ({}). Free some space or choose another --out", file.string(), reason));
}

void flush_to_disk(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(file, std::strerror(errno));
  const int status = ::fsync(descriptor);
  const int reason = errno;
  // Its pages serve the next file, or the system would have to find new ones for every frame: half of what writing one cost.
  ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
  ::close(descriptor);
  if (status != 0) fail(file, std::strerror(reason));
}

}  // namespace

void write_atomically(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write) {
  // The extension stays last: writers choose the format by it.
  std::filesystem::path temporary = file;
  temporary.replace_filename(fmt::format(".part-{}", file.filename().string()));
  std::error_code ignored;
  try {
    write(temporary);
    flush_to_disk(temporary, file);
    std::filesystem::rename(temporary, file);
  } catch (const std::filesystem::filesystem_error& error) {
    std::filesystem::remove(temporary, ignored);
    fail(file, error.code().message());
  } catch (...) {
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void write_text(const std::filesystem::path& file, std::string_view text) {
  write_text(file, {&text, 1});
}

void write_text(const std::filesystem::path& file, std::span<const std::string_view> parts) {
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    for (const std::string_view part : parts) stream << part;
    stream.flush();
    if (!stream) fail(file, std::strerror(errno));
  });
}

}  // namespace scree
