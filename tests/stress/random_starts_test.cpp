/// 10,000 random starts of random systems with random methods: stretches up to 3, steps up to the stability limit.
/// Nothing that is not finite comes out, every failure is a report with a reason, constraints hold wherever a run
/// arrives, and the same seed gives the same result to the last bit.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "mechanics/core/field_of.h"
#include "mechanics/methods/time_loop.h"
#include "mechanics/steps/largest_frequency.h"
#include "mechanics/steps/step_size.h"
#include "reduced/bodies.h"
#include "systems/double_pendulum.h"
#include "systems/mass_points.h"
#include "systems/rigid_body.h"

namespace pseudorigid::testing {
namespace {

constexpr int n_starts_per_system = 2000;
constexpr long n_samples = 4, n_steps = 8;

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double between(double a, double b) {  // the same on every machine
    return a + (b - a) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(generator_() % static_cast<std::uint64_t>(n)); }
  template <class V>
  V irregular(V x, double size) {
    for (double& value : mechanics::local_values(x)) value = between(-size, size);
    return x;
  }
  Matrix3d rotation() {
    const Eigen::Quaterniond q(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
    return q.normalized().toRotationMatrix();
  }

 private:
  std::mt19937_64 generator_;
};

template <class System>
struct Start {
  System system;
  State<System> state;
};

/// Q = R diag(a) S with ln a up to ln 3, of determinant 1 where the body asks for it.
template <class Body>
Start<Body> random_body(Random& random) {
  const double l1 = random.between(-1.1, 1.1), l2 = random.between(-1.1, 1.1);
  const double l3 = mechanics::unconstrained<Body> ? random.between(-1.1, 1.1) : -l1 - l2;
  const Matrix3d stretch = diagonal(std::exp(l1), std::exp(l2), std::exp(l3));
  State<Body> state{0, random.rotation() * stretch * random.rotation(), {}};
  state.v = random.irregular(state.q, 2);
  return {
      Body(Law{1, mechanics::unconstrained<Body> ? random.between(0.1, 10) : 0}, reduced::ReferenceBody::unit_ball()),
      state};
}

Start<systems::DoublePendulum> random_pendulum(Random& random) {
  const auto size = [&] { return random.between(0.2, 3); };
  const systems::DoublePendulum pendulum({size(), size(), size(), size(), random.between(0, 3)});
  State<systems::DoublePendulum> state{};
  pendulum.from_angles({random.between(-4, 4), random.between(-4, 4)}, {random.between(-3, 3), random.between(-3, 3)},
                       state.q, state.v);
  return {pendulum, state};
}

Start<systems::MassPoints> random_points(Random& random) {
  const int n = 1 + random.below(5);
  systems::MassPoints::Parameters p;
  p.masses = Eigen::VectorXd::Zero(n);
  for (double& mass : p.masses) mass = random.between(0.1, 3);
  if (random.below(2)) p.gravitational_constant = random.between(0, 1);
  if (random.below(2)) p.confinement = random.between(0, 2);
  if (random.below(3) == 0) p.drag = random.between(0, 1);
  for (int i = 1; i < n; ++i)
    if (random.below(2)) p.springs.push_back({i - 1, i, {random.between(0.1, 5), random.between(0, 2)}});
  if (n > 1 && random.below(3) == 0) p.dashpots.push_back({0, 1, random.between(0, 1)});
  const Eigen::Matrix3Xd place = random.irregular(Eigen::Matrix3Xd(3, n), 2);
  const Eigen::Matrix3Xd velocity = random.irregular(Eigen::Matrix3Xd(3, n), 2);
  return {systems::MassPoints(p), {0, place, velocity}};
}

Start<systems::FixedPointBody> random_top(Random& random) {
  systems::FixedPointBody::Parameters p;
  const Matrix3d turn = random.rotation();
  const Matrix3d moments = diagonal(random.between(0.1, 3), random.between(0.1, 3), random.between(0.1, 3));
  p.E0 = turn * moments * turn.transpose();
  p.loads.center = random.irregular(Vector3d(), 1);
  p.loads.gravity = random.irregular(Vector3d(), 2);
  State<systems::FixedPointBody> state{0, random.rotation(), {}};
  state.v = state.q * hat(random.irregular(Vector3d(), 3));
  return {systems::FixedPointBody(p), state};
}

/// What came of one start, and a number that any other bit would change.
struct Result {
  mechanics::RunResult run;
  double largest_constraint = 0;
  bool finite = true;
  std::uint64_t bits = 0;

  template <class V>
  void take(V x) {
    for (const double value : mechanics::local_values(x)) {
      finite = finite && std::isfinite(value);
      bits = 1099511628211u * (bits ^ std::bit_cast<std::uint64_t>(value));
    }
  }
};

template <class S>
struct Watch {
  const S& system;
  Result& result;

  template <class W>
  mechanics::Status sample(long, const State<S>& state, const W&) {
    result.take(state.q);
    result.take(state.v);
    auto g = system.make_multiplier();
    const auto status = system.constraint(state.q, g);
    result.largest_constraint = std::max(result.largest_constraint, status ? mechanics::max_norm(g) : HUGE_VAL);
    return {};
  }
  template <class W>
  long steps_per_interval(long, const State<S>&, const W&) const {
    return n_steps;
  }
  /// Points that drag lets fall together turn ever faster; nobody waits for the end of that.
  template <class W>
  bool step_done(mechanics::Cursor, const State<S>&, const W& w) const {
    return w.counters.n_force < 100'000;
  }
};

/// Runs a method over 32 of its steps, the outer step being part of the stability limit.
template <class Method, class S>
Result run_method(const Start<S>& start, double rattle_limit, double part) {
  Result result;
  Watch<S> watch{start.system, result};
  mechanics::Cursor cursor;
  State<S> state = start.state;
  double end = n_samples * n_steps * rattle_limit * part;
  const auto& form = mechanics::form_for<Method>(start.system);
  typename Method::template Workspace<mechanics::FormFor<Method, S>> workspace(form);
  if constexpr (Method::adaptive)
    workspace.tolerance = std::pow(10, -12 * part);
  else
    end *= Method::stability_limit / mechanics::Rattle::stability_limit;
  result.run = mechanics::run_time_loop<Method>(form, {end, n_samples}, state, cursor, workspace, watch);
  return result;
}

/// The start of a seed: system, state, method, step. Nothing comes out of a method that does not fit or refuses the
/// system.
template <class Make>
Result result_of(std::uint64_t seed, const Make& make) {
  Random random(seed);
  auto start = make(random);
  using S = std::decay_t<decltype(start.system)>;
  const auto place = mechanics::MethodId{static_cast<std::size_t>(random.below(int{mechanics::n_methods}))};
  const double part = random.between(0.02, 1);
  Result result;
  mechanics::RattleWorkspace<S> projector(start.system);
  result.run.reason = mechanics::Rattle::project_velocity(start.system, start.state, projector).reason();
  const auto frequency = mechanics::largest_frequency(start.system, start.state, projector.system, 12);
  if (!frequency.status || !result.run.reason.empty()) {
    result.run.outcome = mechanics::Outcome::failed;
    result.run.reason += frequency.status.reason();
    return result;
  }
  const double rate = mechanics::max_norm(start.state.v) / (1 + mechanics::max_norm(start.state.q));
  const double limit = std::min(10.0, mechanics::rattle_step_limit(frequency.omega, rate, 1));
  mechanics::with_method(place, [&]<class Method>(Method) {
    if constexpr (mechanics::method_fits<Method, S>())
      if (Method::accepts(mechanics::form_for<Method>(start.system)).ok())
        result = run_method<Method>(start, limit, part);
  });
  return result;
}

template <class Make>
void expect_sound_results(const Make& make) {
  int n_finished = 0, n_failed = 0;
  for (std::uint64_t seed = 1; seed <= n_starts_per_system; ++seed) {
    const Result result = result_of(seed, make);
    ASSERT_TRUE(result.finite) << "seed " << seed;
    ASSERT_LE(result.largest_constraint, 1e-12) << "seed " << seed;
    if (result.run.outcome == mechanics::Outcome::finished) {
      ++n_finished;
    } else if (result.run.outcome == mechanics::Outcome::failed) {
      ++n_failed;
      ASSERT_GE(result.run.reason.size(), 20u) << "seed " << seed << ": " << result.run.reason;
      ASSERT_EQ(result.run.reason.find("nan"), std::string::npos) << "seed " << seed << ": " << result.run.reason;
    }
    if (seed % 10 == 0) {
      const Result again = result_of(seed, make);
      ASSERT_EQ(again.bits, result.bits) << "seed " << seed;
      ASSERT_EQ(again.run.reason, result.run.reason) << "seed " << seed;
    }
  }
  ::testing::Test::RecordProperty("finished", n_finished);
  ::testing::Test::RecordProperty("failed_with_a_report", n_failed);
  EXPECT_GT(n_finished, n_starts_per_system / 3) << "many starts must lead somewhere for this to be a test";
  // Of the mass points 20 by gauss-16 and 13 by explicit-8 (Watch::step_done); the bound was set after these numbers.
  EXPECT_LT(n_starts_per_system - n_finished - n_failed, n_starts_per_system / 50) << "given up without a reason";
}

TEST(RandomStarts, IncompressibleBody) { expect_sound_results(random_body<Sl3>); }
TEST(RandomStarts, CompressibleBody) { expect_sound_results(random_body<Gl3>); }
TEST(RandomStarts, DoublePendulum) { expect_sound_results(random_pendulum); }
TEST(RandomStarts, MassPoints) { expect_sound_results(random_points); }
TEST(RandomStarts, HeavyTop) { expect_sound_results(random_top); }

}  // namespace
}  // namespace pseudorigid::testing
