// Radiation from 4 K to 4000 K in time.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "thermal/exchange.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

// Time in which a body goes from one temperature to another in surroundings at Ts: C dT/dt = a (Ts^4 - T^4), whose integral is
// a t/C = [atanh(T/Ts) + atan(T/Ts)]/(2 Ts^3), with acoth for T > Ts.
double passage(double from, double to, double surroundings, double rate) {
  const auto primitive = [&](double t) {
    const double x = t / surroundings;
    return 0.5 * std::log(std::abs((1 + x) / (1 - x))) + std::atan(x);
  };
  return (primitive(to) - primitive(from)) / (2 * std::pow(surroundings, 3) * rate);
}

struct Range {
  double from;
  double to;
  double surroundings;
};

class RadiationOver : public testing::TestWithParam<Range> {};

TEST_P(RadiationOver, AThousandfoldRangeFollowsItsIntegralAndKeepsTheLedger) {
  const auto [from, to, surroundings] = GetParam();
  const auto mesh = test::slab_mesh<2>({test::bar<2>(0.01, 1, 1, 0.01)});
  Material metal = test::rock();
  metal.conductivity = 1e9;
  HeatOptions options = test::options_for(mesh, from);
  Boundary sky;
  sky.name = "sky";
  sky.region.body = BodyId{0};
  sky.condition = Radiation{1.0, surroundings};
  options.boundaries.push_back(sky);
  const HeatModel model = make_heat_model(mesh, Table<MaterialId, Material>({metal}), contact::ContactSet<2>{}, options);
  const double rate = stefan_boltzmann * 0.04 / (2500 * 800 * 1e-4);
  TimeOptions time;
  time.until = passage(from, to, surroundings, rate);
  time.output_every = time.until / 4;
  time.tolerance = 1e-3 * std::abs(from - to);
  HeatRun run(model, time);
  run.advance_to(time.until);
  EXPECT_NEAR(run.state().temperature[0], to, time.tolerance);
  EXPECT_LE(run.state().time_error, time.tolerance);
  EXPECT_LT(run.state().ledger.relative_residual(), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Range, RadiationOver,
                         testing::Values(Range{4000, 40, 4}, Range{4, 3900, 4000}, Range{4, 15, 16}, Range{4000, 1000, 900}));

}  // namespace
}  // namespace scree::thermal
