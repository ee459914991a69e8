// Contact points on faces of hexahedra and wedges.
#include "contact/both_diagonals.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "engine/mesh/cells.h"
#include "tests/mesh/cell_boxes.h"

namespace scree::contact {
namespace {

const ContactOptions by_overlap{0.05, 0.01, Model::overlap, {}};

// Hexahedra under wedges that do not match.
mesh::BlockMesh<3> boxes() {
  auto mesh = mesh::test::cell_boxes<3>(
      {{.centre = {0, 0, -0.5}, .mesh_size = 0.5}, {.centre = {0, 0, 0.5}, .mesh_size = 0.34, .kind = mesh::CellKind::wedge}});
  mesh::test::bend_sideways(mesh);
  return mesh;
}

// Any function of the nodes.
double value_of(NodeId node) {
  return std::sin(1.0 + 7.0 * static_cast<double>(node.value()));
}

double value_of(const Stencil<3>& stencil) {
  double sum = 0;
  for_each_weight(stencil, [&](NodeId node, double weight) { sum += weight * value_of(node); });
  return sum;
}

// Of the triangle at a point of its plane, if it holds the point.
std::optional<double> value_in(const mesh::BlockMesh<3>& mesh, const std::array<NodeId, 3>& triangle, const Point<3>& point) {
  const auto weights_of = [&](std::size_t i) {
    const Point<3>& a = mesh.nodes[triangle[(i + 1) % 3]];
    const Point<3>& b = mesh.nodes[triangle[(i + 2) % 3]];
    const Point<3> normal = (b - a).cross(mesh.nodes[triangle[i]] - a);
    return (b - a).cross(point - a).dot(normal) / normal.squaredNorm();
  };
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double weight = weights_of(i);
    if (weight < -1e-12) return std::nullopt;
    sum += weight * value_of(triangle[i]);
  }
  return sum;
}

// The mean over the triangles of both diagonals of the cell's face that hold the point, found by asking all of them.
double brute_force(const mesh::BlockMesh<3>& mesh, const mesh::Cell& cell, const Stencil<3>& stencil) {
  const Point<3> point = point_of(mesh, stencil);
  const auto face = mesh::quadrilateral_of(cell, stencil.nodes);
  if (!face) return value_in(mesh, stencil.nodes, point).value();
  const auto& [a, b, c, d] = *face;
  const auto one = value_in(mesh, {a, b, c}, point), other = value_in(mesh, {a, c, d}, point);
  const auto third = value_in(mesh, {b, c, d}, point), fourth = value_in(mesh, {b, d, a}, point);
  return 0.5 * ((one ? *one : other.value()) + (third ? *third : fourth.value()));
}

TEST(BothDiagonals, GiveTheMeanOfWhatEachGivesAtThePoint) {
  const auto mesh = boxes();
  const mesh::CellOfElement<3> cells(mesh);
  std::size_t quadrilaterals = 0;
  for (const Model model : {Model::overlap, Model::semi_spring}) {
    const auto set = find_contacts<3>(mesh, {0.3, 0.01, model, {}});
    ASSERT_FALSE(set.contacts.empty());
    for (const Contact<3>& contact : set.contacts) {
      for (const auto& [element, stencil] :
           {std::pair(contact.owner_element, contact.on_owner), std::pair(contact.target_element, contact.on_target)}) {
        quadrilaterals += stencil.fourth.valid() ? 1 : 0;
        EXPECT_NEAR(value_of(stencil), brute_force(mesh, mesh.cells[cells[element]], stencil), 1e-12);
      }
      EXPECT_NEAR((point_of(mesh, contact.on_owner) - point_of(mesh, contact.on_target)).norm(), 0, 1e-12);
    }
  }
  EXPECT_GT(quadrilaterals, 100);
}

// What the nodes have of the face that two boxes share.
std::map<NodeId, double> shares_of(const ContactSet<3>& set, double part) {
  std::map<NodeId, double> shares;
  for (const Contact<3>& contact : set.contacts) {
    for (const Stencil<3>& stencil : {contact.on_owner, contact.on_target}) {
      for_each_weight(stencil, [&](NodeId node, double weight) { shares[node] += part * contact.area * weight; });
    }
  }
  return shares;
}

TEST(BothDiagonals, GiveEachNodeOfAnOverlapItsShareOfTheSurfaceThatHeatPasses) {
  const auto mesh = boxes();
  std::map<NodeId, double> shares;
  for (const auto& face : mesh::weighted_faces(mesh)) {
    const Point<3> area = mesh::area_vector<3>(mesh, face.nodes);
    if (std::abs(mesh.nodes[face.nodes[0]].z()) > 1e-9 || std::abs(area.z()) < 0.99 * area.norm()) continue;
    for (const NodeId node : face.nodes) shares[node] += face.weight * area.norm() / 3;
  }
  const auto found = shares_of(find_contacts<3>(mesh, by_overlap), 1);
  ASSERT_EQ(found.size(), shares.size());
  for (const auto& [node, share] : shares) EXPECT_NEAR(found.at(node), share, 1e-12);
}

TEST(BothDiagonals, GiveSemiSpringsOfAParallelogramAQuarterOfItEach) {
  auto mesh = mesh::test::cell_boxes<3>({{.centre = {0, 0, -0.5}, .mesh_size = 1}, {.centre = {0, 0, 0.5}, .mesh_size = 1}});
  for (Point<3>& node : mesh.nodes) node.x() += 0.3 * node.y();
  const auto set = find_contacts<3>(mesh, {});
  ASSERT_EQ(set.contacts.size(), 12);
  std::map<NodeId, double> areas;
  for (const Contact<3>& contact : set.contacts) {
    const auto corner = std::max_element(contact.on_owner.weights.begin(), contact.on_owner.weights.end());
    areas[contact.on_owner.nodes[static_cast<std::size_t>(corner - contact.on_owner.weights.begin())]] += contact.area;
  }
  ASSERT_EQ(areas.size(), 8);
  for (const auto& [node, area] : areas) EXPECT_NEAR(area, 0.25, 1e-14);
}

TEST(BothDiagonals, LeaveTheAreaOfASurfaceAsItIs) {
  const auto mesh = boxes();
  for (const Model model : {Model::overlap, Model::semi_spring}) {
    double face = 0;
    for (const auto& [node, share] : shares_of(find_contacts<3>(mesh, by_overlap), 0.5)) face += share;
    double area = 0;
    for (const Contact<3>& contact : find_contacts<3>(mesh, {0.05, 0.01, model, {}}).contacts) area += contact.area;
    EXPECT_NEAR(area, model == Model::overlap ? face : 2 * face, 1e-12);
  }
}

}  // namespace
}  // namespace scree::contact
