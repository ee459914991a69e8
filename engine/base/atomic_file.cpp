#include "engine/base/atomic_file.h"

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/files_together.h"

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

void flush_and_name(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  if (FilesTogether* together = FilesTogether::of_this_thread()) return together->add(temporary, file);
  flush(temporary, file);
  name_written(temporary, file);
}

// Calls `make` with the temporary name, which writes the file there, and `finish` with both names.
template <class Make, class Finish>
void replace_atomically(const std::filesystem::path& file, const Make& make, const Finish& finish) {
  const std::filesystem::path temporary = temporary_of(file);
  std::error_code ignored;
  try {
    if (FilesTogether* together = FilesTogether::of_this_thread()) together->keep_earlier(file);
    if (const std::error_code reason = make(temporary)) fail(file, reason);
    finish(temporary, file);
  } catch (const std::filesystem::filesystem_error& error) {
    std::filesystem::remove(temporary, ignored);
    fail(file, error.code());
  } catch (...) {
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

}  // namespace

void write_atomically(const std::filesystem::path& name, const std::function<void(const std::filesystem::path&)>& write) {
  const auto make = [&](const std::filesystem::path& temporary) {
    write(temporary);
    return std::error_code();
  };
  replace_atomically(target_of(name), make, flush_and_name);
}

void write_atomically(const std::filesystem::path& name, std::span<const std::string_view> parts, Way way) {
  replace_atomically(
      target_of(name), [&](const std::filesystem::path& temporary) { return write_parts(temporary, parts, way); },
      flush_and_name);
}

void write_text(const std::filesystem::path& file, std::string_view text) {
  write_atomically(file, {&text, 1}, Way::cached);
}

void write_unflushed(const std::filesystem::path& file, std::string_view text) {
  const auto make = [&](const std::filesystem::path& temporary) { return write_parts(temporary, {&text, 1}, Way::cached); };
  replace_atomically(target_of(file), make, name_written);
}

void remove_unfinished(const std::filesystem::path& file) {
  std::filesystem::remove(temporary_of(file));
  std::filesystem::remove(earlier_of(file));
}

}  // namespace scree
