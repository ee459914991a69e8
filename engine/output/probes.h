// Points at which a field is followed in time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "engine/base/check.h"
#include "engine/base/function.h"
#include "engine/mesh/block_mesh.h"
#include "engine/output/cubic_reading.h"
#include "engine/output/probe_table.h"

namespace scree::output {

struct ProbeSpec {
  std::string name;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // [m]
  // How far the probe may be moved to lie on the nearest block's surface [m]. A pile has voids, and which point of it is one
  // differs from packing to packing; 0 makes a probe in a void an error.
  double reach = 0;
  std::optional<Function> exact{};  // the value there as known from elsewhere, to compare with
  SourceLocation where{};
};

// A probe that lies in a block.
template <int dim>
struct Probe {
  std::string name;
  BlockId block;
  Stencil reading;                  // of the nodes
  Point<dim> point;                 // where it is, after moving [m]
  double moved = 0;                 // [m]
  std::optional<Function> exact{};  // as in its ProbeSpec
};

// How a value between nodes is found.
enum class Reading {
  linear,  // from the corners of the element, or of the cell (cell_reading.h)
  cubic,   // cubic_reading.h
};

// The element that holds each probe, boundary included; of several (blocks that penetrate each other, a shared face) the one
// with the lowest number. Throws InputError listing every probe in a void, with the nearest block, its body and distance.
template <int dim>
std::vector<Probe<dim>> locate_probes(const mesh::BlockMesh<dim>& mesh, const std::vector<ProbeSpec>& specs,
                                      Reading reading = Reading::linear);

// The columns of the probes' table: each probe's name, and after it `NAME exact` if its exact value is known.
template <int dim>
std::vector<std::string> columns(const std::vector<Probe<dim>>& probes);

// The values of these columns at a time [s]. Throws InputError where an exact value is not defined.
template <int dim>
std::vector<double> column_values(const std::vector<Probe<dim>>& probes, const Eigen::VectorXd& nodal, double time);

// The exact value of a probe at a time [s]; nothing if it is not known.
template <int dim>
std::optional<double> exact_at(const Probe<dim>& probe, double time);

template <int dim>
double value_at(const Probe<dim>& probe, const Eigen::VectorXd& nodal);

// "low: block 812 of sphere at [0, 0, 0.06] m" for each probe, with the block's number from `numbers`: the comments of its
// table.
template <int dim>
std::vector<std::string> describe(const std::vector<Probe<dim>>& probes, const mesh::BlockMesh<dim>& mesh,
                                  const Table<BlockId, BlockId>& numbers);

}  // namespace scree::output
