// K T as flows between pairs of nodes.
//
// K is symmetric with zero row sums, so (K T)_i = sum_j K_ij (T_j - T_i). Summed like this each flow leaves one node and
// enters another with the same bits, whichever row it is evaluated in: rounding is relative to the flows and not to K times
// some hundred kelvin, and a uniform temperature makes no flow at all. With stiff joints the plain product loses four digits of
// the heat balance.
//
// A joint couples the corners of a face with one another, too: flows as large as its stiffness, which cancel at each node.
// `extended` sums them in long double (64 bits of mantissa on x86), or the sum over all nodes would keep their rounding;
// `plain` will do where steps are short enough to be explicit.
#pragma once

#include <optional>

#include "thermal/heat_model.h"
#include "thermal/row_runs.h"

namespace scree::thermal {

enum class Sums { plain, extended };

class FlowNetwork {
 public:
  // Refers to the matrix, symmetric to the bit; without one nothing flows.
  FlowNetwork(const SparseMatrix* conductance, Sums sums);

  // K T: the heat that leaves each node [W].
  [[nodiscard]] Eigen::VectorXd leaving(const Eigen::VectorXd& temperature) const;

  // Of one node.
  [[nodiscard]] double leaving(NodeId node, const Eigen::VectorXd& temperature) const;

  // Calls use(row, flow) for every row on all threads: flow[c] is the heat that leaves the row's node, summed plainly, at
  // `columns` columns of temperatures that lie side by side [W]. Itself not to be called on several threads.
  template <int columns, class Use>
  void for_each_flow(const double* temperature, const Use& use) const {
    rows().for_each_flow<columns>(temperature, use);
  }

  // The same; see RowRuns::for_each_part.
  template <int columns, class RowsOf>
  void for_each_part(const double* temperature, const RowsOf& rows_of) const {
    rows().for_each_part<columns>(temperature, rows_of);
  }

  [[nodiscard]] bool empty() const { return conductance_ == nullptr || conductance_->nonZeros() == 0; }

 private:
  const RowRuns& rows() const;

  const SparseMatrix* conductance_;
  Sums sums_;
  mutable std::optional<RowRuns> rows_;  // made when all rows are first asked for, which some never do
};

}  // namespace scree::thermal
