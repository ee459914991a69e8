// Which boxes are near each other.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "engine/base/geometry.h"

namespace scree::packing {

// Calls `found` once for every two boxes that are no further apart than `range` [m] along any axis, or, if it is negative, that
// overlap by as much along every axis; in no order that means anything. By strips of space: time goes with the number of boxes
// to the power of 4/3.
template <int dim>
void for_near_boxes(const std::vector<Aabb<dim>>& boxes, double range,
                    const std::function<void(std::size_t, std::size_t)>& found);

}  // namespace scree::packing
