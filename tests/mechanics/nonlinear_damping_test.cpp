/// RATTLE with damping that is not linear in the velocity: an oscillator with friction.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mechanics/core/damping.h"
#include "mechanics/core/unconstrained.h"
#include "support/order_fit.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

/// ẍ = −x − f ẋ/√(ẋ² + s²) with the dissipated energy D as the velocity of a second coordinate.
class RubbedOscillator : public mechanics::Unconstrained {
 public:
  using Vector = Eigen::Vector2d;

  RubbedOscillator(double friction, double slip_speed) : f_(friction), s_(slip_speed) {}

  bool velocity_dependent() const { return true; }
  bool dissipative() const { return true; }
  bool damping_is_linear() const { return false; }
  mechanics::Status force(double, const Vector& q, const Vector& v, Workspace&, Vector& f) const {
    const double w = std::hypot(v[0], s_);
    f = {-q[0] - f_ * v[0] / w, f_ * v[0] * v[0] / w};
    return {};
  }
  void add_damping(const mechanics::VectorState<Vector>& state, const Vector& u, mechanics::Linearization kind,
                   Vector& f) const {
    const double w = std::hypot(state.v[0], s_),
                 part = kind == mechanics::Linearization::tangent ? s_ * s_ / (w * w) : 1;
    f[0] -= f_ / w * part * u[0];
  }
  void apply_mass(const Vector& v, Vector& f) const { f = v; }
  void add_taken(double energy, Vector& v) const { v[1] += energy; }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f; }
  Vector make_vector() const { return Vector::Zero(); }

 private:
  double f_, s_;
};
using RubbedState = mechanics::State<RubbedOscillator>;

RubbedState rubbed_at(double x) { return {0, {x, 0}, {0, 0}}; }
double energy_of_rubbed(const RubbedState& s) { return 0.5 * (s.q[0] * s.q[0] + s.v[0] * s.v[0]) + s.v[1]; }

/// Coulomb's law takes 2f from the amplitude in each half period π, exactly, until |x| < f.
TEST(NonlinearDamping, OfCoulombTakesTwoFFromTheAmplitudeInEachHalfPeriod) {
  constexpr double f = 0.06;
  const RubbedOscillator oscillator(f, 1e-7);
  const auto r = run<mechanics::Rattle>(oscillator, rubbed_at(1), 7 * std::numbers::pi, 7, 400);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (std::size_t k = 0; k < r.states.size(); ++k) {
    const double sign = k % 2 == 0 ? 1 : -1;
    EXPECT_NEAR(r.states[k].q[0], sign * (1 - 2 * f * static_cast<double>(k)), 1e-3);
  }
  EXPECT_NEAR(energy_of_rubbed(r.last()), 0.5, 1e-3);
}

/// After 8 half periods the body sticks at x = 0.04, where the friction balances the spring. It creeps with the
/// velocity s x/√(f² − x²), which is 9e-10. The step is 10⁶ times as long as 1/γ, with the damping rate γ = f/s, and
/// the symmetric method keeps an oscillation of v about this velocity.
TEST(NonlinearDamping, LetsABodyStick) {
  constexpr double f = 0.06, s = 1e-9;
  const RubbedOscillator oscillator(f, s);
  const auto r = run<mechanics::Rattle>(oscillator, rubbed_at(1), 40, 40, 50);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (std::size_t k = 30; k < r.states.size(); ++k) {
    EXPECT_NEAR(r.states[k].q[0], 0.04, 1e-3);
    EXPECT_NEAR(r.states[k].q[0], r.states[30].q[0], 1e-7);
    EXPECT_LT(std::abs(r.states[k].v[0]), 3 * s);
  }
  EXPECT_NEAR(energy_of_rubbed(r.last()), 0.5, 1e-3);
  EXPECT_LT(r.counters.n_force, 25 * r.counters.n_steps);
  RecordProperty("forces_of_a_step", std::to_string(r.counters.n_force / r.counters.n_steps));
}

/// The accepted velocity satisfies v = v_half + (h/2) a(v) to round-off, whatever the step and the slip speed.
TEST(NonlinearDamping, TheVelocitySatisfiesTheEquationOfTheStep) {
  for (const double slip_speed : {1e-1, 1e-4, 1e-10})
    for (const double h : {1e-3, 0.1, 1.0})
      for (const double v : {1.0, 0.05, -1e-5}) {
        const RubbedOscillator oscillator(0.3, slip_speed);
        RubbedState state{0, {0.1, 0}, {v, 0}};
        mechanics::RattleWorkspace<RubbedOscillator> workspace(oscillator);
        for (int i = 0; i < 5; ++i) {
          RubbedState before = state;
          ASSERT_TRUE(mechanics::Rattle::advance(oscillator, h, state, workspace));
          Eigen::Vector2d a;
          RubbedOscillator::Workspace none;
          ASSERT_TRUE(oscillator.force(0, state.q, state.v, none, a));
          const double half = (state.q[0] - before.q[0]) / h;
          EXPECT_NEAR(state.v[0], half + h / 2 * a[0], 1e-13) << slip_speed << ' ' << h << ' ' << v;
        }
      }
}

TEST(NonlinearDamping, KeepsOrderTwo) {
  const RubbedOscillator oscillator(0.2, 0.1);
  constexpr double end = 6;
  const RubbedState exact = run<mechanics::Rattle>(oscillator, rubbed_at(1), end, 1, 40000).last();
  std::vector<ErrorPoint> of_motion, of_energy;
  for (const long n : {100, 200, 400, 800}) {
    const RubbedState last = run<mechanics::Rattle>(oscillator, rubbed_at(1), end, 1, n).last();
    of_motion.push_back({end / static_cast<double>(n), distance(last, exact)});
    of_energy.push_back({end / static_cast<double>(n), std::abs(energy_of_rubbed(last) - 0.5)});
  }
  EXPECT_NEAR(fit_order(of_motion).order, 2, 0.1);
  EXPECT_NEAR(fit_order(of_energy).order, 2, 0.2);
}

}  // namespace
}  // namespace pseudorigid::testing
