// Files that are whole or not there.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "engine/base/file_parts.h"

namespace scree {

// Calls `write` with a temporary name beside `file`, flushes it to disk and renames it to `file`. Of a symbolic link what it
// points to is written. Throws RunError, naming the file and the system's reason, if any of it fails or `file` is there and is
// no regular file (a device, a pipe); the old `file` is then untouched.
void write_atomically(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

// The same for parts that are not put together first, and for text.
void write_atomically(const std::filesystem::path& file, std::span<const std::string_view> parts, Way way);
void write_text(const std::filesystem::path& file, std::string_view text);

// The same for the head of a file to which lines are appended at once, none of which is flushed.
void write_unflushed(const std::filesystem::path& file, std::string_view text);

// Files that wait under their temporary names until all are flushed to disk at once and named in the order in which they were
// last written. That takes the disk little longer than one of them, and flushing each is a third of what a small run takes.
class FilesTogether {
 public:
  // While it lives, what this thread writes by the functions above waits, but for what is not flushed.
  class Scope {
   public:
    explicit Scope(FilesTogether& files);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    FilesTogether* outer_;
  };

  FilesTogether() = default;
  // Names what still waits, if that can be done: files that were written before something went wrong are whole.
  ~FilesTogether();
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;

  // Throws RunError as the functions above do; those that do not have their names then never get them.
  void publish();

  // One that has been written takes the place of an earlier one of that name, which is kept until then.
  void keep_earlier(const std::filesystem::path& file);
  void add(const std::filesystem::path& temporary, const std::filesystem::path& file);

  // All that wait here wait there, behind those.
  void pass_on(FilesTogether& others);

  // Since when the first of them waits, if any do.
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> since() const { return since_; }

 private:
  struct Waiting {
    std::filesystem::path temporary, file;
  };
  std::vector<Waiting> waiting_;
  std::optional<std::chrono::steady_clock::time_point> since_;
};

// Removes what a run that was killed left of a file that it was writing. Throws std::filesystem::filesystem_error.
void remove_unfinished(const std::filesystem::path& file);

// What to say of a file that could not be written, for the system's error.
std::string not_written(const std::filesystem::path& file, std::error_code reason);

}  // namespace scree
