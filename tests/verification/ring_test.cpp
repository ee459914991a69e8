// The ring of Li & Feng (2016), section 2.2: radii 2 m and 5 m, 960 triangles, each its own block; 5760 semi-springs. Inner rim
// at 100 C, outer at 0 C. Exact steady flow per metre of thickness: 2 pi k dT / ln(5/2).
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "tests/verification/steady.h"

namespace scree::thermal {
namespace {

enum class Breaking { whole, per_element };

// A strip of 8 x 60 cells bent into a ring; a whole ring shares its nodes along the seam.
mesh::BlockMesh<2> ring(Breaking breaking) {
  constexpr int around = 60;
  constexpr int across = 8;
  mesh::BlockMesh<2> mesh;
  mesh.bodies.push_back({"ring", MaterialId{0}, false, {}});
  const auto place = [](int i, int j) {
    const double radius = 2 + 3.0 * i / across;
    const double angle = 2 * M_PI * (j % around) / around;
    return Point<2>(radius * std::cos(angle), radius * std::sin(angle));
  };
  const bool whole = breaking == Breaking::whole;
  for (int j = 0; whole && j < around; ++j) {
    for (int i = 0; i <= across; ++i) mesh.nodes.push_back(place(i, j));
  }
  const auto add = [&](std::array<std::array<int, 2>, 3> corners) {
    mesh::BlockMesh<2>::Element element;
    for (int c = 0; c < 3; ++c) {
      const auto [i, j] = corners[c];
      element[c] =
          whole ? NodeId{static_cast<std::size_t>((j % around) * (across + 1) + i)} : mesh.nodes.push_back(place(i, j));
    }
    const ElementId id = mesh.elements.push_back(element);
    if (!whole) mesh.blocks.push_back({BodyId{0}, {element[0].index(), element[0].index() + 3}, {id.index(), id.index() + 1}});
  };
  for (int j = 0; j < around; ++j) {
    for (int i = 0; i < across; ++i) {
      add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
      add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
  }
  if (whole) mesh.blocks.push_back({BodyId{0}, {0, mesh.nodes.size()}, {0, mesh.elements.size()}});
  return mesh;
}

JointOptions stiff(double beta, JointForm form) {
  JointOptions joint;
  joint.law = StiffnessFactor{beta};
  joint.form = form;
  return joint;
}

struct Solution {
  double flow = 0;                                                    // over the exact one
  std::map<std::pair<long, long>, std::vector<double>> temperatures;  // [C], of all nodes at a place, by its coordinates in um
};

Solution solve(const mesh::BlockMesh<2>& mesh, const JointOptions& joint) {
  Material material = test::rock();
  material.conductivity = 4.2;
  const Table<MaterialId, Material> materials({material});
  const auto contacts = contact::find_contacts(mesh, contact_search(joint, mesh.bodies, {}));
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint;
  const HeatModel model = make_heat_model(mesh, materials, contacts, options);
  test::Held held;
  for (const NodeId node : mesh.nodes.ids()) {
    const double radius = mesh.nodes[node].norm();
    if (radius < 2.001) held[node] = 100;
    if (radius > 4.999) held[node] = 0;
  }
  const Eigen::VectorXd temperature = test::steady(model, held);
  Eigen::VectorXd of_rows(model.capacity.size());  // nodes that are tied share one
  std::set<NodeId> rim;
  Solution solution;
  for (const NodeId node : mesh.nodes.ids()) {
    const Point<2> place = mesh.nodes[node] * 1e6;
    solution.temperatures[{std::lround(place.x()), std::lround(place.y())}].push_back(temperature[node.value()]);
    of_rows[model.rows[node].value()] = temperature[node.value()];
    if (mesh.nodes[node].norm() < 2.001) rim.insert(model.rows[node]);
  }
  const Eigen::VectorXd leaving = model.conductance * of_rows;
  for (const NodeId row : rim) solution.flow += leaving[row.value()];
  solution.flow /= 2 * M_PI * 4.2 * 100 / std::log(2.5);
  return solution;
}

double relative_flow(const mesh::BlockMesh<2>& mesh, const JointOptions& joint) {
  return solve(mesh, joint).flow;
}

// Largest difference of any block's node from the whole ring's node in its place [K].
double largest_difference(const Solution& broken, const Solution& whole) {
  double largest = 0;
  for (const auto& [place, values] : broken.temperatures) {
    for (const double value : values) largest = std::max(largest, std::abs(value - whole.temperatures.at(place).front()));
  }
  return largest;
}

TEST(Ring, HasAsManySemiSpringsAsThePaper) {
  EXPECT_EQ(contact::find_contacts<2>(ring(Breaking::per_element), {}).semi_springs, 5760U);
}

TEST(Ring, AContinuumConductsAsTheExactSolution) {
  EXPECT_NEAR(relative_flow(ring(Breaking::whole), {}), 1.002, 1e-3);
}

// The joints are so many resistances in series, each falling as 1/beta.
TEST(Ring, ConsistentJointsBecomeAContinuumAsBetaGrows) {
  const auto mesh = ring(Breaking::per_element);
  const double continuum = relative_flow(ring(Breaking::whole), {});
  const double flow01 = relative_flow(mesh, stiff(0.1, JointForm::consistent));
  const double flow1 = relative_flow(mesh, stiff(1, JointForm::consistent));
  EXPECT_NEAR(flow01, 0.1313, 1e-4);
  EXPECT_NEAR((1 / flow01 - 1 / continuum) / (1 / flow1 - 1 / continuum), 10, 1);
  const double flow10 = relative_flow(mesh, stiff(10, JointForm::consistent));
  const double flow100 = relative_flow(mesh, stiff(100, JointForm::consistent));
  const double flow1000 = relative_flow(mesh, stiff(1000, JointForm::consistent));
  EXPECT_NEAR(flow1000, continuum, 0.001);
  EXPECT_NEAR(flow100, continuum, 0.01);
  EXPECT_NEAR((1 / flow10 - 1 / continuum) / (1 / flow100 - 1 / continuum), 10, 0.5);
  EXPECT_NEAR((1 / flow100 - 1 / continuum) / (1 / flow1000 - 1 / continuum), 10, 0.5);
}

TEST(Ring, ConsistentJointsOfBetaHundredAreTheContinuumWithinAFifthOfAKelvinAndAHundredthOfTheFlow) {
  const auto mesh = ring(Breaking::per_element);
  const Solution whole = solve(ring(Breaking::whole), {});
  const Solution broken = solve(mesh, stiff(100, JointForm::consistent));
  EXPECT_LT(largest_difference(broken, whole), 0.2);
  EXPECT_NEAR(broken.flow / whole.flow, 1, 0.01);
}

// Every triangle its own block and still one ring: corners that match are one node.
TEST(Ring, PerfectJointsAreTheContinuum) {
  const Solution whole = solve(ring(Breaking::whole), {});
  JointOptions joint;
  joint.law = PerfectJoint{};
  const Solution broken = solve(ring(Breaking::per_element), joint);
  EXPECT_LT(largest_difference(broken, whole), 1e-9);
  EXPECT_NEAR(broken.flow / whole.flow, 1, 1e-12);
}

// Each joint stands for the semi-springs of both its sides, which here lie face to face.
TEST(Ring, OverlapsConductAsSemiSpringsOfTheSameBeta) {
  const auto mesh = ring(Breaking::per_element);
  JointOptions joint = stiff(1, JointForm::consistent);
  const double semi_springs = relative_flow(mesh, joint);
  joint.model = contact::Model::overlap;
  EXPECT_NEAR(relative_flow(mesh, joint) / semi_springs, 1, 0.01);
}

TEST(Ring, LiteralJointsConductTooMuchAsBetaGrows) {
  const auto mesh = ring(Breaking::per_element);
  EXPECT_GT(relative_flow(mesh, stiff(100, JointForm::literal)), 1.3);
  EXPECT_GT(relative_flow(mesh, stiff(1000, JointForm::literal)), 3);
}

}  // namespace
}  // namespace scree::thermal
