// K T as flows between pairs of nodes.
//
// K is symmetric with zero row sums, so (K T)_i = sum_j -K_ij (T_i - T_j). Summed like this each flow leaves one node and
// enters another with the same bits: rounding is relative to the flows and not to K times some hundred kelvin, and a uniform
// temperature makes no flow at all. With stiff joints the plain product loses four digits of the heat balance.
//
// A joint couples the corners of a face with one another, too: flows as large as its stiffness, which cancel at each node.
// They are summed in long double (64 bits of mantissa on x86), or the sum over all nodes would keep their rounding.
#pragma once

#include "thermal/heat_model.h"

namespace scree::thermal {

class FlowNetwork {
 public:
  explicit FlowNetwork(const SparseMatrix& conductance);

  // K T: the heat that leaves each node [W].
  [[nodiscard]] Eigen::VectorXd leaving(const Eigen::VectorXd& temperature) const;

  [[nodiscard]] bool empty() const { return links_.empty(); }

 private:
  struct Link {
    int first;
    int second;
    double conductance;  // -K_ij [W/K]
  };
  std::vector<Link> links_;  // in the order of the matrix
  Eigen::Index size_;
};

}  // namespace scree::thermal
