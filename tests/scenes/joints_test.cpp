// The scenes about joints: scenes/ring, scenes/four_blocks, and scenes/bars_and_joint with other laws.

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/scene_run.h"

namespace scree::test {
namespace {

constexpr double celsius = 273.15;
const std::vector<std::string> perfect{"contact.stiffness_factor=null", "contact.perfect=true"};

SceneRun sound_run(const std::string& scene, const std::string& directory, const std::vector<std::string>& overrides = {}) {
  SceneRun made = test::run(scene, fresh_directory(directory), overrides);
  EXPECT_EQ(made.exit_status, 0) << made.summary.dump(2);
  EXPECT_LT(made.summary["heat"]["ledger_residual"], 1e-8);
  return made;
}

TEST(RingOfTriangles, HeatsAsTheSolidRingAtAnyTime) {
  const auto whole = sound_run("ring", "ring_whole", {"bodies.ring.blocks=whole"}).probes().at("middle");
  const SceneRun jointed = sound_run("ring", "ring_100");
  EXPECT_EQ(jointed.summary["blocks"], 960);
  EXPECT_EQ(jointed.summary["contacts"]["semi_springs"], 5760);
  const auto stiff = jointed.probes().at("middle");
  const SceneRun one_mesh = sound_run("ring", "ring_perfect", perfect);
  EXPECT_EQ(one_mesh.summary["heat"]["tied_nodes"], 2880 - 540);
  const auto tied = one_mesh.probes().at("middle");
  ASSERT_EQ(whole.size(), stiff.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_NEAR(stiff[i], whole[i], 0.2) << i;
    EXPECT_NEAR(tied[i], whole[i], 1e-6) << i;
  }
  const double exact = 100 * std::log(5 / 3.97) / std::log(2.5);
  EXPECT_NEAR(stiff.back() - celsius, exact, 0.3);
}

TEST(FourBlocks, AgreeWhateverTheModelOfTheirJoints) {
  const auto springs = sound_run("four_blocks", "four_springs").probes();
  const SceneRun run = sound_run("four_blocks", "four_overlap", {"contact.model=overlap"});
  const auto overlaps = run.probes();
  for (const char* probe : {"in_A", "in_B", "in_C", "in_D"}) {
    EXPECT_NEAR(springs.at(probe).back(), overlaps.at(probe).back(), 1.0) << probe;
    EXPECT_GT(springs.at(probe).back(), celsius + 5) << probe;
  }
  for (const auto& joint : run.summary["joints"]) {
    EXPECT_NEAR(joint["overlap_area"], 1, 1e-12) << joint.dump();
    EXPECT_NEAR(joint["touching_area"], 1, 1e-12) << joint.dump();
  }
}

// Two slabs and a joint of 50 W/m2/K: 100 K over 2 x 0.2 m / 3.1 W/m/K + 1/h, through 0.05 m x 0.05 m.
TEST(BarsOfAConductance, CarryTheClosedForm) {
  const std::vector<std::string> conductance{"contact.stiffness_factor=null", "contact.conductance=50"};
  const SceneRun run = sound_run("bars_and_joint", "bars_conductance", conductance);
  const double expected = 100 / (0.4 / 3.1 + 1 / 50.0) * 0.0025;
  const auto& joint = run.summary["joints"][0];
  EXPECT_EQ(joint["law"], "conductance");
  EXPECT_NEAR(joint["joint_conductance"], 50, 1e-9);
  EXPECT_NEAR(joint["flow"].get<double>() / expected, 1, 2e-3);
}

TEST(BarsOfAConductance, RefuseAJointThatCarriesNothing) {
  const auto refused = [](const std::string& name, const std::string& joints) {
    return refusal("bars_and_joint", fresh_directory(name), {"contact.joints=" + joints});
  };
  const std::string within = refused("bars_within", "[{bodies: [left, left], conductance: 5}]");
  EXPECT_NE(within.find("contact.joints[0]"), std::string::npos) << within;
  const std::string overruled =
      refused("bars_overruled", "[{bodies: [left, right], conductance: 5}, {materials: [rock, rock], insulating: true}]");
  EXPECT_NE(overruled.find("contact.joints[0]"), std::string::npos) << overruled;
  EXPECT_EQ(refused("bars_kept", "[{materials: [rock, rock], insulating: true}]"), "accepted");
}

TEST(ASingleBlock, RefusesAJointTooForItHasNone) {
  const std::string refused =
      refusal("slab", fresh_directory("slab_joint"), {"contact={joints: [{bodies: [bar, bar], insulating: true}]}"});
  EXPECT_NE(refused.find("contact.joints[0]"), std::string::npos) << refused;
}

TEST(JointedCubes, ConductAsTheClosedFormSays) {
  const SceneRun run = test::run("jointed_cubes", fresh_directory("jointed_cubes"));
  ASSERT_EQ(run.exit_status, 0);
  const auto& found = run.summary["effective_conductivity"];
  const double expected = 3 / (1 + 3 / (60 * 0.1));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(found["along"][axis].get<double>(), expected, 1e-9 * expected);
    EXPECT_GT(found["upper"][axis][axis], found["along"][axis]);
  }
  EXPECT_NEAR(found["solid_fraction"].get<double>(), 1, 1e-9);
  EXPECT_FALSE(run.summary["heat"].contains("covered_boundaries"));
  EXPECT_FALSE(run.summary.contains("remarks"));
}

// A window is asked what the pile is, whatever is done to it; of unlike meshes perfect joints go by what drives them.
TEST(PerfectJoints, ConductEffectivelyTheSameWhateverIsHeated) {
  const auto along = [](const std::string& name, const std::string& boundaries) {
    const SceneRun run = sound_run("bars_and_joint", name,
                                   {"contact={perfect: true}", "bodies.right.mesh_size=0.0125",
                                    "materials.steel={density: 7800, conductivity: 310, specific_heat: 480}",
                                    "bodies.right.material=steel", "output.probes=null", "heat.until=1 h", boundaries,
                                    "heat.effective_conductivity={low: [-0.2, -0.025, -0.025], high: [0.2, 0.025, 0.025]}"});
    return run.summary["effective_conductivity"];
  };
  const auto nothing = along("effective_untouched", "heat.boundaries=[]");
  EXPECT_EQ(along("effective_held", "heat.boundaries=[{body: right, temperature: 350}]"), nothing);
  EXPECT_EQ(along("effective_heated", "heat.boundaries=[{body: left, flux: 100}]"), nothing);
}

TEST(Joints, RefuseWhatNoneOfThemUses) {
  const auto refused = [](const std::string& contact) {
    return refusal("bars_and_joint", fresh_directory("joints_unused"), {"contact=" + contact, "heat.until=1 min"});
  };
  EXPECT_NE(refused("{conductance: 50, indentation: 0.3}").find("contact.indentation is 0.3 (is of semi-springs"),
            std::string::npos);
  EXPECT_NE(refused("{insulating: true, model: overlap}").find("contact.model is overlap (is of joints that conduct"),
            std::string::npos);
  EXPECT_NE(refused("{joints: [{bodies: [left, right], insulating: true, model: overlap}]}").find("contact.joints[0].model"),
            std::string::npos);
  EXPECT_EQ(refused("{conductance: 50, model: semi_spring, indentation: 0.3}"), "accepted");
}

TEST(Joints, OfAConductanceAskNothingOfAFormulaWithoutAValueAtTwentyDegrees) {
  const std::vector<std::string> hot{
      "materials.rock={density: 2700, specific_heat: 800, conductivity: {expression: "
      "\"2 + sqrt((T - 350)/100)\", unit: W/(m K)}}",
      "contact={conductance: 60}",
      "heat.initial=400",
      "heat.boundaries=[{body: left, temperature: 450}]",
      "output.probes=null",
      "heat.until=1 h"};
  const SceneRun run = sound_run("bars_and_joint", "hot_joint", hot);
  EXPECT_TRUE(run.summary["joints"][0]["biot"].is_null());
  EXPECT_GT(run.summary["joints"][0]["joint_conductance"], 0);
  auto by_factor = hot;
  by_factor.emplace_back("contact={stiffness_factor: 10}");
  EXPECT_NE(refusal("bars_and_joint", fresh_directory("hot_joint_by_factor"), by_factor).find("at 293.15 K"),
            std::string::npos);
}

TEST(Joints, RefuseAToleranceByWhichOnlyRoundingFindsContacts) {
  const std::string refused = refusal("bars_and_joint", fresh_directory("no_tolerance"), {"contact.tolerance=0"});
  EXPECT_NE(refused.find("contact.tolerance is 0 (must be above 0"), std::string::npos) << refused;
}

// A gap of a quarter of a millimetre between meshes of 50 and 12.5 mm: the coarse side reaches over 1 % of its elements, the
// fine one does not.
TEST(BarsOfUnlikeMeshes, AreToldThatTheirJointConductsHalfAndWithWhichToleranceItConductsAll) {
  const std::vector<std::string> apart{"contact={model: semi_spring, conductance: 50}",
                                       "bodies.left.mesh_size=0.05",
                                       "bodies.right.mesh_size=0.0125",
                                       "bodies.right.box.centre=[0.10025, 0, 0]",
                                       "output.probes=null",
                                       "heat.boundaries.1.within={low: [0.20025, -1, -1], high: [0.20025, 1, 1]}"};
  const SceneRun half = sound_run("bars_and_joint", "bars_apart", apart);
  const auto& told = half.summary["contacts"]["one_sided"];
  EXPECT_EQ(told["count"], half.summary["contacts"]["point_face"]);
  EXPECT_NEAR(half.summary["joints"][0]["touching_area"], 0.00125, 1e-9);
  auto wider = apart;
  wider.push_back(fmt::format("contact.tolerance={}", 1.2 * told["tolerance"].get<double>()));
  const SceneRun all = sound_run("bars_and_joint", "bars_reached", wider);
  EXPECT_FALSE(all.summary["contacts"].contains("one_sided"));
  EXPECT_NEAR(all.summary["joints"][0]["touching_area"], 0.0025, 1e-9);
}

// What they share is heated twice, and blocks are joined by what lies on their surfaces only.
TEST(BarsAndJoint, ThatLieInEachOtherAreNamedAsWellAsThatTheyDoNotTouch) {
  const SceneRun run =
      sound_run("bars_and_joint", "bars_in_each_other",
                {"bodies.right.box.centre=[0.09, 0, 0]", "heat.boundaries=[]", "heat.until=1 min", "output.probes=null"});
  EXPECT_THAT(run.summary["remarks"].get<std::vector<std::string>>(),
              testing::ElementsAre("suspicious: block 0 of body left and block 1 of body right overlap by 0.01 m before "
                                   "anything moves",
                                   "contacts: no two blocks touch: no heat passes between any of them"));
}

TEST(BarsAndJoint, HaveTwoFramesWhereTheNextWouldComeAfterTheEnd) {
  const SceneRun run = sound_run("bars_and_joint", "bars_of_two_frames", {"heat.until=3 h", "output.frames_every=1e19 h"});
  EXPECT_EQ(test::listed_frames(run.directory / "heat.pvd").size(), 2u);
}

// What passes from node to node is so much more than what flows that rounding alone unbalances it.
TEST(BarsAndJoint, OfNextToPerfectConductorsSayWhatRoundingHidesOfTheirLedger) {
  const SceneRun run = test::run("bars_and_joint", fresh_directory("bars_of_perfect_conductors"),
                                 {"materials.rock.conductivity=1e30", "heat.until=1 h",
                                  "heat.boundaries=[{body: left, surface: x_low, temperature: 100 degC}, {body: right, "
                                  "surface: x_high, convection: {coefficient: 5, surroundings: 290}}]"});
  ASSERT_EQ(run.exit_status, 0);
  EXPECT_GT(run.summary["heat"]["ledger_residual"].get<double>(), 1e-8);
  EXPECT_THAT(run.summary["remarks"].get<std::vector<std::string>>(),
              testing::ElementsAre(testing::HasSubstr("is missing from the ledger by rounding")));
}

TEST(JointedCubes, AreToldFromAWindowThatReachesBeyondThem) {
  const SceneRun run = sound_run("jointed_cubes", "window_beyond_cubes",
                                 {"heat.effective_conductivity={low: [-1, 0, 0], high: [0.4, 0.4, 0.4]}"});
  EXPECT_THAT(run.summary["remarks"].get<std::vector<std::string>>(),
              testing::Contains(testing::HasSubstr("the box of heat.effective_conductivity goes from -1 to 0.4 m along x")));
}

// 64 cubes with sides of 0.01 m2, 144 joints of which cover a side of each of two cubes.
TEST(JointedCubes, AreToldFromCubesInTheOpenWhereAllTheirFacesAreCooled) {
  const SceneRun run = test::run("jointed_cubes", fresh_directory("cooled_cubes"),
                                 {"heat.boundaries=[{body: cubes, convection: {coefficient: 5, surroundings: 300}, name: air}]",
                                  "heat.effective_conductivity=null"});
  ASSERT_EQ(run.exit_status, 0);
  const auto& covered = run.summary["heat"]["covered_boundaries"];
  ASSERT_EQ(covered.size(), 1u);
  EXPECT_EQ(covered[0]["name"], "air");
  EXPECT_NEAR(covered[0]["area"], 3.84, 1e-12);
  EXPECT_NEAR(covered[0]["covered_area"], 2.88, 1e-12);
  ASSERT_EQ(run.summary["remarks"].size(), 1u);
  EXPECT_THAT(run.summary["remarks"][0].get<std::string>(), testing::HasSubstr("air acts on 3.84 m2, of which 2.88 m2 lie"));
}

}  // namespace
}  // namespace scree::test
