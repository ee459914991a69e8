// What drives a run in time, and jumps or comes and goes within its steps.
#include <array>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/thermal/builders.h"
#include "tests/thermal/resumed.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

using test::bar;
using test::between_x;
using test::options_for;
using test::rock_only;
using test::slab_mesh;

constexpr std::array integrators{Integrator::implicit, Integrator::stabilised_explicit};

TimeOptions an_hour(Integrator integrator) {
  TimeOptions options;
  options.integrator = integrator;
  options.until = 3600;
  options.output_every = 3600;
  options.tolerance = 0.1;
  return options;
}

// An hour between two outputs of a source in a slab of 1 m2, one metre deep.
HeatState after_an_hour_of(const Function& source, Integrator integrator) {
  const auto mesh = slab_mesh<2>({bar<2>(1, 2, 1, 1)});
  HeatOptions options = options_for(mesh, 300);
  options.sources.push_back({test::on(BodyId{0}, between_x(0, 1)), source, "pulse", {}});
  const HeatModel model = make_heat_model(mesh, rock_only(), contact::ContactSet<2>{}, options);
  HeatRun run(model, an_hour(integrator));
  run.advance_to(3600);
  return run.state();
}

// 1e7 W/m3 for 10 s of an hour come in, whatever the output interval leaps over.
TEST(ChangingDrives, APulseInATableIsNotLeaptOver) {
  for (const Integrator integrator : integrators) {
    for (const double ramp : {5.0, 1e-3}) {
      const Function source = Function::from_table(
          LinearTable({0, 2000 - ramp, 2000, 2010 - ramp, 2010, 3600}, {0, 0, 1e7, 1e7, 0, 0}), ValueRule{});
      const HeatState state = after_an_hour_of(source, integrator);
      EXPECT_NEAR(state.ledger.by_applied[0] / 1e8, 1, 0.01) << ramp;
      EXPECT_LT(state.steps, 200);
    }
  }
}

// Fixed steps do leap over it, and say what that makes.
TEST(ChangingDrives, ThePulseThatAFixedStepLeapsOverIsInItsError) {
  const Function pulse =
      Function::from_table(LinearTable({0, 1000, 1010, 1400, 1410, 3600}, {0, 0, 1e7, 1e7, 0, 0}), ValueRule{});
  const HeatState leapt = after_an_hour_of(pulse, Integrator::explicit_euler);
  const HeatState followed = after_an_hour_of(pulse, Integrator::implicit);
  const double missed = (leapt.temperature - followed.temperature).lpNorm<Eigen::Infinity>();
  EXPECT_EQ(leapt.ledger.by_applied[0], 0) << "the step is short enough, and the test sees nothing";
  EXPECT_GT(missed, 100);
  EXPECT_GT(leapt.time_error, 0.9 * missed);
  EXPECT_LT(leapt.time_error, 1.5 * missed) << "when its sides are is known to half of the way between two looks";
}

TEST(ChangingDrives, TheErrorOfFixedStepsSeesSurroundingsAndHeldTemperaturesBetweenTheirEnds) {
  const Function pulse =
      Function::from_table(LinearTable({0, 1000, 1010, 1400, 1410, 3600}, {300, 300, 900, 900, 300, 300}), ValueRule{});
  const auto mesh = slab_mesh<2>({bar<2>(1, 2, 1, 1)});
  for (const bool holds : {false, true}) {
    HeatOptions options = options_for(mesh, 300);
    Boundary left = test::hold(BodyId{0}, 0, 0, "pulse");
    left.condition = holds ? decltype(left.condition)(FixedTemperature{pulse}) : Convection{5.0, pulse};
    options.boundaries.push_back(left);
    const HeatModel model = make_heat_model(mesh, rock_only(), contact::ContactSet<2>{}, options);
    const auto after_an_hour = [&](Integrator integrator) {
      HeatRun run(model, an_hour(integrator));
      run.advance_to(3600);
      return run.state();
    };
    const HeatState leapt = after_an_hour(Integrator::explicit_euler), followed = after_an_hour(Integrator::implicit);
    const double missed = (leapt.temperature - followed.temperature).lpNorm<Eigen::Infinity>();
    EXPECT_GT(missed, 0.5) << holds;
    EXPECT_GT(leapt.time_error, 0.9 * missed) << holds;
  }
}

TEST(ChangingDrives, APulseInAFormulaIsNotLeaptOver) {
  const auto unit = std::get<UnitConverter>(unit_converter("W/m3", quantity::power_density));
  for (const Integrator integrator : integrators) {
    const auto heat_of = [&](const std::string& formula) {
      const HeatState state = after_an_hour_of(Function::from_expression(formula, unit, ValueRule{}), integrator);
      EXPECT_LT(state.steps, 1500) << formula;
      return state.ledger.by_applied[0];
    };
    EXPECT_NEAR(heat_of("1e7*(t > 2000)*(t < 2010)") / 1e8, 1, 0.01);
    EXPECT_NEAR(heat_of("1e7*exp(-((t - 2000)/20)^2)") / (1e7 * 20 * std::sqrt(std::numbers::pi)), 1, 0.01);
    EXPECT_NEAR(heat_of("1e6*(t > 1000)*(t < 1200)*(x + 1)") / 3e8, 1, 0.01) << "another value at every place";
    EXPECT_NEAR(heat_of("1e6*(sin(2*pi*t/90) > 0)") / 1.8e9, 1, 0.01) << "on for 45 s and off for 45 s, forty times";
  }
}

// What depends on place, too, is looked at here and there: its jumps are not known, and lie within steps.
std::string with_place(const std::string& formula) {
  return formula + " + 0*x";
}

// Of a block that keeps every error that its steps make.
double error_of(const HeatState& state, double warming, double seconds) {
  return std::abs(state.temperature[0] - 300 - warming * seconds);
}

double warming_by(double power) {
  const Material rock = rock_only()[MaterialId{0}];
  return power / (*rock.density * (*rock.specific_heat)(300));  // [K/s]
}

// The estimate must be that of the heat that came in.
TEST(ChangingDrives, TheErrorOfLoadsThatJumpWithinStepsIsEstimatedAndBounded) {
  const auto unit = std::get<UnitConverter>(unit_converter("W/m3", quantity::power_density));
  const double power = 1e6;
  const auto off = [&](const Function& source, double seconds) {
    for (const Integrator integrator : integrators) {
      const HeatState state = after_an_hour_of(source, integrator);
      const double error = error_of(state, warming_by(power), seconds);
      EXPECT_LT(error, 0.1);
      EXPECT_LE(error, 1.1 * state.time_error);
      EXPECT_LT(state.time_error, 0.1);
    }
  };
  for (const double begin : {10.03, 333.77, 1799.0, 2718.28}) {
    for (const double length : {12.3, 37.52, 777.7}) {
      const std::string pulse = fmt::format("{}*(t > {})*(t < {})", power, begin, begin + length);
      const bool seen = length > 3600.0 / 64;
      if (seen) off(Function::from_expression(with_place(pulse), unit, ValueRule{}), length);
      const double ramp = 0.002;
      off(Function::from_table(
              LinearTable({0, begin - ramp, begin, begin + length - ramp, begin + length, 3600}, {0, 0, power, power, 0, 0}),
              ValueRule{}),
          length);
    }
  }
  off(Function::from_expression(with_place(fmt::format("{}*(sin(2*pi*t/90) > 0)", power)), unit, ValueRule{}), 1800);
}

// Steps end at jumps that are known, so that nothing is missed.
// A front heats a strip that all but does not conduct, so that each node's temperature has a closed form: it rises from when
// the front comes to it, which most nodes do between the places that are looked at.
TEST(ChangingDrives, TheErrorOfAFrontThatMovesOverManyNodesIsEstimatedAndBounded) {
  const auto unit = std::get<UnitConverter>(unit_converter("W/m3", quantity::power_density));
  const auto mesh = slab_mesh<2>({bar<2>(1, 60, 1, 0.02)});
  auto materials = rock_only();
  Material& rock = materials[MaterialId{0}];
  rock.conductivity = Conductivity(1e-9);
  const double rate = 1e6 / (*rock.density * (*rock.specific_heat)(300));  // [K/s]
  for (const Integrator integrator : integrators) {
    HeatOptions options = options_for(mesh, 300);
    options.sources.push_back(
        {test::on(BodyId{0}, std::nullopt), Function::from_expression("1e6*(x < 0.001*t)", unit, ValueRule{}), "front", {}});
    TimeOptions time = an_hour(integrator);
    time.until = 1000;
    time.output_every = 50;
    time.tolerance = 0.3;
    HeatRun run(make_heat_model(mesh, materials, contact::ContactSet<2>{}, options), time);
    for (double t = 50; t <= 1000; t += 50) {
      run.advance_to(t);
      double error = 0;
      for (const NodeId node : mesh.nodes.ids()) {
        const double exact = 300 + rate * std::max(0.0, t - mesh.nodes[node].x() / 0.001);
        error = std::max(error, std::abs(run.state().temperature[node.value()] - exact));
      }
      EXPECT_LE(error, 1.6 * run.state().time_error) << t;  // when it jumps is looked for at sixteenths of a step
      EXPECT_LE(error, time.tolerance) << t;
    }
    EXPECT_LE(run.state().time_error, time.tolerance);
  }
}

TEST(ChangingDrives, HeatThatComesAndGoesAtOnceIsSummedToRounding) {
  const auto unit = std::get<UnitConverter>(unit_converter("W/m3", quantity::power_density));
  const double power = 1e6;
  for (const Integrator integrator : integrators) {
    const auto expect_exact = [&](const std::string& formula, double seconds) {
      const HeatState state = after_an_hour_of(Function::from_expression(formula, unit, ValueRule{}), integrator);
      EXPECT_LT(error_of(state, warming_by(power), seconds), 1e-9) << formula;
      EXPECT_LT(state.time_error, 1e-9) << formula;
      EXPECT_LT(state.ledger.relative_residual(), 1e-12) << formula;
    };
    for (const double begin : {10.03, 333.77, 1799.0, 2718.28}) {
      for (const double length : {12.3, 37.52, 777.7}) {
        expect_exact(fmt::format("{}*(t > {})*(t <= {})", power, begin, begin + length), length);
      }
    }
    expect_exact(fmt::format("{}*(sin(2*pi*t/90) > 0)", power), 1800);
    expect_exact(fmt::format("t < 1234.5 ? {0} : (t < 2345.6 ? -{0} : 0)", power), 1234.5 - 1111.1);
  }
}

TEST(ChangingDrives, TheErrorOfSurroundingsThatJumpWithinStepsIsEstimatedAndBounded) {
  const auto unit = std::get<UnitConverter>(unit_converter("K", quantity::temperature));
  const auto mesh = slab_mesh<2>({bar<2>(0.01, 1, 1, 0.01)});
  Table<MaterialId, Material> materials = rock_only();
  materials[MaterialId{0}].conductivity = 1e5;
  const auto expect_bounded = [&](const std::string& temperature, double begin) {
    HeatOptions options = options_for(mesh, 300);
    Boundary air;
    air.name = "air";
    air.region = test::on(BodyId{0}, std::nullopt);
    air.condition = Convection{0.5, Function::from_expression(temperature, unit, ValueRule{})};
    options.boundaries.push_back(air);
    const HeatModel model = make_heat_model(mesh, materials, contact::ContactSet<2>{}, options);
    const double rate = 0.5 * 0.04 / model.capacity.sum();  // of the whole, which is of one temperature
    for (const Integrator integrator : integrators) {
      HeatRun run(model, an_hour(integrator));
      double largest = 0;
      run.advance_to(3600, [&](double time) {
        const double exact = time < begin ? 300 : 500 - 200 * std::exp(-rate * (time - begin));
        largest = std::max(largest, std::abs(run.state().temperature.mean() - exact));
      });
      EXPECT_LT(largest, 0.1) << temperature;
      EXPECT_LE(largest, 1.1 * run.state().time_error) << temperature;
    }
  };
  for (const double begin : {10.03, 333.77, 1799.0, 2718.28}) {
    const std::string jump = fmt::format("300 + 200*(t > {})", begin);
    expect_bounded(jump, begin);
    expect_bounded(with_place(jump), begin);
  }
}

// A swing of which steps are a third is no parabola in them. What an insulated body has taken up is known in closed form.
TEST(ChangingDrives, AnInsulatedBodyIsWithinItsTimeErrorWhateverSwingsHeatIt) {
  const auto unit = std::get<UnitConverter>(unit_converter("W/m3", quantity::power_density));
  const auto mesh = slab_mesh<2>({bar<2>(1, 2, 1, 1)});
  const Material rock = test::rock();
  const double heat_capacity = rock.density.value() * rock.specific_heat.value()(300);  // [J/m3/K]
  for (const double period : {35.0, 60.0, 90.0, 150.0, 240.0, 400.0, 700.0}) {
    const double frequency = 2 * std::numbers::pi / period, swing = 1.0;  // [rad/s], of the temperature [K]
    const double power = swing * frequency * heat_capacity;
    HeatOptions options = options_for(mesh, 300);
    const std::string formula = fmt::format("{:.17g}*sin({:.17g}*t + 1)", power, frequency);
    options.sources.push_back({test::on(BodyId{0}, std::nullopt), Function::from_expression(formula, unit, {}), "swing", {}});
    const HeatModel model = make_heat_model(mesh, rock_only(), contact::ContactSet<2>{}, options);
    for (const Integrator integrator : integrators) {
      HeatRun run(model, an_hour(integrator));
      double largest = 0;
      run.advance_to(3600, [&](double time) {
        const double exact = 300 + swing * (std::cos(1.0) - std::cos(frequency * time + 1));
        largest = std::max(largest, std::abs(run.state().temperature.mean() - exact));
      });
      EXPECT_TRUE(run.within_tolerance()) << formula;
      EXPECT_LE(largest, run.state().time_error) << formula;
    }
  }
}

// A swing puts it off to and fro. Steps whose error takes off what others added need no room: before, the room went with the
// first swings, and 1,200 steps were needed where a quarter of them will do.
TEST(ChangingDrives, AnErrorThatSwingsBackTakesNoRoomFromTheStepsOfAnInsulatedBody) {
  const auto unit = std::get<UnitConverter>(unit_converter("W/m3", quantity::power_density));
  const auto mesh = slab_mesh<2>({bar<2>(0.2, 20, 1, 0.01)});
  HeatOptions options = options_for(mesh, 300);
  options.sources.push_back(
      {test::on(BodyId{0}, std::nullopt), Function::from_expression("2e4*(1 + sin(2*pi*t/3600))", unit, {}), "swing", {}});
  const HeatModel model = make_heat_model(mesh, rock_only(), contact::ContactSet<2>{}, options);
  for (const Integrator integrator : integrators) {
    TimeOptions time = an_hour(integrator);
    time.until = 36000;
    time.output_every = 1800;
    time.tolerance = 0.05;
    HeatRun run(model, time);
    run.advance_to(time.until);
    EXPECT_TRUE(run.within_tolerance());
    EXPECT_LT(run.state().steps, 400);
    const double heat = 2e4 * time.until;  // of ten whole swings [J/m3]
    const double exact = 300 + heat / (test::rock().density.value() * test::rock().specific_heat.value()(300));
    EXPECT_LE((run.state().temperature.array() - exact).abs().maxCoeff(), run.state().time_error);
  }
}

// What its steps are off by stays; as c rises from 200 to 400 K and falls to 500 K it even grows.
TEST(ChangingDrives, AnInsulatedBodyKeepsItsToleranceHoweverLongItIsHeated) {
  const auto unit = std::get<UnitConverter>(unit_converter("W/m3", quantity::power_density));
  const auto mesh = slab_mesh<2>({bar<2>(0.1, 4, 1, 0.05)});
  Table<MaterialId, Material> materials = rock_only();
  materials[MaterialId{0}].specific_heat = Curve::from_table(LinearTable({200, 400, 500}, {600, 1000, 700}));
  for (const std::string formula : {"2e4*(1 + sin(t/700))", "2e4*(1 + sin(t/700))*(1 + 5*x)"}) {
    HeatOptions options = options_for(mesh, 300);
    options.sources.push_back({test::on(BodyId{0}, std::nullopt), Function::from_expression(formula, unit, {}), "source", {}});
    const HeatModel model = make_heat_model(mesh, materials, contact::ContactSet<2>{}, options);
    const auto after_ten_hours = [&](Integrator integrator, double tolerance) {
      TimeOptions time = an_hour(integrator);
      time.until = 36000;
      time.output_every = 1800;
      time.tolerance = tolerance;
      HeatRun run(model, time);
      run.advance_to(time.until);
      return run.state();
    };
    const HeatState exact = after_ten_hours(Integrator::implicit, 1e-3);
    for (const Integrator integrator : integrators) {
      const HeatState state = after_ten_hours(integrator, 0.02);
      EXPECT_LE(state.time_error, 0.02) << formula;
      EXPECT_LE((state.temperature - exact.temperature).lpNorm<Eigen::Infinity>(), state.time_error + exact.time_error)
          << formula;
      EXPECT_LT(state.steps, 3000) << formula;
    }
  }
}

// One of two bars is held where they touch, from 300 K on.
HeatModel held_pair(const std::string& held, double beta, const Curve& specific_heat = 800.0) {
  const auto unit = std::get<UnitConverter>(unit_converter("K", quantity::temperature));
  auto right = bar<2>(0.2, 4, 1, 0.05);
  right.low[0] = 0.2;
  const auto mesh = slab_mesh<2>({bar<2>(0.2, 4, 1, 0.05), right});
  HeatOptions options = options_for(mesh, 300);
  options.joint.law = StiffnessFactor{beta};
  Boundary end = test::hold(BodyId{0}, 0.2, 0, "end");
  end.condition = FixedTemperature{Function::from_expression(held, unit, ValueRule{})};
  options.boundaries.push_back(end);
  Table<MaterialId, Material> materials = rock_only();
  materials[MaterialId{0}].specific_heat = specific_heat;
  return make_heat_model(mesh, materials, test::matching_contacts(mesh), options);
}

// Beside a run with a hundredth of the tolerance.
void expect_estimated(const std::string& held, double beta, Integrator integrator) {
  const HeatModel model = held_pair(held, beta);
  const auto after_an_hour = [&](Integrator by, double tolerance) {
    TimeOptions time = an_hour(by);
    time.tolerance = tolerance;
    HeatRun run(model, time);
    run.advance_to(3600);
    return run.state();
  };
  const HeatState exact = after_an_hour(Integrator::implicit, 1e-3);
  const HeatState state = after_an_hour(integrator, 0.1);
  EXPECT_LE((state.temperature - exact.temperature).lpNorm<Eigen::Infinity>(), state.time_error + exact.time_error)
      << held << ", beta " << beta;
  EXPECT_LT(state.time_error, 0.1) << held << ", beta " << beta;
  EXPECT_LT(state.steps, 150) << held << ", beta " << beta;
}

TEST(ChangingDrives, TheErrorOfHeldTemperaturesThatJumpOrBendWithinStepsIsEstimatedAndBounded) {
  for (const double begin : {10.03, 333.77, 1001.1, 2222.2, 2718.28, 3300.5}) {
    for (const std::string& held :
         {fmt::format("300 + 50*(t > {})", begin), fmt::format("300 + (t > {0} ? 0.02*(t - {0}) : 0)", begin)}) {
      for (const std::string& formula : {held, with_place(held)}) {
        for (const double beta : {0.1, 1e3, 1e9}) expect_estimated(formula, beta, Integrator::implicit);
        for (const double beta : {0.1, 1e3}) expect_estimated(formula, beta, Integrator::stabilised_explicit);
      }
    }
  }
}

// At an output, whichever side of it the formula counts it to.
TEST(ChangingDrives, WhatFollowsAJumpAtAnOutputIsWhatFollowsASuddenStart) {
  for (const Integrator integrator : integrators) {
    for (const Curve& specific_heat : {Curve(800.0), Curve::from_table(LinearTable({200, 500}, {700, 1000}))}) {
      const auto state_after = [&](const std::string& held, double until) {
        TimeOptions time = an_hour(integrator);
        time.output_every = 600;
        HeatRun run(held_pair(held, 10, specific_heat), time);
        run.advance_to(until);
        EXPECT_LT(run.state().ledger.relative_residual(), 1e-12) << held;
        return run.state();
      };
      const HeatState start = state_after("350", 1800);
      const double given = start.ledger.start_jump + start.ledger.by_boundary[0];
      for (const std::string held : {"t < 1800 ? 300 : 350", "t <= 1800 ? 300 : 350"}) {
        const HeatState state = state_after(held, 3600);
        EXPECT_LT((state.temperature - start.temperature).lpNorm<Eigen::Infinity>(), 1e-9) << held;
        EXPECT_NEAR(state.ledger.by_boundary[0] / given, 1, 1e-9) << held;
        EXPECT_EQ(state.steps, start.steps + 3) << held << ": one for each interval before";
      }
    }
  }
}

TEST(ChangingDrives, ARunGoesOnFromAJumpToTheBit) {
  for (const std::string held : {"t < 1200 ? 300 : 350", "t <= 1200 ? 300 : 350", "t < 1300 ? 300 : 350"}) {
    TimeOptions time = an_hour(Integrator::implicit);
    time.output_every = 600;
    test::expect_resumed_to_the_bit(held_pair(held, 10), time, 1200, held);
  }
}

}  // namespace
}  // namespace scree::thermal
