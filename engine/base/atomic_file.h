// Files that are whole or not there.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/file_naming.h"
#include "engine/base/file_parts.h"

namespace scree {

// Calls `write` with a temporary name beside `file`, flushes it to disk and renames it to `file`. Of a symbolic link what it
// points to is written. Throws RunError, naming the file and the system's reason, if any of it fails or `file` is there and is
// no regular file (a device, a pipe); the old `file` is then untouched.
void write_atomically(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

// The same for parts that are not put together first, and for text.
void write_atomically(const std::filesystem::path& file, std::span<const std::string_view> parts, Way way);
void write_text(const std::filesystem::path& file, std::string_view text);

// The same for the head of a file to which lines are appended at once, none of which is flushed.
void write_unflushed(const std::filesystem::path& file, std::string_view text);

// Removes what a run that was killed left of a file that it was writing. Throws std::filesystem::filesystem_error.
void remove_unfinished(const std::filesystem::path& file);

}  // namespace scree
