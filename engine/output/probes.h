// Points at which a field is followed in time.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "engine/base/check.h"
#include "engine/mesh/block_mesh.h"

namespace scree::output {

struct ProbeSpec {
  std::string name;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // [m]
  // How far the probe may be moved to lie in a block [m]. A pile has voids, and which point of it is one differs from packing to
  // packing; 0 makes a probe in a void an error.
  double reach = 0;
  SourceLocation where;
};

// A probe that lies in a block.
template <int dim>
struct Probe {
  std::string name;
  BlockId block;
  ElementId element;
  std::array<double, dim + 1> weights{};  // of the element's nodes
  Point<dim> point;                       // where it is, after moving [m]
  double moved = 0;                       // [m]
};

// Throws InputError listing every probe in a void, with the nearest block, its body and distance.
template <int dim>
std::vector<Probe<dim>> locate_probes(const mesh::BlockMesh<dim>& mesh, const std::vector<ProbeSpec>& specs);

template <int dim>
double value_at(const Probe<dim>& probe, const mesh::BlockMesh<dim>& mesh, const Eigen::VectorXd& nodal);

// probes.csv: `time` in seconds, then a column per probe named after it; comment lines (#) above say in which block each lies
// and where. Rows are flushed one by one; `keep_until` of a resumed run keeps the rows up to and including that time.
class ProbeTable {
 public:
  ProbeTable(std::filesystem::path file, std::vector<std::string> comments, std::vector<std::string> names);
  ProbeTable(std::filesystem::path file, double keep_until);
  void append(double time, const std::vector<double>& values);  // throws RunError

 private:
  std::filesystem::path file_;
};

}  // namespace scree::output
