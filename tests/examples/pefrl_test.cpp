/// The example of docs/adding_a_method.md: order, stability, reversibility, invariants, memory, refusals, step search.

#include "examples/pefrl.h"

#include <gtest/gtest.h>

#include "mechanics/core/chart_field.h"
#include "mechanics/core/field_of.h"
#include "mechanics/core/memory.h"
#include "mechanics/steps/step_search.h"
#include "mechanics/steps/step_size.h"
#include "support/conserved.h"
#include "support/order_test.h"
#include "systems/double_pendulum.h"
#include "systems/sample_systems.h"
#include "systems/torus.h"

namespace pseudorigid::testing {

using mechanics::Pefrl;
using systems::MassPoints;

struct PointsFactory {
  using System = MassPoints;
  MassPoints points{isolated_points()};
  const System& system() const { return points; }
  mechanics::State<System> initial() const { return four_points(); }
  double end() const { return 2; }
  std::vector<long> step_counts(int) const { return {40, 57, 80, 113, 160, 226}; }
  long n_reference_steps() const { return 400; }
};

/// The same points, pulled along x by a force that oscillates.
struct DrivenPoints : MassPoints {
  using MassPoints::MassPoints;
  bool time_dependent() const { return true; }
  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    if (auto status = MassPoints::force(t, q, v, w, f); !status) return status;
    f.row(0).array() += std::cos(3 * t);
    return {};
  }
};
struct DrivenFactory : PointsFactory {
  using System = DrivenPoints;
  DrivenPoints driven{isolated_points()};
  const System& system() const { return driven; }
};

using Cases = ::testing::Types<OrderCase<PointsFactory, Pefrl>, OrderCase<DrivenFactory, Pefrl>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Pefrl, MethodOrder, Cases);

/// Unit mass on a unit spring; |trace| of one step along x is at most 2 while it is stable.
TEST(Pefrl, StabilityLimitIsThatOfTheOscillator) {
  MassPoints::Parameters p;
  p.masses = Eigen::VectorXd::Ones(1);
  p.confinement = 1;
  const MassPoints oscillator(p);
  const auto trace = [&](double h) {
    double sum = 0;
    for (const int column : {0, 1}) {
      mechanics::State<MassPoints> s{0, Eigen::Matrix3Xd::Zero(3, 1), Eigen::Matrix3Xd::Zero(3, 1)};
      (column == 0 ? s.q : s.v)(0) = 1;
      mechanics::PefrlWorkspace<MassPoints> w(oscillator);
      EXPECT_TRUE(Pefrl::advance(oscillator, h, s, w));
      sum += column == 0 ? s.q(0) : s.v(0);
    }
    return std::abs(sum);
  };
  constexpr double increment = 1e-3;
  double h = increment;
  while (trace(h) <= 2 + 1e-12 && h < 10) h += increment;
  EXPECT_LE(Pefrl::stability_limit, h);
  EXPECT_GT(Pefrl::stability_limit, h - 0.011) << "the trait has two decimals, rounded down";
}

TEST(Pefrl, ReturnsWhereItCameFromWhenTimeIsReversed) {
  const MassPoints points(isolated_points());
  auto turned = run<Pefrl>(points, four_points(), 2, 1, 100).last();
  EXPECT_GT(distance(turned, four_points()), 0.1);
  turned.v = -turned.v;
  auto back = run<Pefrl>(points, turned, 2, 1, 100).last();
  back.v = -back.v;
  EXPECT_LT(distance(back, four_points()), 1e-12);  // round-off of 200 steps, carried along the motion
}

/// Linear and angular momentum to round-off; the energy oscillates within h⁴ and does not drift.
TEST(Pefrl, KeepsMomentaAndDoesNotDriftInEnergy) {
  MassPoints::Parameters p = isolated_points();
  p.gravitational_constant = 0;  // springs alone: no close encounters on the way
  const MassPoints points(p);
  const auto r = run<Pefrl>(points, four_points(), 1000, 1000, 20);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  const std::vector first(r.states.begin(), r.states.begin() + 100);
  const Departures early = departures(points, first), late = departures(points, r.states);
  EXPECT_LT(late.momenta, 1e-12);
  EXPECT_GT(early.energy, 1e-10) << "else the bound below says nothing";
  EXPECT_LT(late.energy, 3 * early.energy);
}

TEST(Pefrl, CountsItsForces) {
  const auto r = run<Pefrl>(MassPoints(isolated_points()), four_points(), 1, 2, 10);
  EXPECT_EQ(r.counters.n_steps, 20);
  EXPECT_EQ(r.counters.n_force, 20 * Pefrl::n_stages);
}

TEST(Pefrl, FitsSystemsWithoutConstraintsAlone) {
  static_assert(mechanics::method_fits<Pefrl, MassPoints>());
  static_assert(!mechanics::method_fits<Pefrl, systems::DoublePendulum>());
  static_assert(!mechanics::method_fits<Pefrl, mechanics::ChartField<systems::Torus>>());
}

TEST(Pefrl, RefusesForcesThatBreakItsPromises) {
  MassPoints::Parameters p = isolated_points();
  EXPECT_TRUE(Pefrl::accepts(MassPoints(p)));
  p.drag = 0.1;
  const auto status = Pefrl::accepts(MassPoints(p));
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("use rattle or explicit-8"), std::string::npos) << status.reason();
}

/// What `visit_memory` hands out is all that a resumed run needs to repeat the uninterrupted one bit by bit.
TEST(Pefrl, GoesOnFromItsMemoryBitByBit) {
  const MassPoints points(isolated_points());
  const mechanics::SampleTimes times{2, 10};
  const auto go_on = [&](mechanics::State<MassPoints>& s, mechanics::Cursor& at, auto& w, long n_steps_allowed) {
    Recorder<MassPoints> recorder{20, n_steps_allowed};
    return mechanics::run_time_loop<Pefrl>(points, times, s, at, w, recorder).outcome;
  };
  auto whole = four_points(), halves = whole;
  mechanics::PefrlWorkspace<MassPoints> w_whole(points), w_first(points), w_second(points);
  mechanics::Cursor at_whole, at_halves;
  ASSERT_EQ(go_on(whole, at_whole, w_whole, -1), mechanics::Outcome::finished);
  ASSERT_EQ(go_on(halves, at_halves, w_first, 77), mechanics::Outcome::interrupted);
  std::vector<double> memory;
  mechanics::save_memory(w_first, memory);
  ASSERT_TRUE(mechanics::restore_memory(w_second, memory));
  ASSERT_EQ(go_on(halves, at_halves, w_second, -1), mechanics::Outcome::finished);
  EXPECT_EQ(halves.q, whole.q);
  EXPECT_EQ(halves.v, whole.v);
}

TEST(Pefrl, AForceThatFailsEndsTheRunWithItsReason) {
  auto state = four_points();
  state.q.col(1) = state.q.col(0);
  const auto r = run<Pefrl>(MassPoints(isolated_points()), {0, state.q, 0 * state.v}, 1, 1, 1);
  EXPECT_EQ(r.result.outcome, mechanics::Outcome::failed);
  EXPECT_FALSE(r.result.reason.empty());
}

/// Step = auto: the step that the program's search finds for a tolerance meets it.
TEST(Pefrl, ItsStepIsFoundFromATolerance) {
  const MassPoints points(isolated_points());
  const auto start = four_points();
  constexpr double end = 2, tolerance = 1e-8;
  const auto position = [](const mechanics::State<MassPoints>& s) { return s.q; };
  const mechanics::StepRequest request{.end = end, .window = end, .tolerance = tolerance, .rattle_limit = 0.2};
  namespace detail = mechanics::detail;
  const auto method = detail::fixed_step_method<Pefrl>(mechanics::id_of<mechanics::Rattle>, points, start, request,
                                                       position, detail::NoEnergies{});
  const auto trial = detail::StepSearch(request, true).try_method(method, HUGE_VAL);
  ASSERT_EQ(trial.verdict, mechanics::detail::Trial::Verdict::accepted) << trial.reason;
  const long n_steps = mechanics::SampleTimes{end, 1}.steps_per_interval(trial.step);
  const double error = distance(run<Pefrl>(points, start, end, 1, n_steps).last(),
                                run<mechanics::Rattle8>(points, start, end, 1, 400).last());
  EXPECT_LT(error, tolerance);
  EXPECT_GT(error, tolerance / 1000) << "a far smaller step than necessary";
}

}  // namespace pseudorigid::testing
