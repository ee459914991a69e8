// What a pile is as a bulk: its porosity away from its rim, and the slope of its flanks.
#pragma once

#include <optional>

#include "engine/packing/columns.h"

namespace scree::packing {

// Where a pile is inside: on lines whose neighbours within one block's size all lie in the pile, from one block's size above
// the highest floor to one block's size below the lowest top of these.
struct InnerPorosity {
  double porosity = 0;    // void over all [-]
  double volume = 0;      // of the region: length of the lines in it, times the square of their spacing [m3]
  std::size_t lines = 0;  // that cross it
  Aabb<3> box;            // that holds it, across the vertical and along it [m]
  double margin = 0;      // distance from floor, walls and surface: one block's size [m]
};

// Nothing if the pile is too small to have an inside that is as large as a block.
std::optional<InnerPorosity> inner_porosity(const Columns& columns);

// The inner part of one line; nothing if it has none.
std::optional<Interval> inner_part(const Columns& columns, std::size_t line);

struct Repose {
  double angle = 0;  // of the mean flank against the horizontal [rad]
  double low = 0;    // heights of the mean profile between which the flank is fitted [m]
  double high = 0;
  std::size_t rings = 0;
  double fit = 0;  // part of the variance of the heights there that goes with the flank: 1 for an even round heap [-]
};

// The mean height over rings around the pile's middle, one block's size wide, and a straight line through those between a
// fifth and four fifths of the highest. Nothing for a pile that walls hold, with fewer than three rings there,
// without a fall from its middle outwards, or that is no single round heap: the fit is below a half.
std::optional<Repose> angle_of_repose(const Columns& columns);

}  // namespace scree::packing
