// Files that get their names together.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <vector>

namespace scree {

// Files that wait under their temporary names until all are flushed to disk at once and named in the order in which they were
// last written. That takes the disk little longer than one of them, and flushing each is a third of what a small run takes.
class FilesTogether {
 public:
  // While it lives, what this thread writes atomically waits, but for what is not flushed.
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

  // Throws RunError as writing does; those that do not have their names then never get them.
  void publish();

  // For what writes files (atomic_file.h): where those of this thread wait, if they do.
  static FilesTogether* of_this_thread();
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

}  // namespace scree
