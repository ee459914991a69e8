// Which Scree this is, and which libraries it was built with: for `scree --version` and the run summary.
// A library of its own, scree_version (cmake/ScreeVersion.cmake).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace scree {

struct LibraryVersion {
  std::string_view name;
  std::string_view version;
};

// The project's version, followed in a git checkout by the commit ("0.1.0+g1a2b3c4", "-dirty" with local changes when the build
// was configured for it).
std::string_view version();

// "Release" and the like: the figures of a summary mean little without it.
std::string_view build_type();

// The libraries that results may depend on.
std::span<const LibraryVersion> library_versions();

// All of that for a reader, one line each.
std::string version_text();

}  // namespace scree
