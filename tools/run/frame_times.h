// Which outputs of the heat stage are frames.
#pragma once

#include "tools/scene/scene.h"

namespace scree::run {

// Every so many outputs, as often as output.frames_every is output.every, and the end.
class FrameTimes {
 public:
  explicit FrameTimes(const Scene& scene);

  // At an output [s].
  [[nodiscard]] bool due(double time) const;
  // That of the last frame which is due at an output or before it [s].
  [[nodiscard]] double last(double time) const;

 private:
  [[nodiscard]] double number_of(double time) const;  // of an output

  double every_;   // 0: every output is a frame [s]
  double until_;   // [s]
  double stride_;  // in outputs
};

}  // namespace scree::run
