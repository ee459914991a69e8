#include "engine/base/plain_path.h"

#include <system_error>

namespace scree {

std::filesystem::path plain_path(const std::filesystem::path& path) {
  std::filesystem::path plain = path.lexically_normal();
  std::error_code not_there;
  const bool moved = std::filesystem::exists(path, not_there) && !std::filesystem::equivalent(path, plain, not_there);
  return moved ? path : plain;
}

}  // namespace scree
