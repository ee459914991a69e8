#include "tools/study/plan.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "engine/base/nearest.h"
#include "tools/run/keys.h"
#include "tools/scene/read_scene.h"

namespace scree::study {

namespace {

std::vector<std::string> overrides_of(const Study& study, const Point& point) {
  std::vector<std::string> overrides;
  for (const Change& change : study.changes) overrides.push_back(change.assignment);
  for (std::size_t i = 0; i < study.factors.size(); ++i) {
    for (const std::string& key : study.factors[i].keys) overrides.push_back(key + "=" + point.levels[i].text);
  }
  if (study.ensemble) overrides.push_back(study.ensemble->name() + "=" + point.levels.back().text);
  return overrides;
}

// What the scene says of a value that a run has changed stands where the study gives that value.
SourceLocation place_in_study(const Study& study, const Point& point, const SourceLocation& where) {
  const auto is_of = [&](const std::string& key) { return where.file == "--set " + key; };
  for (std::size_t i = 0; i < study.factors.size(); ++i) {
    const auto& keys = study.factors[i].keys;
    if (std::any_of(keys.begin(), keys.end(), is_of)) return point.levels[i].where;
  }
  if (study.ensemble && is_of(study.ensemble->name())) return study.ensemble->where;
  const auto sets = [&](const Change& change) {
    return where.file == "--set " + change.assignment.substr(0, change.assignment.find('='));
  };
  const auto change = std::find_if(study.changes.begin(), study.changes.end(), sets);
  return change == study.changes.end() ? where : change->where;
}

// Collects what is wrong with the runs, each thing once.
class Complaints {
 public:
  explicit Complaints(const Study& study) : study_(study) {}

  void add(const Point& point, const InputError& error) {
    for (Problem problem : error.problems()) {
      problem.where = place_in_study(study_, point, problem.where);
      add(std::move(problem));
    }
  }

  void add(Problem problem) {
    if (seen_.insert(to_string(problem)).second) problems_.push_back(std::move(problem));
  }

  void raise() {
    if (!problems_.empty()) throw InputError(problems_);
  }

 private:
  const Study& study_;
  std::set<std::string> seen_;
  std::vector<Problem> problems_;
};

Problem problem_of(const Report& report, std::string value, std::string rule, std::string suggestion) {
  return {report.where, "report", std::move(value), std::move(rule), std::move(suggestion)};
}

bool starts_with_part(const std::string& path, const std::string& part) {
  return path == part || path.starts_with(part + ".");
}

// What a run of this scene will have to report; the rest of a path shows in the first summary.
void check_reports(const Study& study, const Scene& scene, Complaints& complaints) {
  std::vector<std::string> probes;
  for (const auto& probe : scene.probes) probes.push_back(probe.name);
  const std::vector<std::string> parts{"status",         "version", "title",  "models",     "blocks",
                                       "elements",       "nodes",   "settle", "contacts",   "joints",
                                       "heat",           "stages",  "scene",  "scene_hash", "effective_conductivity",
                                       "error_estimate", "remarks"};
  for (const Report& report : study.reports) {
    const std::string heat_probe = "heat.probes.";
    std::string probe = report.probe;
    if (report.path.starts_with(heat_probe)) {
      probe = report.path.substr(heat_probe.size(), report.path.find('.', heat_probe.size()) - heat_probe.size());
    }
    if (!probe.empty() && std::find(probes.begin(), probes.end(), probe) == probes.end()) {
      complaints.add(problem_of(report, probe, "must be a probe of the scene", suggest(probe, probes)));
      continue;
    }
    if (!report.probe.empty()) {
      if (scene.heat->time.steady) {
        complaints.add(problem_of(report, report.column, "of use only over time, which a steady scene does without",
                                  fmt::format("Ask for heat.probes.{}.temperature instead", report.probe)));
      }
      continue;
    }
    const auto known = [&](const std::string& part) { return starts_with_part(report.path, part); };
    const std::string first = report.path.substr(0, report.path.find('.'));
    if (!scene.heat && (known("heat") || known("joints") || known("contacts") || known("effective_conductivity"))) {
      complaints.add(problem_of(report, report.path, "of use only with heat", "Take it out, or heat the scene"));
    } else if (!scene.settle && !scene.packing && known("settle")) {
      complaints.add(problem_of(report, report.path, "of use only with blocks that fall", "Take it out"));
    } else if (known("effective_conductivity") && !scene.effective_window) {
      complaints.add(problem_of(report, report.path, "of use only with heat.effective_conductivity", "Ask for it with set"));
    } else if (std::none_of(parts.begin(), parts.end(), known)) {
      complaints.add(problem_of(report, report.path, "must be a path in summary.json", suggest(first, parts)));
    }
  }
}

// Two values that give the same run, such as a default and null: it would stand in the table twice and count double.
Problem same_run(const Study& study, const Point& first, const Point& again) {
  std::size_t i = 0;
  while (again.levels[i].text == first.levels[i].text) ++i;
  return {again.levels[i].where, study.varied()[i], again.levels[i].text,
          fmt::format("must make another run than {}, which means the same here", first.levels[i].text), "Take one out"};
}

}  // namespace

std::vector<PlannedRun> plan(const Study& study) {
  Complaints complaints(study);
  std::vector<PlannedRun> runs;
  std::map<std::string, std::size_t> made;  // the first run of each directory
  for (Point& point : points_of(study)) {
    PlannedRun run;
    run.number = static_cast<int>(runs.size()) + 1;
    run.overrides = overrides_of(study, point);
    try {
      const Scene scene = read_scene(study.scene, run.overrides);
      check_reports(study, scene, complaints);
      run.directory = run::run_key(scene, study.error_estimate);
      if (scene.settle) run.packing = run::fall_key(scene);
      run.bare_values = scene.bare_values;
    } catch (const InputError& error) {
      complaints.add(point, error);
    }
    run.point = std::move(point);
    if (!run.directory.empty()) {
      const auto [first, fresh] = made.emplace(run.directory, runs.size());
      if (!fresh) complaints.add(same_run(study, runs[first->second].point, run.point));
    }
    runs.push_back(std::move(run));
  }
  complaints.raise();
  return runs;
}

}  // namespace scree::study
