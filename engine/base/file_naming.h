// The names under which a file is written until it is whole, and how it gets its own.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace scree {

// The extension stays last: writers choose the format by it.
std::filesystem::path temporary_of(const std::filesystem::path& file);

// Of a file that waits while the next of its name is written.
std::filesystem::path earlier_of(const std::filesystem::path& file);

// These throw RunError, naming the file and the system's reason, if they fail.
void flush(const std::filesystem::path& temporary, const std::filesystem::path& file);
void name_written(const std::filesystem::path& temporary, const std::filesystem::path& file);

// What to say of a file that could not be written, for the system's error.
std::string not_written(const std::filesystem::path& file, std::error_code reason);

}  // namespace scree
