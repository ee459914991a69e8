// The ring of Li & Feng (2016), section 2.2: radii 2 m and 5 m, 960 triangles, each its own block; 5760 semi-springs. Inner rim
// at 100 C, outer at 0 C. Exact steady flow per metre of thickness: 2 pi k dT / ln(5/2).
#include <cmath>

#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"

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

// Steady heat flow over the exact one.
double relative_flow(const mesh::BlockMesh<2>& mesh, const JointOptions& joint) {
  Material material = test::rock();
  material.conductivity = 4.2;
  const Table<MaterialId, Material> materials({material});
  const contact::ContactSet<2> contacts = contact::find_contacts<2>(mesh, {});
  HeatOptions options = test::options_for(mesh, 300);
  options.joint = joint;
  HeatModel model = make_heat_model(mesh, materials, contacts, options);
  // The rims are no boxes: hold their nodes by hand.
  model.boundary_names = {"inner rim", "outer rim"};
  std::vector<double> held;
  for (const NodeId node : mesh.nodes.ids()) {
    const double radius = mesh.nodes[node].norm();
    if (radius > 2.001 && radius < 4.999) continue;
    model.fixed_nodes.push_back(node);
    model.fixed_boundary.push_back(radius < 3 ? 0 : 1);
    held.push_back(radius < 3 ? 400 : 300);
  }
  model.fixed_temperature = Eigen::Map<const Eigen::VectorXd>(held.data(), static_cast<Eigen::Index>(held.size()));
  TimeOptions times;
  times.until = 1e12;
  HeatRun run(model, times);
  run.advance_to(1e12);
  const Eigen::VectorXd leaving = model.conductance * run.state().temperature;
  double flow = 0;
  for (std::size_t i = 0; i < held.size(); ++i) flow += held[i] > 350 ? leaving[model.fixed_nodes[i].value()] : 0;
  return flow / (2 * M_PI * 4.2 * 100 / std::log(2.5));
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
  const double flow10 = relative_flow(mesh, stiff(10, JointForm::consistent));
  const double flow100 = relative_flow(mesh, stiff(100, JointForm::consistent));
  const double flow1000 = relative_flow(mesh, stiff(1000, JointForm::consistent));
  EXPECT_NEAR(flow1000, continuum, 0.001);
  EXPECT_NEAR(flow100, continuum, 0.01);
  EXPECT_NEAR((1 / flow10 - 1 / continuum) / (1 / flow100 - 1 / continuum), 10, 0.5);
  EXPECT_NEAR((1 / flow100 - 1 / continuum) / (1 / flow1000 - 1 / continuum), 10, 0.5);
}

TEST(Ring, LiteralJointsConductTooMuchAsBetaGrows) {
  const auto mesh = ring(Breaking::per_element);
  EXPECT_GT(relative_flow(mesh, stiff(100, JointForm::literal)), 1.3);
  EXPECT_GT(relative_flow(mesh, stiff(1000, JointForm::literal)), 3);
}

}  // namespace
}  // namespace scree::thermal
