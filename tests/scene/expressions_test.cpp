/// The expressions $(…) of a parameter file.

#include "scene/expressions.h"

#include <gtest/gtest.h>

#include "scene/user_error.h"

namespace pseudorigid::scene {
namespace {

TEST(Expressions, AreReplacedByTheirNumbersAndAllElseIsKept) {
  const ParameterValues parameters{{"a", 3.0}, {"b_2", -0.5}};
  EXPECT_EQ(evaluated("", parameters), "");
  EXPECT_EQ(evaluated("a, (b_2); $ 1", parameters), "a, (b_2); $ 1");
  EXPECT_EQ(evaluated("$(a)", parameters), "3");
  EXPECT_EQ(evaluated("1, $(a+1), (x); $(2*(a*(1+b_2)-1)) end", parameters), "1, 4, (x); 1 end");
  EXPECT_EQ(evaluated("$(a)$(b_2)", parameters), "3-0.5");
}

TEST(Expressions, WithoutEndOrValueAreRefused) {
  for (const char* text : {"1, $((a+1), 2", "$(a", "$(", "$()", "$(c)", "$(1/0)", "$(a +* 2)"})
    EXPECT_THROW(evaluated(text, {{"a", 3.0}}), UserError) << text;
}

TEST(Expressions, AreNoLists) {
  for (const char* text : {"$(2,5)", "$(1,5*2)", "$(a, a)", "$(1,2,3)", "$((2,5))", "$((1,5)*2)"})
    EXPECT_THROW(evaluated(text, {{"a", 3.0}}), UserError) << text;
  EXPECT_EQ(evaluated("$(min(2,5)), $(sum(1,2,3))", {}), "2, 6");
}

TEST(Expressions, AreRoundedToWholeNumbersWhereTheseAreAskedFor) {
  EXPECT_EQ(evaluated("$(100*1.1)", {}), "110.00000000000001");
  EXPECT_EQ(evaluated("$(100*1.1)", {}, Rounding::to_whole), "110");
  EXPECT_EQ(evaluated("$(1000*1000)", {}, Rounding::to_whole), "1000000");
  EXPECT_EQ(evaluated("$(110.000001)", {}, Rounding::to_whole), "110.000001");
  EXPECT_EQ(evaluated("$(5/2)", {}, Rounding::to_whole), "2.5");
  EXPECT_EQ(evaluated("$(1e300)", {}, Rounding::to_whole), "1e+300");
}

TEST(Expressions, TellWhichNamesTheyUse) {
  const Sweep parameters{{"a", {1}, {}}, {"b", {1}, {}}, {"c", {1}, {}}, {"e5", {1}, {}}};
  using Names = std::set<std::string>;
  EXPECT_EQ(names_used("a, $(b+1e5), $(sin(c)*pi)", parameters), (Names{"b", "c"}));
  EXPECT_EQ(names_used("$(a > 1 ? b : 2)", parameters), (Names{"a", "b"}));
  EXPECT_EQ(names_used("1", parameters), Names{});
}

TEST(Expressions, KnowTheirOwnNames) {
  for (const char* name : {"pi", "e", "_pi", "_e"}) EXPECT_EQ(meaning_in_expressions(name), "a constant") << name;
  for (const char* name : {"sin", "sqrt", "ln", "sum", "min", "rint", "sign", "abs", "exp", "atan2"})
    EXPECT_EQ(meaning_in_expressions(name), "a function") << name;
  for (const char* name : {"l", "w", "spin", "Sin", "pie"}) EXPECT_EQ(meaning_in_expressions(name), "") << name;
}

TEST(Expressions, NameTheParametersThatThereAre) {
  const auto message = [](const char* text, const ParameterValues& parameters) {
    try {
      evaluated(text, parameters);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message("$(2*spin_)", {{"spin", 3.0}, {"a", 1.0}}),
            "\"2*spin_\" cannot be evaluated: nothing is called \"spin_\"; did you mean \"spin\"?; the parameters of "
            "the sweep are a, spin");
  EXPECT_EQ(message("$(width)", {{"a", 3.0}}),
            "\"width\" cannot be evaluated: nothing is called \"width\"; the parameters of the sweep are a");
  EXPECT_EQ(message("$(c)", {}),
            "\"c\" cannot be evaluated: nothing is called \"c\"; Sweep/Parameters declares no parameter");
}

}  // namespace
}  // namespace pseudorigid::scene
