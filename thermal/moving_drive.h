// What drives a stabilised step and changes within it (rkl2.h): heat into nodes and temperatures of fixed ones, each taken for
// the parabola through its values at the step's start, middle and end. A drive that stays has no rows here and costs nothing.
#pragma once

#include "thermal/heat_balance.h"

namespace scree::thermal {

class MovingDrive {
 public:
  // Temperatures and error side by side: a product reads the matrix once for both.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

  explicit MovingDrive(const HeatModel& model);  // refers to it

  [[nodiscard]] bool empty() const { return heated_.empty() && held_.empty(); }

  // A step of this length from these temperatures [K]; `inverse` is 1/C of each node, 0 for a fixed one [K/J].
  void fit(const HeatBalance& balance, Drives& drives, double time, double length, const Eigen::VectorXd& temperature,
           const Eigen::VectorXd& inverse);

  // Adds `times` h C^-1 g at this part of the step to the temperatures' column.
  void heat(Columns& increment, double times, double part) const;

  // Sets what the fixed nodes have become warmer by at this part of the step.
  void hold(Columns& increment, double part) const;

  // Calls visit(row) for all rows that these two change, on all threads.
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    for_all(heated_, [&](const Parabola& of) { visit(of.row); });
    for_all(held_, [&](const Parabola& of) { visit(of.row); });
  }

 private:
  struct Parabola {
    int row = 0;
    std::size_t fixed = 0;  // of the model's fixed nodes; of those that are held
    double slope = 0;       // at the step's start, over the whole step [K]
    double bend = 0;        // [K]

    void fit(double middle, double end);
    [[nodiscard]] double at(double part) const { return part * (slope + part * bend); }
  };

  template <class Visit>
  static void for_all(const std::vector<Parabola>& rows, const Visit& visit) {
    for_short_chunks(rows.size(), [&](Chunk chunk) {
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) visit(rows[i]);
    });
  }

  std::vector<Parabola> heated_;  // ascending rows
  std::vector<Parabola> held_;
};

}  // namespace scree::thermal
