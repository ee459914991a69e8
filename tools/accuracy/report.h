// What `scree accuracy` leaves behind: accuracy.csv, accuracy.png and a few lines of text.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/accuracy/analysis.h"

namespace scree::accuracy {

std::string to_csv(const std::vector<Measured>& runs);

// `reference` says against what the errors are; empty: there is nothing.
std::string to_text(const std::vector<Measured>& runs, const std::vector<Order>& orders, const std::string& reference);

// Draws error against time and against unknowns from the table of the runs, by gnuplot; false if no error is above 0, for the
// axes are logarithmic. Throws RunError if that fails.
bool draw(const std::vector<Measured>& runs, const std::filesystem::path& csv, const std::filesystem::path& picture);

}  // namespace scree::accuracy
