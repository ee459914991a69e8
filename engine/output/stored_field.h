// The temperatures of an earlier run, on the nodes of a mesh.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "engine/base/check.h"
#include "engine/mesh/block_mesh.h"

namespace scree::output {

struct StoredField {
  std::filesystem::path from;  // output directory of the run (its heat.pvd), a .pvd, or a .vtu
  std::optional<double> time;  // of a series [s]; nothing: its last
  double reach = 0;            // how far a node may lie outside the stored mesh [m]
  SourceLocation where = {};   // in the scene, for messages

  // What is wrong with the file that it names.
  [[nodiscard]] Problem problem(const std::string& value, const std::string& rule, const std::string& suggestion) const;
};

struct NodalField {
  Eigen::VectorXd values;
  bool same_mesh = false;  // every node had the place of the stored one of the same number: no interpolation
  std::size_t moved = 0;   // nodes that lie outside and have the value of the nearest point within reach
};

// The frame that is read. Throws InputError for a file or a time that is not there.
std::filesystem::path stored_frame(const StoredField& stored);

// The point array `temperature` at every node. On a mesh with other nodes a value is interpolated in the cell that holds the
// node, drawn a millionth of its block's extent into the block so that at a joint the block's own side is taken. Throws
// InputError for a file that cannot be read, a time that is not there, and nodes outside the mesh and its reach.
template <int dim>
NodalField read_stored(const StoredField& stored, const mesh::BlockMesh<dim>& mesh);

}  // namespace scree::output
