// Which blocks are taken for convex.
#include "engine/mesh/convex_pieces.h"

#include <gtest/gtest.h>

#include "tests/mesh/body_builders.h"

namespace scree::mesh {
namespace {

// A plate of 40 by 40 cells of 25 mm and one layer, its upper side bent upwards (downwards) from the middle on, as a sphere of
// this radius [m] is.
BlockMesh<3> bent_plate(double radius) {
  BodySpec body = body_of(box_of(1, 1, 0.025), 0.025);
  body.cells = CellKind::hexahedron;
  BlockMesh<3> mesh = make_blocks<3>({body});
  for (Point<3>& node : mesh.nodes) {
    if (node.z() > 0) node.z() += node.head<2>().squaredNorm() / (2 * radius);
  }
  return mesh;
}

TEST(ConvexPieces, ADishWhoseEdgesAreHardlyDentedIsNotConvex) {
  const auto pieces = [](double radius) { return convex_pieces(bent_plate(radius), BlockId{0}).size(); };
  EXPECT_EQ(pieces(1e300), 1U);  // flat
  EXPECT_EQ(pieces(-40), 1U);    // a dome
  EXPECT_GT(pieces(40), 1U);     // 6 mm deep, no edge dented by a thousandth of its length
  EXPECT_EQ(pieces(1e6), 1U);    // less than a thousandth of an edge deep
}

}  // namespace
}  // namespace scree::mesh
