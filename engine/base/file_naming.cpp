#include "engine/base/file_naming.h"

#include <cerrno>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/file_parts.h"

namespace scree {

std::filesystem::path temporary_of(const std::filesystem::path& file) {
  return file.parent_path() / fmt::format(".part-{}", file.filename().string());
}

std::filesystem::path earlier_of(const std::filesystem::path& file) {
  return file.parent_path() / fmt::format(".earlier-{}", file.filename().string());
}

void flush(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  if (const std::error_code reason = flush_to_disk(temporary)) throw RunError(not_written(file, reason));
}

void name_written(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  std::error_code reason;
  std::filesystem::rename(temporary, file, reason);
  if (reason) throw RunError(not_written(file, reason));
}

std::string not_written(const std::filesystem::path& file, std::error_code reason) {
  const bool full = reason == std::errc::no_space_on_device || reason.value() == EDQUOT;
  return fmt::format("{}: could not be written ({}). {}", file.string(), reason.message(),
                     full ? "Free some space or choose another place" : "Choose another place");
}

}  // namespace scree
