#include "thermal/joint_conduction.h"

#include <algorithm>

#include "thermal/contact_conduction.h"
#include "thermal/sparse_sum.h"

namespace scree::thermal {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using SparseMatrix = Eigen::SparseMatrix<double>;

// A list of entries takes some 400 bytes a contact while it becomes a matrix.
constexpr std::size_t contacts_at_once = 1 << 18;

// A sum of many sparse matrices. Each is added to sums of its own size, so that none is copied more often than their number has
// digits in base 2.
class GrowingSum {
 public:
  void add(SparseMatrix part) {
    std::size_t parts = 1;
    while (!sums_.empty() && sums_.back().parts == parts) {
      part = sum_of(sums_.back().sum, part);
      parts *= 2;
      sums_.pop_back();
    }
    sums_.push_back({parts, std::move(part)});
  }

  void add_to(SparseMatrix& matrix) {
    if (sums_.empty()) return;
    SparseMatrix total = std::move(sums_.back().sum);
    sums_.pop_back();
    for (; !sums_.empty(); sums_.pop_back()) total = sum_of(sums_.back().sum, total);
    matrix = sum_of(matrix, total);
  }

 private:
  struct Sum {
    std::size_t parts;
    SparseMatrix sum;
  };
  std::vector<Sum> sums_;
};

// The same difference between rows of the model: all of a lumped side's weight is on its one row.
template <int dim>
TemperatureDifference<dim> between_rows(TemperatureDifference<dim> difference, const NodeMap& rows) {
  if (rows.is_identity()) return difference;
  for (int side = 0; side < 2 * dim; side += dim) {
    int first = -1;  // of the side's entries in use
    for (int i = side; i < side + dim; ++i) {
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
  return difference;
}

// g w w^T.
template <int dim>
void add_contact(const TemperatureDifference<dim>& difference, double conductance, Triplets& entries) {
  for (int i = 0; i < 2 * dim; ++i) {
    for (int j = 0; j < 2 * dim; ++j) {
      const double product = difference.weights[i] * difference.weights[j];
      if (product == 0) continue;  // a semi-edge leaves a third of its entries unused
      entries.emplace_back(difference.nodes[i].value(), difference.nodes[j].value(), conductance * product);
    }
  }
}

// The points of one overlap share their elements, and so their rows of K: they are summed before they are entered.
template <int dim>
class PerfectSum {
 public:
  static constexpr int corners = PerfectTerm<dim>::corners;
  using Matrix = Eigen::Matrix<double, corners, corners>;

  PerfectSum(const NodeMap& rows, Triplets& entries) : rows_(rows), entries_(entries) {}

  void add(const PerfectTerm<dim>& term, double conductance) {
    if (term.nodes != nodes_) flush();
    nodes_ = term.nodes;
    const Eigen::Map<const Eigen::Matrix<double, corners, 1>> jump(term.jump.data()), flux(term.flux.data());
    sum_ += conductance * jump * jump.transpose() - jump * flux.transpose() - flux * jump.transpose();
  }

  // Diagonals are minus the sum of the others, so that rows sum to zero to the last bit of what is entered.
  void flush() {
    for (int i = 0; i < corners; ++i) {
      for (int j = 0; j < i; ++j) {
        if (sum_(i, j) == 0) continue;
        const int row = rows_[nodes_[i]].value(), column = rows_[nodes_[j]].value();
        entries_.emplace_back(row, column, sum_(i, j));
        entries_.emplace_back(column, row, sum_(i, j));
        entries_.emplace_back(row, row, -sum_(i, j));
        entries_.emplace_back(column, column, -sum_(i, j));
      }
    }
    sum_.setZero();
  }

 private:
  const NodeMap& rows_;
  Triplets& entries_;
  std::array<NodeId, corners> nodes_;
  Matrix sum_ = Matrix::Zero();
};

}  // namespace

template <int dim>
JointConduction<dim> joint_conduction(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                                      const contact::ContactSet<dim>& contacts, const JointOptions& joint) {
  JointConduction<dim> conduction;
  conduction.perfect = perfect_terms(mesh, materials, contacts, joint);
  conduction.conductances.reserve(contacts.contacts.size());
  auto perfect = conduction.perfect.begin();
  for (const auto& contact : contacts.contacts) {
    ContactSides sides;
    sides.mean_conductivity = mean_conductivity(mesh, materials, contact);
    const bool has_term = perfect != conduction.perfect.end() && perfect->contact == conduction.conductances.size();
    if (has_term) sides.penalty = (perfect++)->penalty;
    const JointLaw& law = law_between(joint, mesh.bodies, mesh.blocks[contact.owner].body, mesh.blocks[contact.target].body);
    conduction.conductances.push_back(contact_conductance(contact, sides, law));
  }
  return conduction;
}

namespace {

// Of the contacts from `first` to before `last`.
template <int dim>
void add_entries(const contact::ContactSet<dim>& contacts, const JointConduction<dim>& conduction, JointForm form,
                 const NodeMap& rows, std::size_t first, std::size_t last, Triplets& entries) {
  auto perfect = std::lower_bound(conduction.perfect.begin(), conduction.perfect.end(), first,
                                  [](const PerfectTerm<dim>& term, std::size_t contact) { return term.contact < contact; });
  PerfectSum<dim> sum(rows, entries);
  for (std::size_t c = first; c < last; ++c) {
    const double conductance = conduction.conductances[c];
    if (perfect != conduction.perfect.end() && perfect->contact == c) {
      sum.add(*perfect++, conductance);
    } else if (conductance > 0) {
      add_contact(between_rows(temperature_difference(contacts.contacts[c], form), rows), conductance, entries);
    }
  }
  sum.flush();
}

}  // namespace

template <int dim>
void add_joints(const contact::ContactSet<dim>& contacts, const JointConduction<dim>& conduction, JointForm form,
                const NodeMap& rows, SparseMatrix& conductance) {
  SCREE_EXPECT(conduction.conductances.size() == contacts.contacts.size());
  Triplets entries;
  GrowingSum sum;
  for (std::size_t first = 0; first < conduction.conductances.size(); first += contacts_at_once) {
    const std::size_t last = std::min(first + contacts_at_once, conduction.conductances.size());
    entries.clear();
    add_entries(contacts, conduction, form, rows, first, last, entries);
    SparseMatrix part(conductance.rows(), conductance.cols());
    part.setFromTriplets(entries.begin(), entries.end());
    sum.add(std::move(part));
  }
  sum.add_to(conductance);
}

template <int dim>
std::vector<double> contact_flows(const contact::ContactSet<dim>& contacts, const JointConduction<dim>& conduction,
                                  const Eigen::VectorXd& temperature, JointForm form) {
  SCREE_EXPECT(conduction.conductances.size() == contacts.contacts.size());
  std::vector<double> flows;
  flows.reserve(contacts.contacts.size());
  for (const double conductance : conduction.conductances) {
    const auto difference = temperature_difference(contacts.contacts[flows.size()], form);
    double drop = 0;
    for (int i = 0; i < 2 * dim; ++i) {
      if (difference.weights[i] != 0) drop += difference.weights[i] * temperature[difference.nodes[i].value()];
    }
    flows.push_back(conductance * drop);
  }
  for (const PerfectTerm<dim>& term : conduction.perfect) {
    // As differences within each side: the fluxes of a side sum to zero only to rounding, and temperatures in kelvin are large.
    for (int i = 0; i < term.corners; ++i) {
      const int first = i <= dim ? 0 : dim + 1;
      flows[term.contact] -= term.flux[i] * (temperature[term.nodes[i].value()] - temperature[term.nodes[first].value()]);
    }
  }
  return flows;
}

#define SCREE_INSTANTIATE(dim)                                                                                           \
  template JointConduction<dim> joint_conduction<dim>(const mesh::BlockMesh<dim>&, const Table<MaterialId, Material>&,   \
                                                      const contact::ContactSet<dim>&, const JointOptions&);             \
  template void add_joints<dim>(const contact::ContactSet<dim>&, const JointConduction<dim>&, JointForm, const NodeMap&, \
                                Eigen::SparseMatrix<double>&);                                                           \
  template std::vector<double> contact_flows<dim>(const contact::ContactSet<dim>&, const JointConduction<dim>&,          \
                                                  const Eigen::VectorXd&, JointForm);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::thermal
