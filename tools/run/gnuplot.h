// Pictures of tables, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace scree::run {

// A text as gnuplot reads it back, whatever it holds: in double quotes it would run what stands in backquotes.
std::string gnuplot_text(const std::string& text);

// Draws `picture` by the commands that `commands_for` gives for the file that is to be their output. Throws RunError if gnuplot
// is missing or leaves no picture; the old one is then untouched.
void draw_by_gnuplot(const std::function<std::string(const std::filesystem::path&)>& commands_for,
                     const std::filesystem::path& picture);

}  // namespace scree::run
