/// The follower pressure −p n per current area: what it does to a compressible body, and that it only shifts the
/// multiplier of one that keeps its volume.

#include "loads/pressure.h"

#include <gtest/gtest.h>

#include <numbers>

#include "loads/list.h"
#include "mechanics/core/explicit_multiplier.h"
#include "reduced/equilibrium_families.h"
#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

using reduced::Potential;
using reduced::ReferenceBody;

constexpr double p = 0.35, mu = 1, lambda = 3;

LoadedGl3 pressed_ball() {
  return {Potential(Law{mu, lambda}, ReferenceBody::unit_ball(), loads::Pressure{p}.forcing()),
          ReferenceBody::unit_ball()};
}

/// −∮(p n)·HX da over the surface of QB, with Nanson's n da = cof Q N dA, by quadrature on the sphere.
TEST(Pressure, IsTheIntegralOverTheCurrentSurface) {
  std::mt19937 generator(1);
  const Potential V(materials::Fluid{}, ReferenceBody::unit_ball(), loads::Pressure{p}.forcing());
  const Matrix3d Q = random_deformation(generator), H = random_matrix(generator);
  const Matrix3d cofactor = Q.determinant() * Q.inverse().transpose();
  // A quadratic of N on the sphere has the mean over the six directions ±e_i.
  double work = 0;
  for (int i = 0; i < 3; ++i)
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d N = sign * Vector3d::Unit(i);
      work -= 4 * std::numbers::pi / 6 * p * (cofactor * N).dot(H * N);
    }
  EXPECT_NEAR(-mechanics::dot(V.gradient(Q), H), work, 1e-14);
  EXPECT_NEAR(V.energies(Q).external, p * 4 * std::numbers::pi / 3 * Q.determinant(), 1e-14);
  EXPECT_FALSE(V.depends_on_direction());
}

/// W(a Id) of the law: W′ = 3μ(a − 1/a) + (3λ/2)(a⁵ − 1/a).
double slope(double a) { return 3 * mu * (a - 1 / a) + 1.5 * lambda * (std::pow(a, 5) - 1 / a); }
double curvature(double a) { return 3 * mu * (1 + 1 / (a * a)) + 1.5 * lambda * (5 * std::pow(a, 4) + 1 / (a * a)); }

/// The ball rests at W′ + 3p a² = 0, and breathes about it with 3m̄ω² = Vol (W″ + 6p a).
TEST(Pressure, CompressesTheBallAndChangesItsBreathing) {
  double a = 1;
  for (int i = 0; i < 50; ++i) a -= (slope(a) + 3 * p * a * a) / (curvature(a) + 6 * p * a);
  ASSERT_LT(a, 0.98);
  const auto body = pressed_ball();
  const Matrix3d rest = a * Matrix3d::Identity();
  EXPECT_LT(body.energy_density().gradient(rest).norm(), 1e-14);

  const double volume = 4 * std::numbers::pi / 3;
  const double omega = std::sqrt(volume * (curvature(a) + 6 * p * a) / (3 * body.m_bar()));
  const double small = 1e-6, quarter = std::numbers::pi / (2 * omega);
  const auto end = integrate(body, moving<LoadedGl3>((a + small) * Matrix3d::Identity(), Matrix3d::Zero()), quarter);
  EXPECT_LT((end.q - rest).norm(), 10 * small * small);
  EXPECT_LT((end.v + small * omega * Matrix3d::Identity()).norm(), 100 * small * small);
}

/// A large breathing, by its own equation 3m̄ ä = −Vol (W′ + 3p a²).
struct Breathing {
  using Vector = Eigen::Matrix<double, 1, 1>;
  struct Workspace {};
  mechanics::Status acceleration(double, const Vector& a, const Vector&, Workspace&, Vector& result) const {
    result[0] = -(4 * std::numbers::pi / 3) * (slope(a[0]) + 3 * p * a[0] * a[0]) / (3 * 4 * std::numbers::pi / 15);
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
};

TEST(Pressure, BreathesAsTheRadiusAlone) {
  const mechanics::VectorState<Breathing::Vector> start{0, Breathing::Vector(1.2), Breathing::Vector(0.0)};
  const auto radii = integrate_samples(Breathing{}, start, 4, 20);
  const auto body = pressed_ball();
  const auto states = integrate_samples(body, moving<LoadedGl3>(1.2 * Matrix3d::Identity(), Matrix3d::Zero()), 4, 20);
  for (std::size_t k = 0; k < states.size(); ++k)
    EXPECT_LT((states[k].q - radii[k].q[0] * Matrix3d::Identity()).norm(), 1e-10);
  EXPECT_GT(std::abs(radii[3].q[0] - 1.2), 0.1);
}

/// Relative equilibria know the pressure: a compressible ball that spins under it keeps its figure.
TEST(Pressure, IsPartOfRelativeEquilibria) {
  const auto body = pressed_ball();
  const reduced::IsotropicBody<Potential> isotropic{body.energy_density(), body.m_bar(), false};
  const auto family = reduced::spheroids_of_spin(isotropic, {0.3, 0.9, 3});
  ASSERT_EQ(family.points.size(), 3u);
  for (const auto& point : family.points) {
    EXPECT_LT(point.residual, 1e-13);
    const auto start = moving<LoadedGl3>(point.motion.A, point.motion.co_moving_velocity());
    const auto end = integrate(body, start, 3.0);
    EXPECT_LT((observed(body, end).semi_axes - observed(body, start).semi_axes).norm(), 1e-11);
    EXPECT_GT((end.q - start.q).norm(), 0.1);
  }
}

/// On SL(3) p Vol cof Q is the reaction of λ = p Vol/m̄: the motion is that without, and loads::at_constant_volume
/// leaves the pressure out.
TEST(Pressure, ShiftsTheMultiplierAndNothingElse) {
  std::mt19937 generator(2);
  for (const auto& reference : {ReferenceBody::unit_ball(), ReferenceBody::ellipsoid({1.4, 0.9, 0.7})}) {
    const LoadedSl3 free{Potential(Law{mu, 0}, reference), reference},
        pressed{Potential(Law{mu, 0}, reference, loads::Pressure{p}.forcing()), reference};
    const auto s = random_unimodular_state(generator);
    LoadedSl3::Workspace w;
    Matrix3d a = free.make_vector(), b = a;
    ASSERT_TRUE(free.acceleration(0, s.q, s.v, w, a));
    ASSERT_TRUE(pressed.acceleration(0, s.q, s.v, w, b));
    EXPECT_LT((a - b).norm(), 1e-13 * (1 + a.norm()));
    const double shift = observed(pressed, s).multiplier - observed(free, s).multiplier;
    EXPECT_NEAR(shift, p * reference.volume / pressed.m_bar(), 1e-12);
  }
  const loads::BodyFacts ball{.incompressible = true, .volume_by_inertia = 5};
  EXPECT_NE(loads::Pressure{p}.needed(ball).find("the multiplier 1.75 higher"), std::string::npos);
  EXPECT_FALSE(loads::constant_forcing(loads::at_constant_volume({loads::Pressure{p}})).present());
}

}  // namespace
}  // namespace pseudorigid::testing
