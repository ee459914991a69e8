#include "engine/base/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree {

namespace {

thread_local FilesTogether* together = nullptr;  // where files of this thread wait, if they do

[[noreturn]] void fail(const std::filesystem::path& file, std::error_code reason) {
  throw RunError(not_written(file, reason));
}

// The extension stays last: writers choose the format by it.
std::filesystem::path temporary_of(const std::filesystem::path& file) {
  return file.parent_path() / fmt::format(".part-{}", file.filename().string());
}

// Of a file that waits while the next of its name is written.
std::filesystem::path earlier_of(const std::filesystem::path& file) {
  return file.parent_path() / fmt::format(".earlier-{}", file.filename().string());
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

void flush(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  if (const std::error_code reason = flush_to_disk(temporary)) fail(file, reason);
}

void name_written(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  std::error_code reason;
  std::filesystem::rename(temporary, file, reason);
  if (reason) fail(file, reason);
}

void flush_and_name(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  if (together != nullptr) return together->add(temporary, file);
  flush(temporary, file);
  name_written(temporary, file);
}

// Calls `make` with the temporary name, which writes the file there, and `finish` with both names.
template <class Make, class Finish>
void replace_atomically(const std::filesystem::path& file, const Make& make, const Finish& finish) {
  const std::filesystem::path temporary = temporary_of(file);
  std::error_code ignored;
  try {
    if (together != nullptr) together->keep_earlier(file);
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

std::string not_written(const std::filesystem::path& file, std::error_code reason) {
  const bool full = reason == std::errc::no_space_on_device || reason.value() == EDQUOT;
  return fmt::format("{}: could not be written ({}). {}", file.string(), reason.message(),
                     full ? "Free some space or choose another place" : "Choose another place");
}

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

FilesTogether::Scope::Scope(FilesTogether& files) : outer_(std::exchange(together, &files)) {}

FilesTogether::Scope::~Scope() {
  together = outer_;
}

FilesTogether::~FilesTogether() {
  try {
    publish();
  } catch (...) {
  }
}

void remove_unfinished(const std::filesystem::path& file) {
  std::filesystem::remove(temporary_of(file));
  std::filesystem::remove(earlier_of(file));
}

void FilesTogether::keep_earlier(const std::filesystem::path& file) {
  for (Waiting& each : waiting_) {
    if (each.file == file) std::filesystem::rename(std::exchange(each.temporary, earlier_of(file)), earlier_of(file));
  }
}

void FilesTogether::add(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  const auto replaced = std::erase_if(waiting_, [&](const Waiting& earlier) { return earlier.file == file; });
  std::error_code ignored;
  if (replaced > 0) std::filesystem::remove(earlier_of(file), ignored);
  waiting_.push_back({temporary, file});
  if (!since_) since_ = std::chrono::steady_clock::now();
  begin_to_flush(temporary);  // or the disk does nothing meanwhile
}

void FilesTogether::pass_on(FilesTogether& others) {
  if (since_ && !others.since_) others.since_ = since_;
  since_.reset();
  std::move(waiting_.begin(), waiting_.end(), std::back_inserter(others.waiting_));
  waiting_.clear();
}

void FilesTogether::publish() {
  const std::vector<Waiting> files = std::exchange(waiting_, {});
  since_.reset();
  try {
    for (const Waiting& each : files) flush(each.temporary, each.file);
    for (const Waiting& each : files) name_written(each.temporary, each.file);
  } catch (...) {
    std::error_code ignored;
    for (const Waiting& each : files) std::filesystem::remove(each.temporary, ignored);
    throw;
  }
}

}  // namespace scree
