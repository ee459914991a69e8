#include "engine/base/atomic_file.h"

#include <cerrno>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::error_code reason) {
  throw RunError(not_written(file, reason));
}

std::error_code last_error() {
  return {errno, std::generic_category()};
}

// The file that a name stands for: through a symbolic link its target, which need not be there yet.
std::filesystem::path target_of(std::filesystem::path file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw RunError(fmt::format("{}: could not be written (it is no regular file). Choose another place", file.string()));
  }
  constexpr int most_links = 40;  // as the system follows
  for (int i = 0; i < most_links && std::filesystem::is_symlink(file, ignored); ++i)
    file = file.parent_path() / std::filesystem::read_symlink(file);
  return file;
}

void flush_to_disk(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(file, last_error());
  const int status = ::fsync(descriptor);
  const std::error_code reason = last_error();
  // Its pages serve the next file, or the system would have to find new ones for every frame: half of what writing one cost.
  ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
  ::close(descriptor);
  if (status != 0) fail(file, reason);
}

}  // namespace

std::string not_written(const std::filesystem::path& file, std::error_code reason) {
  const bool full = reason == std::errc::no_space_on_device || reason.value() == EDQUOT;
  return fmt::format("{}: could not be written ({}). {}", file.string(), reason.message(),
                     full ? "Free some space or choose another place" : "Choose another place");
}

void write_atomically(const std::filesystem::path& name, const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path file = target_of(name);
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
    fail(file, error.code());
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
    if (!stream) fail(file, last_error());
  });
}

}  // namespace scree
