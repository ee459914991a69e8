#include "thermal/joint_conduction.h"

#include <algorithm>

#include "thermal/contact_conduction.h"
#include "thermal/incidence.h"
#include "thermal/row_assembly.h"
#include "thermal/sparse_sum.h"
#include "thermal/tied_nodes.h"

namespace scree::thermal {

namespace {

// Where tied nodes let both sides have a row, its weight is the sum.
template <int dim>
void join_sides(TemperatureDifference<dim>& difference) {
  for (int i = 0; i < difference.side; ++i) {
    if (difference.weights[i] == 0) continue;
    for (int other = difference.side; other < 2 * difference.side; ++other) {
      if (difference.weights[other] == 0 || difference.nodes[other] != difference.nodes[i]) continue;
      difference.weights[i] += difference.weights[other];
      difference.weights[other] = 0;
    }
  }
}

// The same difference between rows of the model: all of a lumped side's weight is on its one row.
template <int dim>
TemperatureDifference<dim> between_rows(TemperatureDifference<dim> difference, const NodeMap& rows) {
  if (rows.is_identity()) return difference;
  for (const int side : {0, difference.side}) {
    int first = -1;  // of the side's entries in use
    for (int i = side; i < side + difference.side; ++i) {
      if (difference.weights[i] == 0) continue;
      difference.nodes[i] = rows[difference.nodes[i]];
      if (first < 0) {
        first = i;
      } else if (difference.nodes[i] == difference.nodes[first]) {
        difference.weights[first] = side == 0 ? 1 : -1;
        difference.weights[i] = 0;
      }
    }
  }
  join_sides(difference);
  return difference;
}

// A perfect term between rows of the model: nodes that share one are one entry.
struct RowTerm {
  int size = 0;
  std::array<int, PerfectTerms::most_nodes> rows{};
  std::array<double, PerfectTerms::most_nodes> jump{};
  std::array<double, PerfectTerms::most_nodes> flux{};

  RowTerm(const PerfectNodes& of_term, const NodeMap& map) {
    for (std::size_t i = 0; i < of_term.size(); ++i) {
      const int here = find(map[of_term.nodes[i]].value());
      rows[here] = map[of_term.nodes[i]].value();
      jump[here] += of_term.jump[i];
      flux[here] += of_term.flux[i];
      size = std::max(size, here + 1);
    }
  }

  // Where the row stands, or would stand.
  [[nodiscard]] int find(int row) const {
    return static_cast<int>(std::find(rows.begin(), rows.begin() + size, row) - rows.begin());
  }
};

// What the contacts add to the rows of K: g w w^T of each, less w q^T + q w^T of perfect ones.
template <int dim>
class JointRows {
 public:
  JointRows(const contact::ContactSet<dim>& contacts, const JointConduction& conduction, JointForm form, Field field,
            const NodeMap& rows, std::size_t size)
      : contacts_(contacts),
        conduction_(conduction),
        form_(form),
        field_(field),
        rows_(rows),
        contacts_at_(
            incidence_of(size, conduction.conductances.size(),
                         [this](std::size_t contact, const auto& visit) { this->visit_rows_of_contact(contact, visit); })),
        perfect_at_(incidence_of(conduction.perfect.terms.empty() ? 0 : size, conduction.perfect.terms.size(),
                                 [this](std::size_t term, const auto& visit) { this->visit_rows_of_perfect(term, visit); })) {}

  void add_row(int row, RowSum& sum) const {
    if (!conduction_.perfect.terms.empty()) {
      for (const std::uint32_t term : perfect_at_.of(row)) add_perfect(conduction_.perfect.terms[term], row, sum);
    }
    for (const std::uint32_t contact : contacts_at_.of(row)) add_contact(contact, row, sum);
  }

 private:
  TemperatureDifference<dim> difference(std::size_t contact) const {
    return between_rows(temperature_difference(contacts_.contacts[contact], form_), rows_);
  }

  // Terms come in the order of their contacts.
  [[nodiscard]] bool is_perfect(std::size_t contact) const {
    const auto before = [](const PerfectTerm& term, std::size_t other) { return term.contact < other; };
    const auto& terms = conduction_.perfect.terms;
    const auto found = std::lower_bound(terms.begin(), terms.end(), contact, before);
    return found != terms.end() && found->contact == contact;
  }

  template <class Visit>
  void visit_rows_of_contact(std::size_t contact, const Visit& visit) const {
    if (field_ == Field::phi || !(conduction_.conductances[contact] > 0) || is_perfect(contact)) return;
    const TemperatureDifference<dim> between = difference(contact);
    for (int i = 0; i < 2 * between.side; ++i) {
      if (between.weights[i] != 0) visit(between.nodes[i].value());  // a semi-edge leaves a third of its entries unused
    }
  }

  template <class Visit>
  void visit_rows_of_perfect(std::size_t number, const Visit& visit) const {
    const PerfectTerm& perfect = conduction_.perfect.terms[number];
    if (perfect.of_phi.has_value() != (field_ == Field::phi)) return;
    if (is_tied(contacts_.contacts[perfect.contact], rows_)) return;
    const RowTerm term(conduction_.perfect.nodes_of(perfect), rows_);
    for (int i = 0; i < term.size; ++i) visit(term.rows[i]);
  }

  void add_contact(std::size_t contact, int row, RowSum& sum) const {
    const TemperatureDifference<dim> between = difference(contact);
    int here = 0;
    while (between.nodes[here].value() != row || between.weights[here] == 0) ++here;
    for (int i = 0; i < 2 * between.side; ++i) {
      const double product = between.weights[here] * between.weights[i];
      if (product != 0) sum.add(between.nodes[i].value(), conduction_.conductances[contact] * product);
    }
  }

  // The diagonal is minus the sum of the others, so that the row sums to zero to the last bit of what is entered.
  void add_perfect(const PerfectTerm& perfect, int row, RowSum& sum) const {
    const double conductance = conduction_.conductances[perfect.contact];
    const double scale = perfect.of_phi.value_or(1);
    const RowTerm term(conduction_.perfect.nodes_of(perfect), rows_);
    const int here = term.find(row);
    for (int i = 0; i < term.size; ++i) {
      if (i == here) continue;
      const double entry = scale * (conductance * (term.jump[here] * term.jump[i]) -
                                    (term.jump[here] * term.flux[i] + term.jump[i] * term.flux[here]));
      if (entry == 0) continue;
      sum.add(term.rows[i], entry);
      sum.add(row, -entry);
    }
  }

  const contact::ContactSet<dim>& contacts_;
  const JointConduction& conduction_;
  JointForm form_;
  Field field_;
  const NodeMap& rows_;
  Incidence contacts_at_;
  Incidence perfect_at_;
};

// As differences within each side: the fluxes of a side sum to zero only to rounding, and temperatures in kelvin are large.
double perfect_flow(const PerfectTerm& term, const JointConduction& conduction, const Eigen::VectorXd& temperature) {
  const PerfectNodes of_term = conduction.perfect.nodes_of(term);
  std::array<double, PerfectTerms::most_nodes> field{};  // as if k were that at the reference temperature [K]
  for (std::size_t i = 0; i < of_term.size(); ++i) {
    const double at = temperature[of_term.nodes[i].value()];
    field[i] = term.of_phi ? *term.of_phi * conduction.conductivities[term.material.index()].integral(at) : at;
  }
  double drop = 0;
  double flux = 0;
  for (std::size_t i = 0; i < of_term.size(); ++i) {
    drop += of_term.jump[i] * field[i];
    flux += of_term.flux[i] * (field[i] - field[i < of_term.owners ? 0 : of_term.owners]);
  }
  return conduction.conductances[term.contact] * drop - flux;
}

// The processor begins to read a contact some way ahead: they are too many for its caches, and by itself it starts too late. No
// cache need keep it, where it would take the place of what the computing threads use.
template <int dim>
void fetch_ahead(const contact::Contacts<dim>& contacts, std::size_t contact) {
  constexpr std::size_t line = 64;
  const std::size_t ahead = std::min(contact + 32, contacts.size() - 1);
  const char* start = reinterpret_cast<const char*>(&contacts[ahead]);
  for (std::size_t at = 0; at < sizeof contacts[0]; at += line) __builtin_prefetch(start + at, 0, 0);
}

// And the temperatures that one will ask for which has been read by now: the target's lie anywhere.
template <int dim>
void fetch_ahead(const contact::Contacts<dim>& contacts, std::size_t contact, const Eigen::VectorXd& temperature) {
  const contact::Contact<dim>& ahead = contacts[std::min(contact + 8, contacts.size() - 1)];
  __builtin_prefetch(&temperature[ahead.on_target.nodes[0].value()]);
}

}  // namespace

template <int dim>
JointConduction joint_conduction(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                 const contact::ContactSet<dim>& contacts, const JointOptions& joint,
                                 const DrivenNodes& driven) {
  JointConduction conduction;
  conduction.perfect = perfect_terms(mesh, materials, contacts, joint, driven);
  const auto& terms = conduction.perfect.terms;
  const bool any_of_phi =
      std::any_of(terms.begin(), terms.end(), [](const PerfectTerm& term) { return term.of_phi.has_value(); });
  if (any_of_phi) {
    for (const Material& material : materials) {
      conduction.conductivities.push_back(material.conductivity ? material.conductivity->value : Curve());
    }
  }
  conduction.conductances.reserve(contacts.contacts.size());
  auto perfect = terms.begin();
  for (const auto& contact : contacts.contacts) {
    const JointLaw& law = law_between(joint, mesh.bodies, mesh.blocks[contact.owner].body, mesh.blocks[contact.target].body);
    ContactSides sides;
    if (std::holds_alternative<StiffnessFactor>(law)) sides.mean_conductivity = mean_conductivity(mesh, materials, contact);
    const bool has_term = perfect != terms.end() && perfect->contact == conduction.conductances.size();
    if (has_term) sides.penalty = (perfect++)->penalty;
    conduction.conductances.push_back(contact_conductance(contact, sides, law));
  }
  return conduction;
}

template <int dim>
void add_joints(const contact::ContactSet<dim>& contacts, const JointConduction& conduction, JointForm form, Field field,
                const NodeMap& rows, SparseMatrix& conductance) {
  SCREE_EXPECT(conduction.conductances.size() == contacts.contacts.size());
  const bool none = field == Field::phi ? conduction.conductivities.empty() : contacts.contacts.empty();
  if (none) return;
  const auto size = static_cast<int>(conductance.rows());
  const JointRows<dim> joints(contacts, conduction, form, field, rows, static_cast<std::size_t>(size));
  const SparseMatrix of_joints = assembled(
      size,
      [&](int row, RowSum& sum) {
        joints.add_row(row, sum);
        return 1.0;
      },
      rows.in_mesh_order());
  sum_of(conductance, of_joints).swap(conductance);
}

template <int dim>
std::vector<double> contact_flows(const contact::ContactSet<dim>& contacts, const JointConduction& conduction,
                                  const Eigen::VectorXd& temperature, JointForm form) {
  SCREE_EXPECT(conduction.conductances.size() == contacts.contacts.size());
  std::vector<double> flows;
  flows.reserve(contacts.contacts.size());
  auto term = conduction.perfect.terms.begin();
  for (std::size_t c = 0; c < contacts.contacts.size(); ++c) {
    fetch_ahead<dim>(contacts.contacts, c);
    fetch_ahead<dim>(contacts.contacts, c, temperature);
    if (term != conduction.perfect.terms.end() && term->contact == c) {
      flows.push_back(perfect_flow(*term++, conduction, temperature));
    } else {
      flows.push_back(conduction.conductances[c] * temperature_drop(contacts.contacts[c], form, temperature));
    }
  }
  return flows;
}

#define SCREE_INSTANTIATE(dim)                                                                                              \
  template JointConduction joint_conduction<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,           \
                                                 const contact::ContactSet<dim>&, const JointOptions&, const DrivenNodes&); \
  template void add_joints<dim>(const contact::ContactSet<dim>&, const JointConduction&, JointForm, Field, const NodeMap&,  \
                                Eigen::SparseMatrix<double>&);                                                              \
  template std::vector<double> contact_flows<dim>(const contact::ContactSet<dim>&, const JointConduction&,                  \
                                                  const Eigen::VectorXd&, JointForm);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
