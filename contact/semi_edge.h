// Semi-edges (3-D only): each joins two neighbouring semi-springs of one face and so runs beside one of its edges.
#pragma once

#include "contact/semi_spring.h"

namespace scree::contact {

// Weights of the face's corners at a place on the semi-edge beside edge `side` (from corner `side` to the next one), a
// fraction of the way from one semi-spring to the other.
inline std::array<double, 3> semi_edge_weights(int side, double along, double indentation) {
  const auto start = semi_spring_weights<3>(side, indentation);
  const auto end = semi_spring_weights<3>((side + 1) % 3, indentation);
  std::array<double, 3> weights;
  for (int i = 0; i < 3; ++i) weights[i] = (1 - along) * start[i] + along * end[i];
  return weights;
}

// The same point of the edge that a semi-edge runs beside.
inline std::array<double, 3> weights_on_edge(std::array<double, 3> weights, double indentation) {
  for (double& weight : weights) weight = (weight - indentation / 3) / (1 - indentation);
  return weights;
}

// A_SE = A_SS_i + A_SS_j, eq. (10) [m2].
inline double semi_edge_area(const Surface<3>& surface, FaceId face) {
  return 2 * semi_spring_area(surface, face);
}

}  // namespace scree::contact
