#include "contact/both_diagonals.h"

#include <algorithm>

#include "engine/base/check.h"
#include "engine/base/chunks.h"
#include "engine/mesh/cells.h"

namespace scree::contact {

namespace {

// A quadrilateral face about a triangle in it: the corners in turn, of which 0 and 2 are the ends of the triangle's diagonal
// and 3 is not the triangle's.
struct Face {
  std::array<NodeId, 4> corners;
  std::array<double, 4> areas;         // a_i, seen from the side to which both diagonals are perpendicular; of any unit
  std::array<std::size_t, 3> place{};  // of the triangle's corners
  std::array<double, 4> weights{};     // of a point, by the triangle's corners

  // Which end of the diagonal has no part in the point's triangle of the other one.
  [[nodiscard]] std::size_t left_out() const { return weights[0] / areas[0] < weights[2] / areas[2] ? 0 : 2; }
};

std::optional<Face> face_about(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell, const Stencil<3>& stencil) {
  const auto corners = mesh::quadrilateral_of(cell, stencil.nodes);
  if (!corners) return std::nullopt;
  Face face{*corners, {}};
  const auto at = [&](std::size_t i) -> const Point<3>& { return mesh.nodes[face.corners[i % 4]]; };
  const Point<3> normal = (at(2) - at(0)).cross(at(3) - at(1));
  for (std::size_t i = 0; i < 4; ++i) face.areas[i] = (at(i + 2) - at(i + 1)).cross(at(i + 3) - at(i + 1)).dot(normal);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(corners->begin(), corners->end(), stencil.nodes[i]);
    face.place[i] = static_cast<std::size_t>(found - corners->begin());
    face.weights[face.place[i]] = stencil.weights[i];
  }
  return face;
}

// Of a semi-spring's area as a third of its triangle, eq. (9): what it is as its part of the corner's share.
double of_third(const Face& face) {
  const auto& [a0, a1, a2, a3] = face.areas;
  const double whole = a0 + a2;
  const auto corner = std::max_element(face.weights.begin(), face.weights.end()) - face.weights.begin();
  if (corner == 1) return (whole + a3) / (2 * a3);
  return (whole + (corner == 0 ? a2 : a0)) / (2 * whole);
}

// The mean of w and w'.
void see_both(const Face& face, Stencil<3>& stencil) {
  const double way = 0.5 * face.weights[face.left_out()] / face.areas[face.left_out()];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t place = face.place[i];
    stencil.weights[i] += (place == 1 ? way : -way) * face.areas[place];
  }
  stencil.fourth = face.corners[3];
}

}  // namespace

void see_both_diagonals(const mesh::BlockMesh<3>& mesh, Contacts<3>& contacts) {
  if (mesh.cells.empty()) return;
  const Table<ElementId, CellId> cells = mesh::element_cells(mesh);
  const auto face_of = [&](ElementId element, const Stencil<3>& stencil) -> std::optional<Face> {
    if (!cells[element].valid()) return std::nullopt;
    return face_about(mesh, mesh.cells[cells[element]], stencil);
  };
  for_chunks(contacts.size(), [&](Chunk chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
      Contact<3>& contact = contacts[i];
      if (contact.kind == Kind::edge_edge) continue;
      if (const auto face = face_of(contact.owner_element, contact.on_owner)) {
        if (contact.kind == Kind::point_face) contact.area *= of_third(*face);
        see_both(*face, contact.on_owner);
      }
      if (const auto face = face_of(contact.target_element, contact.on_target)) see_both(*face, contact.on_target);
    }
  });
}

std::optional<std::array<TrianglePart, 2>> halves(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell,
                                                  const std::array<NodeId, 3>& triangle) {
  const auto face = face_about(mesh, cell, {triangle, {}, {}});
  if (!face) return std::nullopt;
  std::array<std::array<double, 3>, 3> corners{};  // of the triangle, in the order of the face
  std::array<double, 3> middle{};                  // where the diagonals cross
  const double both = face->areas[0] + face->areas[2];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t place = face->place[i];
    corners[place][i] = 1;
    if (place != 1) middle[i] = face->areas[place] / both;
  }
  return std::array<TrianglePart, 2>{{{corners[0], corners[1], middle}, {corners[1], corners[2], middle}}};
}

// The mean of w and w' leaves out the same corner as w: both are equally far along the way for both ends.
std::array<NodeId, 3> other_triangle(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell, const Stencil<3>& stencil) {
  const auto face = face_about(mesh, cell, stencil);
  SCREE_EXPECT(face.has_value());
  return {face->corners[1], face->corners[3], face->corners[2 - face->left_out()]};
}

}  // namespace scree::contact
