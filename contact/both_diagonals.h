// Quadrilateral faces of cells, which joints see as conduction does: through both diagonals (engine/mesh/cells.h). The search
// knows triangles only, those of the one diagonal by which the conforming split cuts the face.
//
// A contact point with the weights w on such a triangle has others on the triangles of the other diagonal. The temperature
// there is the mean of the two, sum of (w + w')/2 times those of the four corners: it prefers no diagonal, and passes a linear
// field. With a_i the area of the triangle of the three other corners, the corners of a flat quadrilateral have
//   a_0 x_0 - a_1 x_1 + a_2 x_2 - a_3 x_3 = 0,    a_0 - a_1 + a_2 - a_3 = 0,
// so w + t (-a_0, a_1, -a_2, a_3) is the same point for every t; w' is the one in which, on the way from w, the first corner
// gets the weight 0. A face that is twisted is seen from the side to which its diagonals are perpendicular. From there a
// strongly twisted one may not be convex (some a_i <= 0): it is left to the one diagonal.
//
// A semi-spring of a face with N corners has A/N of its area (9). Of a quadrilateral each corner has the mean of what both
// diagonals give it, which is A/4 for a parallelogram: whose diagonal ends there, the two semi-springs of both triangles share
// it as the triangles share the face. Semi-edges keep the point and the area (10) of their triangle: where edges cross there is
// no face to share out.
#pragma once

#include <optional>

#include "contact/contact_set.h"

namespace scree::contact {

// Gives the points of semi-springs, of their targets and of overlaps their fourth corners, and semi-springs their areas. Blocks
// without cells cost nothing.
void see_both_diagonals(const mesh::BlockMesh<3>& mesh, Contacts<3>& contacts);

// A part of a triangle, each of its corners by the weights of the triangle's.
using TrianglePart = std::array<std::array<double, 3>, 3>;

// The two parts of a triangle of a quadrilateral in which what both diagonals give is linear, w and w': it is cut by the other
// diagonal, from its corner that is no end of its own. Nothing for a face that is seen through one diagonal.
std::optional<std::array<TrianglePart, 2>> halves(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell,
                                                  const std::array<NodeId, 3>& triangle);

// Of a point with a fourth corner the triangle of the other diagonal that it is on.
std::array<NodeId, 3> other_triangle(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell, const Stencil<3>& stencil);

}  // namespace scree::contact
