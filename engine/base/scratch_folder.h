// A folder of a call's own among the temporary files, gone with it.
#pragma once

#include <filesystem>

namespace scree {

class ScratchFolder {
 public:
  ScratchFolder();  // throws RunError if there is no place for one
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace scree
