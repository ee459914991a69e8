// Contacts that come and go, beside a list that is searched from its start.
#include "engine/rigid/held_contacts.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace scree::rigid {
namespace {

using Blocks = std::array<int, 2>;

std::vector<Blocks> blocks_of(const HeldContacts& contacts) {
  std::vector<Blocks> blocks;
  for (const HeldContact* contact : contacts.all()) blocks.push_back(contact->blocks);
  return blocks;
}

TEST(HeldContacts, StandInTheOrderInWhichTheyCameAndTheLastTakesThePlaceOfOneThatGoes) {
  std::mt19937 random(3);
  HeldContacts contacts;
  std::vector<Blocks> expected;
  for (int i = 0; i < 20000; ++i) {
    const bool add = expected.empty() || random() % 5 < (i < 10000 ? 3U : 2U);
    if (add) {
      expected.push_back({i, i + 1});
      EXPECT_EQ(contacts.add({i, i + 1}).place, static_cast<int>(expected.size()) - 1);
    } else {
      const std::size_t which = random() % expected.size();
      contacts.remove(*contacts.all()[which]);
      expected[which] = expected.back();
      expected.pop_back();
    }
    if (i % 500 == 0) {
      EXPECT_EQ(blocks_of(contacts), expected);
    }
  }
  EXPECT_EQ(blocks_of(contacts), expected);
}

TEST(HeldContacts, StayWhereTheyAreWhileOthersComeAndGo) {
  HeldContacts contacts;
  HeldContact& first = contacts.add({1, 2});
  first.count = 3;
  for (int i = 0; i < 5000; ++i) contacts.add({i, 7});
  EXPECT_EQ(contacts.all()[0], &first);
  EXPECT_EQ(first.count, 3);
}

TEST(HeldContacts, KnowNothingOfWhatWasInTheirMemory) {
  HeldContacts contacts;
  HeldContact& first = contacts.add({1, 2});
  first.count = 4;
  first.fresh = true;
  for (HeldPoint& point : first.points) point.impulses = {1, 2, 3};
  contacts.remove(first);
  const HeldContact& next = contacts.add({3, 4});
  EXPECT_EQ(next.count, 0);
  EXPECT_FALSE(next.fresh);
  EXPECT_EQ(next.points[3].impulses[2], 0);
}

}  // namespace
}  // namespace scree::rigid
