/// Units of entries and columns: words that are checked where they are compiled.

#include "entries/unit.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace pseudorigid::scene {
namespace {

using Factors = std::vector<std::pair<std::string, int>>;

Factors factors(Unit unit) {
  Factors factors;
  unit.visit([&](std::string_view word, int power) { factors.emplace_back(word, power); });
  return factors;
}

TEST(Unit, HasFactorsWithPowers) {
  EXPECT_EQ(factors("mass*length^2/time"), (Factors{{"mass", 1}, {"length", 2}, {"time", -1}}));
  EXPECT_EQ(factors("length^3/mass/time^2"), (Factors{{"length", 3}, {"mass", -1}, {"time", -2}}));
  EXPECT_EQ(factors("1/time"), (Factors{{"1", 1}, {"time", -1}}));
  EXPECT_TRUE(factors("").empty());
}

/// The constructor of a Unit asks this when the program is compiled.
TEST(Unit, MisspeltWordsAreNone) {
  static_assert(Unit::is_unit("pressure*time") && Unit::is_unit(""));
  for (const char* words : {"lenght", "length/tiem", "Length", "length ", "length^x", "length^", "length^0",
                            "length^-2", "mass**length", "radians", "mass*(length)"})
    EXPECT_FALSE(Unit::is_unit(words)) << words;
}

}  // namespace
}  // namespace pseudorigid::scene
