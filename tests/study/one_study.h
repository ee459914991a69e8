// A study that the command makes, in a folder of its own.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/study/table.h"

namespace scree::test {

// The bytes of a file.
std::string contents(const std::filesystem::path& file);

struct Ended {
  int status = 0;
  std::string text;  // of standard output and standard error
};

Ended shell(const std::string& command, const std::filesystem::path& folder);

// A study of the falling scene, and what to do with it.
struct OneStudy {
  explicit OneStudy(const std::string& text);

  [[nodiscard]] std::string command(const std::string& options) const;
  [[nodiscard]] Ended run(const std::string& options = "") const;
  [[nodiscard]] study::Table table() const;
  [[nodiscard]] nlohmann::json summary(std::size_t row) const;

  std::filesystem::path file;
  std::filesystem::path out;
};

// Two joints, and two packings for each.
extern const char* const two_by_two;

}  // namespace scree::test
