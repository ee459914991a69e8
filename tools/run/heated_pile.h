// A pile ready to be heated: blocks in their places, what joins them, probes, and the temperatures it starts from.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/find_contacts.h"
#include "contact/one_sided.h"
#include "engine/output/probes.h"
#include "engine/packing/remaining.h"
#include "thermal/heat_model.h"
#include "thermal/joint_conduction.h"
#include "tools/scene/scene.h"

namespace scree::run {

template <int dim>
struct HeatedPile {
  mesh::BlockMesh<dim> mesh;  // as placed, without blocks that left the scene as it settled: they take no part
  packing::Places places;     // of its blocks and nodes in the packing
  bool settled = false;       // by a fall, and not where a scene placed them
  contact::ContactSet<dim> contacts;
  std::optional<contact::OneSided> one_sided;  // of these, if there are any
  thermal::JointConduction joints;
  std::vector<std::string> unused_joints;  // keys of rules that hold for none of the contacts
  std::vector<output::Probe<dim>> probes;
  std::optional<Eigen::VectorXd> start;  // temperatures of an earlier run, if the scene starts from them [K]
  std::string key;                       // of the heat stage
};

// Without its joints yet. `note` is told where the temperatures come from, if from an earlier run.
template <int dim>
HeatedPile<dim> placed_pile(const Scene& scene, const packing::Packing<dim>& packing,
                            const std::function<void(const std::string&)>& note = {});

// How probes are read: from polynomials where nodes are worth it.
output::Reading probe_reading(const Scene& scene);

// The scene's probes. Throws InputError for one that is nowhere, or whose exact temperature has no value at the start.
template <int dim>
std::vector<output::Probe<dim>> located_probes(const Scene& scene, const mesh::BlockMesh<dim>& mesh);

// Of which the effective conductivity is asked, if it is.
template <int dim>
std::optional<Aabb<dim>> effective_window(const Scene& scene);

// How its bodies' contacts are looked for.
template <int dim>
contact::ContactOptions search_of(const Scene& scene, const HeatedPile<dim>& pile);

// Finds where its blocks touch, and what conducts there. Throws InputError for a joint between bodies that do not touch, unless
// it was a fall that kept them apart.
template <int dim>
void join(const Scene& scene, HeatedPile<dim>& pile);

// The balance of heat of a joined pile.
template <int dim>
std::shared_ptr<const thermal::HeatModel> heat_model(const Scene& scene, const HeatedPile<dim>& pile);

// The same without what heats it, by which perfect joints go beside it (driven_nodes): what the pile is, not what is done to
// it.
template <int dim>
std::shared_ptr<const thermal::HeatModel> undriven_model(const Scene& scene, const HeatedPile<dim>& pile,
                                                         std::shared_ptr<const thermal::HeatModel> driven);

}  // namespace scree::run
