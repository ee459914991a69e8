#include "thermal/perfect_joint.h"

#include <algorithm>

#include <fmt/format.h>

#include "thermal/block_conduction.h"
#include "thermal/contact_conduction.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

template <int dim>
class PerfectJoints {
 public:
  PerfectJoints(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                const contact::ContactSet<dim>& contacts, const JointOptions& joint)
      : mesh_(mesh), materials_(materials), contacts_(contacts.contacts) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const BodyId owner = mesh.blocks[contacts_[c].owner].body, target = mesh.blocks[contacts_[c].target].body;
      if (std::holds_alternative<PerfectJoint>(law_between(joint, mesh.bodies, owner, target))) perfect_.push_back(c);
    }
  }

  [[nodiscard]] std::vector<PerfectTerm<dim>> terms() {
    std::vector<PerfectTerm<dim>> terms;
    if (perfect_.empty()) return terms;
    bounds_ = Table<ElementId, double>(mesh_.elements.size(), 0);
    for (const std::size_t c : perfect_) {
      add_to_bound(c, contacts_[c].owner, contacts_[c].owner_element);
      add_to_bound(c, contacts_[c].target, contacts_[c].target_element);
    }
    terms.reserve(perfect_.size());
    for (const std::size_t c : perfect_) terms.push_back(term(c));
    return terms;
  }

 private:
  // c of the element, from the areas that have to do with it.
  void add_to_bound(std::size_t c, BlockId block, ElementId element) {
    const Point<dim> normal = contact_normal(mesh_, contacts_[c]);
    const double conductivity = normal.dot(conducted<dim>(mesh_, materials_, block, normal));
    bounds_[element] += contacts_[c].area * conductivity / mesh::element_volume(mesh_, element);
  }

  struct Sides {
    double of_owner, of_target;  // w of the two sides
    double penalty;              // gamma
    bool one_varying_material = false;
  };

  [[nodiscard]] Sides weigh(const contact::Contact<dim>& contact) const {
    const double c1 = bounds_[contact.owner_element], c2 = bounds_[contact.target_element];
    const bool owner_varies = materials_[material(contact.owner)].conductivity->varies();
    const bool target_varies = materials_[material(contact.target)].conductivity->varies();
    if (owner_varies && target_varies && material(contact.owner) != material(contact.target)) refuse(contact);
    if (owner_varies && !target_varies) return {0, 1, 2 * c2};
    if (target_varies && !owner_varies) return {1, 0, 2 * c1};
    return {c2 / (c1 + c2), c1 / (c1 + c2), 2 * c1 * c2 / (c1 + c2), owner_varies};
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

  [[nodiscard]] PerfectTerm<dim> term(std::size_t c) const {
    const contact::Contact<dim>& contact = contacts_[c];
    PerfectTerm<dim> term;
    term.contact = c;
    term.material = material(contact.owner);
    const Sides sides = weigh(contact);
    term.penalty = sides.penalty;
    if (sides.one_varying_material) term.of_phi = 1 / materials_[term.material].conductivity->value(reference_temperature);
    const Point<dim> normal = contact_normal(mesh_, contact);
    set_side(term, 0, contact.owner_element,
             contact.area * sides.of_owner * conducted<dim>(mesh_, materials_, contact.owner, normal));
    set_side(term, dim + 1, contact.target_element,
             contact.area * sides.of_target * conducted<dim>(mesh_, materials_, contact.target, normal));
    set_jump(term, 0, contact.on_owner, 1);
    set_jump(term, dim + 1, contact.on_target, -1);
    return term;
  }

  // The element's corners from `first` on, with `weight` . grad T as their flux.
  void set_side(PerfectTerm<dim>& term, int first, ElementId element, const Point<dim>& weight) const {
    const Corners<dim> areas = opposite_areas<dim>(corner_points<dim>(mesh_, mesh_.elements[element]));
    const double volume = mesh::element_volume(mesh_, element);
    for (int a = 0; a <= dim; ++a) {
      term.nodes[first + a] = mesh_.elements[element][a];
      term.flux[first + a] = -weight.dot(areas.col(a)) / (dim * volume);
    }
  }

  static void set_jump(PerfectTerm<dim>& term, int first, const contact::Stencil<dim>& stencil, double sign) {
    for (int i = 0; i < dim; ++i) {
      const auto corner = std::find(term.nodes.begin() + first, term.nodes.begin() + first + dim + 1, stencil.nodes[i]);
      term.jump[static_cast<std::size_t>(corner - term.nodes.begin())] = sign * stencil.weights[i];
    }
  }

  const mesh::BlockMesh<dim>& mesh_;
  const Table<MaterialId, Material>& materials_;
  const contact::Contacts<dim>& contacts_;
  std::vector<std::size_t> perfect_;
  Table<ElementId, double> bounds_;
};

}  // namespace

template <int dim>
std::vector<PerfectTerm<dim>> perfect_terms(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                            const contact::ContactSet<dim>& contacts, const JointOptions& joint) {
  return PerfectJoints<dim>(mesh, materials, contacts, joint).terms();
}

template std::vector<PerfectTerm<2>> perfect_terms<2>(const mesh::BlockMesh<2>&, const Table<MaterialId, Material>&,
                                                      const contact::ContactSet<2>&, const JointOptions&);
template std::vector<PerfectTerm<3>> perfect_terms<3>(const mesh::BlockMesh<3>&, const Table<MaterialId, Material>&,
                                                      const contact::ContactSet<3>&, const JointOptions&);

}  // namespace scree::thermal
