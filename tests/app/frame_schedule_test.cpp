#include "app/run/frame_schedule.h"

#include <gtest/gtest.h>

namespace pseudorigid::app {
namespace {

TEST(FrameSchedule, SpreadsFramesFromTheFirstSampleToTheLast) {
  const FrameSchedule three(3, 10);
  EXPECT_EQ(three.sample(0), 0);
  EXPECT_EQ(three.sample(1), 5);
  EXPECT_EQ(three.sample(2), 10);
  EXPECT_TRUE(three.has(5));
  EXPECT_FALSE(three.has(4));
  EXPECT_EQ(three.n_before(6), 2);
  EXPECT_EQ(FrameSchedule(1, 10).sample(0), 10);
}

/// A loop over the frames before a sample would take 10¹⁸ steps here.
TEST(FrameSchedule, AsksNothingOfFramesOneByOne) {
  constexpr long n = 1'000'000'000;
  const FrameSchedule every(n + 1, n);
  for (const long k : {0L, 1L, n / 3, n - 1, n}) {
    EXPECT_TRUE(every.has(k)) << k;
    EXPECT_EQ(every.n_before(k), k);
  }
}

}  // namespace
}  // namespace pseudorigid::app
