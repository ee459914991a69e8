#include "thermal/contact_conduction.h"

#include "thermal/block_conduction.h"

namespace scree::thermal {

template <int dim>
Point<dim> contact_normal(const mesh::BlockMesh<dim>& mesh, const contact::Contact<dim>& contact) {
  const Point<dim> own = mesh::area_vector<dim>(mesh, contact.on_owner.nodes).normalized();
  if (contact.kind != contact::Kind::overlap) return own;
  return (own - mesh::area_vector<dim>(mesh, contact.on_target.nodes).normalized()).normalized();
}

template <int dim>
Point<dim> conducted(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials, BlockId block,
                     const Point<dim>& normal) {
  const Conductivity& conductivity = *materials[mesh.bodies[mesh.blocks[block].body].material].conductivity;
  return conductivity.value(reference_temperature) * conductivity_ratios<dim>(conductivity, mesh.blocks[block]) * normal;
}

template <int dim>
double mean_conductivity(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                         const contact::Contact<dim>& contact) {
  const Point<dim> normal = contact_normal(mesh, contact);
  return 0.5 * (normal.dot(conducted<dim>(mesh, materials, contact.owner, normal)) +
                normal.dot(conducted<dim>(mesh, materials, contact.target, normal)));
}

#define SCREE_INSTANTIATE(dim)                                                                                 \
  template Point<dim> contact_normal<dim>(const mesh::BlockMesh<dim>&, const contact::Contact<dim>&);          \
  template Point<dim> conducted<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&, BlockId, \
                                     const Point<dim>&);                                                       \
  template double mean_conductivity<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,      \
                                         const contact::Contact<dim>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
