#include "thermal/contact_conduction.h"

#include "thermal/heat_model.h"

namespace scree::thermal {

template <int dim>
TemperatureDifference<dim> temperature_difference(const contact::Contact<dim>& contact, JointForm form) {
  const contact::Stencil<dim>& owner = form == JointForm::consistent ? contact.on_owner : contact.literal_owner;
  TemperatureDifference<dim> difference;
  for (int i = 0; i < dim; ++i) {
    difference.nodes[i] = owner.nodes[i];
    difference.weights[i] = owner.weights[i];
    difference.nodes[dim + i] = contact.on_target.nodes[i];
    difference.weights[dim + i] = -contact.on_target.weights[i];
  }
  return difference;
}

template <int dim>
double mean_conductivity(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                         const contact::Contact<dim>& contact) {
  const auto conductivity = [&](BlockId block) {
    return materials[mesh.bodies[mesh.blocks[block].body].material].conductivity.value().value.constant().value();
  };
  return 0.5 * (conductivity(contact.owner) + conductivity(contact.target));
}

template <int dim>
std::vector<double> contact_conductances(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                         const contact::ContactSet<dim>& contacts, const JointOptions& joint) {
  std::vector<double> conductances;
  conductances.reserve(contacts.contacts.size());
  for (const auto& contact : contacts.contacts) {
    conductances.push_back(contact_conductance(contact, mean_conductivity(mesh, materials, contact), joint));
  }
  return conductances;
}

template <int dim>
std::vector<double> contact_flows(const contact::ContactSet<dim>& contacts, const std::vector<double>& conductances,
                                  const Eigen::VectorXd& temperature, JointForm form) {
  SCREE_EXPECT(conductances.size() == contacts.contacts.size());
  std::vector<double> flows;
  flows.reserve(conductances.size());
  for (std::size_t c = 0; c < conductances.size(); ++c) {
    const auto difference = temperature_difference(contacts.contacts[c], form);
    double drop = 0;
    for (int i = 0; i < 2 * dim; ++i) {
      if (difference.weights[i] != 0) drop += difference.weights[i] * temperature[difference.nodes[i].value()];
    }
    flows.push_back(conductances[c] * drop);
  }
  return flows;
}

#define SCREE_INSTANTIATE(dim)                                                                                            \
  template TemperatureDifference<dim> temperature_difference<dim>(const contact::Contact<dim>&, JointForm);               \
  template double mean_conductivity<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,                 \
                                         const contact::Contact<dim>&);                                                   \
  template std::vector<double> contact_conductances<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&, \
                                                         const contact::ContactSet<dim>&, const JointOptions&);           \
  template std::vector<double> contact_flows<dim>(const contact::ContactSet<dim>&, const std::vector<double>&,            \
                                                  const Eigen::VectorXd&, JointForm);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
