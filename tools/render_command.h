// `scree render`: a picture of a run.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace scree {

struct RenderArguments {
  std::string directory;          // of the run
  std::string series = "heat";    // settle, heat or contacts
  std::string array;              // empty: what the series is looked at for
  std::string time;               // a quantity; empty: the last frame
  std::string cut;                // y of the plane in front of which nothing is drawn, a quantity; empty: no cut
  std::vector<std::string> view;  // low and high corner, six quantities; empty: everything
  bool lines = false;             // contacts as lines
  std::string animation;          // a video instead of a picture; empty: a picture
  std::string duration;           // of the animation, a quantity; empty: as suits the series
  std::string picture;            // empty: SERIES.png in the run's directory
};

void declare_render(CLI::App& command, RenderArguments& arguments);

int render_command(const RenderArguments& arguments);

}  // namespace scree
