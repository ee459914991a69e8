// Is the pile at rest?
#pragma once

#include <string>
#include <vector>

#include <LinearMath/btTransform.h>

#include "engine/rigid/damping.h"

namespace scree::rigid {

double kinetic_energy(const btRigidBody& body, double mass);  // rotation included [J]

// Whether a window of this length is over; times are sums of steps.
inline bool is_over(double passed, double window) {
  return passed >= window * (1 - 5e-7);
}

// How far the points of a block may move in a window of rest: a part of the mean edge, or of the block's own width where that
// is less, so that a pebble beside a boulder is not still by the boulder's measure.
class AllowedWay {
 public:
  AllowedWay(double part, double mean_edge) : part_(part), mean_edge_(mean_edge) {}

  double operator()(const World& world, BlockId block) const;  // [m]
  [[nodiscard]] double part() const { return part_; }
  [[nodiscard]] double largest() const { return part_ * mean_edge_; }  // [m]

 private:
  double part_, mean_edge_;
};

// What one step tells about the state of motion.
struct Motion {
  double rms_speed = 0;   // sqrt(2 kinetic energy / mass), rotation included [m/s]
  double max_speed = 0;   // of any point of a block [m/s]
  double unbalanced = 0;  // mean net force on a block over mean force of a touching pair [-]
};

Motion observe_motion(const World& world, const Damping& damping, double time_step);

// Looks at consecutive windows of time: a window is one of rest if in every step of it the speed and the unbalanced force were
// below their limits and no block was further than allowed from where it was as the window began.
class RestWatch {
 public:
  RestWatch(const World& world, const SettleOptions& options, double mean_edge, double time);

  // True if a window of rest has just ended.
  bool observe(const World& world, const Motion& motion, double time);

  [[nodiscard]] double window() const { return window_; }              // length of the last whole one [s]
  [[nodiscard]] double displacement() const { return displacement_; }  // largest way of a block in it [m]
  [[nodiscard]] std::string criterion() const;
  [[nodiscard]] std::string obstacle() const;  // what the last whole window lacked

 private:
  struct Furthest {  // by what it may move
    BlockId block;
    double way = 0;           // [m]
    double over_allowed = 0;  // [-]
  };
  void begin(const World& world, double time);
  [[nodiscard]] bool quiet() const;  // but for ways
  void look_for_ways(const World& world);

  double rest_speed_, rest_unbalanced_, rest_window_;
  AllowedWay allowed_;
  double since_ = 0;
  Motion largest_;                  // of the window so far, each for itself
  Motion last_;                     // of the last whole one
  bool lost_some_ = false;          // in the last whole one
  Furthest last_furthest_;          // in the last whole one
  std::vector<btTransform> poses_;  // of the free bodies at the beginning of the window
  std::vector<BlockId> blocks_;
  double way_ = 0;     // of a block in the window so far, the largest [m]
  Furthest furthest_;  // in the window so far
  double window_ = 0;
  double displacement_ = 0;
};

}  // namespace scree::rigid
