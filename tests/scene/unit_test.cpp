/// Units of entries and columns, and the words of choices: what is checked where it is compiled.

#include "entries/unit.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "entries/entry_kinds.h"

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

enum class Fruit { apple, pear, plum };

/// The constructor of a Choice asks this when the program is compiled: a table with room for a word too many has an
/// empty one.
TEST(Choice, WordsAreThereOnceAndForOneValue) {
  constexpr NameTable<Fruit, 2> sound{{{"apple", Fruit::apple}, {"pear", Fruit::pear}}};
  constexpr NameTable<Fruit, 3> too_large{{{"apple", Fruit::apple}, {"pear", Fruit::pear}}};
  constexpr NameTable<Fruit, 2> same_word{{{"apple", Fruit::apple}, {"apple", Fruit::pear}}};
  constexpr NameTable<Fruit, 2> same_value{{{"apple", Fruit::apple}, {"pear", Fruit::apple}}};
  static_assert(is_sound(sound) && !is_sound(too_large) && !is_sound(same_word) && !is_sound(same_value));
}

TEST(Choice, CountsItsWords) {
  constexpr auto fruits = choice<Fruit>({{"apple", Fruit::apple}, {"pear", Fruit::pear}});
  EXPECT_EQ(fruits.words(), (std::vector<std::string_view>{"apple", "pear"}));
  EXPECT_EQ(fruits.print(Fruit::pear), "pear");
  EXPECT_THROW((void)fruits.print(Fruit::plum), std::logic_error);
}

}  // namespace
}  // namespace pseudorigid::scene
