// Semi-springs: the points through which a boundary face feels the blocks around it (Li & Feng 2016, section 1.4).
//
// Every face has one per corner, moved from the corner towards the face's centre, so that it lies inside the face and not on
// an edge where several faces are equally close.
#pragma once

#include "contact/surface.h"

namespace scree::contact {

// Weights of the face's corners at the semi-spring of one of them.
template <int dim>
std::array<double, dim> semi_spring_weights(int corner, double indentation) {
  std::array<double, dim> weights;
  weights.fill(indentation / dim);
  weights[corner] += 1 - indentation;
  return weights;
}

// Of the semi-spring of each corner.
template <int dim>
std::array<std::array<double, dim>, dim> all_semi_spring_weights(double indentation) {
  std::array<std::array<double, dim>, dim> weights;
  for (int corner = 0; corner < dim; ++corner) weights[corner] = semi_spring_weights<dim>(corner, indentation);
  return weights;
}

// A_SS = A_face / N_vertices, eq. (9), of a triangle or edge [m2]; those of quadrilaterals follow (both_diagonals.h).
template <int dim>
double semi_spring_area(const Surface<dim>& surface, FaceId face) {
  return surface.areas[face] / dim;
}

}  // namespace scree::contact
