#pragma once
/// Lists of methods for typed suites, taken from the table of methods: a new line of the table is in them.
///
///   TYPED_TEST_SUITE(EveryMethod, Methods<All>);
///   using BallCases = CasesOf<BallCase, Symplectic>;   // BallCase<Method> of each
///   INSTANTIATE_TYPED_TEST_SUITE_P(Ball, MethodOrder, BallCases);

#include <gtest/gtest.h>

#include <tuple>
#include <type_traits>

#include "mechanics/methods/methods.h"

namespace pseudorigid::testing {

struct All {
  template <class Method>
  static constexpr bool has = true;
};
struct FixedStep {
  template <class Method>
  static constexpr bool has = !Method::adaptive;
};
/// Of fixed step and without a past: the others, multistep methods, have a formula in states before.
struct OneStep {
  template <class Method>
  static constexpr bool has = !Method::adaptive && !requires {
    Method::formula;
  };
};
/// RATTLE and its compositions: one-step maps that keep constraint, momenta and the symplectic form.
struct Symplectic {
  template <class Method>
  static constexpr bool has = Method::symplectic;
};

namespace detail {
template <class Method>
using Itself = Method;

template <template <class> class Case, class Kind, class... Methods>
auto those_of(std::tuple<Methods...>) -> decltype(std::tuple_cat(
    std::declval<std::conditional_t<Kind::template has<Methods>, std::tuple<std::type_identity<Case<Methods>>>,
                                    std::tuple<>>>()...));

template <class... Cases>
auto types_of(std::tuple<std::type_identity<Cases>...>) -> ::testing::Types<Cases...>;
}  // namespace detail

template <template <class> class Case, class Kind>
using CasesOf = decltype(detail::types_of(detail::those_of<Case, Kind>(mechanics::MethodTable{})));

template <class Kind>
using Methods = CasesOf<detail::Itself, Kind>;

}  // namespace pseudorigid::testing
