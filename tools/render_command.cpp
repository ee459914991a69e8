#include "tools/render_command.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/check.h"
#include "engine/base/units.h"
#include "engine/output/render.h"
#include "tools/run/interrupt.h"
#include "tools/run/output_place.h"
#include "tools/run/run_files.h"

namespace scree {

namespace {

const std::vector<std::string> series_names{"settle", "heat", "contacts"};

// What a series is looked at for, and how its legend reads.
struct Look {
  std::string array;
  std::string title;
  double offset = 0;
};

Look look_of(const RenderArguments& arguments) {
  const std::string array = !arguments.array.empty()         ? arguments.array
                            : arguments.series == "heat"     ? "temperature"
                            : arguments.series == "contacts" ? "heat_flow"
                                                             : "body";
  if (array == "temperature") return {array, "temperature [degC]", -273.15};
  if (array == "heat_flux") return {array, "heat flux [W/m2]"};
  if (array == "heat_flow") return {array, "heat flow [W]"};
  if (array == "space_error") return {array, "space error [K]"};
  if (array == "area") return {array, "area [m2]"};
  if (array == "gap") return {array, "gap [m]"};
  return {array, array};
}

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& rule) {
  Problem wrong;
  wrong.key = option;
  wrong.value = value;
  wrong.rule = rule;
  throw InputError(wrong);
}

double number(const std::string& option, const std::string& text, const Quantity& quantity) {
  const auto parsed = parse_quantity(text, quantity);
  if (const auto* problem = std::get_if<UnitProblem>(&parsed)) {
    Problem wrong;
    wrong.key = option;
    wrong.value = text;
    wrong.rule = problem->reason;
    wrong.suggestion = problem->suggestion;
    throw InputError(wrong);
  }
  return std::get<double>(parsed);
}

Aabb<3> view_of(const std::vector<std::string>& corners) {
  Aabb<3> view;
  for (std::size_t corner = 0; corner < 2; ++corner) {
    Eigen::Vector3d point;
    for (std::size_t i = 0; i < 3; ++i) {
      point[static_cast<Eigen::Index>(i)] = number("--view", corners[3 * corner + i], quantity::length);
    }
    if (corner == 1 && (point.array() <= view.max().array()).any()) {
      refuse("--view", fmt::format("{}", fmt::join(corners, " ")), "must be a low corner and a high one: x y z x y z");
    }
    view.extend(point);
  }
  return view;
}

// A run may be without settling or without heat.
void check_series(const std::filesystem::path& index) {
  std::error_code ignored;
  const auto is_there = [&](const std::string& series) {
    return std::filesystem::is_regular_file(index.parent_path() / (series + ".pvd"), ignored);
  };
  if (is_there(index.stem().string())) return;
  Problem wrong;
  wrong.key = "--series";
  wrong.value = index.stem().string();
  wrong.rule = fmt::format("must be a series of {}", index.parent_path().string());
  std::vector<std::string> others;
  std::copy_if(series_names.begin(), series_names.end(), std::back_inserter(others), is_there);
  wrong.suggestion =
      others.empty() ? "There is none: name the --out of a run" : fmt::format("There is {}", fmt::join(others, ", "));
  throw InputError(wrong);
}

// Half as many pixels as a picture, since there are many of them.
constexpr int animation_width = 840;
constexpr int animation_height = 490;

constexpr double shortest = 0.1;  // [s]; of an animation
constexpr double longest = 3600;

std::optional<double> duration_of(const RenderArguments& arguments) {
  if (arguments.duration.empty()) return std::nullopt;
  const double duration = number("--duration", arguments.duration, quantity::time);
  if (!(duration >= shortest && duration <= longest)) refuse("--duration", arguments.duration, "must be from 0.1 s to 1 h");
  return duration;
}

// Ctrl-C reaches ffmpeg, too, which then fails first.
void animate_or_stop(const output::Picture& picture, const output::Film& film, const std::string& video) {
  run::catch_interrupts();
  try {
    output::animate(picture, film, video);
  } catch (const RunError&) {
    run::check_interrupt();
    throw;
  }
}

int animate(const RenderArguments& arguments, output::Picture picture) {
  picture.width = animation_width;
  picture.height = animation_height;
  if (picture.time) refuse("--time", arguments.time, "not given with --animation, which shows all frames");
  run::check_output_place("--animation", arguments.animation, {".webm", ".mp4"});
  try {
    animate_or_stop(picture, {duration_of(arguments), run::check_interrupt}, arguments.animation);
  } catch (const run::Interrupted&) {
    fmt::print(stderr, "scree: interrupted; there is no {}\n", arguments.animation);
    return 130;
  }
  fmt::print("{}\n", arguments.animation);
  return 0;
}

}  // namespace

void declare_render(CLI::App& command, RenderArguments& arguments) {
  command.add_option("directory", arguments.directory, "the --out of a run")->required();
  command.add_option("--series", arguments.series, "settle, heat or contacts")->check(CLI::IsMember(series_names));
  command.add_option("--array", arguments.array, "what the colours show (default: temperature, heat_flow or body)");
  command.add_option("--time", arguments.time, "of the frame, such as \"2 h\" (default: the last)");
  command.add_option("--cut", arguments.cut, "leave out what is in front of this y, such as \"0 m\"");
  command.add_option("--view", arguments.view, "low and high corner of what the picture shows: x y z x y z")->expected(6);
  command.add_flag("--lines", arguments.lines,
                   "contacts as lines between their blocks, coloured by the size of their heat flow");
  CLI::Option* animation =
      command.add_option("--animation", arguments.animation, "all frames as a video instead: FILE.webm or FILE.mp4");
  command
      .add_option("--duration", arguments.duration, "of the animation, such as \"20 s\" (default: 10 s, less of few frames)")
      ->needs(animation);
  command.add_option("--picture", arguments.picture, "the PNG (default: SERIES.png in the run's directory)")
      ->excludes(animation);
}

int render_command(const RenderArguments& arguments) {
  const std::filesystem::path directory = arguments.directory;
  if (arguments.lines && arguments.series != "contacts") refuse("--lines", "given", "only with --series contacts");
  const Look look = look_of(arguments);
  output::Picture picture;
  picture.series = directory / (arguments.series + ".pvd");
  check_series(picture.series);
  picture.array = look.array;
  picture.title = look.title;
  picture.offset = look.offset;
  if (!arguments.time.empty()) {
    picture.time = number("--time", arguments.time, quantity::time);
    if (!(*picture.time >= 0)) refuse("--time", arguments.time, "must be not negative");
  }
  if (!arguments.cut.empty()) picture.cut = number("--cut", arguments.cut, quantity::length);
  if (!arguments.view.empty()) picture.view = view_of(arguments.view);
  picture.lines = arguments.lines;
  if (!arguments.animation.empty()) return animate(arguments, picture);
  const std::filesystem::path png =
      arguments.picture.empty() ? run::RunFiles{directory}.picture(arguments.series) : std::filesystem::path(arguments.picture);
  run::check_output_place("--picture", png, {".png"});
  const double drawn = output::render(picture, png);
  if (picture.time && *picture.time != drawn) {
    fmt::print(stderr, "note: the frame drawn is the nearest to {}, at {:.10g} s\n", arguments.time, drawn);
  }
  fmt::print("{}\n", png.string());
  return 0;
}

}  // namespace scree
