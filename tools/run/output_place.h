// Where a command is told to put what it makes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scree::run {

// Throws InputError unless the name ends in one of these and the folder is there: before anything is drawn.
void check_output_place(const std::string& option, const std::filesystem::path& file, const std::vector<std::string>& endings);

// Makes a folder for results, and those it lies in. Throws RunError.
void make_output_folder(const std::filesystem::path& folder);

}  // namespace scree::run
