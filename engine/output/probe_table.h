// The table of probe values that grows with a run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::output {

// How the column of a probe's exact value is called, and back: nothing for any other column.
std::string exact_column(const std::string& probe);
std::optional<std::string> probe_of_exact_column(const std::string& column);

// probes.csv: comment lines (#) that say in which block each probe lies and where, then a header, `time` and a column per probe
// named after it, then a row per time. Numbers are in their shortest form that reads back to the same double; a name with a
// comma or quote is quoted (RFC 4180). Rows are flushed one by one.
class ProbeTable {
 public:
  // A new table; an older one of that name is replaced. Throws RunError.
  ProbeTable(std::filesystem::path file, const std::vector<std::string>& comments, const std::vector<std::string>& names);
  // Goes on with the table of an interrupted run: keeps the rows up to and including the one at `keep_until` [s] and drops the
  // later ones, a half-written last one included. Throws RunError if there is no such table, or it lacks its head or that row.
  ProbeTable(std::filesystem::path file, const std::vector<std::string>& comments, const std::vector<std::string>& names,
             double keep_until);

  // Adds a row for `time` [s]. Throws RunError (disk full) and leaves the table as it was.
  void append(double time, const std::vector<double>& values);

 private:
  std::filesystem::path file_;
};

}  // namespace scree::output
