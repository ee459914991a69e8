// Curves over an axis, as SVG inside a page.
#pragma once

#include <string>
#include <vector>

namespace scree::report {

struct Curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  bool dashed = false;
};

struct Chart {
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  bool points = false;  // marks instead of lines
};

// Round numbers from at or below `low` to at or above `high`, at most seven.
std::vector<double> ticks(double low, double high);

// Points that are not finite are left out; a chart without any is empty.
std::string to_svg(const Chart& chart);

}  // namespace scree::report
