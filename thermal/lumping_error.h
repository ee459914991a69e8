// How wrong temperatures are because blocks are lumped: an estimate in kelvin, while the run goes on.
//
// Heat flows q_p [W] through the patches of a lumped block make its inside differ from its one temperature by at most
//   theta = sum R |q_p| + max c |q_p|
// wherever one looks, R the bulk resistance and c the constriction of a patch (inner_resistance.h): all contacts with one other
// block, all that one exchange with surroundings reaches, or where one load sets heat free. What flows into the block at some
// places of a patch and out of it at others counts both ways. It also takes from the drop over the joint at each place, so that
// this carries less,
//   g s,   s = (sum of R |q| over all that flows the same way as there) + c |q_p|,
// and that heat is missing elsewhere: to first order in the Biot number the temperatures are off by e,
//   C de/dt = -J e + d,   d = the sum of what the patches carry less,   J = -dF/dT,
// which backward Euler steps follow beside the run's own. The estimate is the largest theta plus the largest |e|. In the first
// instants after a sudden start the inside has not built up theta yet, and the estimate is too large. Without loads it is at
// most what temperatures may differ by at all.
#pragma once

#include <vector>

#include "thermal/free_nodes.h"
#include "thermal/heat_balance.h"
#include "thermal/temperature_range.h"

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

  // After a step of `length` [s] to these temperatures; an infinite one leads to the steady state. `range`: what temperatures
  // there have been so far, within and outside.
  void advance(const Eigen::VectorXd& temperature, const Drive& drive, double length, const TemperatureRange& range,
               LumpingError& error);

 private:
  // Where heat passes between a lumped block's row and another one: an entry of K off its diagonal.
  struct Link {
    int row;
    int other;
    double conductance;  // [W/K]
  };
  // Where it passes between that row and its surroundings, or is set free.
  struct Place {
    int row;
    int number;       // of the exchange, or of the load
    Eigen::Index at;  // among what that reaches
  };
  struct Patch {
    int block;  // its position among the lumped ones
    int size;   // how many links or places
    PatchResistance resists;
  };
  struct Flow;
  struct Inside;
  void include(const TemperatureRange& range);
  [[nodiscard]] double most() const;  // that temperatures can be off by [K]
  void add_links(int block);
  // Where the exchange or load `number` reaches lumped blocks. Patches of its kind are numbered from `first` on.
  void add_places(const NodeShares& on, std::size_t number, std::size_t first, std::vector<Place>& places,
                  std::vector<Patch>& patches) const;
  [[nodiscard]] std::vector<Flow> flows(const Eigen::VectorXd& temperature, const Drive& drive) const;
  // Every patch with what flows through its links or places, each by visit(const Patch&, std::span<const Flow>).
  template <class Visit>
  void for_each_patch(const std::vector<Flow>& flows, const Visit& visit) const;
  [[nodiscard]] std::vector<Inside> insides(const std::vector<Flow>& flows, double time) const;
  [[nodiscard]] double applied(const Place& place, double time) const;  // of a load [W]
  void apply(double time, std::vector<Inside>& insides) const;
  [[nodiscard]] Eigen::VectorXd missing(const std::vector<Flow>& flows, const std::vector<Inside>& insides) const;
  void make_matrix();
  void set_matrix(const Eigen::VectorXd& conductivity_of_all, const Eigen::VectorXd& more);
  void carry(const Eigen::VectorXd& heat, const Linearised& at, double length, Eigen::VectorXd& carried);

  const HeatModel& model_;
  const std::vector<LumpedBlock>& blocks_;
  TemperatureRange range_;
  double start_spread_ = 0;           // the largest of the blocks' [K]
  Table<MaterialId, double> harder_;  // how many times what blocks resist at the start they may resist in that range [-]
  HeatBalance balance_;
  FreeNodes free_;
  // Links of all lumped blocks in turn, then places of all exchanges; patches in the order of both.
  std::vector<Link> links_;
  std::vector<Place> places_;
  std::vector<Patch> patches_;
  // Of all loads.
  std::vector<Place> loaded_places_;
  std::vector<double> steady_heat_;  // set free there by a load that does not change in time [W]
  std::vector<Patch> loaded_patches_;
  SparseMatrix matrix_;                 // C/h + J of the last step, between free rows [W/K]
  std::vector<Eigen::Index> diagonal_;  // places of its diagonal among its values
  Eigen::VectorXd conductance_;         // its values, of K alone
  SparseMatrix unit_conductance_;       // of U, if there is one
};

}  // namespace scree::thermal
