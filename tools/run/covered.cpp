#include "tools/run/covered.h"

#include <algorithm>

#include "engine/mesh/cells.h"

namespace scree::run {

namespace {

constexpr double least_part = 1e-3;  // of its area: blocks that touch in points and edges only cover less

template <int dim>
Table<BodyId, double> body_areas(const mesh::BlockMesh<dim>& mesh) {
  Table<BodyId, double> areas(mesh.bodies.size(), 0.0);
  for (const mesh::WeightedFace<dim>& face : mesh::weighted_faces(mesh)) {
    areas[mesh.blocks[face.block].body] += face.weight * mesh::face_area<dim>(mesh, face);
  }
  return areas;
}

bool acts_on_all_faces(const thermal::Boundary& boundary) {
  return !boundary.region.within && !boundary.region.surface &&
         !std::holds_alternative<thermal::FixedTemperature>(boundary.condition);
}

}  // namespace

template <int dim>
std::vector<CoveredBoundary> covered_boundaries(const mesh::BlockMesh<dim>& mesh,
                                                const std::vector<thermal::Boundary>& boundaries,
                                                const std::map<std::pair<BodyId, BodyId>, double>& overlap_areas) {
  std::vector<CoveredBoundary> covered;
  if (overlap_areas.empty() || std::none_of(boundaries.begin(), boundaries.end(), acts_on_all_faces)) return covered;
  const Table<BodyId, double> areas = body_areas(mesh);
  // Within a body both blocks' faces are its own.
  Table<BodyId, double> shared(mesh.bodies.size(), 0.0);
  for (const auto& [bodies, area] : overlap_areas) {
    shared[bodies.first] += area;
    shared[bodies.second] += area;
  }
  for (const thermal::Boundary& boundary : boundaries) {
    const BodyId body = boundary.region.body;
    if (!acts_on_all_faces(boundary) || shared[body] <= least_part * areas[body]) continue;
    covered.push_back({boundary.name, areas[body], shared[body]});
  }
  return covered;
}

template std::vector<CoveredBoundary> covered_boundaries<2>(const mesh::BlockMesh<2>&, const std::vector<thermal::Boundary>&,
                                                            const std::map<std::pair<BodyId, BodyId>, double>&);
template std::vector<CoveredBoundary> covered_boundaries<3>(const mesh::BlockMesh<3>&, const std::vector<thermal::Boundary>&,
                                                            const std::map<std::pair<BodyId, BodyId>, double>&);

}  // namespace scree::run
