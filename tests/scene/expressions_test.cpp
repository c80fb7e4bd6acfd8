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
