// Fourth order in space on grids of equal cells (`heat.space_order: 4`).
//
// Of a wave of the vector k on a grid whose cells are h_i long, the conductance of the multilinear element makes
//   C^-1 K T = a (sum_i k_i^2 (1 - h_i^2 k_i^2/12) - m sum_i,j!=i k_i^2 h_j^2 k_j^2/12) T + O(h^4)
// with m = 2 integrated by Gauss, and with m = 0 integrated at the corners. Their mean has m = 1, which is
//   a |k|^2 (1 - sum_i h_i^2 k_i^2/12):
// an error that storage by M, the mean of the lumped C and of the consistent one (Goudreau and Taylor, Comput. Methods Appl.
// Mech. Eng. 2, 1973), makes as well, as C^-1 M = 1 - sum_i h_i^2 k_i^2/12 + O(h^4). So M dT/dt = Q - K T errs by O(h^4).
// (Guddati and Yue, ibid. 193, 2004, get there by moving the points of quadrature, which gives cells that are no boxes another
// mass.) At the corners of cells that are no parallelepipeds not even a uniform gradient is integrated exactly: they take mixed
// discretisation (cell_conduction.h) instead, which in the plane is the same where it matters.
//
// Explicit steps need no solution with M: with B = C - M, the capacity that neighbours share,
//   C dT/dt = (I + B C^-1) (Q - K T)
// differs from it by O(h^4), too (Krenk, ibid. 191, 2001, does so for waves). The rows of B add up to zero: what it passes on
// is neither made nor lost.
//
// Sources. Q is what nodes get of a power p that is smooth in place, C p/(rho c), where M p/(rho c) belongs: Q - B C^-1 Q takes
// its place. A flux over a surface has no such form here: one that varies along it, with a conductivity that is not the same
// along and across it or cells that are no squares, is of order two.
//
// Held nodes. At them dT/dt = 0 whatever flows in, so they pass nothing on; what they share of their neighbours' heating comes
// out of the hold. Where a hold's temperature differs from the initial one, M carries the jump into the nodes beside it, the
// other way and by some tenth of it: T = T0 + C^-1 (I + B C^-1) B (T_held - T0) at t = 0+. It is this that makes
// a sudden start as exact as the rest; nodes beside it leave the range of the given temperatures for the first moments.
//
// The order is four where the cells of a block are equal boxes and the axes of its conductivity along theirs, and no heat but
// from holds and sources enters. Cells of other shapes, convection, a flux (of order two where the surface is; what it gives
// the cells beside it is off by rho c h^2/12 times the slope that it makes, which an insulated body keeps), joints, and a
// source or an initial temperature that has a slope across an insulated side lower it to two. The heat that passes a hold is of
// order two in any case, since contents are sums of C T.
#pragma once

#include <optional>
#include <vector>

#include "thermal/cell_conduction.h"
#include "thermal/flow_network.h"
#include "thermal/heat_balance.h"
#include "thermal/heat_options.h"

namespace scree::thermal {

// Turns a corner of a quadrilateral or hexahedron from mixed discretisation into one of fourth order.
template <int dim>
void make_fourth_order(mesh::CellKind kind, const CellPoints<dim>& points, const Tensor<dim>& conductivity, int corner,
                       CornerOfCell& mixed);

// Throws InputError for a scene whose heat can not be resolved in fourth order.
template <int dim>
void check_fourth_order(const mesh::BlockMesh<dim>& mesh, const Table<MaterialId, Material>& materials,
                        const HeatOptions& options);

// A bound of the largest eigenvalue of I + C^-1 B: by its cells where they are equal, else by Gershgorin's circles; 1 without
// B [-].
double largest_gain(const HeatModel& model);

// T at t = 0+, the fixed nodes at `held` [K].
Eigen::VectorXd after_jump(const HeatModel& model, const Eigen::VectorXd& held);

// What fixed nodes are given of the heating of the nodes beside them.
class HeldShares {
 public:
  explicit HeldShares(const HeatModel& model);

  // Of each fixed node [W].
  [[nodiscard]] Eigen::VectorXd shares(const HeatBalance& balance, const Eigen::VectorXd& temperature,
                                       const Drive& drive) const;

  // The free nodes that they share with. Ascending.
  [[nodiscard]] const std::vector<NodeId>& givers() const { return givers_; }

 private:
  struct Share {
    Eigen::Index fixed;  // its place among the fixed nodes
    Eigen::Index giver;
    double share;  // [-]
  };
  std::vector<NodeId> givers_;
  std::vector<Share> shares_;
  Eigen::Index fixed_;
};

}  // namespace scree::thermal
