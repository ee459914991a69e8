// A lock that processes on one or several machines share, and that ends with whoever holds it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace scree::run {

class FileLock {
 public:
  enum class Kind { shared, exclusive };
  enum class Heirs { none, children };  // whether processes started from now on hold it, too, until they end

  // Nothing if somebody else holds it. Throws RunError if the file cannot be made.
  static std::optional<FileLock> take(const std::filesystem::path& file, Kind kind, Heirs heirs);

  // For a command, by its name, that starts runs in the file's folder, which hold the lock with it. Throws RunError if another
  // one, or a run of its, holds it.
  static FileLock of_command(const std::filesystem::path& file, Kind kind, const std::string& command);

  // The same for this process alone, as soon as nobody else holds it.
  static FileLock wait(const std::filesystem::path& file);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace scree::run
