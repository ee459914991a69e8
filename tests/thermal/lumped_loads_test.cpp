// What loads make of the inside of a lumped block: the stated error against the meshed block.
#include <functional>
#include <variant>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/thermal/lumped_cases.h"

namespace scree::thermal {
namespace {

using test::row_of_cubes;

// Heated near a corner only, for as long as its inside takes to follow.
TEST(LumpedLoads, HaveAnErrorThatIsKnownWhereTheyAreStrongAtOneEnd) {
  const auto run = [](BlockModel model, const std::string& density) {
    auto row = row_of_cubes<2>(1, 20);
    Source source{test::on(BodyId{0}), test::formula(density), "source", {}};
    row.options.sources.push_back(source);
    row.options.blocks.model = model;
    return test::heated(row.model(), 20000);
  };
  for (const std::string density : {"1e5*exp(-x/0.01)", "1e5*exp(-(x + y)/0.02)"}) {
    const auto meshed = run(BlockModel::meshed, density);
    const double real = 0.5 * (meshed.temperature.maxCoeff() - meshed.temperature.minCoeff());
    const double stated = run(BlockModel::lumped, density).lumping.largest;
    EXPECT_GT(stated, real) << density;
    EXPECT_LT(stated, 6 * real) << density;
  }
}

// How many times the largest difference from the mean that a load makes within a square or a cube is stated.
template <int dim>
double stated_of_real(const std::function<void(HeatOptions&)>& load, int cells) {
  const auto run = [&](BlockModel model) {
    auto row = row_of_cubes<dim>(1, cells);
    load(row.options);
    row.options.blocks.model = model;
    return row.model();
  };
  const HeatModel model = run(BlockModel::meshed);
  const Eigen::VectorXd temperature = test::heated(model, 20000, 0.5).temperature;
  const double mean = temperature.dot(model.capacity) / model.capacity.sum();
  const double real = (temperature.array() - mean).abs().maxCoeff();
  EXPECT_GT(real, 1);
  return test::heated(run(BlockModel::lumped), 20000, 0.5).lumping.largest / real;
}

std::function<void(HeatOptions&)> through_surface(const Aabb<3>& within, const std::variant<HeatFlux, HeatFlow>& condition) {
  return [=](HeatOptions& options) {
    Boundary boundary;
    boundary.region = test::on(BodyId{0}, within);
    std::visit([&](const auto& one) { boundary.condition = one; }, condition);
    boundary.name = "load";
    options.boundaries.push_back(boundary);
  };
}

std::function<void(HeatOptions&)> set_free(const std::string& density) {
  return [=](HeatOptions& options) { options.sources.push_back({test::on(BodyId{0}), test::formula(density), "source", {}}); };
}

void expect_stated(const std::string& load, double of_real) {
  EXPECT_GT(of_real, 1) << load;
  EXPECT_LT(of_real, 3.5) << load;
}

template <int dim>
void expect_stated_through(const Aabb<3>& within, const std::variant<HeatFlux, HeatFlow>& condition, const std::string& name) {
  expect_stated(fmt::format("{} in {} dimensions", name, dim),
                stated_of_real<dim>(through_surface(within, condition), dim == 2 ? 16 : 8));
}

TEST(LumpedLoads, HaveAnErrorThatIsKnownInACornerAndOnAPartOfASide) {
  for (const double part : {0.5, 0.25}) {
    const Point<3> high = Point<3>::Constant(part * test::side), low = Point<3>::Zero();
    const std::string name = fmt::format("{} of a side", part);
    expect_stated_through<2>(Aabb<3>{low, high}, HeatFlux{1000.0}, name);
    expect_stated_through<3>(Aabb<3>{low, high}, HeatFlux{1000.0}, name);
    expect_stated_through<2>(Aabb<3>{low, Point<3>(high.x(), 0, 0)}, HeatFlow{100.0}, name + ", one only");
    expect_stated_through<3>(Aabb<3>{low, Point<3>(high.x(), high.y(), 0)}, HeatFlow{100.0}, name + ", one only");
  }
}

TEST(LumpedLoads, HaveAnErrorThatIsKnownWhereTheyHeatOnePartAndCoolAnother) {
  const Aabb<3> everywhere{Point<3>::Constant(-1), Point<3>::Constant(1)};
  const auto unit = std::get<UnitConverter>(unit_converter("W/m2", quantity::heat_flux));
  for (const std::string flux : {"1000*(x/0.05 - 1)", "1000*sin(2*pi*x/0.1)"}) {
    const HeatFlux condition{Function::from_expression(flux, unit, ValueRule{})};
    expect_stated_through<2>(everywhere, condition, flux);
    expect_stated_through<3>(everywhere, condition, flux);
  }
  for (const std::string power : {"1e5*(x/0.05 - 1)", "1e5*sin(2*pi*x/0.1)", "1e5*sin(2*pi*x/0.1)*sin(2*pi*y/0.1)"}) {
    expect_stated(power, stated_of_real<2>(set_free(power), 16));
    expect_stated(power, stated_of_real<3>(set_free(power), 8));
  }
}

TEST(LumpedLoads, HaveAnErrorThatIsKnownWhereASourceIsStrongInASmallPart) {
  for (const std::string middle : {"0.05", "0"}) {
    const std::string power = fmt::format("1e5*exp(-((x - {0})^2 + (y - {0})^2)/0.0002)", middle);
    expect_stated(power, stated_of_real<2>(set_free(power), 32));
    expect_stated(power, stated_of_real<3>(set_free(power), 8));
  }
}

// A spark beside a source that heats all of the cube.
TEST(LumpedLoads, HaveTheSameErrorWhereOneOfThemIsSmallAndSetsHardlyAnythingFree) {
  const auto stated = [](bool spark) {
    auto row = row_of_cubes<3>(1, 8);
    set_free("1e5*x/0.1")(row.options);
    if (spark)
      through_surface({Eigen::Vector3d(-1e-9, -1e-9, -1e-9), Eigen::Vector3d(1e-9, 0.0126, 0.0126)},
                      HeatFlow{1e-3})(row.options);
    row.options.blocks.model = BlockModel::lumped;
    return test::heated(row.model(), 20000, 0.5).lumping.largest;
  };
  EXPECT_GT(stated(false), 1);
  EXPECT_NEAR(stated(true) / stated(false), 1, 0.001);
}

}  // namespace
}  // namespace scree::thermal
