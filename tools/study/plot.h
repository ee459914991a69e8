// `scree plot`: one figure of a study against another, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/study/table.h"

namespace scree::study {

struct PlotArguments {
  std::string directory;
  std::string x;
  std::string y;
  std::string series;   // a column; empty: one series
  std::string x_label;  // empty: the column's name
  std::string y_label;
  std::vector<std::string> log_axes;  // x, y
  std::string picture;                // empty: Y.png in the directory
};

// One point; `low` and `high` bound its mean's confidence, or are its value.
struct Mark {
  double x = 0;
  double y = 0;
  double low = 0;
  double high = 0;
};

struct Series {
  std::string name;
  std::vector<Mark> marks;  // by x
};

// The rows that have both figures, by the column `series`. With a column Y.mean the means with their confidence; of runs only
// those that are complete. Throws InputError for a column that is not there, or holds no numbers.
std::vector<Series> series_of(const Table& table, const PlotArguments& arguments);

void declare_plot(CLI::App& command, PlotArguments& arguments);

int plot_command(const PlotArguments& arguments);

}  // namespace scree::study
