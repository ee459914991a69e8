#include "contact/both_diagonals.h"

#include <algorithm>

#include "engine/base/check.h"
#include "engine/base/chunks.h"
#include "engine/mesh/cells.h"

namespace scree::contact {

namespace {

using OfCorners = std::array<double, 4>;

// A quadrilateral face about a triangle in it: the corners in turn, of which 0 and 2 are the ends of the triangle's diagonal
// and 3 is not the triangle's.
struct Quadrilateral {
  std::array<NodeId, 4> corners;
  std::array<std::size_t, 3> place{};  // of the triangle's corners
  OfCorners areas{};                   // a_i, of any unit

  [[nodiscard]] OfCorners weights_of(const std::array<double, 3>& of_triangle) const {
    OfCorners weights{};
    for (std::size_t i = 0; i < 3; ++i) weights[place[i]] = of_triangle[i];
    return weights;
  }

  // Which end of the diagonal has no part in a point's triangle of the other one.
  [[nodiscard]] std::size_t left_out(const OfCorners& weights) const {
    return weights[0] / areas[0] < weights[2] / areas[2] ? 0 : 2;
  }
};

// The area vectors of the triangles of the three other corners, twice as long.
std::array<Point<3>, 4> opposite_triangles(const mesh::BlockMesh<3>& mesh, const std::array<NodeId, 4>& corners) {
  const auto at = [&](std::size_t i) -> const Point<3>& { return mesh.nodes[corners[i % 4]]; };
  std::array<Point<3>, 4> triangles;
  for (std::size_t i = 0; i < 4; ++i) triangles[i] = (at(i + 2) - at(i + 1)).cross(at(i + 3) - at(i + 1));
  return triangles;
}

// Nothing for a face of three corners, and for one that is not convex.
std::optional<Quadrilateral> quadrilateral_about(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell,
                                                 const std::array<NodeId, 3>& triangle) {
  const auto corners = mesh::quadrilateral_of(cell, triangle);
  if (!corners) return std::nullopt;
  Quadrilateral face{*corners};
  const auto triangles = opposite_triangles(mesh, *corners);
  const Point<3> normal = triangles[0] + triangles[2];
  for (std::size_t i = 0; i < 4; ++i) {
    face.areas[i] = triangles[i].dot(normal);
    if (!(face.areas[i] > 0)) return std::nullopt;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(corners->begin(), corners->end(), triangle[i]);
    face.place[i] = static_cast<std::size_t>(found - corners->begin());
  }
  return face;
}

// Of a semi-spring's area as a third of its triangle: what it is as its part of the corner's share.
double of_third(const mesh::BlockMesh<3>& mesh, const Quadrilateral& face, const OfCorners& weights) {
  OfCorners areas{};
  const auto triangles = opposite_triangles(mesh, face.corners);
  std::transform(triangles.begin(), triangles.end(), areas.begin(), [](const Point<3>& triangle) { return triangle.norm(); });
  const auto corner = std::max_element(weights.begin(), weights.end()) - weights.begin();
  if (corner == 1) return (areas[3] + areas[0] + areas[2]) / (2 * areas[3]);
  const double whole = areas[1] + areas[3];
  return (whole + areas[corner == 0 ? 2 : 0]) / (2 * whole);
}

// The mean of w and w'.
void see_both(const Quadrilateral& face, const OfCorners& weights, Stencil<3>& stencil) {
  const std::size_t left_out = face.left_out(weights);
  const double way = 0.5 * weights[left_out] / face.areas[left_out];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t place = face.place[i];
    stencil.weights[i] += (place == 1 ? way : -way) * face.areas[place];
  }
  stencil.fourth = face.corners[3];
}

}  // namespace

void see_both_diagonals(const mesh::BlockMesh<3>& mesh, Contacts<3>& contacts) {
  if (mesh.cells.empty()) return;
  const mesh::CellOfElement<3> cells(mesh);
  const auto face_of = [&](ElementId element, const Stencil<3>& stencil) -> std::optional<Quadrilateral> {
    const CellId cell = cells[element];
    if (!cell.valid()) return std::nullopt;
    return quadrilateral_about(mesh, mesh.cells[cell], stencil.nodes);
  };
  for_chunks(contacts.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      Contact<3>& contact = contacts[i];
      if (contact.kind == Kind::edge_edge) continue;
      if (const auto face = face_of(contact.owner_element, contact.on_owner)) {
        const OfCorners weights = face->weights_of(contact.on_owner.weights);
        if (contact.kind == Kind::point_face) contact.area *= of_third(mesh, *face, weights);
        see_both(*face, weights, contact.on_owner);
      }
      if (const auto face = face_of(contact.target_element, contact.on_target)) {
        see_both(*face, face->weights_of(contact.on_target.weights), contact.on_target);
      }
    }
  });
}

std::optional<std::array<TrianglePart, 2>> halves(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell,
                                                  const std::array<NodeId, 3>& triangle) {
  const auto face = quadrilateral_about(mesh, cell, triangle);
  if (!face) return std::nullopt;
  std::array<std::array<double, 3>, 3> corners{};  // of the triangle, in the order of the face
  std::array<double, 3> middle{};                  // where the diagonals cross
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t place = face->place[i];
    corners[place][i] = 1;
    if (place != 1) middle[i] = face->areas[place] / (face->areas[0] + face->areas[2]);
  }
  return std::array<TrianglePart, 2>{{{corners[0], corners[1], middle}, {corners[1], corners[2], middle}}};
}

// The mean of w and w' leaves out the same corner as w: both are equally far along the way for both ends.
std::array<NodeId, 3> other_triangle(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell, const Stencil<3>& stencil) {
  const auto face = quadrilateral_about(mesh, cell, stencil.nodes);
  SCREE_EXPECT(face.has_value());
  return {face->corners[1], face->corners[3], face->corners[2 - face->left_out(face->weights_of(stencil.weights))]};
}

}  // namespace scree::contact
