// The two sides of the heat balance dH/dt = F(T, t): what each node stores and what flows into it.
//
// Storage: H = m int c dT up to T, m the node's mass; C T where c does not depend on temperature. Only differences of H are
// used, so energy is conserved whatever c(T) does, and the integral may begin where it likes (Curve::integral).
//
// Conduction: where k depends on temperature, Kirchhoff's Phi = int k dT up to T, of one material from one beginning, takes the
// place of k T at the nodes: the heat that leaves is U Phi(T), U the blocks' matrix of eqs. (4)-(5) at 1 W/m/K (for a tensor k:
// its ratios). Flux is -grad Phi exactly, so a steady k(T) costs no accuracy. Flows stay pairs of equal and opposite ones.
#pragma once

#include "thermal/drive.h"
#include "thermal/flow_network.h"

namespace scree::thermal {

// C = dH/dT and J = -dF/dT = K + U diag(conductivity) + diag(loss), one entry per node each.
struct Linearised {
  Eigen::VectorXd capacity;      // [J/K]
  Eigen::VectorXd loss;          // to surroundings [W/K]
  Eigen::VectorXd conductivity;  // [W/m/K]; empty without U
};

// What a tangent is taken at.
struct TangentPoint {
  const Eigen::VectorXd& temperature;  // [K]
  const Drive& drive;
};

// How much more heat each node loses to surroundings as it gets warmer [W/K].
Eigen::VectorXd loss_to_surroundings(const HeatModel& model, const Eigen::VectorXd& temperature, const Drive& drive);

// C = dH/dT of each node [J/K].
Eigen::VectorXd capacity_at(const HeatModel& model, const Eigen::VectorXd& temperature);

// dC/dT over C of each node [1/K], 0 where it is not known (Curve::slope).
Eigen::VectorXd capacity_slope_at(const HeatModel& model, const Eigen::VectorXd& temperature);

// Whether the heat capacity of a node that gets warmer or colder by more than `least` [K] is far from a single value on the
// way, as in a peak of latent heat, or puts its temperature off by more than that at a kink, as at a table's rows: temperatures
// bend there.
bool capacity_bends_on_the_way(const HeatModel& model, const Eigen::VectorXd& from, const Eigen::VectorXd& to, double least);
// The same of conductivities.
bool conductivity_bends_on_the_way(const HeatModel& model, const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                   double least);

class HeatBalance {
 public:
  explicit HeatBalance(const HeatModel& model, Sums sums = Sums::extended);  // refers to it

  // F: heat into each node, from its neighbours and from outside [W].
  [[nodiscard]] Eigen::VectorXd heating(const Eigen::VectorXd& temperature, const Drive& drive) const;

  // What of F comes from outside, loads and exchanges.
  [[nodiscard]] Eigen::VectorXd driven(const Eigen::VectorXd& temperature, const Drive& drive) const;

  // F of some nodes, in ascending order, one entry each; with `tangent`, F of its temperatures and along the tangent there.
  [[nodiscard]] Eigen::VectorXd heating_at(const std::vector<NodeId>& nodes, const Eigen::VectorXd& temperature,
                                           const Drive& drive, const TangentPoint* tangent = nullptr) const;

  // Heat that a change of temperature stores in each node [J].
  [[nodiscard]] Eigen::VectorXd stored(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;
  // The larger of each node's H at both [J]: what is stored is a difference of these, with their rounding.
  [[nodiscard]] Eigen::VectorXd largest_stored(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;
  // In a single one, and in all of them together.
  [[nodiscard]] double stored_at(NodeId node, const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;
  [[nodiscard]] double stored_in_all(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;

  // The temperatures at which each node has stored so much heat [J], up from `from`, looked for from `guess` on; what is not
  // finite stays so.
  [[nodiscard]] Eigen::VectorXd temperature_after(const Eigen::VectorXd& from, const Eigen::VectorXd& heat,
                                                  const Eigen::VectorXd& guess) const;

  [[nodiscard]] Linearised linearised(const Eigen::VectorXd& temperature, const Drive& drive) const;

  // J times a small change of temperature, at fixed nodes too [W].
  [[nodiscard]] Eigen::VectorXd lost(const Eigen::VectorXd& change, const Linearised& at) const;

  // K, without U; and U, and what it multiplies, Phi of each node [W/m].
  [[nodiscard]] const FlowNetwork& flows() const { return flows_; }
  [[nodiscard]] const FlowNetwork& unit_flows() const { return unit_flows_; }
  [[nodiscard]] Eigen::VectorXd conducted(const Eigen::VectorXd& temperature) const;

  // Through one exchange; `tangent` as for heating_at().
  struct Exchanged {
    double heat = 0;  // [W]
    double size = 0;  // the same without signs [W]
  };
  [[nodiscard]] Exchanged exchanged(std::size_t exchange, const Eigen::VectorXd& temperature, const Drive& drive,
                                    const TangentPoint* tangent = nullptr) const;
  // How much less comes in through one for a small change of temperature [W].
  [[nodiscard]] double lost_to(std::size_t exchange, const Eigen::VectorXd& change, const TangentPoint& at) const;

 private:
  const HeatModel& model_;
  FlowNetwork flows_;
  FlowNetwork unit_flows_;  // of U
};

}  // namespace scree::thermal
