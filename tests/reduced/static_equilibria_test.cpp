/// The pseudo-rigid body at rest (reduced/static_equilibria.h): the landscape against differences; critical points in
/// closed form, all of them, with spectra along Q exp(εX), which needs no multiplier:
///
///   d²V(Q exp(εX))/dε² = D²V(Q)[QX, QX] + DV(Q)[QX²],   tr X = 0.

#include "reduced/static_equilibria.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/dense.h"
#include "support/differences.h"

namespace pseudorigid::testing {
namespace {

using mechanics::CriticalPoint;
using mechanics::CriticalPoints;
using reduced::Dissipation;
using reduced::Potential;
using reduced::ReferenceBody;
using reduced::StaticLandscape;

const ReferenceBody ball = ReferenceBody::unit_ball();
constexpr double ball_m_bar = 4.0 / 15 * std::numbers::pi, ball_volume = 4.0 / 3 * std::numbers::pi;

StaticLandscape neo_hookean_ball(const loads::Forcing& forcing, const Dissipation& dissipation = {}) {
  return {Potential(Law{1, 0}, ball, forcing), ball, dissipation, true};
}

CriticalPoints equilibria(const StaticLandscape& landscape, bool dissipative = false, bool incompressible = true,
                          const Matrix3d& traction = Matrix3d::Zero()) {
  CriticalPoints found;
  const auto status =
      mechanics::find_equilibria(landscape, dissipative, reduced::static_search(incompressible, traction, 300), found);
  EXPECT_TRUE(status) << status.reason();
  return found;
}

/// The neo-Hookean ball, μ = 1, under a dead traction P̄ and a tide T, written out: with ∂V = Vol(Q − P̄) + m̄TQ the
/// second derivative along Q exp(εX), in the metric m̄|QX|².
Eigen::VectorXd exact_spectrum(const Matrix3d& Q, const Matrix3d& P, const Matrix3d& T) {
  std::vector<Matrix3d> basis;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j) basis.push_back(Vector3d::Unit(i) * Vector3d::Unit(j).transpose());
  basis.push_back(diagonal(1, -1, 0));
  basis.push_back(diagonal(0, 1, -1));
  const Matrix3d dV = ball_volume * (Q - P) + ball_m_bar * T * Q;
  Eigen::MatrixXd B(8, 8), M(8, 8);
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b) {
      const Matrix3d QX = Q * basis[a], QY = Q * basis[b];
      const Matrix3d square = 0.5 * Q * (basis[a] * basis[b] + basis[b] * basis[a]);
      B(a, b) = (ball_volume * QX + ball_m_bar * T * QX).cwiseProduct(QY).sum() + dV.cwiseProduct(square).sum();
      M(a, b) = ball_m_bar * QX.cwiseProduct(QY).sum();
    }
  return generalized_eigenvalues(B, M);
}

TEST(StaticLandscape, AgreesWithDifferences) {
  std::mt19937 generator(3);
  const ReferenceBody bodies[] = {ball, ReferenceBody::ellipsoid({1.4, 0.9, 0.7})};
  for (const ReferenceBody& body : bodies)
    for (const auto& [name, law] : laws(true)) {
      SCOPED_TRACE(name);
      const Dissipation dissipation{.viscosity = 0.3, .drag = 0.2};
      const StaticLandscape landscape(
          Potential(
              law, body,
              {.gravity_constant = 0.4, .quadratic = generic_quadratic(), .nominal_traction = generic_traction()}),
          body, dissipation, true);
      const Eigen::VectorXd q = random_deformation(generator).reshaped(), x = random_matrix(generator).reshaped();
      const Eigen::VectorXd lambda = Eigen::VectorXd::Constant(1, 0.7);
      // The gradient of V − Λ ln det Q; differences of order 8 with h = 0.005 as in potential_test.cpp.
      const double h = 0.005;
      const auto lagrangian = [&](int k) {
        const Eigen::VectorXd at = q + k * h * x;
        return landscape.potential(at) - lambda[0] * std::log(StaticLandscape::matrix(at).determinant());
      };
      const auto gradient = [&](int k) {
        Eigen::VectorXd dV;
        Eigen::MatrixXd G;
        const Eigen::VectorXd at = q + k * h * x;
        EXPECT_TRUE(landscape.gradient(at, dV));
        landscape.constraint_gradient(at, G);
        return Eigen::VectorXd(dV - G.transpose() * lambda);
      };
      Eigen::MatrixXd H, C, M;
      ASSERT_TRUE(landscape.hessian(q, lambda, H));
      EXPECT_NEAR(first_difference(lagrangian, h), gradient(0).dot(x), 1e-9 * (1 + gradient(0).norm()));
      EXPECT_LT((first_difference(gradient, h) - H * x).norm(), 1e-9 * (1 + H.norm()));
      ASSERT_TRUE(landscape.damping(q, C));
      Matrix3d force = Matrix3d::Zero();
      const double power = dissipation.add_force(body, StaticLandscape::matrix(q), x.reshaped(3, 3), force);
      EXPECT_NEAR(x.dot(C * x), power, 1e-12 * power);
      landscape.mass(q, M);
      EXPECT_NEAR(x.dot(M * x), (x.reshaped(3, 3) * body.E0 * x.reshaped(3, 3).transpose()).trace(), 1e-13);
    }
}

/// A ball under the dead traction TN, Rivlin's cube: from Q − T = λQ⁻ᵀ the matrix Q is symmetric, and its eigenvalues
/// solve x² − Tx − λ = 0: all are 1, or two of them, y ≠ x, sum to T with x = 1/y²,
///
///   y³ − Ty² + 1 = 0,
///
/// each root a sphere of directions of the third. One root is negative (a body turned by π), the others exist for
/// T > 3/∛4 = 1.8899; Q = Id loses its stability at T = 2.
TEST(Statement_5_8_3, EquilibriaOfABallUnderEqualTension) {
  for (const double T : {1.5, 1.95, 2.5}) {
    SCOPED_TRACE(T);
    std::vector<Matrix3d> exact{Matrix3d::Identity()};
    for (double y = -1.2; y < 3; y += 0.001) {
      const auto cubic = [T](double s) { return s * s * (s - T) + 1; };
      if (cubic(y) * cubic(y + 0.001) >= 0) continue;
      double low = y, high = y + 0.001;
      for (int i = 0; i < 60; ++i) (cubic(low) * cubic(0.5 * (low + high)) <= 0 ? high : low) = 0.5 * (low + high);
      exact.push_back(diagonal(1 / (low * low), low, low));
    }
    EXPECT_EQ(exact.size(), T < 1.88988 ? 2 : 4);
    const Matrix3d P = T * Matrix3d::Identity(), none = Matrix3d::Zero();
    const CriticalPoints found = equilibria(neo_hookean_ball({.nominal_traction = P}));
    EXPECT_EQ(found.points.size(), exact.size());
    for (const Matrix3d& Q : exact) {
      const double V = ball_volume * (0.5 * (Q.squaredNorm() - 3) - T * Q.trace());
      const auto same =
          std::ranges::find_if(found.points, [&](const CriticalPoint& p) { return std::abs(p.V - V) < 1e-10; });
      ASSERT_NE(same, found.points.end()) << Q;
      const Eigen::VectorXd spectrum = exact_spectrum(Q, P, none);
      EXPECT_LT((same->hessian_eigenvalues - spectrum).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_EQ(same->morse_index, (spectrum.array() < -1e-9).count());
      EXPECT_EQ(same->nullity, Q == Matrix3d::Identity() ? 0 : 2) << "directions of the third axis";
      EXPECT_EQ(same->n_unstable, same->morse_index);
    }
    // Rivlin: Id is stable up to 2; beyond 1.8899 the body with two long axes is too, and the one between is a saddle.
    const auto stable = [](const CriticalPoint& p) { return p.morse_index == 0; };
    const auto n_stable = std::ranges::count_if(found.points, stable);
    EXPECT_EQ(n_stable, T < 1.88988 ? 1 : T < 2 ? 2 : 1);
  }
}

/// Under a small dead traction with the principal values T_i the body is nearly rigid: −Vol P̄:R has four critical
/// points on SO(3), R = diag(s₁, s₂, s₃) with s_i = ±1 and det R = 1, and its second derivative about the axis k is
/// Vol(s_iT_i + s_jT_j) (Chillingworth, Marsden and Wan, Arch. Rational Mech. Anal. 80, 1982).
TEST(StaticEquilibria, OfASmallTractionAreFourRotations) {
  const Vector3d T(0.001, 0.002, 0.0035);
  const Matrix3d P = diagonal(T[0], T[1], T[2]);
  const CriticalPoints found = equilibria(neo_hookean_ball({.nominal_traction = P}), false, true, P);
  ASSERT_EQ(found.points.size(), 4);
  std::vector<int> indices;
  for (const CriticalPoint& p : found.points) {
    const Matrix3d Q = StaticLandscape::matrix(p.q);
    const Vector3d s = Q.diagonal().array().sign();
    EXPECT_LT((Q - Matrix3d(s.asDiagonal())).norm(), 0.01);
    int index = 0;
    for (int k = 0; k < 3; ++k) index += s[(k + 1) % 3] * T[(k + 1) % 3] + s[(k + 2) % 3] * T[(k + 2) % 3] < 0;
    EXPECT_EQ(p.morse_index, index);
    EXPECT_EQ(p.nullity, 0);
    indices.push_back(index);
  }
  EXPECT_EQ(indices, (std::vector{0, 1, 2, 3})) << "the Morse inequalities of SO(3) need one of each";
}

/// Dead tractions and tides without symmetry: V rises at large stretches, and three of the four equilibria violate
/// Morse's count. A fluid in a tide that does not hold it falls outwards, and nothing can be said.
TEST(StaticEquilibria, OneThatIsMissingIsNoticed) {
  const Matrix3d P = generic_traction();
  const StaticLandscape landscape = neo_hookean_ball({.quadratic = generic_quadratic(), .nominal_traction = P});
  const CriticalPoints found = equilibria(landscape, false, true, P);
  ASSERT_GE(found.points.size(), 4u);
  EXPECT_TRUE(landscape.rises_at(3));
  EXPECT_FALSE(reduced::misses_equilibria(landscape, found.points));
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    auto points = found.points;
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_TRUE(reduced::misses_equilibria(landscape, points)) << i;
  }
  const StaticLandscape fluid(Potential(materials::Fluid{}, ball, {.quadratic = diagonal(-1, 0.5, 0.7)}), ball, {},
                              true);
  EXPECT_FALSE(fluid.rises_at(3));
  EXPECT_FALSE(reduced::misses_equilibria(fluid, {}));
}

/// One that a body may be turned to without a change of V is degenerate.
TEST(StaticEquilibria, OfASymmetricBodyAreNotCounted) {
  const CriticalPoints found = equilibria(neo_hookean_ball({}));
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_GT(found.points[0].nullity, 0);
  EXPECT_FALSE(reduced::misses_equilibria(neo_hookean_ball({}), found.points));
}

/// The search goes on while it is told that points are missing, and says so at its end.
TEST(StaticEquilibria, AreLookedForWhileOneIsMissing) {
  const Matrix3d P = generic_traction();
  const StaticLandscape landscape = neo_hookean_ball({.nominal_traction = P});
  auto search = reduced::static_search(true, P, 5);
  search.misses_points = [&](const auto& points) { return reduced::misses_equilibria(landscape, points); };
  search.n_starts_at_most = 1000;
  CriticalPoints found;
  ASSERT_TRUE(mechanics::find_critical_points(landscape, search, found));
  EXPECT_FALSE(found.misses_points);
  EXPECT_LT(found.n_starts, 1000);
  search.misses_points = [](const auto&) { return true; };
  search.n_starts_at_most = 17;
  ASSERT_TRUE(mechanics::find_critical_points(landscape, search, found));
  EXPECT_TRUE(found.misses_points);
  EXPECT_EQ(found.n_starts, 17);
}

/// In a tide the neo-Hookean ball has (Vol + m̄T)QQᵀ = λ: one shape, turned within in any way.
TEST(StaticEquilibria, OfATideAreOneShape) {
  const Matrix3d T = diagonal(-1.1, 0.4, 0.9);
  const CriticalPoints found = equilibria(neo_hookean_ball({.quadratic = T}));
  ASSERT_EQ(found.points.size(), 1);
  const Vector3d k = Vector3d::Constant(ball_volume) + ball_m_bar * T.diagonal();
  const double lambda = std::cbrt(k.prod());  // Λ, but for the −Vol ln det Q of the law, which is stress-free at Id
  const Matrix3d Q = StaticLandscape::matrix(found.points[0].q), B = Q * Q.transpose();
  EXPECT_LT((B - Matrix3d((lambda * k.cwiseInverse()).asDiagonal())).norm(), 1e-12);
  EXPECT_NEAR(found.points[0].lambda[0], lambda - ball_volume, 1e-11);
  EXPECT_EQ(found.points[0].nullity, 3) << "turns of the reference ball";
  EXPECT_EQ(found.points[0].morse_index, 0);
  const Eigen::VectorXd exact = exact_spectrum(Q, Matrix3d::Zero(), T);
  EXPECT_LT((found.points[0].hessian_eigenvalues - exact).cwiseAbs().maxCoeff(), 1e-9);
}

/// A compressible ball (Ciarlet–Geymonat) in a pressure keeps its shape: μ(l − 1/l) + (λ/2)(l⁶ − 1)/l + p l² = 0.
TEST(StaticEquilibria, OfACompressibleBallInAPressure) {
  const double lame = 2, p = 0.8;
  const StaticLandscape landscape(Potential(Law{1, lame}, ball, {.pressure = p}), ball, {}, false);
  const CriticalPoints found = equilibria(landscape, false, false);
  const auto stable = std::ranges::find_if(found.points, [](const CriticalPoint& c) { return c.morse_index == 0; });
  ASSERT_NE(stable, found.points.end());
  const Matrix3d Q = StaticLandscape::matrix(stable->q);
  const double l = std::cbrt(Q.determinant());
  EXPECT_LT((Q.transpose() * Q - l * l * Matrix3d::Identity()).norm(), 1e-11);
  EXPECT_NEAR((l - 1 / l) + lame / 2 * (std::pow(l, 6) - 1) / l + p * l * l, 0, 1e-11);
  EXPECT_LT(l, 0.95);
  EXPECT_EQ(stable->nullity, 3) << "turns";
}

/// Saint Venant–Kirchhoff's energy is finite where volumes vanish, and critical at Q = 0: no equilibrium of a body.
TEST(StaticEquilibria, AreNoCollapsedBodies) {
  const Potential V(materials::make_law("saint-venant-kirchhoff", {.lame_lambda = 2}, false), ball);
  const CriticalPoints found = equilibria(StaticLandscape(V, ball, {}, false), false, false);
  ASSERT_GE(found.points.size(), 1);
  for (const CriticalPoint& p : found.points) EXPECT_GT(StaticLandscape::matrix(p.q).determinant(), 1e-8);
}

/// With viscosity and drag the saddles keep the dimension of their unstable manifolds (5.8.3) and the rates decay.
TEST(Statement_5_8_3, HoldsForThePseudoRigidBodyWithViscosityAndDrag) {
  const Matrix3d P = generic_traction();
  const Dissipation dissipation{.viscosity = 0.2, .drag = 0.1};
  const CriticalPoints found = equilibria(neo_hookean_ball({.nominal_traction = P}, dissipation), true);
  const CriticalPoints undamped = equilibria(neo_hookean_ball({.nominal_traction = P}));
  ASSERT_EQ(found.points.size(), undamped.points.size());
  ASSERT_GE(found.points.size(), 4);
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const CriticalPoint& p = found.points[i];
    EXPECT_TRUE(p.obeys_5_8_3());
    EXPECT_EQ(p.morse_index, undamped.points[i].morse_index);
    EXPECT_EQ((p.rates.real().array() > 0).count(), p.morse_index);
    EXPECT_EQ((undamped.points[i].rates.real().array() < -1e-3).count(), p.morse_index) << "undamped, pairs ±z";
  }
}

}  // namespace
}  // namespace pseudorigid::testing
