#include "tools/accuracy/report.h"

#include <algorithm>

#include <fmt/format.h>

#include "tools/run/gnuplot.h"

namespace scree::accuracy {

namespace {

std::string error_text(const std::optional<double>& error) {
  return error ? fmt::format("{:.6g}", *error) : std::string("nan");
}

std::string word(const std::string& model) {
  return model.empty() ? "-" : model;
}

// Both panels, the runs that no other beats filled. Of the table {csv} and for the picture {picture}.
constexpr const char* plot = R"(set terminal pngcairo size 1200,520 font "DejaVu Sans,12" background "white"
set output {picture}
set datafile separator comma
set logscale xy
set format y "10^{{%T}}"
set border 3 linewidth 1.2 linecolor "#404040"
set tics nomirror out
set grid linetype 1 linecolor "#dddddd" linewidth 1
set ylabel "largest error at the probes [K]"
set key bottom left
set multiplot layout 1,2
set xlabel "wall time of contacts, assembly and heat [s]"
plot {csv} using (strcol(17) eq "1" ? $9 : NaN):14 with points pointtype 7 pointsize 1.4 linecolor "#c23b22" title "no run is faster and better", \
     {csv} using (strcol(17) eq "0" ? $9 : NaN):14 with points pointtype 6 pointsize 1.2 linecolor "#3d4a8f" title "beaten"
set xlabel "nodes"
stats {csv} using ($6 > 0 ? $6 : NaN) nooutput
set xrange [10**floor(log10(STATS_min)) : 10**(floor(log10(STATS_max)) + 1)]  # they may all be the same
plot {csv} using ($6 > 0 ? $6 : NaN):14 with points pointtype 7 pointsize 1.2 linecolor "#3d4a8f" notitle
unset multiplot
)";

}  // namespace

std::string to_csv(const std::vector<Measured>& runs) {
  std::string csv =
      "mesh_factor,tolerance,integrator,contact_model,block_model,nodes,elements,steps,wall_seconds,whole_wall_seconds,"
      "peak_memory_bytes,time_error,lumping_error,max_error,rms_error,exit_status,on_front\n";
  for (const Measured& run : runs) {
    csv += fmt::format("{:g},{:g},{},{},{},{},{},{},{:.4f},{:.4f},{:.0f},{:.6g},{:.6g},{},{},{},{}\n", run.rung.mesh_factor,
                       run.rung.tolerance, run.rung.integrator, run.rung.contact_model, run.rung.block_model, run.nodes,
                       run.elements, run.steps, run.wall_seconds, run.whole_wall_seconds, run.peak_memory_bytes, run.time_error,
                       run.lumping_error, error_text(run.max_error), error_text(run.rms_error), run.exit_status,
                       run.on_front ? 1 : 0);
  }
  return csv;
}

std::string to_text(const std::vector<Measured>& runs, const std::vector<Order>& orders, const std::string& reference) {
  std::string text = reference.empty() ? "errors are not known: the finest run, which would tell them, was not made\n"
                                       : fmt::format("errors against {}\n", reference);
  text += fmt::format("{:>6} {:>10} {:>15} {:>12} {:>7} {:>9} {:>7} {:>9} {:>11} {:>11} {:>11}\n", "mesh", "tolerance",
                      "integrator", "contacts", "blocks", "nodes", "steps", "wall s", "time err K", "lump err K", "max err K");
  for (const Measured& run : runs) {
    text += fmt::format("{:>6g} {:>10g} {:>15} {:>12} {:>7} {:>9} {:>7} {:>9.3f} {:>11.3g} {:>11} {:>11} {}\n",
                        run.rung.mesh_factor, run.rung.tolerance, run.rung.integrator, word(run.rung.contact_model),
                        word(run.rung.block_model), run.nodes, run.steps, run.wall_seconds, run.time_error,
                        run.lumping_error > 0 ? fmt::format("{:.3g}", run.lumping_error) : "-",
                        run.max_error                   ? fmt::format("{:.3g}", *run.max_error)
                        : run.ran && !reference.empty() ? "reference"
                                                        : "-",
                        run.exit_status != 0 ? fmt::format("exit {}", run.exit_status)
                        : run.on_front       ? "*"
                                             : "");
  }
  text += "* no other run is both faster and more accurate\n";
  for (const Order& order : orders) text += fmt::format("observed order in {}: {:.2f} ({})\n", order.of, order.order, order.at);
  return text;
}

bool draw(const std::vector<Measured>& runs, const std::filesystem::path& csv, const std::filesystem::path& picture) {
  const auto has_a_place = [](const Measured& run) { return run.nodes > 0 && run.max_error.value_or(0) > 0; };
  if (std::none_of(runs.begin(), runs.end(), has_a_place)) return false;
  const auto commands_for = [&](const std::filesystem::path& output) {
    return fmt::format(plot, fmt::arg("csv", run::gnuplot_text(csv.string())),
                       fmt::arg("picture", run::gnuplot_text(output.string())));
  };
  run::draw_by_gnuplot(commands_for, picture);
  return true;
}

}  // namespace scree::accuracy
