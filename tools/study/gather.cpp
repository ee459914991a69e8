#include "tools/study/gather.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/check.h"
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

Cell reported(const Report& report, const Outcome& outcome, const output::ProbeHistory& history) {
  if (report.probe.empty()) return cell_of(value_at(outcome.summary, report.path));
  const auto values = history.values.find(report.probe);
  if (values == history.values.end()) return {};
  return {first_time_at(history.times, values->second, report.reaches).value_or(missing)};
}

// What came of a run.
struct Result {
  Outcome outcome;
  std::vector<Cell> reported;  // of each report
};

// A complete run whose probes cannot be read is damaged: the others still make a table.
Result result_of(const Study& study, const StudyFiles& files, const std::string& run) {
  Outcome outcome = read_outcome(files, run);
  output::ProbeHistory history;
  const bool asked = std::any_of(study.reports.begin(), study.reports.end(), [](const Report& r) { return !r.probe.empty(); });
  // One that has not ended may reach a temperature yet, and one that went wrong is no measurement.
  if (asked && outcome.status == "complete") {
    try {
      history = output::read_probe_history(files.run(run).probes(), value_at(outcome.summary, "heat.time").get<double>());
    } catch (const std::exception& error) {
      outcome.status = "damaged";
      outcome.reason = fmt::format("{}. Remove runs/{} to have it made again", error.what(), run);
    }
  }
  std::vector<Cell> cells;
  for (const Report& report : study.reports) cells.push_back(reported(report, outcome, history));
  return {std::move(outcome), std::move(cells)};
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
  std::vector<Result> results;
  results.reserve(runs.size());
  for (const PlannedRun& run : runs) results.push_back(result_of(study, files, run.directory));
  Table table;
  const auto add = [&](const std::string& name, auto cell) {
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < runs.size(); ++i) cells.push_back(cell(runs[i], results[i]));
    table.columns.push_back(column_of(name, cells));
  };
  add("run", [](const PlannedRun& run, const Result&) { return Cell{static_cast<double>(run.number)}; });
  add("point", [](const PlannedRun& run, const Result&) { return Cell{static_cast<double>(run.point.number + 1)}; });
  const std::vector<std::string> varied = study.varied();
  for (std::size_t i = 0; i < varied.size(); ++i) {
    add(varied[i], [&](const PlannedRun& run, const Result&) { return cell_of(run.point.levels[i]); });
  }
  for (std::size_t i = 0; i < study.reports.size(); ++i) {
    add(study.reports[i].column, [&](const PlannedRun&, const Result& result) { return result.reported[i]; });
  }
  add("status", [](const PlannedRun&, const Result& result) { return Cell{missing, result.outcome.status, true}; });
  add("reason", [](const PlannedRun&, const Result& result) { return Cell{missing, result.outcome.reason, true}; });
  const auto positive = [](double value) { return Cell{value > 0 ? value : missing}; };
  add("wall_seconds", [&](const PlannedRun&, const Result& result) { return positive(result.outcome.wall_seconds); });
  add("peak_memory_bytes", [&](const PlannedRun&, const Result& result) { return positive(result.outcome.peak_memory_bytes); });
  add("directory", [](const PlannedRun& run, const Result&) { return Cell{missing, "runs/" + run.directory, true}; });
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
