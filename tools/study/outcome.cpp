#include "tools/study/outcome.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/atomic_file.h"

namespace scree::study {

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

Json read_json(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) return {};
  Json json = Json::parse(stream, nullptr, false);
  return json.is_object() ? json : Json();
}

std::string last_line(const fs::path& log) {
  std::ifstream stream(log);
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

// What a run has said may be of any encoding, as names of files are.
void write_json(const fs::path& file, const Json& json) {
  write_text(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

bool Outcome::is_final() const {
  return status == "complete" || status == "not_settled" || status == "not_converged" || status == "bad_input";
}

Outcome read_outcome(const StudyFiles& files, const std::string& run) {
  Outcome outcome;
  outcome.summary = read_json(files.run(run).summary());
  const Json end = read_json(files.outcome(run));
  double stages = 0;
  if (!outcome.summary.is_null()) {
    outcome.status = outcome.summary.value("status", "running");
    const auto reasons = outcome.summary.value("reasons", std::vector<std::string>{});
    outcome.reason = fmt::format("{}", fmt::join(reasons, "; "));
    for (const Json& stage : outcome.summary.value("stages", Json::array())) {
      stages += stage.value("wall_seconds", 0.0);
      outcome.peak_memory_bytes = std::max(outcome.peak_memory_bytes, stage.value("peak_memory_bytes", 0.0));
    }
  }
  if (end.is_null()) {
    // Whoever started it was killed before it ended.
    if (outcome.is_final()) outcome.wall_seconds = stages;
    return outcome;
  }
  outcome.wall_seconds = end.value("wall_seconds", 0.0);
  outcome.peak_memory_bytes = std::max(outcome.peak_memory_bytes, end.value("peak_memory_bytes", 0.0));
  // The process has ended, and its summary does not know.
  if (outcome.status == "running" || outcome.status == "pending") {
    outcome.status = end.value("status", "crashed");
    outcome.reason = end.value("reason", "");
  }
  return outcome;
}

void write_outcome(const StudyFiles& files, const std::string& run, const run::ChildEnd& end) {
  Json json{{"exit_status", end.exit_status}, {"wall_seconds", end.wall_seconds}, {"peak_memory_bytes", end.peak_memory_bytes}};
  if (end.exit_status == 2) json["status"] = "bad_input";  // it leaves no summary to say so, if it was refused before its work
  const std::string said = last_line(files.log(run));
  json["reason"] = end.exit_status > 128 && end.exit_status != 130
                       ? fmt::format("ended by signal {}{}{}", end.exit_status - 128, said.empty() ? "" : ": ", said)
                       : said;
  write_json(files.outcome(run), json);
}

void write_refusal(const StudyFiles& files, const std::string& run, const std::string& reason) {
  fs::create_directories(files.run(run).directory);
  write_json(files.outcome(run), {{"status", "failed"}, {"reason", reason}});
}

}  // namespace scree::study
