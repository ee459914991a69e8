#include "tools/report/study_report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "tools/report/chart.h"
#include "tools/report/page.h"

namespace scree::report {

namespace {

constexpr std::size_t most_charts = 8;

using Row = std::vector<std::string>;

// RFC 4180: a cell in quotes may hold commas, line ends, and quotes that are doubled.
std::vector<Row> parse_csv(std::istream& in) {
  std::vector<Row> rows;
  Row row;
  std::string cell;
  bool quoted = false;
  const auto end_row = [&] {
    row.push_back(std::exchange(cell, ""));
    rows.push_back(std::exchange(row, {}));
  };
  for (char c = 0; in.get(c);) {
    if (quoted && c == '"' && in.peek() == '"') {
      cell += static_cast<char>(in.get());
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      row.push_back(std::exchange(cell, ""));
    } else if (!quoted && c == '\n') {
      end_row();
    } else if (quoted || c != '\r') {
      cell += c;
    }
  }
  if (!cell.empty() || !row.empty()) end_row();
  return rows;
}

double value_of(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() && !cell.empty() ? value : std::nan("");
}

std::vector<double> column(const std::vector<Row>& rows, std::size_t number) {
  std::vector<double> values;
  for (std::size_t i = 1; i < rows.size(); ++i)
    values.push_back(number < rows[i].size() ? value_of(rows[i][number]) : std::nan(""));
  return values;
}

bool varies(const std::vector<double>& values) {
  return !values.empty() && std::isfinite(values.front()) && std::any_of(values.begin(), values.end(), [&](double value) {
    return std::isfinite(value) && value != values.front();
  });
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

void add_charts(Page& page, const std::vector<Row>& rows) {
  std::optional<std::size_t> against;
  std::size_t charts = 0;
  for (std::size_t number = 0; number < rows.front().size() && charts < most_charts; ++number) {
    const std::string& name = rows.front()[number];
    const auto values = column(rows, number);
    if (!is_figure(name) || !varies(values)) continue;
    if (!against) {
      against = number;
      continue;
    }
    Chart chart;
    chart.x_label = rows.front()[*against];
    chart.y_label = name;
    chart.points = true;
    chart.curves = {{name, column(rows, *against), values}};
    page.figure_with(to_svg(chart), fmt::format("{} against {}", name, rows.front()[*against]));
    ++charts;
  }
}

std::vector<Row> read_rows(const std::filesystem::path& file) {
  std::ifstream in(file);
  auto rows = parse_csv(in);
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
    page.figure_with(fmt::format("<img alt=\"\" src=\"{}\">", data_url(picture, "image/png")), picture.filename().string());
  }
  if (std::filesystem::exists(directory / "ensembles.csv")) {
    add_table(page, "Ensembles", read_rows(directory / "ensembles.csv"));
  }
  add_table(page, "Runs", rows);
  return page.html();
}

}  // namespace scree::report
