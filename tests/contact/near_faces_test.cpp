// What is left out is nothing that touches: the search on the kept faces against that on the whole surface.
#include "contact/near_faces.h"

#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "contact/target_search.h"
#include "tests/contact/builders.h"

namespace scree::contact {
namespace {

using namespace testing;

template <int dim>
using Nodes = std::array<NodeId, dim>;

// What each semi-spring and semi-edge takes, told by nodes.
template <int dim>
struct Found {
  std::map<std::pair<Nodes<dim>, std::size_t>, Nodes<dim>> springs;
  std::map<std::pair<Nodes<dim>, std::size_t>, Nodes<2>> edges;
};

template <int dim>
Found<dim> found_on(const Surface<dim>& surface, const ContactOptions& options) {
  const Targets<dim> targets = find_targets(surface, options);
  Found<dim> found;
  for (std::size_t i = 0; i < targets.of_springs.faces.size(); ++i) {
    const FaceId target = targets.of_springs.faces[i];
    if (target.valid()) found.springs[{surface.faces[FaceId{i / dim}].nodes, i % dim}] = surface.faces[target].nodes;
  }
  for (const TakenEdge& edge : targets.of_edges) {
    found.edges[{surface.faces[FaceId{edge.semi_edge / 3}].nodes, edge.semi_edge % 3}] = surface.edges[edge.target].nodes;
  }
  return found;
}

// A plate of 16 by 16 cells (in 2-D, 200 of them) with stones on a part of it, more of them than blocks whose boxes are asked
// one by one, and a bar among them.
template <int dim>
mesh::BlockMesh<dim> stones_on_a_plate() {
  BlockOf<dim> plate;
  for (int i = 0; i < (dim == 2 ? 200 : 256); ++i) {
    Point<dim> low = Point<dim>::Zero();
    low[0] = 0.1 * (dim == 2 ? i : i % 16);
    if (dim == 3) low[1] = 0.1 * (i / 16);
    low[dim - 1] = -0.1;
    const auto cell = box<dim>(low, Point<dim>::Constant(0.1));
    plate.insert(plate.end(), cell.begin(), cell.end());
  }
  std::vector<BlockOf<dim>> blocks{plate};
  std::mt19937 random(11);
  for (const auto& stone : random_simplices<dim>(60, 0.4, 0.1, random)) {
    BlockOf<dim> moved{stone};
    double lowest = stone[0][dim - 1];
    for (const auto& corner : stone) lowest = std::min(lowest, corner[dim - 1]);
    for (auto& corner : moved[0]) {
      corner += Point<dim>::Constant(0.41);
      corner[dim - 1] -= lowest + 0.41;
    }
    blocks.push_back(moved);
  }
  Point<dim> low = Point<dim>::Constant(0.1), size = Point<dim>::Constant(0.05);
  size[0] = 0.6;
  blocks.push_back(box<dim>(low, size));
  return mesh_of<dim>(blocks);
}

template <int dim>
void leave_out_nothing_that_touches() {
  const auto mesh = stones_on_a_plate<dim>();
  const ContactOptions options{0.05, 0.1};
  const Surface<dim> whole = make_surface(mesh);
  Surface<dim> near = surface_of(mesh, near_faces(mesh, mesh::boundary_faces(mesh), {options.tolerance, options.indentation}));
  add_rims(near);
  const Found<dim> of_whole = found_on(whole, options), of_near = found_on(near, options);
  EXPECT_GT(of_whole.springs.size(), 30);
  EXPECT_EQ(of_near.springs, of_whole.springs);
  EXPECT_EQ(of_near.edges, of_whole.edges);
  EXPECT_GE(of_whole.edges.size(), dim == 3 ? 10 : 0);
  EXPECT_LT(4 * near.faces.size(), 3 * whole.faces.size());
}

TEST(NearFaces, LeaveOutNothingThatTouches) {
  leave_out_nothing_that_touches<2>();
  leave_out_nothing_that_touches<3>();
}

TEST(NearFaces, OfBlocksThatAreFarFromOneAnotherAreNone) {
  const auto mesh = mesh_of<3>({box<3>(at(0, 0, 0), at(1, 1, 1)), box<3>(at(1.2, 0, 0), at(1, 1, 1))});
  EXPECT_EQ(near_faces(mesh, mesh::boundary_faces(mesh), {0.01, 0.05}).size(), 0);
  // No edge is longer than the diagonal of 1.73, and 0.12 of it is as far as each side reaches.
  EXPECT_EQ(near_faces(mesh, mesh::boundary_faces(mesh), {0.12, 0.05}).size(), 24);
}

}  // namespace
}  // namespace scree::contact
