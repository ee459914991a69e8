#include "engine/mesh/convex_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace scree::mesh {

namespace {

constexpr double allowed_dent = 1e-3;  // of the length of the edges beside it
// What may be one face: triangles whose normals differ by at most this angle [rad] and whose corners lie in one plane, but for
// this part of the block's diagonal. The first does for blocks that were meshed here; corners that were rounded to the digits
// of a file want the second.
struct Flatness {
  double angle;
  double height;
};
constexpr Flatness exactly_flat{1e-6, 1};
constexpr Flatness nearly_flat{0.05, 1e-4};
constexpr double bent_by = 5e-3;  // faces at a smaller angle are nearly one [rad]
constexpr std::int32_t opposite[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // corners of a tetrahedron's faces

struct Surface {
  std::vector<Eigen::Vector3d> points;                  // [m]
  std::vector<std::array<std::int32_t, 3>> triangles;   // counter-clockwise seen from outside
  std::vector<Eigen::Vector3d> normals;                 // unit
  std::vector<std::array<std::int32_t, 3>> neighbours;  // across the edge from corner i to corner i + 1
};

using DirectedEdge = std::pair<std::int32_t, std::int32_t>;

// Nothing if an edge belongs to more or fewer than two triangles.
bool connect(Surface& surface) {
  std::map<DirectedEdge, std::int32_t> owner;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& corner = surface.triangles[t];
    for (int i = 0; i < 3; ++i) {
      if (!owner.emplace(DirectedEdge{corner[i], corner[(i + 1) % 3]}, static_cast<std::int32_t>(t)).second) return false;
    }
  }
  for (const auto& corner : surface.triangles) {
    auto& beside = surface.neighbours.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto twin = owner.find({corner[(i + 1) % 3], corner[i]});
      if (twin == owner.end()) return false;
      beside[i] = twin->second;
    }
  }
  return true;
}

template <std::size_t count>
std::array<NodeId, count> sorted(std::array<NodeId, count> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::optional<Surface> boundary_surface(const BlockMesh<3>& mesh, BlockId block) {
  std::map<std::array<NodeId, 3>, int> uses;
  std::vector<std::array<NodeId, 3>> all;
  for (const ElementId e : mesh.blocks[block].elements) {
    for (const auto& face : opposite) {
      const auto& node = mesh.elements[e];
      all.push_back({node[face[0]], node[face[1]], node[face[2]]});
      ++uses[sorted(all.back())];
    }
  }
  Surface surface;
  std::map<NodeId, std::int32_t> number;
  for (const auto& face : all) {
    if (uses[sorted(face)] != 1) continue;
    auto& corners = surface.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const auto [at, fresh] = number.emplace(face[i], static_cast<std::int32_t>(surface.points.size()));
      if (fresh) surface.points.push_back(mesh.nodes[face[i]]);
      corners[i] = at->second;
    }
    const auto& p = surface.points;
    surface.normals.push_back((p[corners[1]] - p[corners[0]]).cross(p[corners[2]] - p[corners[0]]).normalized());
  }
  if (!connect(surface)) return std::nullopt;
  return surface;
}

// Height of the neighbour's far corner above a triangle, over the longest edge of the neighbour.
bool is_dented(const Surface& surface, std::size_t triangle, int side) {
  const auto& far = surface.triangles[surface.neighbours[triangle][side]];
  const Eigen::Vector3d& from = surface.points[surface.triangles[triangle][0]];
  double longest = 0;
  double height = 0;
  for (int i = 0; i < 3; ++i) {
    longest = std::max(longest, (surface.points[far[i]] - surface.points[far[(i + 1) % 3]]).norm());
    height = std::max(height, surface.normals[triangle].dot(surface.points[far[i]] - from));
  }
  return height > allowed_dent * longest;
}

// Triangles reached from `seed` over neighbours for which `same(neighbour)` holds get the number `label`.
template <class Same>
void flood(const Surface& surface, std::int32_t seed, std::int32_t label, std::vector<std::int32_t>& labels, Same same) {
  std::vector<std::int32_t> open{seed};
  labels[seed] = label;
  while (!open.empty()) {
    const std::int32_t t = open.back();
    open.pop_back();
    for (const std::int32_t n : surface.neighbours[t]) {
      if (labels[n] < 0 && same(n)) {
        labels[n] = label;
        open.push_back(n);
      }
    }
  }
}

bool is_convex(const Surface& surface) {
  std::vector<std::int32_t> part(surface.triangles.size(), -1);
  flood(surface, 0, 0, part, [](std::int32_t) { return true; });
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (part[t] < 0) return false;
    for (int side = 0; side < 3; ++side) {
      if (is_dented(surface, t, side)) return false;
    }
  }
  return true;
}

void add_edges(ConvexPiece& piece) {
  std::map<DirectedEdge, std::int32_t> owner;
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    const auto& corners = piece.faces[f].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      owner[{corners[i], corners[(i + 1) % corners.size()]}] = static_cast<std::int32_t>(f);
    }
  }
  for (const auto& [edge, face] : owner) {
    const auto twin = owner.find({edge.second, edge.first});
    if (edge.first < edge.second && twin != owner.end())
      piece.edges.push_back({{edge.first, edge.second}, {face, twin->second}, false, {}});
  }
}

// Triangles in groups, each to be one face.
struct Groups {
  std::vector<std::int32_t> of;  // each triangle
  std::vector<Eigen::Vector3d> normals;
};

Groups single_triangles(const Surface& surface) {
  Groups groups{std::vector<std::int32_t>(surface.triangles.size()), surface.normals};
  std::iota(groups.of.begin(), groups.of.end(), 0);
  return groups;
}

double area(const Surface& surface, std::size_t triangle) {
  const auto& c = surface.triangles[triangle];
  return (surface.points[c[1]] - surface.points[c[0]]).cross(surface.points[c[2]] - surface.points[c[0]]).norm() / 2;
}

// Around the seeds in their order.
Groups grown(const Surface& surface, const std::vector<std::size_t>& seeds, const Flatness& flat) {
  Aabb<3> box;
  for (const Eigen::Vector3d& point : surface.points) box.extend(point);
  const double height = flat.height * box.diagonal().norm();
  Groups groups{std::vector<std::int32_t>(surface.triangles.size(), -1), {}};
  for (const std::size_t seed : seeds) {
    if (groups.of[seed] >= 0) continue;
    const Eigen::Vector3d& normal = surface.normals[seed];
    const Eigen::Vector3d& on = surface.points[surface.triangles[seed][0]];
    flood(surface, static_cast<std::int32_t>(seed), static_cast<std::int32_t>(groups.normals.size()), groups.of,
          [&](std::int32_t n) {
            const Eigen::Vector3d& other = surface.normals[n];
            const auto& corners = surface.triangles[n];
            return normal.cross(other).norm() < flat.angle && normal.dot(other) > 0 &&
                   std::all_of(corners.begin(), corners.end(),
                               [&](std::int32_t c) { return std::abs(normal.dot(surface.points[c] - on)) <= height; });
          });
    groups.normals.push_back(normal);
  }
  return groups;
}

// Large triangles first, whose normals are rounded least; each face with the mean of its triangles' normals.
Groups grown_from_the_largest(const Surface& surface) {
  std::vector<double> areas;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) areas.push_back(area(surface, t));
  std::vector<std::size_t> seeds(areas.size());
  std::iota(seeds.begin(), seeds.end(), 0);
  std::stable_sort(seeds.begin(), seeds.end(), [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  Groups groups = grown(surface, seeds, nearly_flat);
  for (Eigen::Vector3d& normal : groups.normals) normal.setZero();
  for (std::size_t t = 0; t < areas.size(); ++t) groups.normals[groups.of[t]] += areas[t] * surface.normals[t];
  for (Eigen::Vector3d& normal : groups.normals) normal.normalize();
  return groups;
}

// The corners that each group is bounded by, one after the other; nothing if one is not bounded by a single line.
using Outline = std::vector<std::int32_t>;
std::optional<std::vector<Outline>> outlines(const Surface& surface, const Groups& groups) {
  std::vector<std::map<std::int32_t, std::int32_t>> next(groups.normals.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (groups.of[surface.neighbours[t][i]] == groups.of[t]) continue;
      const auto& corners = surface.triangles[t];
      if (!next[groups.of[t]].emplace(corners[i], corners[(i + 1) % 3]).second) return std::nullopt;
    }
  }
  std::vector<Outline> result;
  for (const auto& edges : next) {
    if (edges.empty()) return std::nullopt;
    Outline& outline = result.emplace_back(Outline{edges.begin()->first});
    for (std::int32_t at = edges.begin()->second; at != outline.front() && outline.size() < edges.size(); at = edges.at(at)) {
      outline.push_back(at);
    }
    if (outline.size() != edges.size() || edges.at(outline.back()) != outline.front()) return std::nullopt;
  }
  return result;
}

bool is_convex(const ConvexPiece& piece, const ConvexPiece::Face& face) {
  const std::size_t count = face.corners.size();
  const auto side = [&](std::size_t i) -> Eigen::Vector3d {
    return (piece.vertices[face.corners[(i + 1) % count]] - piece.vertices[face.corners[i % count]]).normalized();
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (side(i).cross(side(i + 1)).dot(face.normal) < -allowed_dent) return false;
  }
  return count >= 3;
}

// The edges that stand out: dents part nothing.
void add_ridges(ConvexPiece& piece) {
  add_edges(piece);
  std::erase_if(piece.edges, [&](const ConvexPiece::Edge& edge) {
    const auto& [left, right] = edge.faces;
    const Eigen::Vector3d along = piece.vertices[edge.corners[1]] - piece.vertices[edge.corners[0]];
    const Eigen::Vector3d turn = piece.faces[left].normal.cross(piece.faces[right].normal);
    if (turn.norm() < bent_by) piece.faces[left].bent = piece.faces[right].bent = true;
    return turn.dot(along) <= 0;
  });
}

// Keeps the points at which three or more faces meet: the others lie inside a face or on a straight edge. Nothing if a face
// would not be a convex polygon.
std::optional<ConvexPiece> merged(const Surface& surface, const Groups& groups) {
  const auto bounds = outlines(surface, groups);
  if (!bounds) return std::nullopt;
  std::vector<std::set<std::int32_t>> faces_at(surface.points.size());
  for (std::size_t t = 0; t < groups.of.size(); ++t) {
    for (const std::int32_t corner : surface.triangles[t]) faces_at[corner].insert(groups.of[t]);
  }
  ConvexPiece piece;
  std::vector<std::int32_t> number(surface.points.size(), -1);
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    if (faces_at[p].size() < 3) continue;
    number[p] = static_cast<std::int32_t>(piece.vertices.size());
    piece.vertices.push_back(surface.points[p]);
  }
  for (const Outline& outline : *bounds) {
    auto& face = piece.faces.emplace_back(ConvexPiece::Face{groups.normals[piece.faces.size()], {}});
    for (const std::int32_t corner : outline) {
      if (number[corner] >= 0) face.corners.push_back(number[corner]);
    }
    if (!is_convex(piece, face)) return std::nullopt;
  }
  add_ridges(piece);
  return piece;
}

// By the first grouping that makes convex polygons, none of them bent if another one does it; single triangles are convex.
ConvexPiece convex_piece(const Surface& surface) {
  std::vector<std::size_t> in_order(surface.triangles.size());
  std::iota(in_order.begin(), in_order.end(), 0);
  const auto exact = merged(surface, grown(surface, in_order, exactly_flat));
  const auto is_bent = [](const ConvexPiece::Face& face) { return face.bent; };
  if (exact && std::none_of(exact->faces.begin(), exact->faces.end(), is_bent)) return *exact;
  if (const auto nearly = merged(surface, grown_from_the_largest(surface))) return *nearly;
  return exact ? *exact : *merged(surface, single_triangles(surface));
}

ConvexPiece tetrahedron(const BlockMesh<3>& mesh, ElementId element) {
  ConvexPiece piece;
  for (const NodeId node : mesh.elements[element]) piece.vertices.push_back(mesh.nodes[node]);
  for (const auto& c : opposite) {
    const auto& p = piece.vertices;
    piece.faces.push_back({(p[c[1]] - p[c[0]]).cross(p[c[2]] - p[c[0]]).normalized(), {c[0], c[1], c[2]}});
  }
  add_edges(piece);
  return piece;
}

// A face of the block's surface beside an edge.
struct Beside {
  Eigen::Vector3d normal;
  Eigen::Vector3d far;  // its corner away from the edge [m]
};

bool stands_out(const std::vector<Beside>& faces, const Eigen::Vector3d& on_edge) {
  if (faces.size() != 2) return false;
  const Eigen::Vector3d way = faces[1].far - on_edge;
  return faces[0].normal.dot(way) < -allowed_dent * way.norm();
}

// Which faces, edges and nodes of the elements are the block's.
void mark_inner(const BlockMesh<3>& mesh, const Block& block, std::vector<ConvexPiece>& pieces) {
  const auto& elements = block.elements;
  const NodeId first = *block.nodes.begin();
  std::map<std::array<NodeId, 3>, int> uses;
  std::map<std::array<NodeId, 2>, std::vector<Beside>> beside;
  const auto for_each_face = [&](const auto& use) {
    std::size_t p = 0;
    for (const ElementId e : elements) {
      for (ConvexPiece::Face& face : pieces[p++].faces) {
        const auto node = [&](int i) { return mesh.elements[e][face.corners[static_cast<std::size_t>(i)]]; };
        use(face, std::array{node(0), node(1), node(2)});
      }
    }
  };
  for_each_face([&](ConvexPiece::Face&, const std::array<NodeId, 3>& nodes) { ++uses[sorted(nodes)]; });
  for_each_face([&](ConvexPiece::Face& face, const std::array<NodeId, 3>& nodes) {
    face.inner = uses[sorted(nodes)] > 1;
    for (std::size_t i = 0; i < 3 && !face.inner; ++i) {
      beside[sorted(std::array{nodes[i], nodes[(i + 1) % 3]})].push_back({face.normal, mesh.nodes[nodes[(i + 2) % 3]]});
    }
  });
  std::size_t p = 0;
  for (const ElementId e : elements) {
    for (const NodeId node : mesh.elements[e]) pieces[p].nodes.push_back(node.value() - first.value());
    for (ConvexPiece::Edge& edge : pieces[p].edges) {
      const std::array nodes{mesh.elements[e][edge.corners[0]], mesh.elements[e][edge.corners[1]]};
      const std::vector<Beside>& faces = beside[sorted(nodes)];
      edge.inner = !stands_out(faces, mesh.nodes[nodes[0]]);
      if (!edge.inner) edge.beside = {faces[0].normal, faces[1].normal};
    }
    ++p;
  }
}

}  // namespace

std::vector<ConvexPiece> convex_pieces(const BlockMesh<3>& mesh, BlockId block) {
  const auto& elements = mesh.blocks[block].elements;
  if (elements.size() > 1) {
    const std::optional<Surface> surface = boundary_surface(mesh, block);
    if (surface && is_convex(*surface)) return {convex_piece(*surface)};
  }
  std::vector<ConvexPiece> pieces;
  for (const ElementId e : elements) pieces.push_back(tetrahedron(mesh, e));
  mark_inner(mesh, mesh.blocks[block], pieces);
  return pieces;
}

std::vector<std::vector<Eigen::Vector3d>> surface_edges(const BlockMesh<3>& mesh, BlockId block) {
  const auto& nodes = mesh.blocks[block].nodes;
  std::vector<std::vector<Eigen::Vector3d>> edges(nodes.size());
  Table<FaceId, Face<3>> faces;
  add_boundary_faces(mesh, block, faces);
  // A closed surface has every edge in both directions.
  for (const Face<3>& face : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      const NodeId from = face.nodes[i], to = face.nodes[(i + 1) % 3];
      edges[static_cast<std::size_t>(from.value() - (*nodes.begin()).value())].push_back(
          (mesh.nodes[to] - mesh.nodes[from]).normalized());
    }
  }
  return edges;
}

}  // namespace scree::mesh
