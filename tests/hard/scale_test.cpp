// The same problem in micrometres, in kilometres and far from the origin gives the same dimensionless answer.
#include <gtest/gtest.h>

#include "contact/find_contacts.h"
#include "tests/thermal/builders.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

// Temperatures of two touching slabs at a given Fourier number, their corners at `origin`.
Eigen::VectorXd temperatures(double length, double origin) {
  auto left = test::bar<2>(0.5 * length, 4, 3, 0.3 * length);
  left.low.setConstant(origin);
  auto right = test::bar<2>(0.5 * length, 3, 2, 0.3 * length);
  right.low.setConstant(origin);
  right.low[0] += 0.5 * length;
  const auto mesh = test::slab_mesh<2>({left, right});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(
      {{BodyId{0}, test::between_x(origin - 1e-3 * length, origin + 1e-3 * length)}, FixedTemperature{400}, "left", {}});
  const auto contacts = contact::find_contacts(mesh, {});
  EXPECT_GT(contacts.contacts.size(), 0u);
  const HeatModel model = make_heat_model(mesh, test::rock_only(), contacts, options);
  TimeOptions times;
  times.until = 0.1 * length * length / 2e-6;  // kappa of the rock
  times.tolerance = 0.01;
  HeatRun run(model, times);
  run.advance_to(times.until);
  return run.state().temperature;
}

double largest_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / 100;
}

TEST(Scale, MicrometresAndKilometresGiveTheSameDimensionlessAnswer) {
  const Eigen::VectorXd metre = temperatures(1, 0);
  EXPECT_GT(metre.maxCoeff() - metre.minCoeff(), 10);
  EXPECT_LT(largest_difference(temperatures(1e-6, 0), metre), 1e-9);
  EXPECT_LT(largest_difference(temperatures(1e3, 0), metre), 1e-9);
}

TEST(Scale, APlaceThousandKilometresAwayGivesTheSameAnswerToTheRoundingOfItsCoordinates) {
  // Coordinates of 1e6 m carry 1e-10 m, or 1e-9 of a cell.
  EXPECT_LT(largest_difference(temperatures(1, 1e6), temperatures(1, 0)), 1e-7);
}

}  // namespace
}  // namespace scree::thermal
