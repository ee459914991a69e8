#include "thermal/tied_nodes.h"

#include <utility>
#include <vector>

#include "engine/mesh/disjoint_sets.h"
#include "thermal/held_nodes.h"

namespace scree::thermal {

namespace {

constexpr double same_place = 1e-6;  // of the contact's characteristic length

// Pairs of corners that lie on each other.
using Matching = boost::container::static_vector<std::pair<NodeId, NodeId>, 4>;

// Which of the target's corners lies on each of the owner's; none unless all do.
template <int dim>
Matching matching_corners(const mesh::BlockMesh<dim>& mesh, const contact::Contact<dim>& contact) {
  const auto corners = nodes_of(contact.on_owner), others = nodes_of(contact.on_target);
  Matching matching;
  if (corners.size() != others.size()) return matching;
  for (const NodeId corner : corners) {
    const auto on_it = std::find_if(others.begin(), others.end(), [&](NodeId other) {
      return (mesh.nodes[other] - mesh.nodes[corner]).norm() <= same_place * contact.length;
    });
    if (on_it == others.end()) return {};
    matching.emplace_back(corner, *on_it);
  }
  return matching;
}

// Nodes that are one, and the condition that holds them, if any does.
class Ties {
 public:
  Ties(std::size_t nodes, const HeatModel& model) : sets_(nodes), hold_(holds_of_nodes(model)) {}

  // Whether no two conditions would hold them then.
  [[nodiscard]] bool may_be_one(NodeId a, NodeId b) {
    const int hold_a = hold_[sets_.root(a.index())], hold_b = hold_[sets_.root(b.index())];
    return hold_a < 0 || hold_b < 0 || hold_a == hold_b;
  }

  void make_one(NodeId a, NodeId b) {
    const int hold = std::max(hold_[sets_.root(a.index())], hold_[sets_.root(b.index())]);
    sets_.join(a.index(), b.index());
    hold_[sets_.root(a.index())] = hold;
  }

  [[nodiscard]] NodeId set_of(NodeId node) { return NodeId(sets_.root(node.index())); }

 private:
  mesh::DisjointSets sets_;
  std::vector<int> hold_;  // of each set, at its root
};

}  // namespace

template <int dim>
std::optional<Table<NodeId, NodeId>> tied_nodes(const mesh::BlockMesh<dim>& mesh, const contact::ContactSet<dim>& contacts,
                                                const JointConduction& joints, const HeatModel& model) {
  if (joints.perfect.terms.empty()) return std::nullopt;
  Ties ties(mesh.nodes.size(), model);
  bool any = false;
  for (const PerfectTerm& term : joints.perfect.terms) {
    const Matching matching = matching_corners(mesh, contacts.contacts[term.contact]);
    if (!std::all_of(matching.begin(), matching.end(),
                     [&](const auto& pair) { return ties.may_be_one(pair.first, pair.second); })) {
      continue;
    }
    any = any || !matching.empty();
    for (const auto& [corner, other] : matching) ties.make_one(corner, other);
  }
  if (!any) return std::nullopt;
  Table<NodeId, NodeId> first_of_set(mesh.nodes.size());
  Table<NodeId, NodeId> tied(mesh.nodes.size());
  for (const NodeId node : mesh.nodes.ids()) {
    NodeId& first = first_of_set[ties.set_of(node)];
    if (!first.valid()) first = node;
    tied[node] = first;
  }
  return tied;
}

template std::optional<Table<NodeId, NodeId>> tied_nodes<2>(const mesh::BlockMesh<2>&, const contact::ContactSet<2>&,
                                                            const JointConduction&, const HeatModel&);
template std::optional<Table<NodeId, NodeId>> tied_nodes<3>(const mesh::BlockMesh<3>&, const contact::ContactSet<3>&,
                                                            const JointConduction&, const HeatModel&);

}  // namespace scree::thermal
