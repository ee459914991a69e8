// A folder of a test's own, gone afterwards: tests run side by side.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace scree::test {

class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "scree-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  ~TempFolder() { std::filesystem::remove_all(path_); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// One for the whole program, for what several tests share.
inline const std::filesystem::path& temp_folder() {
  static const TempFolder folder;
  return folder.path();
}

}  // namespace scree::test
