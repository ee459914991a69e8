// Perfect joints between faces that match, corner upon corner: the corners that lie on each other are one node, and K is that
// of one mesh. Nothing is coupled there, and nothing stiffened; perfect_joint.h is for faces that do not match. A quadrilateral
// and the two triangles of tetrahedra do not, as heat that passes them evenly is shared out to their corners differently.
#pragma once

#include <algorithm>
#include <optional>

#include <boost/container/static_vector.hpp>

#include "contact/contact_set.h"
#include "thermal/heat_model.h"
#include "thermal/joint_conduction.h"
#include "thermal/node_map.h"

namespace scree::thermal {

// Of each node the first of those that are one with it; nothing if no two are. Corners match within a millionth of the
// element's edge, and only if no two conditions hold them. What holds one of them holds all.
template <int dim>
std::optional<Table<NodeId, NodeId>> tied_nodes(const mesh::BlockMesh<dim>& mesh, const contact::ContactSet<dim>& contacts,
                                                const JointConduction& joints, const HeatModel& model);

// The corners of a contact's face.
template <int dim>
boost::container::static_vector<NodeId, 4> nodes_of(const contact::Stencil<dim>& face) {
  boost::container::static_vector<NodeId, 4> nodes;
  for_each_weight(face, [&](NodeId node, double) { nodes.push_back(node); });
  return nodes;
}

// Whether the two faces of the contact have the same rows: it adds nothing to K.
template <int dim>
bool is_tied(const contact::Contact<dim>& contact, const NodeMap& rows) {
  if (rows.is_identity()) return false;
  const auto nodes = nodes_of(contact.on_owner), others = nodes_of(contact.on_target);
  return nodes.size() == others.size() && std::all_of(nodes.begin(), nodes.end(), [&](NodeId node) {
           return std::any_of(others.begin(), others.end(), [&](NodeId other) { return rows[other] == rows[node]; });
         });
}

}  // namespace scree::thermal
