// Suspicions about where blocks are.
#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <Eigen/LU>

#include "engine/packing/blocks_in_others.h"
#include "engine/packing/near_boxes.h"
#include "engine/packing/penetration.h"
#include "tools/scene/suspicions.h"

namespace scree {

namespace {

const std::string& body_name(const auto& mesh, BlockId block) {
  return mesh.bodies[mesh.blocks[block].body].name;
}

std::string overlap_sentence(const auto& mesh, BlockId a, BlockId b, const std::string& depth) {
  return fmt::format("block {} of body {} and block {} of body {} overlap{} before anything moves", a.value(),
                     body_name(mesh, a), b.value(), body_name(mesh, b), depth);
}

// Blocks that only touch overlap by rounding.
constexpr double rounding = 1e-6;  // of the mean edge, of an element in barycentric coordinates, or of the extent of all blocks

// Nodes of a block, and middles of its elements, which tell where all nodes lie on each other.
std::vector<Eigen::Vector2d> points_of(const mesh::BlockMesh<2>& mesh, BlockId block) {
  std::vector<Eigen::Vector2d> points;
  for (const NodeId node : mesh.blocks[block].nodes) points.push_back(mesh.nodes[node]);
  for (const ElementId element : mesh.blocks[block].elements) {
    const auto& corners = mesh.elements[element];
    points.push_back((mesh.nodes[corners[0]] + mesh.nodes[corners[1]] + mesh.nodes[corners[2]]) / 3);
  }
  return points;
}

// Whether one of these points of block `a` lies inside an element of block `b`.
bool reaches_into(const mesh::BlockMesh<2>& mesh, BlockId a, BlockId b) {
  const std::vector<Eigen::Vector2d> points = points_of(mesh, a);
  for (const ElementId element : mesh.blocks[b].elements) {
    const auto& corners = mesh.elements[element];
    Eigen::Matrix2d edges;
    edges << mesh.nodes[corners[1]] - mesh.nodes[corners[0]], mesh.nodes[corners[2]] - mesh.nodes[corners[0]];
    const Eigen::Matrix2d inverse = edges.inverse();
    for (const Eigen::Vector2d& point : points) {
      const Eigen::Vector2d w = inverse * (point - mesh.nodes[corners[0]]);
      if (w.minCoeff() > rounding && w.sum() < 1 - rounding) return true;
    }
  }
  return false;
}

// A box seen along gravity: its footprint, and its lowest point.
struct Shadow {
  Aabb<2> footprint;
  double low = std::numeric_limits<double>::infinity();
};

Shadow shadow_of(const mesh::BlockMesh<3>& mesh, BlockId block, const Eigen::Matrix3d& frame) {
  Shadow shadow;
  for (const NodeId node : mesh.blocks[block].nodes) {
    const Eigen::Vector3d p = frame * mesh.nodes[node];
    shadow.footprint.extend(p.head<2>());
    shadow.low = std::min(shadow.low, p.z());
  }
  return shadow;
}

}  // namespace

// The deepest pair only: the others are of its kind, and mending the scene shows the next.
template <>
Sentences overlapping_blocks(const mesh::BlockMesh<3>& mesh, packing::Pairs asked) {
  const double least = rounding * mesh::mean_edge(mesh);
  const packing::PieceSet pieces(mesh, packing::blocks_in_others(mesh, least, asked));
  const packing::Penetration deepest = packing::measure_penetration(pieces, least, {}, asked);
  if (deepest.max <= least) return {};
  return {overlap_sentence(mesh, deepest.first, deepest.second, fmt::format(" by {:.3g} m", deepest.max))};
}

// The first pair only. Found by points inside elements: two slim blocks that cross without holding each other's nodes are
// missed.
template <>
Sentences overlapping_blocks(const mesh::BlockMesh<2>& mesh, packing::Pairs asked) {
  const auto boxes = packing::block_boxes(mesh);
  Sentences sentences;
  packing::for_near_boxes<2>(boxes.raw(), -rounding * mesh::mean_edge(mesh), [&](std::size_t i, std::size_t j) {
    const BlockId a{std::min(i, j)}, b{std::max(i, j)};
    if (!sentences.empty() || !packing::is_asked(asked, packing::owner_of(mesh, a), packing::owner_of(mesh, b))) return;
    if (reaches_into(mesh, a, b) || reaches_into(mesh, b, a)) sentences.push_back(overlap_sentence(mesh, a, b, ""));
  });
  return sentences;
}

Sentences falling_forever(const mesh::BlockMesh<3>& mesh, const Eigen::Vector3d& gravity) {
  const Eigen::Matrix3d frame = Eigen::Quaterniond::FromTwoVectors(-gravity, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<Shadow> fixed;
  for (const BlockId block : mesh.blocks.ids()) {
    if (mesh.bodies[mesh.blocks[block].body].fixed) fixed.push_back(shadow_of(mesh, block, frame));
  }
  Table<BodyId, std::size_t> falling(mesh.bodies.size());
  Table<BodyId, std::size_t> blocks(mesh.bodies.size());
  for (const BlockId block : mesh.blocks.ids()) {
    const BodyId body = mesh.blocks[block].body;
    if (mesh.bodies[body].fixed) continue;
    const Shadow shadow = shadow_of(mesh, block, frame);
    const bool stopped = std::any_of(fixed.begin(), fixed.end(), [&](const Shadow& below) {
      return below.low < shadow.low && below.footprint.intersects(shadow.footprint);
    });
    ++blocks[body];
    if (!stopped) ++falling[body];
  }
  Sentences sentences;
  for (const BodyId body : mesh.bodies.ids()) {
    if (falling[body] == 0) continue;
    sentences.push_back(fmt::format("nothing fixed lies below {} of {} blocks of body {}: they may fall forever", falling[body],
                                    blocks[body], mesh.bodies[body].name));
  }
  return sentences;
}

template <int dim>
Sentences window_beyond_blocks(const mesh::BlockMesh<dim>& mesh, const Aabb<3>& window) {
  Aabb<dim> all;
  for (const Point<dim>& node : mesh.nodes) all.extend(node);
  Sentences sentences;
  for (Eigen::Index axis = 0; axis < dim; ++axis) {
    const double low = all.min()[axis], high = all.max()[axis];
    const double slack = rounding * (high - low);
    if (window.min()[axis] >= low - slack && window.max()[axis] <= high + slack) continue;
    sentences.push_back(
        fmt::format("the box of heat.effective_conductivity goes from {:g} to {:g} m along {}, the blocks from {:g} to {:g} m: "
                    "the void beyond them counts as part of the sample",
                    window.min()[axis], window.max()[axis], "xyz"[axis], low, high));
  }
  return sentences;
}
template Sentences window_beyond_blocks(const mesh::BlockMesh<2>&, const Aabb<3>&);
template Sentences window_beyond_blocks(const mesh::BlockMesh<3>&, const Aabb<3>&);

template <int dim>
Sentences isolated_blocks(const mesh::BlockMesh<dim>& mesh, const contact::ContactSet<dim>& contacts, const Scene& scene) {
  if (mesh.blocks.size() < 2) return {};
  const thermal::HeatOptions& heat = *scene.heat;
  const thermal::JointOptions& joint = heat.joint;
  Table<BodyId, char> heated(mesh.bodies.size(), 0);
  for (const auto& boundary : heat.boundaries) heated[boundary.region.body] = 1;
  for (const auto& source : heat.sources) heated[source.region.body] = 1;
  Table<BlockId, bool> touched(mesh.blocks.size(), false);
  for (const auto& contact : contacts.contacts) {
    if (touched[contact.owner] && touched[contact.target]) continue;
    const BodyId owner = mesh.blocks[contact.owner].body, target = mesh.blocks[contact.target].body;
    if (std::holds_alternative<thermal::InsulatingJoint>(thermal::law_between(joint, mesh.bodies, owner, target))) continue;
    touched[contact.owner] = true;
    touched[contact.target] = true;
  }
  const auto& of_block = touched.raw();
  if (scene.places.contains("contact") &&
      std::none_of(of_block.begin(), of_block.end(), [](bool touches) { return touches; })) {
    return {std::holds_alternative<thermal::InsulatingJoint>(joint.law)
                ? "no joint conducts: no heat passes between any two blocks"
                : "no two blocks touch: no heat passes between any of them"};
  }
  Table<BodyId, std::size_t> alone(mesh.bodies.size());
  Table<BodyId, std::size_t> blocks(mesh.bodies.size());
  for (const BlockId block : mesh.blocks.ids()) {
    const BodyId body = mesh.blocks[block].body;
    ++blocks[body];
    if (!touched[block] && heated[body] == 0) ++alone[body];
  }
  Sentences sentences;
  for (const BodyId body : mesh.bodies.ids()) {
    if (alone[body] == 0) continue;
    sentences.push_back(fmt::format("{} of {} blocks of body {} touch nothing: no heat passes to or from them", alone[body],
                                    blocks[body], mesh.bodies[body].name));
  }
  return sentences;
}
template Sentences isolated_blocks(const mesh::BlockMesh<2>&, const contact::ContactSet<2>&, const Scene&);
template Sentences isolated_blocks(const mesh::BlockMesh<3>&, const contact::ContactSet<3>&, const Scene&);

}  // namespace scree
