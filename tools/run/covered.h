// Boundaries that act on faces which lie on other blocks.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/mesh/block_mesh.h"
#include "thermal/heat_options.h"

namespace scree::run {

// Of a boundary that acts on all faces of a body.
struct CoveredBoundary {
  std::string name;
  double area = 0;          // of those faces [m2]
  double covered_area = 0;  // of it what lies on other blocks, where neither air nor sky reaches [m2]
};

// Those of which more than a thousandth is covered. `overlap_areas` is that of contact::overlap_areas.
template <int dim>
std::vector<CoveredBoundary> covered_boundaries(const mesh::BlockMesh<dim>& mesh,
                                                const std::vector<thermal::Boundary>& boundaries,
                                                const std::map<std::pair<BodyId, BodyId>, double>& overlap_areas);

}  // namespace scree::run
