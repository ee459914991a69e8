// The effective conductivity tensor of the blocks and joints in a window of space, with its bounds.
//
// Hill 1963; Hazanov & Huet 1994: for a sample of finite size, a linear temperature on its boundary gives a tensor that is
// never below the effective one, a uniform flux through its boundary one that is never above it. Between them lies what a
// measurement between two plates gives: two sides held, the others insulated.
#pragma once

#include <optional>
#include <vector>

#include "engine/mesh/cells.h"
#include "thermal/heat_model.h"

namespace scree::thermal {

template <int dim>
struct EffectiveConductivity {
  using Tensor = Eigen::Matrix<double, dim, dim>;
  Tensor upper = Tensor::Zero();  // temperature linear on and outside the window's boundary [W/m/K]
  // Uniform flux through the window's sides [W/m/K]; nothing unless faces of blocks cover all of them, nor where blocks on two
  // sides are not joined, nor where joints are so stiff that it is lost in rounding.
  std::optional<Tensor> lower;
  Point<dim> along = Point<dim>::Zero();  // per axis, between two plates [W/m/K]
  double solid_fraction = 0;              // of the window's volume [-]
  // Of the mean over the axes of the conductivity, voids at 0: in the mean over the axes no arrangement conducts better
  // [W/m/K].
  double volume_mean = 0;
};

// Of a simplex as conduction sees it: an element, or one of either split of a cell, which count half.
template <int dim>
struct PartInside {
  mesh::Simplex<dim> nodes;
  BlockId block;
  double volume = 0;  // [m3] (2-D: [m2])
};

// What lies in the window. Throws InputError if nothing does.
template <int dim>
std::vector<PartInside<dim>> parts_in(const mesh::BlockMesh<dim>& mesh, const Aabb<dim>& window);

// Nodes on and outside the window's sides are held, where a temperature that is linear along the axis would hold them, and
// fluxes related to the mean gradient that is left within the sides. Exact in a homogeneous solid, wherever they cut its
// elements; otherwise the bounds are ones only if the sides cut none. `model` is that of `mesh`, whatever it holds fixed.
// Throws InputError for a window that holds no part of an element.
template <int dim>
EffectiveConductivity<dim> effective_conductivity(const mesh::BlockMesh<dim>& mesh,
                                                  const Table<MaterialId, Material>& materials, const HeatModel& model,
                                                  const Aabb<dim>& window);

}  // namespace scree::thermal
