// Few points that integrate over a polygon what is quadratic.
#pragma once

#include "contact/polygon.h"

namespace scree::contact {

// Places of equal weight, within the polygon, that integrate quadratic functions exactly, and its length (3-D: twice its area).
template <int dim>
struct Quadrature {
  std::array<Seen<dim>, dim> places;
  double size = 0;
};

Quadrature<2> quadrature(const Polygon<2>& segment);
Quadrature<3> quadrature(const Polygon<3>& polygon);

}  // namespace scree::contact
