// Large arrays that are read over and over, in pages of 2 MB: with pages of 4 kB a loop that streams through memory waits for
// addresses as long as for data (thermal/README.md, "Speed").
#pragma once

#include <cstddef>

namespace scree {

inline constexpr std::size_t huge_page = std::size_t{1} << 21;  // [bytes]
inline constexpr std::size_t worth_huge_pages = 4 * huge_page;

// Asks the system to keep these bytes, into which nothing has been written yet, in huge pages as far as whole ones fit. Where
// it does not do that, nothing happens; nor for arrays of less than `worth`, which are too small to gain.
void prefer_huge_pages(void* data, std::size_t bytes, std::size_t worth = worth_huge_pages);

}  // namespace scree
