// Pictures of a series, drawn without a screen.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "engine/base/geometry.h"

namespace scree::output {

struct Picture {
  std::filesystem::path series;  // the .pvd
  std::string array;             // coloured by: real values with a legend, integers (block, body) one colour each
  std::optional<double> time;    // of the frame [s], the nearest one is drawn; the last frame if not given
  std::optional<Aabb<3>> view;   // what the picture is to show; everything if not given [m]
  std::optional<double> cut;     // shows the inside: only what lies behind the plane y = this [m]
  bool lines = false;            // of a series of contacts: each as lines to the blocks it joins, by magnitude
  int width = 1200;              // [pixels]
  int height = 700;
  std::string title;                           // of the legend, with the unit; the array's name if empty
  std::optional<std::array<double, 2>> range;  // of the legend; that of the frame if not given
  double offset = 0;                           // added to every value first: -273.15 shows kelvin as degrees Celsius
};

// Draws one frame into a PNG and returns its time [s]. 3-D is seen from above at an angle, from the side of negative y; 2-D
// from the front.
// Throws InputError for an array the frame does not have, and RunError for a series that cannot be read, a picture that cannot
// be written, or a missing Xvfb.
double render(const Picture& picture, const std::filesystem::path& png);

struct Film {
  std::optional<double> duration;      // [s]; 10 s if not given, or less where frames would stand still for long
  std::function<void()> before_frame;  // may throw to stop: no file is left then
};

// Draws all frames, or as many as can be seen in the time, into a video: .webm (VP9) or .mp4 (H.264), both of which browsers
// play. One legend and one camera for all. Throws as `render` does, and RunError without ffmpeg.
void animate(const Picture& picture, const Film& film, const std::filesystem::path& video);

}  // namespace scree::output
