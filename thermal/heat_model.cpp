#include "thermal/heat_model.h"

#include <cmath>

#include <fmt/format.h>

#include "engine/mesh/cells.h"
#include "thermal/block_conduction.h"
#include "thermal/boundary.h"
#include "thermal/joint_conduction.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

template <int dim>
const Material& material_of(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, BlockId block) {
  return materials[mesh.bodies[mesh.blocks[block].body].material];
}

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
    if (body.index() >= options.initial_temperature.size() || !std::isfinite(options.initial_temperature[body])) {
      missing.add("heat.initial", "missing for body " + name, "must give every body a temperature, K", "");
    }
  }
  missing.raise();
}

// Eqs. (4), (5) and (7) of every simplex, by its weight.
template <int dim>
void add_blocks(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, HeatModel& model,
                Triplets& entries) {
  for (const BlockId b : mesh.blocks.ids()) {
    const Material& material = material_of(mesh, materials, b);
    const double volumetric_heat = *material.density * material.specific_heat->constant().value();
    mesh::for_each_simplex(mesh, mesh.blocks[b], [&](const mesh::Simplex<dim>& nodes, double weight) {
      const CornerMatrix<dim> conductance =
          weight * element_conductance<dim>(corner_points<dim>(mesh, nodes), material.conductivity->value.constant().value());
      const double capacity = weight * corner_capacity<dim>(mesh::simplex_volume<dim>(mesh, nodes), volumetric_heat);
      for (int i = 0; i <= dim; ++i) {
        model.capacity[nodes[i].value()] += capacity;
        for (int j = 0; j <= dim; ++j) entries.emplace_back(nodes[i].value(), nodes[j].value(), conductance(i, j));
      }
    });
  }
}

template <int dim>
Point<dim> simplex_flux(const mesh::BlockMesh<dim>& mesh, const Material& material, const mesh::Simplex<dim>& nodes,
                        const Eigen::VectorXd& temperature) {
  CornerValues<dim> corner;
  for (int i = 0; i <= dim; ++i) corner[i] = temperature[nodes[i].value()];
  return element_flux<dim>(corner_points<dim>(mesh, nodes), material.conductivity->value.constant().value(), corner);
}

// Over both splits, by volume.
template <int dim>
Point<dim> mean_flux(const mesh::BlockMesh<dim>& mesh, const Material& material, CellId cell,
                     const Eigen::VectorXd& temperature) {
  Point<dim> sum = Point<dim>::Zero();
  double volume = 0;
  for (const mesh::Simplex<dim>& nodes : mesh::both_splits(mesh, cell)) {
    const double part = mesh::simplex_volume<dim>(mesh, nodes);
    sum += part * simplex_flux<dim>(mesh, material, nodes, temperature);
    volume += part;
  }
  return sum / volume;
}

}  // namespace

template <int dim>
HeatModel make_heat_model(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                          const contact::ContactSet<dim>& contacts, const HeatOptions& options) {
  check_bodies(mesh, materials, options);
  const auto size = static_cast<Eigen::Index>(mesh.nodes.size());
  HeatModel model;
  model.blocks = Table<NodeId, BlockId>(mesh.nodes.size());
  model.capacity = Eigen::VectorXd::Zero(size);
  model.load = Eigen::VectorXd::Zero(size);
  model.initial.resize(size);
  for (const BlockId b : mesh.blocks.ids()) {
    for (const NodeId node : mesh.blocks[b].nodes) {
      model.blocks[node] = b;
      model.initial[node.value()] = options.initial_temperature[mesh.blocks[b].body];
    }
  }
  apply_boundaries(mesh, options, model);
  Triplets entries;
  entries.reserve(mesh.elements.size() * (dim + 1) * (dim + 1) + contacts.contacts.size() * 4 * dim * dim);
  add_blocks(mesh, materials, model, entries);
  add_joints(contacts, joint_conduction(mesh, materials, contacts, options.joint), options.joint.form, entries);
  model.conductance.resize(size, size);
  model.conductance.setFromTriplets(entries.begin(), entries.end());
  return model;
}

template <int dim>
std::vector<Point<dim>> cell_fluxes(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                    const Eigen::VectorXd& temperature) {
  const std::vector<Point<dim>> of_elements = element_fluxes(mesh, materials, temperature);
  if (mesh.cells.empty()) return of_elements;
  std::vector<Point<dim>> fluxes;
  for (const BlockId b : mesh.blocks.ids()) {
    const mesh::Block& block = mesh.blocks[b];
    for (const CellId cell : block.cells) fluxes.push_back(mean_flux(mesh, material_of(mesh, materials, b), cell, temperature));
    if (block.cells.size() > 0) continue;
    for (const ElementId e : block.elements) fluxes.push_back(of_elements[e.index()]);
  }
  return fluxes;
}

template <int dim>
std::vector<Point<dim>> element_fluxes(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                       const Eigen::VectorXd& temperature) {
  std::vector<Point<dim>> fluxes(mesh.elements.size());
  for (const BlockId b : mesh.blocks.ids()) {
    const Material& material = material_of(mesh, materials, b);
    for (const ElementId e : mesh.blocks[b].elements) {
      fluxes[e.index()] = simplex_flux<dim>(mesh, material, mesh.elements[e], temperature);
    }
  }
  return fluxes;
}

#define SCREE_INSTANTIATE(dim)                                                                                          \
  template HeatModel make_heat_model<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,              \
                                          const contact::ContactSet<dim>&, const HeatOptions&);                         \
  template std::vector<Point<dim>> cell_fluxes<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,    \
                                                    const Eigen::VectorXd&);                                            \
  template std::vector<Point<dim>> element_fluxes<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&, \
                                                       const Eigen::VectorXd&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
