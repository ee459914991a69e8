#include "thermal/heat_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/brief_waits.h"
#include "thermal/assemble_blocks.h"
#include "thermal/boundary.h"
#include "thermal/choose_lumped.h"
#include "thermal/fourth_order.h"
#include "thermal/held_joints.h"
#include "thermal/joint_conduction.h"
#include "thermal/places.h"
#include "thermal/problems.h"
#include "thermal/row_numbering.h"
#include "thermal/share_rows.h"
#include "thermal/tied_nodes.h"

namespace scree::thermal {

namespace {

// Everything that is missing, in one error.
class MissingValues {
 public:
  void add(const std::string& key, const std::string& value, const std::string& rule, const std::string& suggestion) {
    problems_.push_back(problem(key, value, rule, suggestion));
  }

  // A property that varies with temperature keeps to its rule by itself.
  void need(const std::optional<Curve>& property, const std::string& key, const std::string& unit) {
    const std::optional<double> constant = property ? property->constant() : std::nullopt;
    if (property && (!constant || (std::isfinite(*constant) && *constant > 0))) return;
    const std::string value = property ? fmt::format("{:g}", *constant) : "missing";
    add(key, value, "must be positive, " + unit, "Heat needs it in every material that a body is made of");
  }

  void raise() const {
    if (!problems_.empty()) throw InputError(problems_);
  }

 private:
  std::vector<Problem> problems_;
};

std::optional<Curve> value_of(const std::optional<Conductivity>& conductivity) {
  return conductivity ? std::optional<Curve>(conductivity->value) : std::nullopt;
}

template <int dim>
void check_bodies(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, const HeatOptions& options) {
  MissingValues missing;
  Table<MaterialId, char> checked(materials.size(), 0);
  for (const BodyId body : mesh.bodies.ids()) {
    const std::string& name = mesh.bodies[body].name;
    const MaterialId id = mesh.bodies[body].material;
    if (!id.valid() || id.index() >= materials.size()) {
      missing.add("bodies." + name + ".material", "missing", "must name a material", "Give the body a material");
    } else if (checked[id] == 0) {
      checked[id] = 1;
      const std::string key = "materials." + materials[id].name;
      missing.need(materials[id].density, key + ".density", "kg/m3");
      missing.need(value_of(materials[id].conductivity), key + ".conductivity", "W/m/K");
      missing.need(materials[id].specific_heat, key + ".specific_heat", "J/kg/K");
    }
    if (!options.initial_field && body.index() >= options.initial_temperature.size()) {
      missing.add("heat.initial", "missing for body " + name, "must give every body a temperature, K", "");
    }
  }
  if (options.initial_field && options.initial_field->size() != static_cast<Eigen::Index>(mesh.nodes.size())) {
    missing.add("heat.initial", fmt::format("a field of {} nodes", options.initial_field->size()),
                fmt::format("must have a temperature for each of the {} nodes", mesh.nodes.size()), "");
  }
  missing.raise();
}

bool varies(const Material& material) {
  return material.conductivity->varies() || !material.specific_heat->constant();
}

// Temperatures of nodes whose body moves may not be known yet.
bool initial_is_known(const HeatOptions& options, const MovingBodies& moving, BodyId body) {
  return !moving.contains(body) || !(options.initial_field || options.initial_temperature[body].varies_in_place());
}

template <int dim>
void set_initial(const mesh::BlockMesh<dim>& mesh, const HeatOptions& options, const MovingBodies& moving, HeatModel& model) {
  for (const NodeId node : mesh.nodes.ids()) {
    const auto row = static_cast<Eigen::Index>(node.index());
    const BodyId body = mesh.blocks[model.blocks[node]].body;
    const Eigen::Vector3d place = model.places.col(row);
    if (!initial_is_known(options, moving, body)) continue;
    model.initial[row] = options.initial_field ? (*options.initial_field)[row] : options.initial_temperature[body](place, 0);
    if (std::isfinite(model.initial[row]) && model.initial[row] >= 0) continue;
    throw InputError(problem("heat.initial",
                             fmt::format("{:g} at ({:g}, {:g}, {:g}) m", model.initial[row], place.x(), place.y(), place.z()),
                             "must be a temperature of 0 K or more"));
  }
}

// Properties that depend on temperature where the run begins: a formula that breaks its rule there says so by itself.
template <int dim>
void check_properties(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                      const HeatOptions& options, const MovingBodies& moving, const HeatModel& model) {
  for (const BlockId b : mesh.blocks.ids()) {
    const BodyId body = mesh.blocks[b].body;
    const Material& material = materials[mesh.bodies[body].material];
    if (!varies(material) || !initial_is_known(options, moving, body)) continue;
    double last = std::numeric_limits<double>::quiet_NaN();
    for (const NodeId node : mesh.blocks[b].nodes) {
      const double temperature = model.initial[node.value()];
      if (temperature == last) continue;
      last = temperature;
      material.conductivity->value(temperature);
      (*material.specific_heat)(temperature);
    }
  }
}

// What properties that depend on temperature need, if there are any.
template <int dim>
void set_varying(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, HeatModel& model) {
  if (std::none_of(mesh.bodies.begin(), mesh.bodies.end(),
                   [&](const mesh::Body& body) { return varies(materials[body.material]); })) {
    return;
  }
  VaryingProperties& varying = model.varying.emplace();
  varying.mass = Eigen::VectorXd::Zero(model.capacity.size());
  for (const Material& material : materials) {  // one that no body is made of may lack them
    varying.specific_heat.push_back(material.specific_heat.value_or(Curve()));
    varying.conductivity.push_back(material.conductivity ? material.conductivity->value : Curve());
  }
  varying.material = Table<NodeId, int>(mesh.nodes.size());
  for (const NodeId node : mesh.nodes.ids()) {
    varying.material[node] = static_cast<int>(mesh.bodies[mesh.blocks[model.blocks[node]].body].material.index());
  }
}

// Nodes, what they start from, and what acts on them from outside.
template <int dim>
HeatModel unjoined(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, const HeatOptions& options,
                   const MovingBodies& moving) {
  check_bodies(mesh, materials, options);
  if (options.space_order == SpaceOrder::fourth) check_fourth_order(mesh, materials, options);
  const auto size = static_cast<Eigen::Index>(mesh.nodes.size());
  HeatModel model;
  model.blocks = Table<NodeId, BlockId>(mesh.nodes.size());
  model.capacity = Eigen::VectorXd::Zero(size);
  model.initial = Eigen::VectorXd::Zero(size);
  model.places = places_of(mesh);
  for (const BlockId b : mesh.blocks.ids()) {
    for (const NodeId node : mesh.blocks[b].nodes) model.blocks[node] = b;
    model.bodies.push_back(mesh.blocks[b].body);
  }
  for (const mesh::Body& body : mesh.bodies) model.body_names.push_back(body.name);
  set_initial(mesh, options, moving, model);
  check_properties(mesh, materials, options, moving, model);
  apply_boundaries(mesh, options, moving, model);
  return model;
}

}  // namespace

bool has_constant_properties(const HeatModel& model) {
  return !model.varying && std::all_of(model.exchanges.begin(), model.exchanges.end(), [](const Exchange& exchange) {
    return exchange.law == Exchange::Law::convection && !exchange.coefficient.varies_in_time();
  });
}

template <int dim>
void check_heat_options(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                        const HeatOptions& options, const MovingBodies& moving) {
  unjoined(mesh, materials, options, moving);
}

template <int dim>
HeatModel make_heat_model(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                          const contact::ContactSet<dim>& contacts, const HeatOptions& options) {
  check_bodies(mesh, materials, options);
  const JointConduction joints = joint_conduction(mesh, materials, contacts, options.joint, driven_nodes(mesh, options));
  return make_heat_model(mesh, materials, contacts, joints, options);
}

template <int dim>
HeatModel make_heat_model(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                          const contact::ContactSet<dim>& contacts, const JointConduction& joints, const HeatOptions& options) {
  wait_briefly();
  HeatModel model = unjoined(mesh, materials, options, {});
  check_held_joints(joints, model, options.time.until);
  set_varying(mesh, materials, model);
  model.lumped = choose_lumped(mesh, materials, contacts, joints, options, model);
  // Fourth order knows no neighbours but its own, and a node of two materials no one curve.
  std::optional<Table<NodeId, NodeId>> tied;
  if (!model.varying && options.space_order == SpaceOrder::second) tied = tied_nodes(mesh, contacts, joints, model);
  if (tied) {
    for (const NodeId node : mesh.nodes.ids()) model.tied_nodes += (*tied)[node] != node ? 1 : 0;
  }
  const auto numbering = number_rows(mesh, model, tied);
  assemble_blocks(mesh, materials, options.space_order, numbering, model).swap(model.conductance);
  if (numbering) share_rows(mesh, materials, *numbering, model);
  if (!contacts.contacts.empty()) model.fastest_cell.reset();  // joints conduct, too
  add_joints(contacts, joints, options.joint.form, Field::temperature, model.rows, model.conductance);
  if (model.varying) add_joints(contacts, joints, options.joint.form, Field::phi, model.rows, model.varying->unit_conductance);
  return model;
}

#define SCREE_INSTANTIATE(dim)                                                                                               \
  template void check_heat_options<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&, const HeatOptions&, \
                                        const MovingBodies&);                                                                \
  template HeatModel make_heat_model<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,                   \
                                          const contact::ContactSet<dim>&, const HeatOptions&);                              \
  template HeatModel make_heat_model<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,                   \
                                          const contact::ContactSet<dim>&, const JointConduction&, const HeatOptions&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
