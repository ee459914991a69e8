#include "contact/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "engine/base/chunks.h"
#include "engine/base/coordinate_rounding.h"
#include "engine/base/parts.h"
#include "engine/mesh/cells.h"

namespace scree::contact {

namespace {

// Angle of the face at a corner; 1 in 2-D, where both edges at a node count alike.
template <int dim>
double angle_at(const Corners<dim>& corners, int corner) {
  if constexpr (dim == 2) {
    return 1;
  } else {
    const Point<3> a = corners[(corner + 1) % 3] - corners[corner];
    const Point<3> b = corners[(corner + 2) % 3] - corners[corner];
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }
}

struct EdgeUse {
  NodeId low, high;
  FaceId face;
  int side;

  [[nodiscard]] bool is_before(const EdgeUse& other) const {
    return low < other.low || (low == other.low && high < other.high);
  }
};

// The uses of the edges of a block's faces in the order of their nodes, then faces. They are entered in the order of the faces,
// each behind those of its lower node, which are few; where all are few, behind them all.
class EdgeUses {
 public:
  const std::vector<EdgeUse>& of(const Surface<3>& surface, std::size_t first, std::size_t end, const IdRange<NodeId>& nodes) {
    constexpr std::size_t few = 6;  // faces
    const bool apart = end - first > few;
    const auto group = [&](const EdgeUse& use) { return apart ? use.low.index() - nodes.first() : 0; };
    const auto for_each = [&](const auto& visit) {
      for (std::size_t f = first; f < end; ++f) {
        const auto& corners = surface.faces[FaceId{f}].nodes;
        for (int side = 0; side < 3; ++side) {
          const NodeId from = corners[side], to = corners[(side + 1) % 3];
          visit(EdgeUse{std::min(from, to), std::max(from, to), FaceId{f}, side});
        }
      }
    };
    begin_.assign((apart ? nodes.size() : 1) + 1, 0);
    for_each([&](const EdgeUse& use) { ++begin_[group(use) + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    end_.assign(begin_.begin(), begin_.end() - 1);
    uses_.resize(begin_.back());
    for_each([&](const EdgeUse& use) {
      std::size_t at = end_[group(use)]++;
      for (; at > begin_[group(use)] && use.is_before(uses_[at - 1]); --at) uses_[at] = uses_[at - 1];
      uses_[at] = use;
    });
    return uses_;
  }

 private:
  std::vector<EdgeUse> uses_;
  std::vector<std::size_t> begin_, end_;  // of those of each lower node, begin_ with one more
};

// Joins the sorted uses of a block's edges in twos. Where four faces meet in one edge (a block that touches itself), this
// gives two edges; where the boundary is open, an edge with the same face twice.
void pair_uses(const std::vector<EdgeUse>& uses, std::vector<SurfaceEdge>& edges, Surface<3>& surface) {
  for (std::size_t i = 0; i < uses.size();) {
    const EdgeUse& use = uses[i];
    const bool paired = i + 1 < uses.size() && use.low == uses[i + 1].low && use.high == uses[i + 1].high;
    const EdgeUse& second = uses[paired ? i + 1 : i];
    const EdgeId edge{edges.size()};
    edges.push_back({{use.low, use.high}, {use.face, second.face}});
    surface.face_edges[use.face][use.side] = edge;
    surface.face_edges[second.face][second.side] = edge;
    i += paired ? 2 : 1;
  }
}

// Edges of the blocks of a chunk, numbered from 0, block by block, since no node is shared between blocks.
std::vector<SurfaceEdge> edges_of(const std::vector<std::size_t>& starts, Chunk blocks, Surface<3>& surface) {
  std::vector<SurfaceEdge> edges;
  EdgeUses uses;
  for (std::size_t block = blocks.begin; block < blocks.end; ++block) {
    if (starts[block] == starts[block + 1]) continue;
    pair_uses(uses.of(surface, starts[block], starts[block + 1], surface.mesh.blocks[BlockId{block}].nodes), edges, surface);
  }
  return edges;
}

void add_edges(const std::vector<std::size_t>& starts, const std::vector<Chunk>& blocks, Surface<3>& surface) {
  surface.face_edges = FoundTable<FaceId, std::array<EdgeId, 3>>(surface.faces.size());
  Parts<SurfaceEdge> parts(blocks.size());
  for_chunks(blocks, [&](Chunk chunk) { parts.put(chunk.number, edges_of(starts, chunk, surface)); });
  std::vector<std::size_t> before(parts.count() + 1, 0);
  for (std::size_t i = 0; i < parts.count(); ++i) before[i + 1] = before[i] + parts[i].size();
  surface.edges = FoundTable<EdgeId, SurfaceEdge>(before.back());
  for_chunks(blocks, [&](Chunk chunk) {
    std::copy(parts[chunk.number].begin(), parts[chunk.number].end(),
              surface.edges.begin() + static_cast<std::ptrdiff_t>(before[chunk.number]));
    for (std::size_t f = starts[chunk.begin]; f < starts[chunk.end]; ++f) {
      for (EdgeId& edge : surface.face_edges[FaceId{f}]) edge = EdgeId{edge.index() + before[chunk.number]};
    }
  });
}

template <int dim>
void measure_face(FaceId f, const mesh::CharacteristicLength<dim>& lengths, Surface<dim>& surface) {
  const Point<dim> area = mesh::area_vector<dim>(surface.mesh, surface.faces[f].nodes);
  surface.areas[f] = area.norm();
  surface.normals[f] = area.normalized();
  surface.lengths[f] = lengths.of(surface.faces[f].element);
}

template <int dim>
Point<dim> weighted_normal(const Surface<dim>& surface, FaceId f, int corner) {
  return angle_at<dim>(corners_of(surface, f), corner) * surface.normals[f];
}

template <int dim>
void add_node_normals(FaceId f, Surface<dim>& surface) {
  for (int i = 0; i < dim; ++i) surface.node_normals[surface.faces[f].nodes[i]] += weighted_normal(surface, f, i);
}

// At a vertex of a block of one element, whose faces follow one another in the order of the vertices they are opposite to.
template <int dim>
Point<dim> node_normal(const Surface<dim>& surface, std::size_t first, int vertex) {
  Point<dim> sum = Point<dim>::Zero();
  for (int plane = 0; plane <= dim; ++plane) {
    if (plane == vertex) continue;
    const auto& corners = mesh::opposite_corners<dim>[plane];
    const auto corner = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    sum += weighted_normal(surface, FaceId{first + static_cast<std::size_t>(plane)}, static_cast<int>(corner));
  }
  return sum;
}

template <int dim>
double rounding_of(const mesh::BlockMesh<dim>& mesh) {
  std::vector<Aabb<dim>> parts(chunk_count(mesh.nodes.size()));
  for_chunks(mesh.nodes.size(), [&](Chunk chunk) {
    Aabb<dim> some;
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) some.extend(mesh.nodes[NodeId{i}]);
    parts[chunk.number] = some;
  });
  double largest = 0;
  for (const Aabb<dim>& part : parts) largest = std::max(largest, coordinate_rounding(part));
  return largest;
}

}  // namespace

template <int dim>
Surface<dim> surface_of(const mesh::BlockMesh<dim>& mesh, Table<FaceId, mesh::Face<dim>> faces) {
  Surface<dim> surface{
      mesh, rounding_of(mesh), std::move(faces), {}, {}, {}, std::make_shared<BlockElements<dim>>(mesh), {}, {}, {}};
  const std::size_t count = surface.faces.size();
  surface.normals = FoundTable<FaceId, Point<dim>>(count);
  surface.areas = FoundTable<FaceId, double>(count);
  surface.lengths = FoundTable<FaceId, double>(count);
  const mesh::CharacteristicLength<dim> lengths(mesh);
  for_chunks(count, [&](Chunk chunk) {
    for (std::size_t f = chunk.begin; f < chunk.end; ++f) measure_face<dim>(FaceId{f}, lengths, surface);
  });
  return surface;
}

template <int dim>
void add_rims(Surface<dim>& surface) {
  const std::vector<std::size_t> starts = block_starts(surface.mesh, surface.faces);
  const std::vector<Chunk> blocks = chunks_by_size(starts, chunk_size);
  if (surface.mesh.blocks.size() < surface.mesh.elements.size()) {
    surface.node_normals = Table<NodeId, Point<dim>>(surface.mesh.nodes.size(), Point<dim>::Zero());
    // Faces of two blocks have no node in common.
    for_chunks(blocks, [&](Chunk chunk) {
      for (std::size_t f = starts[chunk.begin]; f < starts[chunk.end]; ++f) {
        if (!is_whole(surface.mesh, surface.faces[FaceId{f}].block)) add_node_normals<dim>(FaceId{f}, surface);
      }
    });
  }
  if constexpr (dim == 3) add_edges(starts, blocks, surface);
}

template <int dim>
std::vector<std::size_t> block_starts(const mesh::BlockMesh<dim>& mesh, const Table<FaceId, mesh::Face<dim>>& faces) {
  std::vector<std::size_t> starts(mesh.blocks.size() + 1, 0);
  for (const auto& face : faces) ++starts[face.block.index() + 1];
  for (std::size_t block = 1; block < starts.size(); ++block) starts[block] += starts[block - 1];
  return starts;
}

template <int dim>
double rise_at_rim(const Surface<dim>& surface, const PlacedFace& at, const std::array<double, dim>& weights,
                   const Point<dim>& offset) {
  const auto& corners = mesh::opposite_corners<dim>[at.plane];
  const auto rise = [&](FaceId face) { return surface.normals[face].dot(offset); };
  // Faces of a whole block follow one another.
  const auto own_face = [&](int plane) {
    return FaceId{at.face.index() + static_cast<std::size_t>(plane) - static_cast<std::size_t>(at.plane)};
  };
  unsigned zero = 0;
  for (int i = 0; i < dim; ++i) zero |= (weights[i] == 0 ? 1u : 0u) << i;
  if (zero == 0) return rise(at.face);
  if (dim == 3 && std::has_single_bit(zero)) {
    const auto beyond = static_cast<std::size_t>(std::countr_zero(zero));
    if (at.whole) return rise(at.face) + rise(own_face(corners[beyond]));
    const SurfaceEdge& edge = surface.edges[surface.face_edges[at.face][(beyond + 1) % 3]];
    return rise(edge.faces[0]) + rise(edge.faces[1]);
  }
  const auto corner = static_cast<std::size_t>(std::countr_one(zero));
  if (!at.whole) return surface.node_normals[surface.faces[at.face].nodes[corner]].dot(offset);
  // The weights are of no matter if it leads out along all normals, or in.
  const int vertex = corners[corner];
  unsigned out = 0, in = 0;
  for (int plane = 0; plane <= dim; ++plane) {
    if (plane == vertex) continue;
    const double along = rise(own_face(plane));
    out |= along > 0 ? 1u : 0u;
    in |= along < 0 ? 1u : 0u;
  }
  if (out != in) return out != 0 ? 1 : -1;
  return node_normal(surface, own_face(0).index(), vertex).dot(offset);
}

#define SCREE_INSTANTIATE(dim)                                                                                             \
  template Surface<dim> surface_of<dim>(const mesh::BlockMesh<dim>&, Table<FaceId, mesh::Face<dim>>);                      \
  template void add_rims<dim>(Surface<dim>&);                                                                              \
  template std::vector<std::size_t> block_starts<dim>(const mesh::BlockMesh<dim>&, const Table<FaceId, mesh::Face<dim>>&); \
  template double rise_at_rim<dim>(const Surface<dim>&, const PlacedFace&, const std::array<double, dim>&, const Point<dim>&);
SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
#undef SCREE_INSTANTIATE

}  // namespace scree::contact
