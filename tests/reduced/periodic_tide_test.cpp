/// The periodic tide T cos(ωt + φ): the centre of mass under it by Mathieu's functions and by integration,
/// the body by an equation of motion that is written here, the energy that the tide gives and its balance.

#include "loads/periodic_tide.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/core/declared_dependence.h"
#include "mechanics/core/explicit_multiplier.h"
#include "reduced/center_of_mass.h"
#include "reduced/dissipative_body.h"
#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/dense.h"
#include "support/differences.h"
#include "support/integrate.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using loads::PeriodicTide;
using mechanics::ExplicitMultiplier;
using reduced::CenterOfMass;
using reduced::CenterPath;
using reduced::ReferenceBody;

constexpr double omega = 2.3, phase = 0.4;

PeriodicTide tide(const Matrix3d& T = generic_quadratic(), double frequency = omega) {
  PeriodicTide load{.frequency = frequency, .phase = phase};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) load.amplitude[i][j] = T(i, j);
  return load;
}

TEST(PeriodicTide, RateIsTheDerivativeOfTheForcing) {
  const PeriodicTide load = tide();
  const double h = 0.01, t = 1.7;
  const Matrix3d rate = first_difference([&](int k) { return load.forcing(t + k * h).quadratic; }, h);
  EXPECT_LT((load.forcing_rate(t).quadratic - rate).norm(), 1e-12);
  EXPECT_LT((load.forcing(0).quadratic - std::cos(phase) * generic_quadratic()).norm(), 1e-15);
  EXPECT_EQ(load.largest_forcing().quadratic, generic_quadratic());
}

/// ẍ + (a − 2q cos 2t)x = 0 with a characteristic number a is solved by ce₁ = Σ A_k cos (2k+1)t, whose coefficients are
/// the eigenvector of Hill's matrix.
TEST(PeriodicTide, CentreOfMassFollowsMathieusFunction) {
  constexpr int n = 30;
  constexpr double q = 1.5;
  Eigen::MatrixXd hill = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    hill(k, k) = (2 * k + 1) * (2 * k + 1) + (k == 0 ? q : 0);
    if (k > 0) hill(k, k - 1) = hill(k - 1, k) = q;
  }
  const auto [values, vectors] = symmetric_spectrum(hill);
  const double a = values[0];
  const Eigen::VectorXd A = vectors.col(0);
  PeriodicTide load = tide(-2 * q * Matrix3d::Identity(), 2);
  load.phase = 0;
  const Vector3d direction(0.3, -0.5, 0.2);
  CenterPath path(CenterOfMass{
      .position = A.sum() * direction, .quadratic = a * Matrix3d::Identity(), .driving = loads::Loads{load}});
  for (const double t : {0.0, 0.3, 2.0, 7.7, 31.0}) {
    double x = 0, v = 0;
    for (int k = 0; k < n; ++k) {
      x += A[k] * std::cos((2 * k + 1) * t);
      v -= (2 * k + 1) * A[k] * std::sin((2 * k + 1) * t);
    }
    const auto m = path.at(t);
    EXPECT_LT((m.x - x * direction).norm() + (m.v - v * direction).norm(), 2e-13) << t;
  }
}

/// ẍ = b − (T + T_t)x − cẋ with all that there is; the same whatever is asked for, in whatever order; and its energy.
TEST(PeriodicTide, CentreOfMassKeepsItsBalanceOfEnergy) {
  const CenterOfMass c{.position = {0.3, -0.2, 1.1},
                       .velocity = {-0.5, 0.7, 0.4},
                       .acceleration = {0.2, -0.1, -0.3},
                       .quadratic = generic_quadratic(),
                       .driving = loads::Loads{tide()}};
  CenterPath path(c), other(c);
  const auto energy = [&](double t) {
    const auto m = path.at(t);
    return c.kinetic(m) + c.potential(m) + c.driven(m, t);
  };
  const auto late = other.at(25.1);
  for (const double t : {0.0, 0.1, 1.0, 3.7, 20.0, 20.001, 25.1}) EXPECT_NEAR(energy(t), energy(0), 1e-12);
  EXPECT_EQ(path.at(25.1).x, late.x);
  EXPECT_EQ(other.at(3.7).x, CenterPath(c).at(3.7).x) << "back in time";
  EXPECT_GT(std::abs(path.at(3.7).work), 0.01);

  CenterOfMass dragged = c;
  dragged.drag = 0.3;
  CenterPath slowed(dragged);
  const auto lost = [&](double t) {
    const auto m = slowed.at(t);
    return dragged.kinetic(m) + dragged.potential(m) + dragged.driven(m, t);
  };
  const double h = 0.02, rate = first_difference([&](int k) { return lost(3 + k * h); }, h);
  EXPECT_NEAR(rate, -0.3 * slowed.at(3).v.squaredNorm(), 1e-9);
}

TEST(PeriodicTide, CentreOfMassAtRestInTheOriginStays) {
  CenterPath path(CenterOfMass{.driving = loads::Loads{tide()}});
  EXPECT_EQ(path.at(1e9).x, Vector3d::Zero());
}

template <class Body>
reduced::DissipativeBody<Body> driven(const ReferenceBody& reference, const reduced::Dissipation& dissipation = {}) {
  const Law law{1, std::is_same_v<Body, LoadedSl3> ? 0.0 : 1.7};
  return {Body{reduced::Potential(law, reference), reference}, dissipation, loads::Loads{tide()}};
}

/// Q̈E₀ = −Vol P(Q) − T cos(ωt + φ) Q E₀ as it stands, for a compressible body.
struct DrivenField {
  using Vector = Matrix3d;
  struct Workspace {};
  ReferenceBody reference;
  mechanics::Status acceleration(double t, const Vector& Q, const Vector&, Workspace&, Vector& a) const {
    const Matrix3d P = materials::to_matrix(Law{1, 1.7}.stress(materials::to_tensor(Q)));
    a = -reference.volume * P * reference.E0.inverse() - std::cos(omega * t + phase) * generic_quadratic() * Q;
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
};

TEST(PeriodicTide, MovesTheBodyByItsEquation) {
  for (const auto& reference : {ReferenceBody::unit_ball(), ReferenceBody::ellipsoid({1.4, 0.9, 0.7})}) {
    const auto body = driven<LoadedGl3>(reference);
    const auto start = benchmark_state<LoadedGl3>();
    const auto expected = integrate_samples(DrivenField{reference}, start, 6, 12);
    const auto states = integrate_samples(ExplicitMultiplier(body), body.state_of(start), 6, 12);
    for (std::size_t k = 0; k < states.size(); ++k) EXPECT_LT(distance(body.motion(states[k]), expected[k]), 1e-10);
  }
}

/// Whatever turns and circulates, of both kinds of body: kinetic + elastic + external + dissipated is constant, to the
/// order of the method; external has what the tide has given.
template <class Body>
class DrivenBody : public ::testing::Test {
 protected:
  static constexpr bool incompressible = std::is_same_v<Body, LoadedSl3>;

  template <class Method>
  void expect_order(const reduced::Dissipation& dissipation, const std::vector<long>& counts) {
    const auto body = driven<Body>(ReferenceBody::unit_ball(), dissipation);
    ASSERT_TRUE(Method::accepts(body));
    const auto start = body.state_of(benchmark_state<Body>());
    std::vector<ErrorPoint> points;
    for (const long n : counts) {
      const auto r = run<Method>(body, start, 3.0, 1, n);
      ASSERT_TRUE(r.finished()) << r.result.reason;
      points.push_back(
          {3.0 / static_cast<double>(n), std::abs(observed(body, r.last()).energy() - observed(body, start).energy())});
    }
    const auto fit = fit_order(points);
    EXPECT_GE(fit.n_used, 3u);
    EXPECT_NEAR(fit.order, Method::order, 0.15);
  }
};
using BothBodies = ::testing::Types<LoadedSl3, LoadedGl3>;
TYPED_TEST_SUITE(DrivenBody, BothBodies);

TYPED_TEST(DrivenBody, BalanceOfEnergyHasTheOrderOfTheMethod) {
  this->template expect_order<mechanics::Rattle>({}, {400, 800, 1600, 3200});
  this->template expect_order<mechanics::Rattle4>({}, {400, 800, 1600, 3200});
  this->template expect_order<mechanics::Rattle>({.viscosity = 0.06, .drag = 0.1}, {400, 800, 1600, 3200});
}

TYPED_TEST(DrivenBody, BalanceOfEnergyToRoundOff) {
  for (const reduced::Dissipation& dissipation : {reduced::Dissipation{}, {.viscosity = 0.06, .drag = 0.1}}) {
    const auto body = driven<TypeParam>(ReferenceBody::unit_ball(), dissipation);
    const auto states =
        integrate_samples(ExplicitMultiplier(body), body.state_of(benchmark_state<TypeParam>()), 10, 40);
    const double energy = observed(body, states.front()).energy();
    double change = 0;
    for (const auto& s : states) {
      const auto o = observed(body, s);
      EXPECT_NEAR(o.energy(), energy, 1e-11);
      change = std::max(change, std::abs(o.kinetic + o.elastic + o.dissipated - energy));
    }
    EXPECT_GT(change, 0.1) << "the tide moves the body";
  }
}

TYPED_TEST(DrivenBody, SaysOnWhatItsForceDepends) {
  const auto start = benchmark_state<TypeParam>();
  for (const bool damped : {false, true}) {
    const auto body = driven<TypeParam>(ReferenceBody::unit_ball(),
                                        damped ? reduced::Dissipation{.drag = 0.1} : reduced::Dissipation{});
    EXPECT_TRUE(mechanics::check_declared_dependence(body, body.state_of(start)));
    EXPECT_TRUE(mechanics::time_dependent(body));
    EXPECT_EQ(mechanics::velocity_dependent(body), damped);
    EXPECT_FALSE(mechanics::Symmetric8::accepts(body));
    EXPECT_EQ(bool(mechanics::Rattle4::accepts(body)), !damped);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
