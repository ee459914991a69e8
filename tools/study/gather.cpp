#include "tools/study/gather.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/nearest.h"
#include "engine/output/probe_history.h"
#include "tools/study/first_time.h"
#include "tools/study/outcome.h"
#include "tools/study/summary_value.h"

namespace scree::study {

namespace {

using Json = nlohmann::json;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// What one column holds in one row.
struct Cell {
  double number = missing;
  std::string text = {};
  bool is_text = false;
};

Cell cell_of(const Json& value) {
  if (value.is_number()) return {value.get<double>()};
  if (value.is_boolean()) return {value.get<bool>() ? 1.0 : 0.0};
  if (value.is_null()) return {};
  return {missing, value.is_string() ? value.get<std::string>() : value.dump(), true};
}

Cell cell_of(const Level& level) {
  if (level.number) return {*level.number};
  return {missing, level.text, true};
}

Cell reported(const Report& report, const Outcome& outcome, const run::RunFiles& files) {
  if (report.probe.empty()) return cell_of(value_at(outcome.summary, report.path));
  // A run that has not ended may reach it yet, and one that went wrong is no measurement.
  if (outcome.status != "complete") return {};
  const output::ProbeHistory history = output::read_probe_history(files.probes());
  const auto values = history.values.find(report.probe);
  if (values == history.values.end()) return {};
  return {first_time_at(history.times, values->second, report.reaches).value_or(missing)};
}

// Numbers, unless a row has a text.
Column column_of(const std::string& name, const std::vector<Cell>& cells) {
  Column column{name};
  column.is_text = std::any_of(cells.begin(), cells.end(), [](const Cell& cell) { return cell.is_text; });
  for (const Cell& cell : cells) {
    if (column.is_text) {
      column.texts.push_back(cell.is_text || std::isnan(cell.number) ? cell.text : fmt::format("{}", cell.number));
    } else {
      column.numbers.push_back(cell.number);
    }
  }
  return column;
}

}  // namespace

Table gather(const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files) {
  std::vector<Outcome> outcomes;
  outcomes.reserve(runs.size());
  for (const PlannedRun& run : runs) outcomes.push_back(read_outcome(files, run.directory));
  Table table;
  const auto add = [&](const std::string& name, auto cell) {
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < runs.size(); ++i) cells.push_back(cell(runs[i], outcomes[i]));
    table.columns.push_back(column_of(name, cells));
  };
  add("run", [](const PlannedRun& run, const Outcome&) { return Cell{static_cast<double>(run.number)}; });
  add("point", [](const PlannedRun& run, const Outcome&) { return Cell{static_cast<double>(run.point.number + 1)}; });
  const std::vector<std::string> varied = study.varied();
  for (std::size_t i = 0; i < varied.size(); ++i) {
    add(varied[i], [&](const PlannedRun& run, const Outcome&) { return cell_of(run.point.levels[i]); });
  }
  for (const Report& report : study.reports) {
    add(report.column,
        [&](const PlannedRun& run, const Outcome& outcome) { return reported(report, outcome, files.run(run.directory)); });
  }
  add("status", [](const PlannedRun&, const Outcome& outcome) { return Cell{missing, outcome.status, true}; });
  add("reason", [](const PlannedRun&, const Outcome& outcome) { return Cell{missing, outcome.reason, true}; });
  const auto positive = [](double value) { return Cell{value > 0 ? value : missing}; };
  add("wall_seconds", [&](const PlannedRun&, const Outcome& outcome) { return positive(outcome.wall_seconds); });
  add("peak_memory_bytes", [&](const PlannedRun&, const Outcome& outcome) { return positive(outcome.peak_memory_bytes); });
  add("directory", [](const PlannedRun& run, const Outcome&) { return Cell{missing, "runs/" + run.directory, true}; });
  return table;
}

std::vector<std::string> paths_not_found(const Study& study, const std::vector<PlannedRun>& runs, const StudyFiles& files) {
  std::vector<Json> summaries;
  for (const PlannedRun& run : runs) {
    Outcome outcome = read_outcome(files, run.directory);
    if (outcome.status == "complete") summaries.push_back(std::move(outcome.summary));
  }
  std::vector<std::string> sentences;
  if (summaries.empty()) return sentences;
  for (const Report& report : study.reports) {
    // A figure that is null is there: it says that this run has none.
    const auto has = [&](const Json& summary) {
      const auto known = leaves(summary);
      return !value_at(summary, report.path).is_null() || std::find(known.begin(), known.end(), report.path) != known.end();
    };
    if (report.path.empty() || std::any_of(summaries.begin(), summaries.end(), has)) continue;
    const auto close = nearest(report.path, leaves(summaries.front()));
    sentences.push_back(fmt::format("{}: report: {} is in no summary.json{}", to_string(report.where), report.path,
                                    close ? fmt::format(". Did you mean {}?", *close) : ""));
  }
  return sentences;
}

Standing standing_of(const Table& table) {
  Standing standing;
  for (const std::string& status : table.find("status")->texts) {
    if (status == "complete") {
      ++standing.complete;
    } else if (status == "pending" || status == "running" || status == "interrupted") {
      ++standing.open;
    } else {
      ++standing.unsound;
    }
  }
  return standing;
}

}  // namespace scree::study
