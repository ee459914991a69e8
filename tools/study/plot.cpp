#include "tools/study/plot.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/check.h"
#include "engine/base/nearest.h"
#include "tools/run/gnuplot.h"
#include "tools/run/output_place.h"
#include "tools/study/study_files.h"

namespace scree::study {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& rule,
                         const std::string& suggestion) {
  Problem problem;
  problem.key = option;
  problem.value = value;
  problem.rule = rule;
  problem.suggestion = suggestion;
  throw InputError(problem);
}

const Column& column_of(const Table& table, const std::string& option, const std::string& name) {
  const Column* column = table.find(name);
  if (column != nullptr) return *column;
  std::vector<std::string> names;
  for (const Column& candidate : table.columns) names.push_back(candidate.name);
  refuse(option, name, "must be a column of the table", suggest(name, names));
}

const std::vector<double>& numbers_of(const Table& table, const std::string& option, const std::string& name) {
  const Column& column = column_of(table, option, name);
  if (column.is_text) refuse(option, name, "must be a column of numbers", "It may be the --series");
  return column.numbers;
}

bool has_two_at_one_x(const Series& series) {
  const auto& marks = series.marks;
  return std::adjacent_find(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.x == b.x; }) != marks.end();
}

std::string data_block(std::size_t number, const Series& series) {
  std::string text = fmt::format("$series{} << END\n", number);
  for (const Mark& mark : series.marks) text += fmt::format("{} {} {} {}\n", mark.x, mark.y, mark.low, mark.high);
  return text + "END\n";
}

std::string commands_of(const std::vector<Series>& all, const PlotArguments& arguments, const std::filesystem::path& picture) {
  std::string text = fmt::format(
      "set terminal pngcairo noenhanced size 760,520 font \"DejaVu Sans,12\" background \"white\"\n"
      "set output {}\nset border 3 linewidth 1.2 linecolor \"#404040\"\nset tics nomirror out\n"
      "set grid linetype 1 linecolor \"#dddddd\" linewidth 1\nset key outside top horizontal\n",
      run::gnuplot_text(picture.string()));
  for (const std::string& axis : arguments.log_axes) text += fmt::format("set logscale {}\n", axis);
  text += fmt::format("set xlabel {}\n", run::gnuplot_text(arguments.x_label.empty() ? arguments.x : arguments.x_label));
  text += fmt::format("set ylabel {}\n", run::gnuplot_text(arguments.y_label.empty() ? arguments.y : arguments.y_label));
  std::vector<std::string> plots;
  for (std::size_t i = 0; i < all.size(); ++i) {
    text += data_block(i, all[i]);
    const bool sure =
        std::all_of(all[i].marks.begin(), all[i].marks.end(), [](const Mark& mark) { return mark.low == mark.high; });
    // A line through points that differ in something else as well would say what nobody found.
    const std::string style =
        has_two_at_one_x(all[i]) ? (sure ? "points" : "yerrorbars") : (sure ? "linespoints" : "yerrorlines");
    plots.push_back(fmt::format("$series{} using {} with {} pointtype {} linewidth 1.6 {}", i, sure ? "1:2" : "1:2:3:4", style,
                                5 + 2 * i, all[i].name.empty() ? "notitle" : "title " + run::gnuplot_text(all[i].name)));
  }
  return text + fmt::format("plot {}\n", fmt::join(plots, ", "));
}

Table table_for(const PlotArguments& arguments) {
  const StudyFiles files{arguments.directory};
  if (std::filesystem::exists(files.ensembles_hdf5())) {
    Table ensembles = read_table(files.ensembles_hdf5());
    if (ensembles.find(arguments.y + ".mean") != nullptr) return ensembles;
  }
  return read_table(files.table_hdf5());
}

}  // namespace

std::vector<Series> series_of(const Table& table, const PlotArguments& arguments) {
  const bool means = table.find(arguments.y + ".mean") != nullptr;
  const auto& x = numbers_of(table, "--x", arguments.x);
  const auto& y = numbers_of(table, "--y", means ? arguments.y + ".mean" : arguments.y);
  const auto& low = means ? numbers_of(table, "--y", arguments.y + ".low") : y;
  const auto& high = means ? numbers_of(table, "--y", arguments.y + ".high") : y;
  const Column* by = arguments.series.empty() ? nullptr : &column_of(table, "--series", arguments.series);
  const Column* status = table.find("status");
  std::vector<Series> all;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const bool sound = status == nullptr || status->texts[row] == "complete";
    if (!sound || std::isnan(x[row]) || std::isnan(y[row])) continue;
    const std::string name = by == nullptr ? "" : fmt::format("{} {}", by->name, by->cell(row));
    auto series = std::find_if(all.begin(), all.end(), [&](const Series& one) { return one.name == name; });
    if (series == all.end()) series = all.insert(all.end(), {name, {}});
    series->marks.push_back(
        {x[row], y[row], std::isnan(low[row]) ? y[row] : low[row], std::isnan(high[row]) ? y[row] : high[row]});
  }
  for (Series& series : all) {
    std::stable_sort(series.marks.begin(), series.marks.end(), [](const Mark& a, const Mark& b) { return a.x < b.x; });
  }
  return all;
}

void declare_plot(CLI::App& command, PlotArguments& arguments) {
  command.add_option("directory", arguments.directory, "the --out of a study")->required();
  command.add_option("--x", arguments.x, "the column along the bottom, such as a key that varies")->required();
  command.add_option("--y", arguments.y, "the column to show; of an ensemble its mean with the 95 % confidence interval")
      ->required();
  command.add_option("--series", arguments.series, "a column whose values make a line each");
  command.add_option("--x-label", arguments.x_label, "instead of the column's name");
  command.add_option("--y-label", arguments.y_label, "instead of the column's name");
  command.add_option("--log", arguments.log_axes, "axes with a logarithmic scale")->check(CLI::IsMember({"x", "y"}));
  command.add_option("--picture", arguments.picture, "the PNG (default: the column's name in the study's directory)");
}

int plot_command(const PlotArguments& arguments) {
  const std::vector<Series> all = series_of(table_for(arguments), arguments);
  if (all.empty()) throw RunError(fmt::format("{}: no run is complete and has both figures", arguments.directory));
  const std::filesystem::path picture = arguments.picture.empty()
                                            ? std::filesystem::path(arguments.directory) / (arguments.y + ".png")
                                            : std::filesystem::path(arguments.picture);
  run::check_output_place("--picture", picture, {".png"});
  run::draw_by_gnuplot([&](const std::filesystem::path& output) { return commands_of(all, arguments, output); }, picture);
  fmt::print("{}\n", picture.string());
  return 0;
}

}  // namespace scree::study
