/// What methods promise, on polynomial bodies of degree 3, incompressible and compressible, in an octant and as whole
/// balls: orders, reversibility, constraints, momenta, energy, and runs that are resumed.

#include <gtest/gtest.h>

#include "mechanics/core/memory.h"
#include "polynomial/motions.h"
#include "support/conserved.h"
#include "support/method_lists.h"
#include "support/order_test.h"

namespace pseudorigid::testing {

template <class BodyType, class MethodType>
struct Combination {
  using Body = BodyType;
  using Method = MethodType;
  /// Largest frequencies: 7.3 c/r (PHYSICS section 10), and about 1.7 times that of waves that change the volume.
  static constexpr double largest_frequency = incompressible<Body> ? 8 : 14;
  /// Step of about equal reserve of stability for every method; adaptive ones choose their own.
  static constexpr double step = [] {
    if constexpr (Method::adaptive)
      return 0.3 / largest_frequency;
    else
      return 0.3 * Method::stability_limit / largest_frequency;
  }();
  static long n_steps(double end) { return std::lround(std::ceil(end / step)); }
};
template <class Method>
using Incompressible = Combination<IncompressibleBody, Method>;
template <class Method>
using Compressible = Combination<CompressibleBody, Method>;

template <class Body>
struct OctantFactory {
  using System = Body;
  Body body = elastic_body<Body>(all_planes);
  const System& system() const { return body; }
  State<System> initial() const { return pulsating(body); }
  double end() const { return incompressible<Body> ? 1.5 : 0.8; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {200, 400, 800, 1600};
    if (order == 4) return {40, 57, 80, 113, 160, 226};
    if (order == 6) return {34, 40, 48, 57, 67, 80, 95};
    return {34, 37, 40, 44, 48, 52};
  }
  long n_reference_steps() const { return 240; }
};
using IncompressibleOrders = OrderCases<OctantFactory<IncompressibleBody>, OneStep>;
using CompressibleOrders = OrderCases<OctantFactory<CompressibleBody>, OneStep>;
INSTANTIATE_TYPED_TEST_SUITE_P(IncompressibleOctant, MethodOrder, IncompressibleOrders);
INSTANTIATE_TYPED_TEST_SUITE_P(CompressibleOctant, MethodOrder, CompressibleOrders);

template <class C>
class SymplecticMethod : public ::testing::Test {};
TYPED_TEST_SUITE_P(SymplecticMethod);

TYPED_TEST_P(SymplecticMethod, ReturnsWhereItCameFromWhenTimeIsReversed) {
  using Body = typename TypeParam::Body;
  constexpr double end = 3;
  for (const Planes& planes : {all_planes, no_planes}) {
    const auto body = elastic_body<Body>(planes);
    const auto start = pulsating(body);
    const auto there = run<typename TypeParam::Method>(body, start, end, 1, TypeParam::n_steps(end));
    ASSERT_TRUE(there.finished()) << there.result.reason;
    auto turned = there.last();
    EXPECT_GT(nonaffine_part(body, turned.q), 1e-3);
    turned.v = -turned.v;
    auto back = run<typename TypeParam::Method>(body, turned, end, 1, TypeParam::n_steps(end)).last();
    back.v = -back.v;
    EXPECT_GT(distance(there.last(), start), 0.1);
    EXPECT_LT(distance(back, start), 3e-13);
  }
}

TYPED_TEST_P(SymplecticMethod, EnergyErrorIsBoundedAndDoesNotDrift) {
  using Body = typename TypeParam::Body;
  const auto body = elastic_body<Body>(all_planes);
  const auto start = pulsating(body);
  constexpr long n_samples = 400;
  constexpr double end = 200;
  const auto r = run<typename TypeParam::Method>(body, start, end, n_samples, TypeParam::n_steps(end / n_samples));
  ASSERT_TRUE(r.finished()) << r.result.reason;
  const double E = energy(body, start);
  double early = 0, late = 0;
  for (std::size_t k = 0; k < r.states.size(); ++k) {
    double& largest = k < r.states.size() / 4 ? early : late;
    largest = std::max(largest, std::abs(energy(body, r.states[k]) - E));
  }
  EXPECT_LT(late, 1.5 * early + 1e-13);
  EXPECT_LT(late, 0.03 * E);
}

REGISTER_TYPED_TEST_SUITE_P(SymplecticMethod, ReturnsWhereItCameFromWhenTimeIsReversed,
                            EnergyErrorIsBoundedAndDoesNotDrift);
using SymplecticIncompressible = CasesOf<Incompressible, Symplectic>;
using SymplecticCompressible = CasesOf<Compressible, Symplectic>;
INSTANTIATE_TYPED_TEST_SUITE_P(Incompressible, SymplecticMethod, SymplecticIncompressible);
INSTANTIATE_TYPED_TEST_SUITE_P(Compressible, SymplecticMethod, SymplecticCompressible);

/// At the steps of these tests, with a reserve of 2 and more; momenta of methods that are not symplectic.
struct Errors {
  double energy, momenta;
};
constexpr Errors errors_of_order(int order) {
  if (order == 2) return {4e-2, 1e-14};
  if (order == 4) return {2e-3, 3e-4};
  return {2e-5, 3e-9};
}

template <class C>
class EveryMethod : public ::testing::Test {};
TYPED_TEST_SUITE_P(EveryMethod);

TYPED_TEST_P(EveryMethod, KeepsConstraintMomentaAndEnergy) {
  using Body = typename TypeParam::Body;
  using Method = typename TypeParam::Method;
  constexpr double end = 6;
  constexpr long n_samples = 12;
  for (const Planes& planes : {all_planes, Planes{false, false, true}, no_planes}) {
    const auto body = elastic_body<Body>(planes);
    const auto start = pulsating(body);
    const auto r = run<Method>(body, start, end, n_samples, TypeParam::n_steps(end / n_samples));
    ASSERT_TRUE(r.finished()) << r.result.reason;
    EXPECT_GT(nonaffine_part(body, r.last().q), 1e-3);
    const Departures d = departures(body, r.states);
    EXPECT_LT(d.constraint, 1e-14);
    EXPECT_LT(d.constraint_rate, 1e-13);
    EXPECT_LT(d.momenta, Method::symplectic ? 1e-14 : errors_of_order(Method::order).momenta);
    EXPECT_LT(d.energy, errors_of_order(Method::order).energy);
  }
}

/// One step of a method of either kind.
template <class Method, class Form>
mechanics::Status one_step(const Form& form, double h, State<Form>& state,
                           typename Method::template Workspace<Form>& w) {
  if constexpr (Method::adaptive)
    return Method::step(form, 1e3, state, w);
  else
    return Method::advance(form, h, state, w);
}

/// The Gram solver's factor is that of an earlier position, which must be remembered.
TYPED_TEST_P(EveryMethod, ResumesBitByBit) {
  using Body = typename TypeParam::Body;
  using Method = typename TypeParam::Method;
  using Form = mechanics::FormFor<Method, Body>;
  const auto body = elastic_body<Body>(all_planes);
  const Form& form = mechanics::form_for<Method>(body);
  State<Form> state = pulsating(body);
  typename Method::template Workspace<Form> workspace(form), other(form);
  const double h = TypeParam::step;
  for (int k = 0; k < 30; ++k) ASSERT_TRUE((one_step<Method, Form>(form, h, state, workspace)));
  std::vector<double> memory;
  mechanics::save_memory(workspace, memory);
  ASSERT_TRUE(mechanics::restore_memory(other, memory));
  State<Form> resumed = state;
  for (int k = 0; k < 30; ++k) {
    ASSERT_TRUE((one_step<Method, Form>(form, h, state, workspace)));
    ASSERT_TRUE((one_step<Method, Form>(form, h, resumed, other)));
    ASSERT_EQ(distance(state, resumed), 0) << k;
  }
}

REGISTER_TYPED_TEST_SUITE_P(EveryMethod, KeepsConstraintMomentaAndEnergy, ResumesBitByBit);
/// A body of many degrees of freedom has no use for the stages in lanes.
struct AllButGauss {
  template <class Method>
  static constexpr bool has = !std::is_same_v<Method, mechanics::Gauss16>;
};
static_assert(!mechanics::method_fits<mechanics::Gauss16, IncompressibleBody>());
using AllIncompressible = CasesOf<Incompressible, AllButGauss>;
using AllCompressible = CasesOf<Compressible, AllButGauss>;
INSTANTIATE_TYPED_TEST_SUITE_P(Incompressible, EveryMethod, AllIncompressible);
INSTANTIATE_TYPED_TEST_SUITE_P(Compressible, EveryMethod, AllCompressible);

template <class Body>
class Conserving : public ::testing::Test {};
using Bodies = ::testing::Types<IncompressibleBody, CompressibleBody>;
TYPED_TEST_SUITE(Conserving, Bodies);

TYPED_TEST(Conserving, EnergyAndMomentaAreKeptAtAnyStep) {
  for (const Planes& planes : {all_planes, no_planes})
    for (const double h : {0.01, 0.04, 0.08}) {
      const auto body = elastic_body<TypeParam>(planes);
      expect_everything_kept<mechanics::EnergyMomentum>(body, pulsating(body), h, planes == all_planes ? 400 : 100);
    }
}

}  // namespace pseudorigid::testing
