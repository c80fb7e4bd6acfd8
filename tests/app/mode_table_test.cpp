/// What is no table of frequencies.

#include "app/run/mode_table.h"

#include <gtest/gtest.h>

namespace pseudorigid::app {
namespace {

ModeFrequency frequency(double least, double largest) {
  return {0.5 * (least + largest), least, largest, false, 3, 0, 7};
}
bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(ModeTable, CopiesThatDifferAreNamed) {
  EXPECT_EQ(differing_copies({frequency(1, 1.009)}), "");
  EXPECT_TRUE(contains(differing_copies({frequency(1, 1), frequency(0.144, 0.2)}), "T3"));
  EXPECT_EQ(differing_copies({frequency(1, 1.05)}, 0.1), "");
}

TEST(ModeTable, AnUnstableMotionIsNamedWithItsRate) {
  const io::Units units{.time = 2};
  EXPECT_EQ(instability({frequency(1, 2)}, units), "");
  EXPECT_EQ(instability({}, units), "");
  const std::string text = instability({frequency(-0.5, -0.5), frequency(1, 1)}, units);
  EXPECT_TRUE(contains(text, "T3")) << text;
  EXPECT_TRUE(contains(text, "0.25")) << text;
}

}  // namespace
}  // namespace pseudorigid::app
