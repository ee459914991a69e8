#include "tools/run/heated_pile.h"

#include <fmt/format.h>

#include "contact/find_contacts.h"
#include "engine/output/stored_field.h"
#include "thermal/boundary.h"
#include "tools/run/keys.h"

namespace scree::run {

namespace {

// The temperatures of an earlier run, if the scene starts from them.
template <int dim>
std::optional<Eigen::VectorXd> earlier_temperatures(const Scene& scene, const mesh::BlockMesh<dim>& mesh,
                                                    const std::function<void(const std::string&)>& note) {
  if (!scene.initial_field) return std::nullopt;
  const output::NodalField field = output::read_stored(*scene.initial_field, mesh);
  if (note) {
    note(field.same_mesh ? std::string("heat: starts from the temperatures of an earlier run, node by node")
                         : fmt::format("heat: starts from temperatures interpolated in the mesh of an earlier "
                                       "run; {} nodes lay outside",
                                       field.moved));
  }
  return field.values;
}

}  // namespace

output::Reading probe_reading(const Scene& scene) {
  const bool fourth = scene.heat && scene.heat->space_order == thermal::SpaceOrder::fourth;
  return fourth ? output::Reading::cubic : output::Reading::linear;
}

template <int dim>
std::vector<output::Probe<dim>> located_probes(const Scene& scene, const mesh::BlockMesh<dim>& mesh) {
  auto probes = output::locate_probes(mesh, scene.probes, probe_reading(scene));
  for (const output::Probe<dim>& probe : probes) output::exact_at(probe, 0);
  return probes;
}

template <int dim>
std::optional<Aabb<dim>> effective_window(const Scene& scene) {
  if (!scene.effective_window) return std::nullopt;
  const Aabb<3>& window = *scene.effective_window;
  return Aabb<dim>(window.min().template head<dim>(), window.max().template head<dim>());
}

template <int dim>
HeatedPile<dim> placed_pile(const Scene& scene, const packing::Packing<dim>& packing,
                            const std::function<void(const std::string&)>& note) {
  HeatedPile<dim> pile;
  packing::Remaining<dim> blocks = packing::remaining(packing);
  pile.mesh = std::move(blocks.mesh);
  pile.places = std::move(blocks.places);
  pile.settled = packing.settled.has_value();
  pile.probes = located_probes(scene, pile.mesh);
  pile.start = earlier_temperatures(scene, pile.mesh, note);
  pile.key = heat_key(scene, packing, pile.start ? &*pile.start : nullptr);
  return pile;
}

template <int dim>
contact::ContactOptions search_of(const Scene& scene, const HeatedPile<dim>& pile) {
  return thermal::contact_search(scene.heat->joint, pile.mesh.bodies, *scene.contact);
}

template <int dim>
void join(const Scene& scene, HeatedPile<dim>& pile) {
  const thermal::JointOptions& joint = scene.heat->joint;
  if (pile.mesh.blocks.size() > 1) {
    const contact::ContactOptions search = search_of(scene, pile);
    pile.contacts = contact::find_contacts(pile.mesh, search);
    pile.one_sided = contact::one_sided(pile.mesh, pile.contacts, search.tolerance);
  }
  auto unused = thermal::unused_rules(joint, pile.mesh, pile.contacts);
  for (const Problem& problem : unused) pile.unused_joints.push_back(problem.key);
  if (!unused.empty() && !pile.settled) throw InputError(std::move(unused));
  pile.joints = thermal::joint_conduction(pile.mesh, scene.materials, pile.contacts, joint,
                                          thermal::driven_nodes(pile.mesh, *scene.heat));
}

template <int dim>
std::shared_ptr<const thermal::HeatModel> heat_model(const Scene& scene, const HeatedPile<dim>& pile) {
  thermal::HeatOptions options = *scene.heat;
  options.initial_field = pile.start;
  // Made where it stays: Eigen 3.4 copies a sparse matrix that is moved.
  return std::shared_ptr<const thermal::HeatModel>(
      new thermal::HeatModel(thermal::make_heat_model(pile.mesh, scene.materials, pile.contacts, pile.joints, options)));
}

template <int dim>
std::shared_ptr<const thermal::HeatModel> undriven_model(const Scene& scene, const HeatedPile<dim>& pile,
                                                         std::shared_ptr<const thermal::HeatModel> driven) {
  if (!thermal::any_perfect(scene.heat->joint)) return driven;
  thermal::HeatOptions options = *scene.heat;
  options.initial_field = pile.start;
  options.boundaries.clear();
  options.sources.clear();
  return std::shared_ptr<const thermal::HeatModel>(
      new thermal::HeatModel(thermal::make_heat_model(pile.mesh, scene.materials, pile.contacts, options)));
}

#define SCREE_INSTANTIATE(dim)                                                                                 \
  template std::vector<output::Probe<dim>> located_probes<dim>(const Scene&, const mesh::BlockMesh<dim>&);     \
  template HeatedPile<dim> placed_pile<dim>(const Scene&, const packing::Packing<dim>&,                        \
                                            const std::function<void(const std::string&)>&);                   \
  template std::optional<Aabb<dim>> effective_window<dim>(const Scene&);                                       \
  template contact::ContactOptions search_of<dim>(const Scene&, const HeatedPile<dim>&);                       \
  template void join<dim>(const Scene&, HeatedPile<dim>&);                                                     \
  template std::shared_ptr<const thermal::HeatModel> heat_model<dim>(const Scene&, const HeatedPile<dim>&);    \
  template std::shared_ptr<const thermal::HeatModel> undriven_model<dim>(const Scene&, const HeatedPile<dim>&, \
                                                                         std::shared_ptr<const thermal::HeatModel>);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::run
