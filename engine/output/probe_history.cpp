#include "engine/output/probe_history.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/csv.h"
#include "engine/base/plain_number.h"
#include "engine/output/probe_table.h"

namespace scree::output {

namespace {

// The finished lines of a table below its comments: one that ends with the file is still being written.
std::string_view rows_of(std::string_view text) {
  text = text.substr(0, text.rfind('\n') + 1);
  while (text.starts_with('#')) text.remove_prefix(text.find('\n') + 1);
  return text;
}

double number_of(const std::filesystem::path& file, const std::string& cell) {
  const auto number = plain_number(cell);
  if (!number) throw RunError(fmt::format("{}: is damaged: \"{}\" is no number. Run the scene again", file.string(), cell));
  return *number;
}

}  // namespace

ProbeHistory read_probe_history(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    Problem problem;
    problem.key = "output.probes";
    problem.value = file.string();
    problem.rule = "must be a table of probes that a run has left";
    throw InputError(problem);
  }
  if (!std::filesystem::is_regular_file(file)) {
    throw RunError(fmt::format("{}: is damaged: it is no file. Run the scene again", file.string()));
  }
  ProbeHistory history;
  std::vector<std::vector<double>*> columns;
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  for (const std::vector<std::string>& cells : csv_rows(rows_of(text))) {
    if (columns.empty()) {
      columns.push_back(&history.times);
      for (auto name = std::next(cells.begin()); name != cells.end(); ++name) {
        const auto probe = probe_of_exact_column(*name);
        columns.push_back(probe ? &history.exact[*probe] : &history.values[*name]);
      }
      continue;
    }
    if (cells.size() != columns.size())
      throw RunError(fmt::format("{}: is damaged: rows are not equally long. Run the scene again", file.string()));
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i]->push_back(number_of(file, cells[i]));
  }
  return history;
}

ProbeHistory read_probe_history(const std::filesystem::path& file, double end) {
  ProbeHistory history = read_probe_history(file);
  if (history.times.empty() || history.times.back() != end) {
    throw RunError(fmt::format("{}: is damaged: it ends before its run did. Run the scene again", file.string()));
  }
  return history;
}

std::size_t first_compared(const ProbeHistory& history) {
  return history.times.size() > 1 ? 1 : 0;
}

std::optional<double> largest_error(const ProbeHistory& history) {
  std::optional<double> largest;
  for (const auto& [probe, exact] : history.exact) {
    const std::vector<double>& values = history.values.at(probe);
    for (std::size_t i = first_compared(history); i < exact.size(); ++i) {
      largest = std::max(largest.value_or(0), std::abs(values[i] - exact[i]));
    }
  }
  return largest;
}

}  // namespace scree::output
