#include "engine/output/probe_history.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "engine/base/check.h"
#include "engine/output/probe_table.h"

namespace scree::output {

namespace {

// The cells of a line as ProbeTable writes them (RFC 4180).
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool doubled = quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (doubled) {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

}  // namespace

ProbeHistory read_probe_history(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    Problem problem;
    problem.key = "output.probes";
    problem.value = file.string();
    problem.rule = "must be a table of probes that a run has left";
    throw InputError(problem);
  }
  ProbeHistory history;
  std::vector<std::vector<double>*> columns;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (columns.empty()) {
      columns.push_back(&history.times);
      for (auto name = std::next(cells.begin()); name != cells.end(); ++name) {
        const auto probe = probe_of_exact_column(*name);
        columns.push_back(probe ? &history.exact[*probe] : &history.values[*name]);
      }
      continue;
    }
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i]->push_back(std::stod(cells.at(i)));
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
