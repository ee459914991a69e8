// Where to stand to see given points.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scree::output {

struct Camera {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();    // [m]
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();  // in the middle of the picture [m]
  Eigen::Vector3d up = Eigen::Vector3d::Zero();     // unit
};

struct Lens {
  double angle = 25;     // of the view, vertical [degrees]
  double aspect = 1;     // width over height
  double margin = 1.06;  // distance over the nearest that shows everything
};

// The nearest camera in direction `back` (from the points towards the eye) that shows all points, in the middle. `vertical`
// points up in the picture.
Camera aim(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& back, const Eigen::Vector3d& vertical,
           const Lens& lens);

}  // namespace scree::output
