#include "tools/run/certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "engine/base/hash.h"
#include "engine/packing/bulk.h"
#include "engine/packing/touching_pairs.h"

namespace scree::run {

namespace {

using Json = nlohmann::ordered_json;
using packing::Meeting;
using packing::TouchingPair;

// Blocks nearer than this part of a block's size touch. Between 1e-5 and 1e-2 the mean coordination number of a poured pile
// changes by a tenth (engine/packing/README.md).
constexpr double touching_range = 1e-3;
constexpr double lean_degrees = 2;

struct Measured {
  const mesh::BlockMesh<3>& mesh;  // placed
  Eigen::Matrix3d turn;            // by which the mesh is upright
  packing::Columns columns;        // of the mesh turned upright
  std::vector<TouchingPair> pairs;
  std::vector<bool> counted;  // of each block: it is free and still in the scene
  std::vector<bool> inner;    // and its centre lies in the inner region
};

// Which way round up is z.
Eigen::Matrix3d upright(const Eigen::Vector3d& gravity) {
  if (gravity.norm() == 0) return Eigen::Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(-gravity, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

mesh::BlockMesh<3> turned_by(const Eigen::Matrix3d& turn, mesh::BlockMesh<3> mesh) {
  for (Point<3>& node : mesh.nodes) node = turn * node;
  return mesh;
}

Eigen::Vector3d centre_of(const mesh::BlockMesh<3>& mesh, BlockId block) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double volume = 0;
  for (const ElementId e : mesh.blocks[block].elements) {
    const double part = mesh::element_volume(mesh, e);
    for (const NodeId node : mesh.elements[e]) centre += part / 4 * mesh.nodes[node];
    volume += part;
  }
  return centre / volume;
}

bool free_block(const mesh::BlockMesh<3>& mesh, BlockId block) {
  return !mesh.bodies[mesh.blocks[block].body].fixed;
}

std::vector<bool> inner_blocks(const mesh::BlockMesh<3>& mesh, const packing::Columns& columns,
                               const std::vector<bool>& counted) {
  std::vector<bool> inner(mesh.blocks.size());
  for (const BlockId block : mesh.blocks.ids()) {
    if (!counted[block.index()]) continue;
    const Eigen::Vector3d centre = centre_of(mesh, block);
    const auto line = columns.nearest(centre.head<2>());
    const auto part = line ? packing::inner_part(columns, *line) : std::nullopt;
    inner[block.index()] = part && part->low <= centre.z() && centre.z() <= part->high;
  }
  return inner;
}

Json porosity_json(const Measured& measured) {
  const packing::Columns& columns = measured.columns;
  const auto inner = packing::inner_porosity(columns);
  if (!inner) return nullptr;
  const auto list = [](const Eigen::Vector3d& of) { return std::vector<double>(of.begin(), of.end()); };
  return {
      {"value", inner->porosity},
      {"solid_fraction", 1 - inner->porosity},
      {"method",
       fmt::format("vertical lines {:.3g} m apart, exact along each, overlaps counted once; at least one block's size, {:.3g} "
                   "m, from the floor, the walls and the surface",
                   columns.spacing, inner->margin)},
      {"volume", inner->volume},
      {"lines", inner->lines},
      {"low", list(inner->box.min())},
      {"high", list(inner->box.max())},
      {"axes", {list(measured.turn.row(0)), list(measured.turn.row(1)), list(measured.turn.row(2))}}};
}

Json coordination_json(const Measured& measured) {
  std::vector<double> neighbours(measured.mesh.blocks.size());
  for (const TouchingPair& pair : measured.pairs) {
    ++neighbours[pair.first.index()];
    ++neighbours[pair.second.index()];
  }
  double inner = 0, inner_blocks = 0, all = 0, blocks = 0, untouched = 0;
  for (const BlockId block : measured.mesh.blocks.ids()) {
    if (!measured.counted[block.index()]) continue;
    const double count = neighbours[block.index()];
    all += count;
    ++blocks;
    if (count == 0) ++untouched;
    if (!measured.inner[block.index()]) continue;
    inner += count;
    ++inner_blocks;
  }
  const auto mean = [](double sum, double count) { return count > 0 ? Json(sum / count) : Json(nullptr); };
  return {{"mean", mean(inner, inner_blocks)},
          {"blocks", static_cast<std::size_t>(inner_blocks)},
          {"mean_of_all", mean(all, blocks)},
          {"without_contact", static_cast<std::size_t>(untouched)}};
}

Json contacts_json(const Measured& measured) {
  std::array<std::size_t, 6> counts{};
  std::size_t with_fixed = 0;
  for (const TouchingPair& pair : measured.pairs) {
    ++counts[static_cast<std::size_t>(pair.meeting)];
    if (!free_block(measured.mesh, pair.first) || !free_block(measured.mesh, pair.second)) ++with_fixed;
  }
  const auto of = [&](Meeting meeting) { return counts[static_cast<std::size_t>(meeting)]; };
  return {{"face_face", of(Meeting::face_face)},
          {"face_edge", of(Meeting::face_edge)},
          {"face_point", of(Meeting::face_point)},
          {"edge_edge", of(Meeting::edge_edge)},
          {"edge_point", of(Meeting::edge_point)},
          {"point_point", of(Meeting::point_point)},
          {"with_fixed", with_fixed}};
}

// Penetrations and gaps of the pairs that touch.
void add_distances(Json& json, const std::vector<TouchingPair>& pairs) {
  std::array<double, 2> sums{}, largest{}, counts{};
  for (const TouchingPair& pair : pairs) {
    const std::size_t side = pair.gap < 0 ? 0 : 1;
    sums[side] += std::abs(pair.gap);
    largest[side] = std::max(largest[side], std::abs(pair.gap));
    ++counts[side];
  }
  for (const auto& [name, side] : {std::pair<const char*, std::size_t>("penetrations", 0), {"gaps", 1}}) {
    json[name] = {{"pairs", static_cast<std::size_t>(counts[side])},
                  {"mean", counts[side] > 0 ? sums[side] / counts[side] : 0.0},
                  {"largest", largest[side]}};
  }
}

double weight(const Scene& scene, const mesh::BlockMesh<3>& mesh, BlockId block) {
  double volume = 0;
  for (const ElementId e : mesh.blocks[block].elements) volume += mesh::element_volume(mesh, e);
  const double density = scene.materials[mesh.bodies[mesh.blocks[block].body].material].density.value_or(0);
  return volume * density * scene.settle->options.gravity.norm();
}

// Net force of the last step over the weight, of every free block that is still in the scene.
Json balance_json(const Scene& scene, const packing::Packing<3>& packing, const std::vector<bool>& counted) {
  double sum = 0, count = 0, largest = 0, balanced = 0;
  BlockId worst;
  for (const BlockId block : packing.mesh.blocks.ids()) {
    if (!counted[block.index()]) continue;
    const double bearing = weight(scene, packing.mesh, block);
    if (bearing <= 0) return nullptr;
    const double share = packing.settled->net_force[block] / bearing;
    sum += share;
    ++count;
    if (share < 0.01) ++balanced;
    if (share > largest) worst = block;
    largest = std::max(largest, share);
  }
  if (count == 0) return nullptr;
  return {{"mean", sum / count},
          {"largest", largest},
          {"largest_block", worst.valid() ? Json(worst.value()) : Json(nullptr)},
          {"blocks", static_cast<std::size_t>(count)},
          {"within_a_hundredth", static_cast<std::size_t>(balanced)}};
}

std::string geometry_hash(const mesh::BlockMesh<3>& placed) {
  Hasher hasher;
  for (const Point<3>& node : placed.nodes) hasher.add_bytes(node.data(), 3 * sizeof(double));
  return hasher.hex();
}

}  // namespace

Json certificate(const Scene& scene, const packing::Packing<3>& packing) {
  const mesh::BlockMesh<3> placed = packing::placed_mesh(packing);
  const Eigen::Matrix3d turn = upright(scene.settle->options.gravity);
  const mesh::BlockMesh<3> turned = turned_by(turn, placed);
  const packing::PieceSet pieces(turned);
  const std::vector<BlockId>& lost = packing.settled->lost_blocks;
  const auto is_lost = [&lost](BlockId block) { return std::binary_search(lost.begin(), lost.end(), block); };
  Measured measured{turned, turn, packing::cut_by_lines(turned, pieces, lost), {}, {}, {}};
  for (const BlockId block : turned.blocks.ids()) measured.counted.push_back(free_block(turned, block) && !is_lost(block));
  const double size = measured.columns.size;
  // Blocks that keep a clearance bear each other across it.
  const double range = touching_range * size + scene.settle->options.clearance;
  measured.pairs = packing::touching_pairs(pieces, {range, lean_degrees * std::numbers::pi / 180});
  std::erase_if(measured.pairs, [&](const TouchingPair& pair) { return is_lost(pair.first) || is_lost(pair.second); });
  measured.inner = inner_blocks(turned, measured.columns, measured.counted);
  const auto repose = packing::angle_of_repose(measured.columns);
  Json json{{"block_size", size},
            {"touching_range", range},
            {"lean_degrees", lean_degrees},
            {"porosity", porosity_json(measured)},
            {"coordination", coordination_json(measured)},
            {"contacts", contacts_json(measured)},
            {"force_balance", balance_json(scene, packing, measured.counted)}};
  add_distances(json, measured.pairs);
  json["height"] = packing.settled->top;
  json["angle_of_repose_degrees"] = repose ? Json(repose->angle * 180 / std::numbers::pi) : Json(nullptr);
  json["angle_of_repose_fit"] = repose ? Json(repose->fit) : Json(nullptr);
  json["packing_hash"] = geometry_hash(placed);
  return json;
}

}  // namespace scree::run
