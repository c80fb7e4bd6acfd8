#pragma once
/// The declared order of every method, as one typed suite for any system. A factory says what to run:
///
///   struct Factory {
///     using System = …;                                        // a ConstrainedSystem
///     const System& system() const;
///     mechanics::State<System> initial() const;
///     double end() const;
///     std::vector<long> step_counts(int order) const;          // of the whole run, for a method of that order
///     long n_reference_steps() const;                          // of order 8, the reference
///   };
///
///   using Cases = OrderCases<Factory, OneStep>;    // every such method of the table (method_lists.h)
///   INSTANTIATE_TYPED_TEST_SUITE_P(Ball, MethodOrder, Cases);
///
/// The error is that of the full state (q, v) at the end; fit_order drops the round-off plateau.

#include <gtest/gtest.h>

#include <vector>

#include "support/method_lists.h"
#include "support/order_fit.h"
#include "support/runs.h"

namespace pseudorigid::testing {

template <class FactoryType, class MethodType>
struct OrderCase {
  using Factory = FactoryType;
  using Method = MethodType;
};

namespace detail {
template <class Factory>
struct OrderCaseOf {
  template <class Method>
  using With = OrderCase<Factory, Method>;
};

/// A reference of order 8 cannot measure a higher order: such a method has a suite of its own (gauss_16_test.cpp).
template <class Kind>
struct UpToTheReference {
  template <class Method>
  static constexpr bool has = Kind::template has<Method>&& Method::order <= mechanics::Rattle8::order;
};
}  // namespace detail

template <class Factory, class Kind>
using OrderCases = CasesOf<detail::OrderCaseOf<Factory>::template With, detail::UpToTheReference<Kind>>;

template <class Case>
class MethodOrder : public ::testing::Test {};

TYPED_TEST_SUITE_P(MethodOrder);

TYPED_TEST_P(MethodOrder, IsTheDeclaredOne) {
  using Method = typename TypeParam::Method;
  const typename TypeParam::Factory factory;
  const auto end_state = [&]<class AnyMethod>(AnyMethod, long n_steps) {
    auto r = run<AnyMethod>(factory.system(), factory.initial(), factory.end(), 1, n_steps);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    return r.last();
  };
  const auto reference = end_state(mechanics::Rattle8{}, factory.n_reference_steps());

  std::vector<ErrorPoint> points;
  for (const long n : factory.step_counts(Method::order))
    points.push_back({factory.end() / static_cast<double>(n), distance(end_state(Method{}, n), reference)});
  const auto fit = fit_order(points);

  EXPECT_GE(fit.n_used, 3u);
  EXPECT_NEAR(fit.order, Method::order, 0.1);
  this->RecordProperty("fitted_order", std::to_string(fit.order));
}

REGISTER_TYPED_TEST_SUITE_P(MethodOrder, IsTheDeclaredOne);

}  // namespace pseudorigid::testing
