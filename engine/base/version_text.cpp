#include <fmt/format.h>

#include "engine/base/version.h"

namespace scree {

std::string version_text() {
  std::string text = fmt::format("scree {} ({})", version(), build_type());
  for (const LibraryVersion& library : library_versions()) text += fmt::format("\n{} {}", library.name, library.version);
  return text;
}

}  // namespace scree
