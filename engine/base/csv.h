// Tables as text: RFC 4180.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scree {

// A cell as it is written: in quotes if it holds commas, line ends or quotes, which are doubled.
std::string csv_cell(const std::string& text);

// Rows of cells. Line ends within quotes are part of a cell; a last line without an end is a row, too.
std::vector<std::vector<std::string>> csv_rows(std::string_view text);

}  // namespace scree
