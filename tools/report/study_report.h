// The page of a study, from its table.
#pragma once

#include <filesystem>
#include <string>

namespace scree::report {

// The tables of the study, a chart of every reported figure against the first key that varies unless that takes words, and the
// pictures that lie in its directory. Throws InputError for a table that cannot be read.
std::string study_page(const std::filesystem::path& directory);

}  // namespace scree::report
