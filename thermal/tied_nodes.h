// Perfect joints between faces that match, corner upon corner: the corners that lie on each other are one node, and K is that
// of one mesh. Nothing is coupled there, and nothing stiffened; perfect_joint.h is for faces that do not match.
#pragma once

#include <algorithm>
#include <optional>

#include "contact/contact_set.h"
#include "thermal/heat_model.h"
#include "thermal/joint_conduction.h"
#include "thermal/node_map.h"

namespace scree::thermal {

// Of each node the first of those that are one with it; nothing if no two are. Corners match within a millionth of the
// element's edge, and only if no two conditions hold them. What holds one of them holds all.
template <int dim>
std::optional<Table<NodeId, NodeId>> tied_nodes(const mesh::BlockMesh<dim>& mesh, const contact::ContactSet<dim>& contacts,
                                                const JointConduction<dim>& joints, const HeatModel& model);

// Whether the two faces of the contact have the same rows: it adds nothing to K.
template <int dim>
bool is_tied(const contact::Contact<dim>& contact, const NodeMap& rows) {
  if (rows.is_identity()) return false;
  const auto& others = contact.on_target.nodes;
  return std::all_of(contact.on_owner.nodes.begin(), contact.on_owner.nodes.end(), [&](NodeId node) {
    return std::any_of(others.begin(), others.end(), [&](NodeId other) { return rows[other] == rows[node]; });
  });
}

}  // namespace scree::thermal
