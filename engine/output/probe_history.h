// What a probes.csv holds, read back.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scree::output {

struct ProbeHistory {
  std::vector<double> times;                          // [s]
  std::map<std::string, std::vector<double>> values;  // by probe, one per time
  std::map<std::string, std::vector<double>> exact;   // by probe, of those whose exact value is known
};

// Throws InputError if there is no such table, RunError if it is damaged.
ProbeHistory read_probe_history(const std::filesystem::path& file);
// ... of a run that came to its end at `end` [s]: a table that ends before lacks what may have been reached there.
ProbeHistory read_probe_history(const std::filesystem::path& file, double end);

// The row a comparison begins with: the start, given and not computed, says nothing of a run in time.
[[nodiscard]] std::size_t first_compared(const ProbeHistory& history);

// Largest difference from the exact values over probes and times; nothing if none are known.
std::optional<double> largest_error(const ProbeHistory& history);

}  // namespace scree::output
