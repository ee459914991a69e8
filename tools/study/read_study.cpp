#include "tools/study/read_study.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "engine/base/checked_input.h"
#include "engine/base/plain_path.h"
#include "tools/scene/suspicions.h"
#include "tools/study/design.h"
#include "tools/study/given_keys.h"
#include "tools/study/named_files.h"
#include "tools/study/study_keys.h"

namespace scree::study {

namespace {

namespace fs = std::filesystem;
using Problems = std::vector<Problem>;

class Reader {
 public:
  Reader(fs::path file, Problems& problems) : file_(std::move(file)), problems_(problems) {}

  Study read(const Checked& root) {
    Study study;
    study.file = file_;
    study.scene = plain_path(folder() / root.at("scene").text);
    std::error_code ignored;
    if (root.at("scene").sound && !fs::is_regular_file(study.scene, ignored)) {
      refuse(root.at("scene"), "must be a scene file that exists");
    }
    for (const Checked& change : root.at("set").items) study.changes.push_back({assignment(change), change.where});
    study.error_estimate = root.at("error_estimate").flag();
    for (const Checked& varied : root.at("vary").items) study.factors.push_back(factor(varied));
    if (const Checked* hypercube = root.find("latin_hypercube")) {
      study.hypercube =
          LatinHypercube{hypercube->at("points").integer(), static_cast<std::uint64_t>(hypercube->at("seed").number())};
    }
    if (const Checked* ensemble = root.find("ensemble")) study.ensemble = members(*ensemble);
    for (const Checked& report : root.at("report").items) study.reports.push_back(column(report));
    study.bare_values = bare_values(root);
    std::move(bare_ends_.begin(), bare_ends_.end(), std::back_inserter(study.bare_values));
    check_whole(study, root);
    return study;
  }

 private:
  void refuse(const Checked& value, const std::string& rule, const std::string& suggestion = "") {
    problems_.push_back(value.problem(value.text.empty() ? "empty" : value.text, rule, suggestion));
  }

  [[nodiscard]] fs::path folder() const { return fs::absolute(file_).parent_path(); }

  // What the scene is told: a file that a value names is relative to this one.
  [[nodiscard]] std::string told(const KeyNode& node, const std::string& value) const {
    return with_files_in(folder(), node, value);
  }

  // A scene's key that varies; refuses a path that is none.
  const KeyNode* varied_key(const Checked& path) {
    if (!path.sound) return nullptr;
    const auto found = scene_path(path.text);
    if (!found) {
      refuse(path, "must be the path of a key of the scene", suggest_path(path.text));
      return nullptr;
    }
    varied_.push_back({path.text, *found, path.where});
    return found->node;
  }

  std::string assignment(const Checked& change) {
    const auto equals = change.text.find('=');
    const std::string path = change.text.substr(0, equals);
    const auto found = equals == std::string::npos ? std::nullopt : scene_path(path);
    if (!found) {
      if (change.sound) refuse(change, "must be KEY=VALUE, with the path of a key of the scene", suggest_path(path));
      return change.text;
    }
    set_.push_back({change.text, *found, change.where});
    return fmt::format("{}={}", path, told(*found->node, change.text.substr(equals + 1)));
  }

  Factor factor(const Checked& varied) {
    Factor factor;
    factor.where = varied.where;
    factor.keys.push_back(varied.at("key").text);
    const KeyNode* node = varied_key(varied.at("key"));
    for (const Checked& other : varied.at("also").items) {
      varied_key(other);
      factor.keys.push_back(other.text);
    }
    if (const Checked* values = varied.find("values")) {
      for (const Checked& value : values->items) factor.levels.push_back(level(value, node));
    }
    const Checked* range = varied.find("range");
    if (range != nullptr && node != nullptr) read_range(*range, *node->key, factor);
    refuse_repeated(factor);
    return factor;
  }

  // The same run twice would count double in every mean.
  void refuse_repeated(const Factor& factor) {
    std::set<std::string> texts;
    std::set<double> numbers;
    for (const Level& level : factor.levels) {
      if (level.text.empty()) continue;  // no value, which is refused by itself
      const bool fresh = level.number ? numbers.insert(*level.number).second : texts.insert(level.text).second;
      if (!fresh)
        problems_.push_back({level.where, factor.keys.front(), level.text, "must not be given twice", "Take one out"});
    }
  }

  Level level(const Checked& value, const KeyNode* node) {
    Level level{value.text, std::nullopt, value.where};
    if (node == nullptr) return level;
    const Key& key = *node->key;
    level.text = told(*node, value.text);
    if (key.type == KeyType::quantity || key.type == KeyType::integer) {
      const auto parsed = parse_quantity(value.text, key.quantity);
      if (const auto* number = std::get_if<double>(&parsed)) level.number = *number;
    }
    return level;
  }

  double end_of(const Checked& end, const Key& key) {
    const auto parsed = parse_quantity(end.text, key.quantity);
    if (const auto* problem = std::get_if<UnitProblem>(&parsed)) {
      if (end.sound) refuse(end, fmt::format("{}; {}", rule_words(key, 0), problem->reason), problem->suggestion);
      return 0;
    }
    const auto value = std::get<double>(parsed);
    if (auto sentence = bare_value(end.path, end.text, value, key.quantity)) bare_ends_.push_back(std::move(*sentence));
    return value;
  }

  void read_range(const Checked& range, const Key& key, Factor& factor) {
    const std::size_t before = problems_.size();
    if (key.type != KeyType::quantity && key.type != KeyType::integer) {
      problems_.push_back(range.problem("a range", "must be values, for the key is no number"));
      return;
    }
    const Checked& from = range.at("from");
    const Checked& to = range.at("to");
    const bool logarithmic = range.at("spacing").text == "log";
    Interval interval{end_of(from, key), end_of(to, key), logarithmic, key.type == KeyType::integer,
                      std::string(key.quantity.unit)};
    if (problems_.size() > before || !from.sound || !to.sound) return;
    if (!(interval.low < interval.high)) refuse(to, fmt::format("must be above range.from, {}", from.text));
    if (logarithmic && !(interval.low > 0)) refuse(from, "must be positive where the spacing is log");
    if (problems_.size() > before) return;
    const int points = range.at("points").integer();
    for (int i = 0; i < points; ++i) factor.levels.push_back(interval.at(i / std::max(1.0, points - 1.0), range.where));
    factor.interval = interval;
  }

  Factor members(const Checked& ensemble) {
    Factor factor;
    factor.where = ensemble.where;
    factor.keys.push_back(ensemble.at("key").text);
    const KeyNode* node = varied_key(ensemble.at("key"));
    if (node != nullptr && node->key->type != KeyType::integer) {
      refuse(ensemble.at("key"), "must be a key that takes integers, such as settle.seed or bodies.NAME.random.seed");
    }
    const auto first = static_cast<std::int64_t>(ensemble.at("first").number());
    for (int i = 0; i < ensemble.at("members").integer(); ++i) {
      factor.levels.push_back({fmt::format("{}", first + i), static_cast<double>(first + i), ensemble.where});
    }
    return factor;
  }

  Report column(const Checked& item) {
    const Checked& name = item.is_map ? item.at("column") : item;
    if (name.sound && (name.text.empty() || name.text == ".")) refuse(name, "must be the name of a column");
    Report report;
    report.where = item.where;
    if (!item.is_map) {
      report.column = report.path = item.text;
      return report;
    }
    report.column = item.at("column").text;
    report.path = item.at("path").text;
    report.probe = item.at("probe").text;
    report.reaches = item.at("reaches").number();
    return report;
  }

  void check_whole(const Study& study, const Checked& root) {
    if (study.factors.empty() && !study.ensemble) {
      problems_.push_back(root.problem("without anything that varies", "must have vary, ensemble, or both"));
    }
    if (study.hypercube && study.factors.empty()) {
      problems_.push_back(root.at("latin_hypercube").problem("without use", "of use only with vary", "Take it out"));
    }
    refuse_too_many(study, root);
    for (Problem& problem : overlaps(varied_, set_)) problems_.push_back(std::move(problem));
    for (Problem& problem : repeated(set_)) problems_.push_back(std::move(problem));
    std::set<std::string> names{"run",    "point",        "directory",         "status",
                                "reason", "wall_seconds", "peak_memory_bytes", "columns"};
    for (const GivenKey& key : varied_) names.insert(key.text);
    for (const Report& report : study.reports) {
      if (!names.insert(report.column).second) {
        problems_.push_back(
            {report.where, "a column", report.column, "every column must have a name of its own", "Take one out"});
      }
      if (report.column.find('/') == std::string::npos) continue;
      problems_.push_back({report.where, "a column", report.column, "a name must not hold a slash", ""});
    }
  }

  void refuse_too_many(const Study& study, const Checked& root) {
    const double count = run_count(study);
    if (!(count > most_runs)) return;
    const Checked& varied = root.at(study.factors.empty() ? "ensemble" : "vary");
    problems_.push_back(
        varied.problem(fmt::format("{:.15g} runs", count), fmt::format("must be at most {:.0f} in all", most_runs),
                       study.hypercube ? "Take fewer points or members" : "Take fewer values, or latin_hypercube"));
  }

  fs::path file_;
  Problems& problems_;
  Sentences bare_ends_;  // of ranges, whose kind the scene's key tells
  std::vector<GivenKey> varied_;
  std::vector<GivenKey> set_;
};

}  // namespace

Study read_study(const fs::path& file) {
  Problems problems;
  const Checked root = check_input(read_yaml(file), study_keys(), 3, problems);
  Study study = Reader(file, problems).read(root);
  if (problems.empty()) return study;
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
  });
  throw InputError(std::move(problems));
}

}  // namespace scree::study
