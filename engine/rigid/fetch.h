// Asking for memory before it is needed.
#pragma once

#include <cstddef>

#include "engine/base/wide.h"

namespace scree::rigid {

SCREE_INLINE void fetch(const void* from, std::size_t bytes) {
  constexpr std::size_t line = 64;  // bytes that memory gives at once
  for (std::size_t at = 0; at < bytes; at += line) __builtin_prefetch(static_cast<const char*>(from) + at);
}

}  // namespace scree::rigid
