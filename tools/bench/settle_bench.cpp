// The fall of a scene's blocks by Bullet as it comes and by Scree, one after the other, with what each took and how deep its
// blocks are in each other at the end.
//
//   scree_settle_bench scenes/pile_undamped.yaml SECONDS [PROGRAM]
//
// PROGRAM: only those whose name begins so.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/base/threads.h"
#include "engine/mesh/make_blocks.h"
#include "engine/output/read_vtu.h"
#include "engine/packing/penetration.h"
#include "engine/rigid/settle.h"
#include "tools/bench/peers/plain_bullet.h"
#include "tools/scene/read_scene.h"

namespace scree::bench {
namespace {

// What Bullet keeps between the hulls of blocks at rest, over their mean edge; so far apart, Scree has no overlaps left,
// either.
constexpr double bullets_gap = 0.004;

void measure(const std::string& name, const std::function<packing::Packing<3>()>& fall) {
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  const packing::Packing<3> packing = fall();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double spent = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
  const mesh::BlockMesh<3> placed = packing::placed_mesh(packing);
  const double edge = mesh::mean_edge(packing.mesh);
  const packing::Penetration depth = packing::measure_penetration(packing::PieceSet(placed), 0.01 * edge);
  double top = 0;
  for (const Point<3>& node : placed.nodes) top = std::max(top, node.z());
  fmt::print("{},{:.4f},{:.4f},{:.4f},{:.5f},{},{:.3f}\n", name, wall, spent, 100 * depth.max / edge, 100 * depth.mean / edge,
             depth.touching, top);
  std::fflush(stdout);
}

// In Bullet's step, not the scene's shorter one, and without an end to it when the blocks are at rest.
packing::Packing<3> scree_fall(const Scene& scene, const mesh::BlockMesh<3>& blocks, double seconds, int threads,
                               double clearance) {
  use_threads(threads);
  rigid::SettleOptions options = scene.settle->options;
  options.step = plain_step;
  options.limit = seconds;
  options.rest_speed = 1e-12;
  options.frame_interval = seconds;
  options.clearance = clearance;
  return rigid::settle(blocks, scene.materials, options);
}

int compare(const std::string& file, double seconds, const std::string& only) {
  const Scene scene = read_scene(file);
  const auto blocks = mesh::make_blocks<3>(scene.bodies, output::mesh_readers());
  const Material& material = *scene.materials.begin();
  const double edge = mesh::mean_edge(blocks);
  fmt::print("program,wall_s,processor_s,largest_overlap_percent,mean_overlap_percent,touching_pairs,top_m\n");
  const std::pair<std::string, std::function<packing::Packing<3>()>> programs[] = {
      {"Scree; two threads", [&] { return scree_fall(scene, blocks, seconds, 2, 0); }},
      {"Scree; one thread", [&] { return scree_fall(scene, blocks, seconds, 1, 0); }},
      {"Scree apart; two threads", [&] { return scree_fall(scene, blocks, seconds, 2, bullets_gap * edge); }},
      {"Bullet with its own hulls", [&] { return plain_fall(blocks, *material.density, material.friction, seconds).packing; }}};
  for (const auto& [name, fall] : programs) {
    if (name.starts_with(only)) measure(name, fall);
  }
  return 0;
}

}  // namespace
}  // namespace scree::bench

int main(int count, char** words) {
  if (count != 3 && count != 4) {
    fmt::print(stderr, "usage: scree_settle_bench SCENE SECONDS [PROGRAM]\n");
    return 2;
  }
  try {
    return scree::bench::compare(words[1], std::atof(words[2]), count == 4 ? words[3] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
