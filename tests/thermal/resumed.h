// A run that goes on from a file.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "tests/temp_folder.h"
#include "thermal/heat_run.h"

namespace scree::thermal::test {

// From its state `at` a time, to the end.
inline void expect_resumed_to_the_bit(const HeatModel& model, const TimeOptions& time, double at, const std::string& name) {
  const auto file = scree::test::temp_folder() / "resumed.h5";
  HeatRun whole(model, time);
  whole.advance_to(at);
  write(whole.state(), "key", file);
  whole.advance_to(time.until);
  HeatRun resumed(model, time, read_state(file, "key"));
  resumed.advance_to(time.until);
  EXPECT_EQ(resumed.state().temperature, whole.state().temperature) << name;
  EXPECT_EQ(resumed.state().error, whole.state().error) << name;
  EXPECT_EQ(resumed.state().ledger.residual(), whole.state().ledger.residual()) << name;
  EXPECT_EQ(resumed.state().steps, whole.state().steps) << name;
}

}  // namespace scree::thermal::test
