#include "engine/base/atomic_file.h"

#include <cerrno>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::error_code reason) {
  throw RunError(not_written(file, reason));
}

// The file that a name stands for: through a symbolic link its target, which need not be there yet.
std::filesystem::path target_of(const std::filesystem::path& name) {
  std::filesystem::path file = name;
  std::error_code ignored, unreadable;
  auto status = std::filesystem::symlink_status(file, ignored);
  constexpr int most_links = 40;  // as the system follows
  for (int i = 0; i < most_links && std::filesystem::is_symlink(status); ++i) {
    file = file.parent_path() / std::filesystem::read_symlink(file, unreadable);
    if (unreadable) fail(name, unreadable);
    status = std::filesystem::symlink_status(file, ignored);
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw RunError(fmt::format("{}: could not be written (it is no regular file). Choose another place", name.string()));
  }
  return file;
}

// Calls `make` with the temporary name, which writes the file there and flushes it to disk.
template <class Make>
void replace_atomically(const std::filesystem::path& file, const Make& make) {
  // The extension stays last: writers choose the format by it.
  std::filesystem::path temporary = file;
  temporary.replace_filename(fmt::format(".part-{}", file.filename().string()));
  std::error_code ignored;
  try {
    if (const std::error_code reason = make(temporary)) fail(file, reason);
    std::filesystem::rename(temporary, file);
  } catch (const std::filesystem::filesystem_error& error) {
    std::filesystem::remove(temporary, ignored);
    fail(file, error.code());
  } catch (...) {
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

}  // namespace

std::string not_written(const std::filesystem::path& file, std::error_code reason) {
  const bool full = reason == std::errc::no_space_on_device || reason.value() == EDQUOT;
  return fmt::format("{}: could not be written ({}). {}", file.string(), reason.message(),
                     full ? "Free some space or choose another place" : "Choose another place");
}

void write_atomically(const std::filesystem::path& name, const std::function<void(const std::filesystem::path&)>& write) {
  replace_atomically(target_of(name), [&](const std::filesystem::path& temporary) {
    write(temporary);
    return flush_to_disk(temporary);
  });
}

void write_atomically(const std::filesystem::path& name, std::span<const std::string_view> parts, Way way) {
  replace_atomically(target_of(name),
                     [&](const std::filesystem::path& temporary) { return write_parts(temporary, parts, way); });
}

void write_text(const std::filesystem::path& file, std::string_view text) {
  write_atomically(file, {&text, 1}, Way::cached);
}

}  // namespace scree
