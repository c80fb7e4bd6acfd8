/// What belongs together: copies of a mode, and critical points by Morse's count.

#include "mechanics/equilibria/mode_groups.h"

#include <gtest/gtest.h>

#include "mechanics/equilibria/morse_count.h"

namespace pseudorigid::testing {
namespace {

using mechanics::ModeGroup;

TEST(ModeGroups, AreTheCopiesOfOneKindAndDegree) {
  // T1 twice, an S1 among its copies, one copy of S0, and an incomplete T1.
  const auto groups = mechanics::group_modes(
      {{9, false, 1, 3}, {4, false, 1}, {4.41, false, 1, 2}, {4, true, 1, 3}, {1, true, 0}, {16, false, 1}});
  ASSERT_EQ(groups.size(), 5u);
  EXPECT_TRUE(groups[0].spheroidal);
  EXPECT_EQ(groups[0].degree, 0);
  EXPECT_TRUE(groups[0].complete());
  const auto T1 = [&](int overtone) {
    for (const ModeGroup& group : groups)
      if (!group.spheroidal && group.overtone == overtone) return group;
    return ModeGroup{};
  };
  EXPECT_NEAR(T1(0).omega, (2 + 2.1 + 2.1) / 3, 1e-15);
  EXPECT_EQ(T1(0).modes, (std::vector<std::size_t>{1, 2, 2}));
  EXPECT_EQ(T1(1).least, 3);
  EXPECT_EQ(T1(1).largest, 3);
  EXPECT_FALSE(T1(2).complete());
}

TEST(ModeGroups, OfUnstableMotionsHaveNegativeFrequencies) {
  const auto groups = mechanics::group_modes({{-4, true, 0}, {9, true, 0}});
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].omega, -2);
  EXPECT_EQ(groups[1].overtone, 1);
}

/// On the sphere, Betti numbers 1, 0, 1: a height has two points, and one with a dent has a saddle more.
TEST(MorseCount, OfHeightsOnTheSphere) {
  constexpr int sphere[] = {1, 0, 1};
  EXPECT_TRUE(mechanics::obeys_morse({0, 2}, 2, sphere));
  EXPECT_TRUE(mechanics::obeys_morse({0, 2, 1, 2}, 2, sphere));
  EXPECT_FALSE(mechanics::obeys_morse({0}, 2, sphere));
  EXPECT_FALSE(mechanics::obeys_morse({0, 2, 2}, 2, sphere)) << "a saddle between the two summits";
  EXPECT_FALSE(mechanics::obeys_morse({0, 1}, 2, sphere)) << "no summit";
  EXPECT_FALSE(mechanics::obeys_morse({1, 2}, 2, sphere)) << "the sum with signs is that of nothing missing";
}

/// On SO(3), which SL(3) retracts to.
TEST(MorseCount, OfRotations) {
  constexpr int rotations[] = {1, 1, 1, 1};
  EXPECT_TRUE(mechanics::obeys_morse({3, 1, 0, 2}, 8, rotations));
  EXPECT_TRUE(mechanics::obeys_morse({0, 1, 2, 3, 0, 1, 5, 6}, 8, rotations));
  EXPECT_FALSE(mechanics::obeys_morse({0, 1, 3}, 8, rotations));
  EXPECT_FALSE(mechanics::obeys_morse({}, 8, rotations));
}

}  // namespace
}  // namespace pseudorigid::testing
