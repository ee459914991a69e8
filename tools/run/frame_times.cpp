#include "tools/run/frame_times.h"

#include <algorithm>
#include <cmath>

namespace scree::run {

// A scene may give the two in units in which they are multiples of each other only nearly (read_frames_every).
FrameTimes::FrameTimes(const Scene& scene)
    : every_(scene.frames_every > 0 ? scene.heat->time.output_every : 0),
      until_(scene.heat->time.until),
      stride_(every_ > 0 ? std::max(1.0, std::round(scene.frames_every / every_)) : 1) {}

double FrameTimes::number_of(double time) const {
  return std::round(time / every_);
}

bool FrameTimes::due(double time) const {
  return every_ == 0 || time >= until_ || std::fmod(number_of(time), stride_) == 0;
}

double FrameTimes::last(double time) const {
  if (due(time)) return time;
  return std::floor(number_of(time) / stride_) * stride_ * every_;
}

}  // namespace scree::run
