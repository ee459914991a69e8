// Convection, radiation and conditions that change in time, against NAFEMS (The standard NAFEMS benchmarks, 1990, T2 to T4) and
// closed forms (Carslaw & Jaeger 1959).
#include <cmath>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "tests/verification/formula.h"
#include "thermal/heat_run.h"
#include "thermal/steady_state.h"

namespace scree::thermal {
namespace {

constexpr double zero = 273.15;  // 0 C [K]

Table<MaterialId, Material> material(double conductivity, double specific_heat, double density) {
  Material one = test::rock();
  one.conductivity = conductivity;
  one.specific_heat = specific_heat;
  one.density = density;
  return Table<MaterialId, Material>({one});
}

template <int dim>
double value_at(const mesh::BlockMesh<dim>& mesh, const Eigen::VectorXd& temperature, const Point<dim>& place) {
  NodeId nearest{0};
  for (const NodeId node : mesh.nodes.ids()) {
    if ((mesh.nodes[node] - place).norm() < (mesh.nodes[nearest] - place).norm()) nearest = node;
  }
  EXPECT_LT((mesh.nodes[nearest] - place).norm(), 1e-9);
  return temperature[nearest.value()];
}

Boundary at(const Aabb<3>& part, const decltype(Boundary::condition)& condition, const std::string& name) {
  Boundary boundary;
  boundary.region = Region(BodyId{0}, part);
  boundary.condition = condition;
  boundary.name = name;
  return boundary;
}

TEST(Nafems, TwoIsARadiatingBarOf927Kelvin) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.1, 4, 1, 0.025)});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 1000, "hot end"));
  options.boundaries.push_back(at(test::between_x(0.1, 0.1), Radiation{0.98, 300}, "radiating end"));
  const HeatState steady = steady_state(make_heat_model(mesh, material(55.6, 460, 7850), {}, options));
  EXPECT_NEAR(value_at<2>(mesh, steady.temperature, {0.1, 0}), 927.0, 0.05);
  EXPECT_LT(steady.ledger.relative_residual(), 1e-12);
  EXPECT_NEAR(steady.ledger.by_boundary.at(0), -steady.ledger.by_surroundings.at(0), 1e-9 * steady.ledger.turnover);
}

TEST(Nafems, ThreeIsABarWhoseEndSwingsOf36Point60Degrees) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.1, 100, 1, 0.001)});
  HeatOptions options = test::options_for(mesh, zero);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, zero, "cold end"));
  options.boundaries.push_back(at(test::between_x(0.1, 0.1),
                                  FixedTemperature{test::formula("273.15 + 100*sin(3.14159265358979*t/40)")},
                                  "end that swings"));
  TimeOptions time;
  time.until = 32;
  time.tolerance = 0.005;
  HeatRun run(make_heat_model(mesh, material(35, 440.5, 7200), {}, options), time);
  run.advance_to(32);
  EXPECT_NEAR(value_at<2>(mesh, run.state().temperature, {0.08, 0}) - zero, 36.60, 0.02);
  EXPECT_TRUE(run.within_tolerance());
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-12);
  EXPECT_EQ(overshoot(make_heat_model(mesh, material(35, 440.5, 7200), {}, options), run.state()).value(), 0);
}

double nafems_four(int cells) {
  test::Slab<2> plate;
  plate.size = {0.6, 1.0};
  plate.cells = {3 * cells, 5 * cells};
  const auto mesh = test::slab_mesh<2>({plate});
  HeatOptions options = test::options_for(mesh, zero);
  const double far = 1e9;
  const Aabb<3> base(Eigen::Vector3d(-far, 0, -far), Eigen::Vector3d(far, 0, far));
  const Aabb<3> top(Eigen::Vector3d(-far, 1, -far), Eigen::Vector3d(far, 1, far));
  options.boundaries.push_back(at(base, FixedTemperature{zero + 100}, "base"));
  options.boundaries.push_back(at(test::between_x(0.6, 0.6), Convection{750, zero}, "right"));
  options.boundaries.push_back(at(top, Convection{750, zero}, "top"));
  const HeatState steady = steady_state(make_heat_model(mesh, material(52, 460, 7850), {}, options));
  EXPECT_LT(steady.ledger.relative_residual(), 1e-12);
  EXPECT_LE(steady.steps, 2);  // linear: one solve, and perhaps one against rounding
  return value_at<2>(mesh, steady.temperature, {0.6, 0.2}) - zero;
}

TEST(Nafems, FourIsACooledPlateOf18Point25Degrees) {
  EXPECT_NEAR(nafems_four(40), 18.25, 0.02);
  EXPECT_LT(std::abs(nafems_four(20) - 18.25), std::abs(nafems_four(10) - 18.25));
}

// Half of a slab of thickness 2 L that cools by convection at Biot 1: theta = sum 4 sin z/(2 z + sin 2 z) exp(-z^2 Fo) cos(z
// x/L), with z tan z = Bi.
double cooling_slab(double x_over_l, double fourier) {
  double theta = 0;
  for (int n = 0; n < 40; ++n) {
    double low = n * M_PI;
    double high = low + M_PI / 2 - 1e-13;
    for (int i = 0; i < 200; ++i) {
      const double z = 0.5 * (low + high);
      (z * std::tan(z) < 1 ? low : high) = z;
    }
    theta += 4 * std::sin(low) / (2 * low + std::sin(2 * low)) * std::exp(-low * low * fourier) * std::cos(low * x_over_l);
  }
  return theta;
}

double convection_error(int cells) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(1, cells, 1, 1.0 / cells)});
  HeatOptions options = test::options_for(mesh, 400);
  options.boundaries.push_back(at(test::between_x(1, 1), Convection{2, 300}, "air"));
  TimeOptions time;
  time.until = 0.5;
  time.tolerance = 2e-3;
  HeatRun run(make_heat_model(mesh, material(2, 1, 2), {}, options), time);  // kappa 1 m2/s, Biot 1
  run.advance_to(0.5);
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-12);
  EXPECT_LT(run.state().ledger.by_surroundings.at(0), 0);
  double largest = 0;
  for (const NodeId node : mesh.nodes.ids()) {
    const double exact = 300 + 100 * cooling_slab(mesh.nodes[node].x(), 0.5);
    largest = std::max(largest, std::abs(run.state().temperature[node.value()] - exact));
  }
  return largest;
}

TEST(Surroundings, AConvectingSlabFollowsItsSeriesWithOrderTwo) {
  EXPECT_LT(convection_error(20), 0.03);
  EXPECT_NEAR(std::log2(convection_error(5) / convection_error(10)), 2, 0.3);
}

// A square drawn to a disc: cooling cylinder at Biot 1, theta = sum 2/z J1(z)/(J0^2 + J1^2) exp(-z^2 Fo) J0(z r), z J1 = Bi J0.
TEST(Surroundings, ACoolingCylinderFollowsItsSeries) {
  test::Slab<2> square;
  square.low = {-1, -1};
  square.size = {2, 2};
  square.cells = {40, 40};
  auto mesh = test::slab_mesh<2>({square});
  for (auto& node : mesh.nodes) {
    const double x = node.x();
    const double y = node.y();
    node = {x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2)};
  }
  HeatOptions options = test::options_for(mesh, 400);
  Boundary air = at(test::between_x(-2, 2), Convection{1, 300}, "air");
  air.region.within.reset();
  options.boundaries.push_back(air);
  TimeOptions time;
  time.until = 0.4;
  time.tolerance = 1e-2;
  HeatRun run(make_heat_model(mesh, material(1, 1, 1), {}, options), time);
  run.advance_to(0.4);
  const double z1 = 1.25578371179;  // first root; the next one, 4.0795, has decayed to e^-6.7
  const double z2 = 4.07947770943;
  double centre = 300;
  for (const double z : {z1, z2}) {
    const double j0 = std::cyl_bessel_j(0, z);
    const double j1 = std::cyl_bessel_j(1, z);
    centre += 100 * 2 / z * j1 / (j0 * j0 + j1 * j1) * std::exp(-z * z * 0.4);
  }
  EXPECT_NEAR(value_at<2>(mesh, run.state().temperature, {0, 0}), centre, 0.1);
}

// Constant flux into a half-space: T_s = 2 q/k sqrt(kappa t/pi).
TEST(Surroundings, AHeatedHalfSpaceWarmsWithTheRootOfTime) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(1, 200, 1, 0.005)});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(at(test::between_x(0, 0), HeatFlux{100}, "flux"));
  TimeOptions time;
  time.until = 0.02;
  time.tolerance = 1e-3;
  HeatRun run(make_heat_model(mesh, material(1, 1, 1), {}, options), time);
  run.advance_to(0.02);
  EXPECT_NEAR(value_at<2>(mesh, run.state().temperature, {0, 0}), 300 + 200 * std::sqrt(0.02 / M_PI), 0.03);
  EXPECT_FALSE(overshoot(make_heat_model(mesh, material(1, 1, 1), {}, options), run.state()).has_value());
}

// One element that radiates: dT/dt = -a (T^4 - T_s^4) has a closed form for T_s = 0, 1/T^3 = 1/T_0^3 + 3 a t.
TEST(Surroundings, ABodyThatRadiatesIntoTheVoidCoolsByTheCubeLawAndKeepsItsLedger) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.01, 1, 1, 0.01)});
  HeatOptions options = test::options_for(mesh, 1000);
  Boundary sky = at(test::between_x(-1, 1), Radiation{0.5, 0}, "sky");
  sky.region.within.reset();
  options.boundaries.push_back(sky);
  const HeatModel model = make_heat_model(mesh, material(1e6, 500, 2000), {}, options);
  const double a = 5.670374419e-8 * 0.5 * 0.04 / (1e6 * 1e-4);
  for (const Integrator integrator : {Integrator::implicit, Integrator::stabilised_explicit}) {
    TimeOptions time;
    time.integrator = integrator;
    time.until = 400;
    time.output_every = 50;
    time.tolerance = 0.01;
    HeatRun run(model, time);
    run.advance_to(400);
    EXPECT_NEAR(run.state().temperature[0], std::pow(1e-9 + 3 * a * 400, -1.0 / 3), 0.01);
    EXPECT_LT(run.state().ledger.relative_residual(), 1e-10);
  }
}

TEST(SteadyState, RadiationIsFoundFromFourToFourThousandKelvin) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.1, 4, 1, 0.025)});
  for (const double from : {4.0, 4000.0}) {
    for (const double flux : {1e-3, 1e3, 1.4e7}) {
      HeatOptions options = test::options_for(mesh, from);
      options.boundaries.push_back(at(test::between_x(0, 0), HeatFlux{flux}, "flux"));
      options.boundaries.push_back(at(test::between_x(0.1, 0.1), Radiation{1, 4}, "sky"));
      const HeatState steady = steady_state(make_heat_model(mesh, material(55.6, 460, 7850), {}, options));
      const double exact = std::pow(256 + flux / 5.670374419e-8, 0.25);
      EXPECT_NEAR(value_at<2>(mesh, steady.temperature, {0.1, 0}) / exact, 1, 1e-9);
      EXPECT_LT(steady.ledger.relative_residual(), 1e-11);
    }
  }
}

// If all of its heat left by radiation, the body would be hotter than its conductivity is known for. It leaves by the base: by
// Kirchhoff's transform 148 d - 0.07 d^2 = q L^2/2 for the rise d of the top.
TEST(SteadyState, IsFoundWhereWhatRadiatesAloneWouldBeHotterThanAFormulaHolds) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.01, 24, 24, 0.01)});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 300, "base"));
  options.boundaries.push_back(at(test::between_x(0.01, 0.01), Radiation{0.05, 300}, "top"));
  options.sources.push_back({test::on(BodyId{0}, std::nullopt), 5e6, "power", {}});
  Table<MaterialId, Material> silicon = material(1, 700, 2330);
  silicon[MaterialId{0}].conductivity =
      Curve::from_expression("190 - 0.14*T", std::get<UnitConverter>(unit_converter("", quantity::number)),
                             {.key = "conductivity", .range = positive});
  const HeatState steady = steady_state(make_heat_model(mesh, silicon, {}, options));
  const double rise = (148 - std::sqrt(148.0 * 148 - 4 * 0.07 * 250)) / (2 * 0.07);
  EXPECT_NEAR(value_at<2>(mesh, steady.temperature, {0.01, 0}), 300 + rise, 3e-3);
}

// Nothing is left after some hundred times its own time.
TEST(Surroundings, ABodyThatHasCooledToZeroKelvinStaysThere) {
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.1, 2, 1, 0.05)});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(at(test::between_x(0, 0), Convection{50, 0}, "space"));
  Table<MaterialId, Material> ice = material(2, 900, 1000);
  ice[MaterialId{0}].specific_heat = Curve::from_table(LinearTable({0, 300}, {100, 900}));
  TimeOptions time;
  time.integrator = Integrator::implicit;
  time.until = 60 * 86400;
  HeatRun run(make_heat_model(mesh, ice, {}, options), time);
  run.advance_to(time.until);
  EXPECT_TRUE(run.within_tolerance());
  EXPECT_LT(run.state().temperature.cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(run.state().steps, 1000);
}

TEST(SteadyState, BlocksWithoutAPathToATemperatureAreNamedAndCounted) {
  auto far = test::bar<2>(0.1, 2, 1, 0.05);
  far.low[0] = 1;
  far.block_per_element = true;
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.1, 4, 1, 0.025), far});
  HeatOptions options = test::options_for(mesh, 300);
  options.boundaries.push_back(test::hold(BodyId{0}, 0, 1000, "hot end"));
  try {
    steady_state(make_heat_model(mesh, test::rock_only(), {}, options));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("4 blocks of body1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scree::thermal
