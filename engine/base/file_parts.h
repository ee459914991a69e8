// Writing a file from parts that lie in different places of the memory.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>

namespace scree {

// Through the system's cache, or past it, without a copy: for large files that nobody reads soon. What goes past it must be
// whole pages in whole pages of memory (page_buffer.h); the cache is the way of what is not, and of file systems that have no
// other.
enum class Way { cached, direct };

// Creates or replaces the file and writes the parts one behind the other. Returns what went wrong, if anything; the file may
// then be there in part.
std::error_code write_parts(const std::filesystem::path& file, std::span<const std::string_view> parts, Way way);

// Has the system begin to write a file to the disk. Nothing comes of it where that fails: what is wrong is found by flushing.
void begin_to_flush(const std::filesystem::path& file);

// Returns when a file that somebody has written is on the disk, or what went wrong.
std::error_code flush_to_disk(const std::filesystem::path& file);

}  // namespace scree
