#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "tests/temp_folder.h"
#include "thermal/heat_run.h"

namespace scree::thermal {
namespace {

HeatState some_state() {
  HeatState state;
  state.time = 0.1 * 3;
  state.temperature = Eigen::VectorXd::LinSpaced(101, 273.15, 373.15).array().sin();
  state.error = -state.temperature / 3;
  state.next_step = 1.0 / 3;
  state.ledger = {1.0 / 7, {2.0 / 7, -3.0 / 7}, {}, {6.0 / 7}, 4.0 / 7, 5.0 / 7};
  state.reached = {1.0 / 11, 2.0 / 11};
  state.given = {3.0 / 11, 4.0 / 11};
  state.lumping = {state.temperature / 5, 1.0 / 13};
  state.matrix = {state.temperature / 7, 1.0 / 17, 2.0 / 17};
  state.time_error = 1e-17;
  state.steps = 12;
  state.rejected_steps = 3;
  state.factorisations = 4;
  state.least_step = 1e-300;
  state.largest_step = 600;
  return state;
}

TEST(HeatStateFile, GivesBackEveryBit) {
  const auto file = scree::test::temp_folder() / "state.h5";
  const HeatState state = some_state();
  write(state, "this scene", file);
  const HeatState read = read_state(file, "this scene");
  EXPECT_EQ(read.time, state.time);
  EXPECT_EQ(read.temperature, state.temperature);
  EXPECT_EQ(read.error, state.error);
  EXPECT_EQ(read.next_step, state.next_step);
  EXPECT_EQ(read.ledger.start_jump, state.ledger.start_jump);
  EXPECT_EQ(read.ledger.by_boundary, state.ledger.by_boundary);
  EXPECT_EQ(read.ledger.by_applied, state.ledger.by_applied);
  EXPECT_EQ(read.ledger.by_surroundings, state.ledger.by_surroundings);
  EXPECT_EQ(read.ledger.stored, state.ledger.stored);
  EXPECT_EQ(read.ledger.turnover, state.ledger.turnover);
  EXPECT_EQ(read.time_error, state.time_error);
  EXPECT_EQ(read.reached.least, state.reached.least);
  EXPECT_EQ(read.reached.largest, state.reached.largest);
  EXPECT_EQ(read.given.least, state.given.least);
  EXPECT_EQ(read.given.largest, state.given.largest);
  EXPECT_EQ(read.lumping.carried, state.lumping.carried);
  EXPECT_EQ(read.lumping.largest, state.lumping.largest);
  EXPECT_EQ(read.matrix.temperature, state.matrix.temperature);
  EXPECT_EQ(read.matrix.time, state.matrix.time);
  EXPECT_EQ(read.matrix.scale, state.matrix.scale);
  EXPECT_EQ(read.steps, state.steps);
  EXPECT_EQ(read.rejected_steps, state.rejected_steps);
  EXPECT_EQ(read.factorisations, state.factorisations);
  EXPECT_EQ(read.least_step, state.least_step);
  EXPECT_EQ(read.largest_step, state.largest_step);
}

TEST(HeatStateFile, AnotherKeyAMissingAndADamagedFileAreRefused) {
  const auto file = scree::test::temp_folder() / "state_damage.h5";
  write(some_state(), "this scene", file);
  EXPECT_THROW(read_state(file, "another scene"), InputError);
  EXPECT_THROW(read_state(scree::test::temp_folder() / "none.h5", "this scene"), InputError);
  const auto size = std::filesystem::file_size(file);
  std::string bytes(size, '\0');
  std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(size));
  const double first = some_state().temperature[0];
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&first), sizeof first));
  ASSERT_NE(at, std::string::npos);
  const auto damaged = scree::test::temp_folder() / "state_damaged.h5";
  const auto rewrite = [&](const std::string& content) {
    std::ofstream(damaged, std::ios::binary | std::ios::trunc)
        .write(content.data(), static_cast<std::streamsize>(content.size()));
  };
  std::string flipped = bytes;
  flipped[at] = static_cast<char>(flipped[at] ^ 1);
  rewrite(flipped);
  EXPECT_THROW(read_state(damaged, "this scene"), InputError);
  for (const std::size_t length : {std::size_t{0}, std::size_t{100}, bytes.size() / 2, bytes.size() - 8}) {
    rewrite(bytes.substr(0, length));
    EXPECT_THROW(read_state(damaged, "this scene"), InputError) << length;
  }
}

}  // namespace
}  // namespace scree::thermal
