// Pictures of tables, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>

namespace scree::run {

// A text as gnuplot reads it back, whatever it holds: in double quotes it would run what stands in backquotes.
std::string gnuplot_text(const std::string& text);

// Draws `commands`, whose output is `picture`. Throws RunError if gnuplot is missing or leaves no picture.
void draw_by_gnuplot(const std::string& commands, const std::filesystem::path& picture);

}  // namespace scree::run
