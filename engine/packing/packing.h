// The frozen configuration: where every block came to rest.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/block_mesh.h"

namespace scree::packing {

// What is known about a settled pile; the run's evidence for "at rest".
struct SettleReport {
  bool at_rest = false;
  std::string criterion;        // in words and numbers, what "at rest" meant
  double simulated_time = 0;    // [s]
  double rms_speed = 0;         // over free blocks, at the end [m/s]
  double max_speed = 0;         // fastest free block at the end [m/s]
  double unbalanced_force = 0;  // mean net force on a block over mean force of a touching pair, at the end [-]
  double max_displacement = 0;  // of any free block over the last window [m]
  double window = 0;            // that window [s]
  double max_penetration = 0;   // over all pairs, on the true geometry [m]
  double mean_penetration = 0;  // over the pairs that touch [m]
  // Deepest overlap of two blocks at any time of the fall, over the size of the smaller: the cube root of its volume, or the
  // thickness of a convex one, if that is less [-].
  double deepest_overlap = 0;
  double mean_edge = 0;  // of the free blocks' elements [m]
  double top = 0;        // highest point of a free block, against gravity, above what is fixed below it (scene_bounds.h) [m]
  Table<BlockId, double> net_force;  // on each block in the last step; 0 on fixed and lost ones [N]
  std::vector<BlockId> lost_blocks;  // left the scene; frozen where they left it
};

// Blocks as meshed (`mesh`, reference positions) and the pose each of them took.
template <int dim>
struct Packing {
  mesh::BlockMesh<dim> mesh;
  Table<BlockId, Pose> poses;
  std::optional<SettleReport> settled;  // nothing if the scene has no motion
  std::string key;                      // hash of everything the packing depends on
};

// A packing without motion: every block where it was meshed.
template <int dim>
Packing<dim> unmoved(mesh::BlockMesh<dim> mesh);

// The mesh with every block moved to its pose.
template <int dim>
mesh::BlockMesh<dim> placed_mesh(const Packing<dim>& packing);

// Writes and reads a packing, doubles to the bit (HDF5). A file appears under its name only when it is whole.
// `write` throws RunError (full disk), `read` InputError (missing, damaged, of another dimension or version).
template <int dim>
void write(const Packing<dim>& packing, const std::filesystem::path& file);
template <int dim>
Packing<dim> read(const std::filesystem::path& file);

// The key of a packing file without reading the rest; nothing if there is no readable packing.
std::optional<std::string> stored_key(const std::filesystem::path& file);

}  // namespace scree::packing
