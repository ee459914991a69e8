#include "tools/run/preflight.h"

#include <filesystem>
#include <optional>

#include "engine/output/stored_field.h"
#include "thermal/check_start.h"
#include "thermal/effective_conductivity.h"
#include "thermal/problems.h"
#include "tools/run/heated_pile.h"

namespace scree::run {

namespace {

thermal::MovingBodies moving_bodies(const Scene& scene) {
  thermal::MovingBodies moving;
  if (!scene.settle) return moving;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    if (!scene.bodies[body].fixed) moving.insert(BodyId{body});
  }
  return moving;
}

// The temperatures to start from, if they are those of an earlier run; any while blocks move.
template <int dim>
std::optional<Eigen::VectorXd> earlier_field(const Scene& scene, const mesh::BlockMesh<dim>& blocks, bool moving) {
  if (!scene.initial_field) return std::nullopt;
  if (!moving) return output::read_stored(*scene.initial_field, blocks).values;
  // Which temperatures its nodes will find there is known when they have come to rest.
  output::stored_frame(*scene.initial_field);
  return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(blocks.nodes.size()));
}

}  // namespace

template <int dim>
void check_heat(const Scene& scene, const mesh::BlockMesh<dim>& blocks) {
  if (!scene.heat) return;
  const thermal::MovingBodies moving = moving_bodies(scene);
  thermal::HeatOptions options = *scene.heat;
  options.initial_field = earlier_field(scene, blocks, !moving.empty());
  thermal::check_heat_options(blocks, scene.materials, options, moving);
  if (!moving.empty()) return;
  [[maybe_unused]] const auto probes = located_probes(scene, blocks);
  if (const auto window = effective_window<dim>(scene)) thermal::parts_in(blocks, *window);
}

template <int dim>
void check_placed(const Scene& scene, const packing::Packing<dim>& packing) {
  if (!scene.heat) return;
  HeatedPile<dim> pile = placed_pile(scene, packing);
  check_heat(scene, pile.mesh);
  join(scene, pile);
  thermal::check_start(*heat_model(scene, pile), scene.heat->time);
}

template void check_placed<2>(const Scene&, const packing::Packing<2>&);
template void check_placed<3>(const Scene&, const packing::Packing<3>&);
template void check_heat<2>(const Scene&, const mesh::BlockMesh<2>&);
template void check_heat<3>(const Scene&, const mesh::BlockMesh<3>&);

}  // namespace scree::run
