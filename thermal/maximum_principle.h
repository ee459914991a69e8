// Where temperatures may leave the range of what drives them.
//
// Lumped implicit Euler steps keep every temperature between those of its neighbours if K_ij <= 0 for all i != j (Thomee 2006,
// Galerkin Finite Element Methods for Parabolic Problems, section 15). An obtuse angle between two faces of an element, a
// joint, which couples the corners of one face with each other, and a conductivity that differs along its axes can make K_ij
// positive: heat then flows from the colder to the warmer node of such a pair.
#pragma once

#include <cstdint>

#include "thermal/heat_model.h"

namespace scree::thermal {

struct MaximumPrinciple {
  std::int64_t pairs = 0;     // of nodes that exchange heat
  std::int64_t reversed = 0;  // of them with K_ij > 0
  double largest = 0;         // of K_ij/sqrt(K_ii K_jj) among those [-]
};

// Of everything that conducts, with varying conductivities at 1 W/m/K. Entries within rounding of 0 count as none.
MaximumPrinciple maximum_principle(const HeatModel& model);

}  // namespace scree::thermal
