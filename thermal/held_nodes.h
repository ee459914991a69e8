// Which condition holds each node.
#pragma once

#include <vector>

#include "thermal/heat_model.h"

namespace scree::thermal {

// One entry per node: which of the model's holds, -1 where it is free.
inline std::vector<int> holds_of_nodes(const HeatModel& model) {
  std::vector<int> holds(static_cast<std::size_t>(model.capacity.size()), -1);
  for (std::size_t i = 0; i < model.fixed_nodes.size(); ++i) holds[model.fixed_nodes[i].index()] = model.fixed_hold[i];
  return holds;
}

}  // namespace scree::thermal
