// Files that are whole or not there.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace scree {

// Calls `write` with a temporary name beside `file`, flushes it to disk and renames it to `file`.
// Throws RunError, naming the file and the system's reason, if any of it fails; the old `file` is then untouched.
void write_atomically(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

// The same for text.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace scree
