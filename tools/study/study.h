// A study as the user wrote it: a base scene, what varies, and what is asked of every run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/check.h"

namespace scree::study {

// One value that a run may have.
struct Level {
  std::string text;              // as `--set` takes it
  std::optional<double> number;  // in SI, if it is a quantity
  SourceLocation where;
};

// What every run has otherwise than the scene.
struct Change {
  std::string assignment;  // as `--set` takes it
  SourceLocation where;
};

// All values between two, in SI.
struct Interval {
  double low = 0;
  double high = 0;
  bool logarithmic = false;
  bool whole = false;  // integers only
  std::string unit;    // of SI; empty for a plain number

  // At a fraction of the way, by the kind of spacing; of integers the nearest.
  [[nodiscard]] Level at(double fraction, const SourceLocation& where) const;
  // The one that a fraction in [0, 1) draws, each of the integers as often as the others where they are spaced evenly.
  [[nodiscard]] Level drawn(double fraction, const SourceLocation& where) const;

 private:
  [[nodiscard]] Level level_of(double value, const SourceLocation& where) const;
};

// What varies.
struct Factor {
  std::vector<std::string> keys;     // of the scene; all take the same value, and the first names the column
  std::vector<Level> levels;         // a list, or the points of a range
  std::optional<Interval> interval;  // of a range
  SourceLocation where;

  [[nodiscard]] const std::string& name() const { return keys.front(); }
};

// More would take days even of the smallest runs, and the plan alone minutes.
constexpr double most_runs = 1e5;

struct LatinHypercube {
  int points = 0;
  std::uint64_t seed = 1;
};

// A column of the table.
struct Report {
  std::string column;
  std::string path;  // in summary.json
  // Instead of the path: when the probe is at this temperature for the first time [s].
  std::string probe;
  double reaches = 0;  // [K]
  SourceLocation where;
};

struct Study {
  std::filesystem::path file;
  std::filesystem::path scene;
  std::vector<Change> changes;  // of every run
  std::vector<Factor> factors;
  std::optional<LatinHypercube> hypercube;  // nothing: every combination
  std::optional<Factor> ensemble;           // its members repeat every combination
  std::vector<Report> reports;
  bool error_estimate = false;
  std::vector<std::string> bare_values;  // sentences on its own, as Scene's on the scene's

  // Those of the factors, then the ensemble's.
  [[nodiscard]] std::vector<std::string> varied() const;
};

}  // namespace scree::study
