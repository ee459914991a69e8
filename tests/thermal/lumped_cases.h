// Cubes in a row with joints between them, meshed or lumped.
#pragma once

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/heat_run.h"

namespace scree::thermal::test {

constexpr double side = 0.1;  // of a cube [m]

// h L/k is the Biot number.
inline double conductance_for_biot(double biot) {
  return biot * 4.0 / side;
}

template <int dim>
struct Row {
  mesh::BlockMesh<dim> mesh;
  contact::ContactSet<dim> contacts;
  HeatOptions options;
  Table<MaterialId, Material> materials = rock_only();

  [[nodiscard]] HeatModel model() const { return make_heat_model(mesh, materials, contacts, options); }
};

// Each a body and a block of `cells` cells along an edge; a joint of `conductance` [W/m2/K].
template <int dim>
Row<dim> row_of_cubes(int count, int cells, double conductance = 10) {
  std::vector<Slab<dim>> slabs;
  for (int i = 0; i < count; ++i) {
    slabs.push_back(bar<dim>(side, cells, cells, side));
    slabs.back().low[0] = i * side;
  }
  Row<dim> row;
  row.mesh = slab_mesh<dim>(slabs);
  row.contacts = matching_contacts(row.mesh);
  row.options = options_for(row.mesh, 300);
  row.options.initial_temperature[BodyId{0}] = 400.0;
  row.options.joint.law = JointConductance{conductance};
  return row;
}

inline Boundary convection(BodyId body, double coefficient, const Function& surroundings) {
  Boundary boundary;
  boundary.region = on(body);
  boundary.condition = Convection{coefficient, surroundings};
  boundary.name = "air";
  return boundary;
}

inline HeatState heated(const HeatModel& model, double until = 3600, double tolerance = 0.01,
                        Integrator integrator = Integrator::automatic) {
  TimeOptions options;
  options.until = until;
  options.output_every = until / 6;
  options.tolerance = tolerance;
  options.integrator = integrator;
  HeatRun run(model, options);
  run.advance_to(until);
  return run.state();
}

}  // namespace scree::thermal::test
