#include "tools/report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tools/report/page.h"

namespace scree::report {

namespace {

constexpr double width = 860, height = 380;  // of the drawing, in its own units
constexpr double name_height = 20;
constexpr double left = 92, right = 170, top = 14, bottom = 52;  // margins; the names of the curves stand on the right

// Told apart by those who see colours otherwise, too (Okabe and Ito).
constexpr std::array colours{"#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#888888"};

struct Axis {
  std::vector<double> marks;
  double from = 0;  // in the drawing
  double to = 0;

  [[nodiscard]] double at(double value) const {
    return from + (value - marks.front()) / (marks.back() - marks.front()) * (to - from);
  }
};

std::pair<double, double> extent(const Chart& chart, std::vector<double> Curve::*values) {
  std::pair<double, double> range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  for (const Curve& curve : chart.curves) {
    for (const double value : curve.*values) {
      if (!std::isfinite(value)) continue;
      range = {std::min(range.first, value), std::max(range.second, value)};
    }
  }
  return range;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, escaped(text));
}

// Short enough for the margin.
std::string tick_text(double mark) {
  return std::abs(mark) < 1e5 ? figure(mark) : fmt::format("{:.4g}", mark);
}

std::string grid(const Axis& x, const Axis& y) {
  std::string svg;
  for (const double mark : y.marks) {
    svg += fmt::format("<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>\n", x.from, x.to,
                       y.at(mark), y.at(mark));
    svg += text_at(x.from - 8, y.at(mark) + 4, "end", tick_text(mark));
  }
  for (const double mark : x.marks) svg += text_at(x.at(mark), y.from + 20, "middle", tick_text(mark));
  return svg;
}

std::string drawn(const Curve& curve, const Axis& x, const Axis& y, const char* colour, bool points) {
  std::string line, dots;
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
    line += fmt::format("{:.1f},{:.1f} ", x.at(curve.x[i]), y.at(curve.y[i]));
    dots += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="4" fill="{}"/>)", x.at(curve.x[i]), y.at(curve.y[i]), colour);
  }
  if (points) return dots + "\n";
  return fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{} points=\"{}\"/>\n", colour,
                     curve.dashed ? " stroke-dasharray=\"5 4\"" : "", line);
}

}  // namespace

std::vector<double> ticks(double low, double high) {
  // What differs by rounding alone is one value.
  if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high)))) high = low + std::max(1.0, std::abs(low));
  const double power = std::pow(10, std::floor(std::log10(high - low)));
  for (const double factor : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0}) {
    const double step = factor * power;
    constexpr double rounding = 1e-9;
    const double first = std::floor(low / step + rounding);
    const double last = std::ceil(high / step - rounding);
    if (last - first > 6) continue;
    std::vector<double> marks;
    for (double k = first; k <= last; ++k) marks.push_back(k * step);
    return marks;
  }
  return {low, high};
}

std::string to_svg(const Chart& chart) {
  const auto [low_x, high_x] = extent(chart, &Curve::x);
  const auto [low_y, high_y] = extent(chart, &Curve::y);
  if (!(low_x <= high_x) || !(low_y <= high_y)) return "";
  const Axis x{ticks(low_x, high_x), left, width - right};
  const Axis y{ticks(low_y, high_y), height - bottom, top};
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\">\n"
      "<style>text {{ font: 13px system-ui, sans-serif; fill: currentColor }} .grid {{ stroke: #8886; stroke-width: 1 "
      "}}</style>\n",
      width, std::max(height, top + name_height * static_cast<double>(chart.curves.size() + 1)));
  svg += grid(x, y);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const char* colour = colours[i % colours.size()];
    svg += drawn(chart.curves[i], x, y, colour, chart.points);
    const double row = top + 14 + name_height * static_cast<double>(i);
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"4\" fill=\"{}\"/>\n", x.to + 14, row - 6, colour);
    svg += text_at(x.to + 34, row, "start", chart.curves[i].name);
  }
  svg += text_at((x.from + x.to) / 2, height - 10, "middle", chart.x_label);
  svg += fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     (y.from + y.to) / 2, escaped(chart.y_label));
  return svg + "</svg>\n";
}

}  // namespace scree::report
