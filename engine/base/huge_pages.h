// Large arrays that are read over and over, in pages of 2 MB: with pages of 4 kB a loop that streams through memory waits for
// addresses as long as for data (thermal/README.md, "Speed").
#pragma once

#include <cstddef>

namespace scree {

inline constexpr std::size_t huge_page = std::size_t{1} << 21;  // [bytes]
inline constexpr std::size_t worth_huge_pages = 4 * huge_page;

// Asks the system to keep these bytes, into which nothing has been written yet, in huge pages as far as whole ones fit. Where
// it does not do that, nothing happens; nor for arrays that are too small to gain.
void prefer_huge_pages(void* data, std::size_t bytes);

// Memory for so many bytes in whole pages of that size, which std::free takes back. Huge ones are asked for whatever the number
// of bytes. Throws std::bad_alloc.
void* allocate_pages(std::size_t bytes, std::size_t page);

}  // namespace scree
