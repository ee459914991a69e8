// Files that are whole or not there.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace scree {

// Calls `write` with a temporary name beside `file`, flushes it to disk and renames it to `file`.
// Throws RunError, naming the file and the system's reason, if any of it fails; the old `file` is then untouched.
void write_atomically(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

// The same for text, and for parts of it that are not put together first.
void write_text(const std::filesystem::path& file, std::string_view text);
void write_text(const std::filesystem::path& file, std::span<const std::string_view> parts);

}  // namespace scree
