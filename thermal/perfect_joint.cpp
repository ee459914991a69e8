#include "thermal/perfect_joint.h"

#include <algorithm>

#include <fmt/format.h>
#include <boost/container/static_vector.hpp>

#include "contact/both_diagonals.h"
#include "engine/base/check.h"
#include "engine/mesh/cells.h"
#include "thermal/block_conduction.h"
#include "thermal/contact_conduction.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

template <int dim>
class PerfectJoints {
 public:
  PerfectJoints(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                const contact::ContactSet<dim>& contacts, const JointOptions& joint, const DrivenNodes& driven)
      : mesh_(mesh), materials_(materials), contacts_(contacts.contacts), driven_(driven) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const BodyId owner = mesh.blocks[contacts_[c].owner].body, target = mesh.blocks[contacts_[c].target].body;
      if (std::holds_alternative<PerfectJoint>(law_between(joint, mesh.bodies, owner, target))) perfect_.push_back(c);
    }
  }

  [[nodiscard]] PerfectTerms terms() {
    if (perfect_.empty()) return {};
    bounds_ = Table<ElementId, double>(mesh_.elements.size(), 0);
    cells_ = mesh::CellOfElement<dim>(mesh_);
    cell_bounds_ = Table<CellId, CellBounds>(mesh_.cells.size(), CellBounds{});
    for (const std::size_t c : perfect_) {
      add_to_bounds(c, contacts_[c].owner, owner_side(c));
      add_to_bounds(c, contacts_[c].target, target_side(c));
    }
    found_.terms.reserve(perfect_.size());
    for (const std::size_t c : perfect_) add_term(c);
    return std::move(found_);
  }

 private:
  using CellBounds = std::array<double, 10>;  // of the simplices of both splits

  // A simplex behind a face, as the block's conduction has it.
  struct Behind {
    mesh::Simplex<dim> nodes;
    double* bound;       // c
    double weight = 1;   // in the block's conduction
    double of_flux = 1;  // part of the face's flux q that is its
  };
  using AllBehind = boost::container::static_vector<Behind, 2>;

  [[nodiscard]] AllBehind owner_side(std::size_t c) { return behind(contacts_[c].owner_element, contacts_[c].on_owner); }
  [[nodiscard]] AllBehind target_side(std::size_t c) { return behind(contacts_[c].target_element, contacts_[c].on_target); }

  [[nodiscard]] AllBehind behind(ElementId element, const contact::Stencil<dim>& point) {
    const CellId cell = cells_[element];
    if (!cell.valid()) return {{mesh_.elements[element], &bounds_[element]}};
    return behind_cell_face(cell, point);
  }

  // One of each split: on a quadrilateral the one split has the triangle that was found, the other that of the other diagonal.
  // If it is seen through one diagonal only, one in all.
  [[nodiscard]] AllBehind behind_cell_face(CellId cell, const contact::Stencil<dim>& point) {
    std::array<NodeId, dim> other = point.nodes;
    if constexpr (dim == 3) {
      if (point.fourth.valid()) other = contact::other_triangle(mesh_, mesh_.cells[cell], point);
    }
    const auto splits = mesh::both_splits(mesh_, cell);
    AllBehind found;
    for (std::size_t i = 0; i < splits.size(); ++i) {
      if (!holds(splits[i], point.nodes) && !holds(splits[i], other)) continue;
      found.push_back({splits[i], &cell_bounds_[cell][i], 0.5});
    }
    SCREE_EXPECT(!found.empty());
    for (Behind& simplex : found) simplex.of_flux = 1.0 / static_cast<double>(found.size());
    return found;
  }

  static bool holds(const mesh::Simplex<dim>& simplex, const std::array<NodeId, dim>& face) {
    return std::all_of(face.begin(), face.end(),
                       [&](NodeId node) { return std::find(simplex.begin(), simplex.end(), node) != simplex.end(); });
  }

  // c of the simplices, from the areas that have to do with them.
  void add_to_bounds(std::size_t c, BlockId block, const AllBehind& side) {
    const Point<dim> normal = contact_normal(mesh_, contacts_[c]);
    const double conductivity = normal.dot(conducted<dim>(mesh_, materials_, block, normal));
    for (const Behind& simplex : side) {
      const double volume = simplex.weight * mesh::simplex_volume(mesh_, simplex.nodes);
      *simplex.bound += simplex.of_flux * contacts_[c].area * conductivity / volume;
    }
  }

  static double largest_bound(const AllBehind& side) {
    double largest = 0;
    for (const Behind& simplex : side) largest = std::max(largest, *simplex.bound);
    return largest;
  }

  struct Sides {
    double of_owner, of_target;  // w of the two sides
    double penalty;              // gamma
    bool one_varying_material = false;
  };

  [[nodiscard]] Sides weigh(const contact::Contact<dim>& contact, double c1, double c2) const {
    const bool owner_varies = materials_[material(contact.owner)].conductivity->varies();
    const bool target_varies = materials_[material(contact.target)].conductivity->varies();
    if (owner_varies && target_varies && material(contact.owner) != material(contact.target)) refuse(contact);
    if (owner_varies && !target_varies) return {0, 1, 2 * c2};
    if (target_varies && !owner_varies) return {1, 0, 2 * c1};
    const bool owner_driven = is_driven(contact.on_owner), target_driven = is_driven(contact.on_target);
    if (owner_driven && !target_driven) return {0, 1, 2 * c2, owner_varies};
    if (target_driven && !owner_driven) return {1, 0, 2 * c1, owner_varies};
    return {c2 / (c1 + c2), c1 / (c1 + c2), 2 * c1 * c2 / (c1 + c2), owner_varies};
  }

  [[nodiscard]] bool is_driven(const contact::Stencil<dim>& side) const {
    if (driven_.empty()) return false;
    bool all = true;
    for_each_weight(side, [&](NodeId node, double weight) { all = all && (weight == 0 || driven_[node] != 0); });
    return all;
  }

  [[nodiscard]] MaterialId material(BlockId block) const { return mesh_.bodies[mesh_.blocks[block].body].material; }

  [[noreturn]] void refuse(const contact::Contact<dim>& contact) const {
    throw InputError(problem("contact",
                             fmt::format("a perfect joint between {} and {}", materials_[material(contact.owner)].name,
                                         materials_[material(contact.target)].name),
                             "must have at most one side whose conductivity depends on temperature, unless both are of one "
                             "material",
                             "Give the joint a large conductance instead"));
  }

  void add_term(std::size_t c) {
    const contact::Contact<dim>& contact = contacts_[c];
    PerfectTerm term;
    term.contact = c;
    term.material = material(contact.owner);
    const AllBehind owner = owner_side(c), target = target_side(c);
    const Sides sides = weigh(contact, largest_bound(owner), largest_bound(target));
    term.penalty = sides.penalty;
    if (sides.one_varying_material) term.of_phi = 1 / materials_[term.material].conductivity->value(reference_temperature);
    const Point<dim> normal = contact_normal(mesh_, contact);
    term.first = found_.nodes.size();
    add_side(owner, contact.area * sides.of_owner * conducted<dim>(mesh_, materials_, contact.owner, normal), contact.on_owner,
             1);
    term.owners = static_cast<std::uint8_t>(found_.nodes.size() - term.first);
    add_side(target, contact.area * sides.of_target * conducted<dim>(mesh_, materials_, contact.target, normal),
             contact.on_target, -1);
    term.size = static_cast<std::uint8_t>(found_.nodes.size() - term.first);
    SCREE_EXPECT(term.size <= PerfectTerms::most_nodes);
    found_.terms.push_back(term);
  }

  // The corners of the simplices, with `weight` . grad T as their flux, and the point's weights.
  void add_side(const AllBehind& side, const Point<dim>& weight, const contact::Stencil<dim>& point, double sign) {
    const std::size_t first = found_.nodes.size();
    for (const Behind& simplex : side) {
      const Corners<dim> areas = opposite_areas<dim>(corner_points<dim>(mesh_, simplex.nodes));
      const double volume = mesh::simplex_volume(mesh_, simplex.nodes);
      for (int a = 0; a <= dim; ++a) {
        const std::size_t at = place_of(simplex.nodes[a], first);
        found_.flux[at] -= simplex.of_flux * weight.dot(areas.col(a)) / (dim * volume);
      }
    }
    for_each_weight(point, [&](NodeId node, double of_point) { found_.jump[place_of(node, first)] = sign * of_point; });
  }

  // Where the node is from `first` on, at the end if it was not there.
  std::size_t place_of(NodeId node, std::size_t first) {
    const auto begin = found_.nodes.begin();
    const auto found = std::find(begin + static_cast<std::ptrdiff_t>(first), found_.nodes.end(), node);
    const auto place = static_cast<std::size_t>(found - begin);
    if (found == found_.nodes.end()) {
      found_.nodes.push_back(node);
      found_.jump.push_back(0);
      found_.flux.push_back(0);
    }
    return place;
  }

  const mesh::BlockMesh<dim>& mesh_;
  const Table<MaterialId, Material>& materials_;
  const contact::Contacts<dim>& contacts_;
  const DrivenNodes& driven_;
  std::vector<std::size_t> perfect_;
  Table<ElementId, double> bounds_;  // of the elements of blocks without cells
  mesh::CellOfElement<dim> cells_;
  Table<CellId, CellBounds> cell_bounds_;
  PerfectTerms found_;
};

}  // namespace

template <int dim>
PerfectTerms perfect_terms(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                           const contact::ContactSet<dim>& contacts, const JointOptions& joint, const DrivenNodes& driven) {
  return PerfectJoints<dim>(mesh, materials, contacts, joint, driven).terms();
}

template PerfectTerms perfect_terms<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&,
                                       const contact::ContactSet<2>&, const JointOptions&, const DrivenNodes&);
template PerfectTerms perfect_terms<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&,
                                       const contact::ContactSet<3>&, const JointOptions&, const DrivenNodes&);

}  // namespace scree::thermal
