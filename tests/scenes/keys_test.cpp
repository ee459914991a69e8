// Which parts of a scene the result of each stage depends on.
#include "tools/run/keys.h"

#include <gtest/gtest.h>

#include "tests/scene/scene_text.h"

namespace scree {

namespace {

struct Keys {
  std::string fall;
  std::string heat;  // of one and the same packing
};

Keys keys_with(const std::vector<std::string>& overrides) {
  const Scene scene = test::scene_of(test::whole_scene, overrides);
  return {run::fall_key(scene), run::heat_key<3>(scene, packing::Packing<3>(), nullptr)};
}

TEST(Keys, OfTheSameSceneAreTheSame) {
  EXPECT_EQ(keys_with({}).fall, keys_with({}).fall);
  EXPECT_EQ(keys_with({}).heat, keys_with({}).heat);
}

TEST(Keys, TellApartWhatTheStageDependsOnAndNothingElse) {
  const Keys as_written = keys_with({});
  for (const auto& [change, falls_otherwise, heats_otherwise] : {std::tuple{"title=another", false, false},
                                                                 {"bodies.block.mesh_size=0.05", true, false},
                                                                 {"settle.iterations=90", true, false},
                                                                 {"materials.ore.friction=0.3", true, true},
                                                                 {"materials.ore.conductivity=3.2", false, true},
                                                                 {"contact.stiffness_factor=20", false, true},
                                                                 {"heat.tolerance=0.2 K", false, true},
                                                                 {"output.every=20 min", false, true}}) {
    const Keys changed = keys_with({change});
    EXPECT_EQ(changed.fall != as_written.fall, falls_otherwise) << change;
    EXPECT_EQ(changed.heat != as_written.heat, heats_otherwise) << change;
  }
}

}  // namespace

}  // namespace scree
