// How wrong temperatures are because blocks are lumped: an estimate in kelvin, while the run goes on.
//
// Heat flows q_p [W] through the patches of a lumped block make its inside differ from its one temperature by at most
//   theta = sum R |q_p| + max c |q_p|
// wherever one looks, R the bulk resistance and c the constriction of a patch (inner_resistance.h): all contacts with one other
// block, or what comes from surroundings or is applied, of which the largest count. That also takes from the drop over its
// joints, so that each carries less,
//   g_p s_p,   s_p = (sum of R |q| over all that flows the same way as q_p) + c |q_p|,
// and that heat is missing elsewhere: to first order in the Biot number the temperatures are off by e,
//   C de/dt = -J e + d,   d = the sum of what the patches carry less,   J = -dF/dT,
// which backward Euler steps follow beside the run's own. The estimate is the largest theta plus the largest |e|. In the first
// instants after a sudden start the inside has not built up theta yet, and the estimate is too large.
#pragma once

#include <vector>

#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"

namespace scree::thermal {

// What a run knows of it so far.
struct LumpingError {
  Eigen::VectorXd carried;  // e of every row; empty unless blocks are lumped [K]
  double largest = 0;       // of the estimate, at any time; at first what the means at the start left out [K]
};

class LumpingEstimate {
 public:
  explicit LumpingEstimate(const HeatModel& model);  // refers to it; some of its blocks are lumped

  [[nodiscard]] LumpingError start() const;

  // After a step of `length` [s] to these temperatures; an infinite one leads to the steady state.
  void advance(const Eigen::VectorXd& temperature, const Drive& drive, double length, LumpingError& error) const;

 private:
  // What a lumped block's row has in common with another row: an entry of K off its diagonal.
  struct Link {
    int row;       // the other one
    double entry;  // [W/K]
  };
  // One of the blocks that a lumped block touches.
  struct Neighbour {
    int position;            // of the lumped block
    int links;               // how many
    double conductance = 0;  // of all of them [W/K]
    PatchResistance resists = {};
  };
  struct Flows;
  struct Patch;
  // Every patch of lumped blocks, each by visit(Patch).
  template <class Visit>
  void for_each_patch(const Eigen::VectorXd& temperature, const Drive& drive, const Visit& visit) const;
  [[nodiscard]] std::vector<Flows> flows(const Eigen::VectorXd& temperature, const Drive& drive) const;
  [[nodiscard]] Eigen::VectorXd missing(const Eigen::VectorXd& temperature, const Drive& drive,
                                        const std::vector<Flows>& flows) const;
  void add_neighbours(int position);
  void carry(const Eigen::VectorXd& heat, const Linearised& at, double length, Eigen::VectorXd& carried) const;

  const HeatModel& model_;
  const std::vector<LumpedBlock>& blocks_;
  HeatBalance balance_;
  FreeNodes free_;
  // Of all lumped blocks in turn: what a step goes through lies in the order in which it does.
  std::vector<Neighbour> neighbours_;
  std::vector<Link> links_;
  SparseMatrix conductance_;       // between free rows [W/K]
  SparseMatrix unit_conductance_;  // of U, if there is one
};

}  // namespace scree::thermal
