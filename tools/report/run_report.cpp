#include "tools/report/run_report.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/check.h"
#include "engine/output/probe_history.h"
#include "tools/report/chart.h"
#include "tools/report/page.h"
#include "tools/report/pictures.h"
#include "tools/report/settle_section.h"

namespace scree::report {

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

InputError no_run(const run::RunFiles& files) {
  Problem problem;
  problem.key = "directory";
  problem.value = files.directory.string();
  problem.rule = "that of a run, with its summary.json";
  problem.suggestion = "Run the scene first";
  return InputError(problem);
}

Json read_summary(const run::RunFiles& files) {
  Json summary = Json::parse(text_of(files.summary()), nullptr, false);
  if (summary.is_discarded() || !summary.contains("status")) throw no_run(files);
  return summary;
}

void add_head(Page& page, const Json& summary) {
  const auto status = summary.at("status").get<std::string>();
  page.paragraph(fmt::format("<span class=\"status{}\">{}</span> {} by Scree {}", status == "complete" ? "" : " bad",
                             escaped(status), escaped(text(summary, "scene")), escaped(text(summary, "version"))));
  for (const Json& reason : summary.value("reasons", Json::array())) page.paragraph(escaped(reason.get<std::string>()));
  Rows facts;
  for (const char* key : {"blocks", "elements", "nodes"}) {
    if (summary.contains(key)) facts.push_back({key, figure(summary.at(key).get<double>())});
  }
  facts.push_back({"scene hash", escaped(text(summary, "scene_hash"))});
  page.facts(facts);
}

void add_remarks(Page& page, const Json& summary) {
  if (!summary.contains("remarks")) return;
  page.heading("To know before using it");
  for (const Json& remark : summary.at("remarks")) page.paragraph(escaped(remark.get<std::string>()));
}

void add_models(Page& page, const Json& summary, const run::RunFiles& files) {
  page.heading("What was modelled, and why");
  Rows rows{{"model", "reason"}};
  for (const Json& model : summary.at("models")) {
    rows.push_back({escaped(text(model, "name")), escaped(text(model, "reason"))});
  }
  page.table(rows);
  page.folded("The scene with every default filled in", text_of(files.scene()));
}

void add_pictures(Page& page, const Json& summary, const run::RunFiles& files, Pictures pictures) {
  if (pictures == Pictures::none) return;
  const Json contacts = summary.value("contacts", Json::object());
  double count = 0;
  for (const char* kind : {"point_face", "edge_edge", "overlap"}) count += contacts.value(kind, 0.0);
  page.heading("Pictures");
  for (const Drawn& drawn : draw_pictures(files, {pictures == Pictures::animated, count > 0})) {
    page.figure_with(drawn.html, drawn.caption);
  }
}

struct TimeUnit {
  const char* name;
  double seconds;
};

TimeUnit unit_for(double longest) {
  if (longest > 3 * 3600) return {"h", 3600};
  if (longest > 600) return {"min", 60};
  return {"s", 1};
}

void add_probes(Page& page, const Json& summary, const run::RunFiles& files) {
  if (!std::filesystem::exists(files.probes())) return;
  const bool ended = summary.contains("heat");
  const output::ProbeHistory history = ended ? output::read_probe_history(files.probes(), number(summary.at("heat"), "time"))
                                             : output::read_probe_history(files.probes());
  if (history.times.empty()) return;
  const TimeUnit unit = unit_for(history.times.back());
  Chart chart;
  chart.x_label = fmt::format("time [{}]", unit.name);
  chart.y_label = "temperature [degC]";
  const auto add = [&](const std::string& name, const std::vector<double>& kelvin, bool dashed) {
    Curve curve;
    curve.name = name;
    curve.dashed = dashed;
    for (const double time : history.times) curve.x.push_back(time / unit.seconds);
    for (const double value : kelvin) curve.y.push_back(value - 273.15);
    chart.curves.push_back(curve);
  };
  chart.points = history.times.size() == 1;  // no line to draw
  for (const auto& [name, values] : history.values) add(name, values, false);
  for (const auto& [name, values] : history.exact) add(name + ", exact", values, true);
  page.heading("Temperature at the probes");
  page.figure_with(to_svg(chart), "Probes over time");
}

void add_ledger(Page& page, const Json& heat) {
  page.heading("Energy ledger");
  const Json& ledger = heat.at("ledger");
  const bool steady = heat.value("steady", false);
  Rows rows{{"heat into the blocks", steady ? "W" : "J"}};
  for (const auto& [kind, name] : {std::pair("by_boundary", "boundary"), std::pair("by_applied", "applied"),
                                   std::pair("by_surroundings", "surroundings")}) {
    for (const auto& [key, value] : ledger.at(kind).items()) {
      rows.push_back({fmt::format("{}: {}", name, escaped(key)), figure(value.get<double>())});
    }
  }
  if (!steady) {
    rows.push_back({"jump of boundaries at the start", figure(number(ledger, "start_jump"))});
    rows.push_back({"stored in the blocks", figure(number(ledger, "stored"))});
  }
  rows.push_back({"missing", figure(number(ledger, "residual"))});
  page.table(rows);
  page.paragraph(fmt::format("Missing, relative to the heat that flowed: {}.", figure(number(heat, "ledger_residual"))));
}

void add_errors(Page& page, const Json& heat) {
  page.heading("Errors");
  Rows rows{{"of what", "how much", "against"}};
  if (!heat.value("steady", false)) {
    rows.push_back({"time steps, estimated", figure(number(heat, "time_error")) + " K",
                    "tolerance " + figure(number(heat, "tolerance")) + " K"});
  }
  if (heat.contains("space_error")) {
    rows.push_back({"mesh, estimated, largest of an element", figure(number(heat.at("space_error"), "largest")) + " K", ""});
  }
  if (heat.contains("lumped_blocks")) {
    const Json& lumped = heat.at("lumped_blocks");
    rows.push_back({"one temperature in " + figure(number(lumped, "count")) + " blocks, estimated",
                    figure(number(lumped, "error")) + " K", "Biot numbers up to " + figure(number(lumped, "largest_biot"))});
  }
  if (heat.contains("exact_error")) {
    rows.push_back({"at the probes, true", figure(number(heat, "exact_error")) + " K", "the exact solution the scene names"});
  }
  if (heat.contains("overshoot")) {
    rows.push_back({"beyond the range of what is given", figure(number(heat, "overshoot")) + " K", "maximum principle"});
  }
  page.table(rows);
  page.facts({{"steps", figure(number(heat, "steps"))},
              {"rejected", figure(number(heat, "rejected_steps"))},
              {"factorisations", figure(number(heat, "factorisations"))},
              {"solver", escaped(text(heat, "solver"))}});
}

void add_joints(Page& page, const Json& summary) {
  if (!summary.contains("joints") || summary.at("joints").empty()) return;
  page.heading("Joints");
  Rows rows{
      {"between", "law", "contacts", "h [W/m2/K]", "Biot", "net flow [W]", "all flows [W]", "touching [m2]", "overlap [m2]"}};
  for (const Json& joint : summary.at("joints")) {
    const double contacts = number(joint, "point_face") + number(joint, "edge_edge") + number(joint, "overlap");
    rows.push_back({escaped(text(joint, "first") + " - " + text(joint, "second")), escaped(text(joint, "law")),
                    figure(contacts), value_or(joint, "joint_conductance", "no end"), value_or(joint, "biot", "-"),
                    figure(number(joint, "flow")), figure(number(joint, "absolute_flow")),
                    figure(number(joint, "touching_area")), figure(number(joint, "overlap_area"))});
  }
  page.table(rows);
}

void add_effective(Page& page, const Json& summary) {
  if (!summary.contains("effective_conductivity")) return;
  page.heading("Effective conductivity");
  Rows rows;
  for (const auto& [key, value] : summary.at("effective_conductivity").items()) {
    rows.push_back({escaped(key), escaped(value.dump())});
  }
  page.facts(rows);
}

void add_stages(Page& page, const Json& summary) {
  page.heading("Cost of the stages");
  double longest = 0;
  for (const Json& stage : summary.value("stages", Json::array())) longest = std::max(longest, number(stage, "wall_seconds"));
  Rows rows{{"stage", "wall time [s]", "peak memory [MB]", ""}};
  for (const Json& stage : summary.value("stages", Json::array())) {
    const double seconds = number(stage, "wall_seconds");
    rows.push_back(
        {escaped(text(stage, "name")), fmt::format("{:.3f}", seconds),
         fmt::format("{:.1f}", number(stage, "peak_memory_bytes") / 1e6),
         fmt::format(R"(<span class="bar" style="width:{:.0f}px"></span>)", longest > 0 ? 240 * seconds / longest : 0)});
  }
  page.table(rows);
}

std::string page_of(const Json& summary, const run::RunFiles& files, Pictures pictures) {
  const std::string title = text(summary, "title");
  Page page(title.empty() ? files.directory.filename().string() : title);
  add_head(page, summary);
  add_remarks(page, summary);
  add_models(page, summary, files);
  add_pictures(page, summary, files, pictures);
  add_probes(page, summary, files);
  if (summary.contains("settle")) add_settle(page, summary.at("settle"));
  if (summary.contains("heat")) {
    add_ledger(page, summary.at("heat"));
    add_errors(page, summary.at("heat"));
  }
  add_joints(page, summary);
  add_effective(page, summary);
  add_stages(page, summary);
  return page.html();
}

}  // namespace

std::string run_page(const run::RunFiles& files, Pictures pictures) {
  try {
    return page_of(read_summary(files), files, pictures);
  } catch (const Json::exception&) {
    throw no_run(files);  // of which nobody knows what its summary says
  }
}

}  // namespace scree::report
