#include "tools/report/study_report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/csv.h"
#include "engine/base/plain_number.h"
#include "tools/report/chart.h"
#include "tools/report/page.h"

namespace scree::report {

namespace {

constexpr std::size_t most_charts = 8;

using Row = std::vector<std::string>;

double value_of(const std::string& cell) {
  return plain_number(cell).value_or(std::nan(""));
}

std::vector<double> column(const std::vector<Row>& rows, std::size_t number) {
  std::vector<double> values;
  for (std::size_t i = 1; i < rows.size(); ++i)
    values.push_back(number < rows[i].size() ? value_of(rows[i][number]) : std::nan(""));
  return values;
}

std::optional<std::size_t> place_of(const Row& head, const std::string& name) {
  const auto found = std::find(head.begin(), head.end(), name);
  return found == head.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - head.begin()));
}

// A figure of a run that is not complete is no measurement.
std::vector<double> measured(const std::vector<Row>& rows, std::size_t number) {
  std::vector<double> values = column(rows, number);
  const auto status = place_of(rows.front(), "status");
  if (!status) return values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (*status < rows[i + 1].size() && rows[i + 1][*status] != "complete") values[i] = std::nan("");
  }
  return values;
}

bool varies(const std::vector<double>& values) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  const auto first = std::find_if(values.begin(), values.end(), is_finite);
  return std::any_of(first, values.end(), [&](double value) { return is_finite(value) && value != *first; });
}

void add_table(Page& page, const std::string& heading, std::vector<Row> rows) {
  page.heading(heading);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::string& cell : rows[i]) {
      const double value = value_of(cell);
      cell = i > 0 && std::isfinite(value) ? figure(value) : escaped(cell);
    }
  }
  page.table(rows);
}

// The book-keeping of the table, which nobody wants to see against anything.
bool is_figure(const std::string& name) {
  static const std::set<std::string> others{"run", "point", "status", "reason", "directory", "peak_memory_bytes"};
  return !others.contains(name);
}

// What a study varies over a grid, or by seed, takes every value as often as any other. So may a figure of the packing alone,
// which the table then shows.
bool is_grid(const std::vector<double>& values) {
  std::map<double, std::size_t> counts;
  for (const double value : values) {
    if (!std::isfinite(value)) return false;
    ++counts[value];
  }
  const std::size_t times = counts.begin()->second;
  return times > 1 && std::all_of(counts.begin(), counts.end(), [&](const auto& entry) { return entry.second == times; });
}

// Which columns the charts are drawn over.
struct Axes {
  std::size_t against = 0;           // the first that varies
  std::optional<std::size_t> apart;  // another one that a curve is drawn for each value of
  std::vector<std::size_t> figures;
};

// Nothing if the first key that varies, whose column is the one after the point's, takes words.
std::optional<Axes> find_axes(const std::vector<Row>& rows) {
  if (const auto point = place_of(rows.front(), "point")) {
    const auto first = column(rows, *point + 1);
    if (std::none_of(first.begin(), first.end(), [](double value) { return std::isfinite(value); })) return std::nullopt;
  }
  std::optional<Axes> axes;
  for (std::size_t number = 0; number < rows.front().size(); ++number) {
    const auto values = column(rows, number);
    if (!is_figure(rows.front()[number]) || !varies(values)) continue;
    if (!axes) {
      axes.emplace();
      axes->against = number;
    } else if (!is_grid(values)) {
      axes->figures.push_back(number);
    } else if (!axes->apart) {
      axes->apart = number;
    }
  }
  return axes;
}

std::vector<Curve> curves(const std::vector<Row>& rows, const Axes& axes, std::size_t number) {
  const auto x = column(rows, axes.against);
  const auto y = measured(rows, number);
  if (!axes.apart) return {{rows.front()[number], x, y}};
  const auto apart = column(rows, *axes.apart);
  std::map<double, Curve> found;
  for (std::size_t i = 0; i < apart.size(); ++i) {
    Curve& curve = found[apart[i]];
    curve.name = figure(apart[i]);
    curve.x.push_back(x[i]);
    curve.y.push_back(y[i]);
  }
  std::vector<Curve> all;
  all.reserve(found.size());
  for (auto& [value, curve] : found) all.push_back(std::move(curve));
  return all;
}

void add_charts(Page& page, const std::vector<Row>& rows) {
  const auto axes = find_axes(rows);
  if (!axes) return;
  const Row& names = rows.front();
  for (std::size_t i = 0; i < std::min(most_charts, axes->figures.size()); ++i) {
    const std::size_t number = axes->figures[i];
    Chart chart;
    chart.x_label = names[axes->against];
    chart.y_label = names[number];
    chart.points = true;
    chart.curves = curves(rows, *axes, number);
    const std::string apart = axes->apart ? fmt::format(", a colour for each {}", names[*axes->apart]) : "";
    page.figure_with(to_svg(chart), fmt::format("{} against {}{}", names[number], names[axes->against], apart));
  }
  if (axes->figures.size() > most_charts) {
    page.paragraph(
        fmt::format("{} more figures are in the table; `scree plot` draws them.", axes->figures.size() - most_charts));
  }
}

std::vector<Row> read_rows(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  auto rows = csv_rows(std::string(std::istreambuf_iterator<char>(in), {}));
  if (!rows.empty()) return rows;
  Problem problem;
  problem.key = "table";
  problem.value = file.string();
  problem.rule = "a table with a head";
  throw InputError(problem);
}

}  // namespace

std::string study_page(const std::filesystem::path& directory) {
  const auto rows = read_rows(directory / "table.csv");
  Page page("Study " + directory.filename().string());
  page.paragraph(fmt::format("{} runs.", rows.size() - 1));
  page.heading("Figures");
  add_charts(page, rows);
  std::vector<std::filesystem::path> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() == ".png") pictures.push_back(entry.path());
  }
  std::sort(pictures.begin(), pictures.end());
  for (const auto& picture : pictures) {
    page.figure_with(fmt::format(R"(<img alt="" src="{}">)", data_url(picture, "image/png")), picture.filename().string());
  }
  if (std::filesystem::exists(directory / "ensembles.csv")) {
    add_table(page, "Ensembles", read_rows(directory / "ensembles.csv"));
  }
  add_table(page, "Runs", rows);
  return page.html();
}

}  // namespace scree::report
