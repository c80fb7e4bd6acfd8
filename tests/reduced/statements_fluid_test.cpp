/// Remark 5.7.12 of Oliva, Geometric Mechanics: with the gravitational potential, (5.120) and (5.121) are the equations
/// of Dirichlet and Riemann for a self-gravitating fluid. Units with πGρ = 1, r = 1.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "reduced/bipolar_path.h"
#include "reduced/carlson_gravity.h"
#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

constexpr double G_rho = fluid_time_G;

/// The program's fluid: law none under self-gravity, with its explicit multiplier.
LoadedSl3 self_gravitating_fluid() { return fluid_sl3({G_rho}); }

/// "(5.121) is precisely the Dirichlet–Riemann equation": its right side is −2πGρα_i a_i + λ/a_i with λ = 2p_c/(ρr²)
/// (correction 11) and α_i by another library, along a motion with spin and circulation.
TEST(Statement_5_7_12, GravityGivesTheEquationOfDirichletAndRiemann) {
  const double h = 0.01;
  const int n = 400, margin = 8;
  const auto states = integrate_samples(self_gravitating_fluid(), benchmark_state<Sl3>(), n * h, n, 1e-14);
  std::vector<Matrix3d> Q;
  for (const auto& s : states) Q.push_back(s.q);
  const BipolarPath path(Q, h);
  double residual = 0;
  int n_samples = 0;
  for (int k = margin; k + margin <= n; k += 5) {
    if (path.least_gap(k) < 0.2) continue;
    const Vector3d a = path.A[k].diagonal(), alpha = gravity_coefficients(a.cwiseAbs2());
    const double lambda = 2 * observed(self_gravitating_fluid(), states[k]).central_pressure;
    const Vector3d right = -2 * std::numbers::pi * G_rho * alpha.cwiseProduct(a) + lambda * a.cwiseInverse();
    residual = std::max(residual, (path.acceleration(k) - Matrix3d(right.asDiagonal())).norm());
    ++n_samples;
  }
  EXPECT_GT(n_samples, 20);
  EXPECT_LT(residual, 1e-8);  // differences twice: 1e-14/gap over h² (seen 3e-10)
}

/// Of Q̈ of the fluid from that of Q = exp(tΩ×) A exp(−tΛ×): a figure A that turns about axis 3, with inner motion.
double departure_from_steady_motion(const Matrix3d& A, double Omega, double Lambda) {
  const Matrix3d turn = hat({0, 0, Omega}), inner = hat({0, 0, Lambda}), Qdot = turn * A - A * inner;
  const Matrix3d exact = turn * turn * A - 2 * turn * A * inner + A * inner * inner;
  const auto field = self_gravitating_fluid();
  auto w = field.make_workspace();
  Matrix3d a = Matrix3d::Zero();
  EXPECT_TRUE(field.acceleration(0, A, Qdot, w, a));
  return (a - exact).norm();
}

/// Maclaurin: Ω²/πGρ = 2√(1−e²)(3−2e²) asin(e)/e³ − 6(1−e²)/e².
TEST(Statement_5_7_12, MaclaurinSpheroidsTurnSteadily) {
  for (const double e : {0.3, 0.5, 0.812670011, 0.929955685, 0.99}) {
    const double flat = std::sqrt(1 - e * e), e2 = e * e;
    const double square = 2 * flat * (3 - 2 * e2) * std::asin(e) / (e2 * e) - 6 * (1 - e2) / e2;
    const Matrix3d A = diagonal(1, 1, flat) / std::cbrt(flat);
    EXPECT_LT(departure_from_steady_motion(A, std::sqrt(square), 0), 1e-12) << "e = " << e;
    EXPECT_LT(departure_from_steady_motion(A, 0, std::sqrt(square)), 1e-12) << "its Dedekind dual";
    EXPECT_GT(departure_from_steady_motion(A, 1.1 * std::sqrt(square), 0), 1e-3);
  }
}

/// Jacobi, a₂/a₁ = 0.8: a₃/a₁ = 0.517216, Ω² = 0.366837 πGρ, and Dedekind's ellipsoid of the same shape.
TEST(Statement_5_7_12, JacobiAndDedekindEllipsoids) {
  const Matrix3d A = diagonal(1, 0.8, 0.517216) / std::cbrt(0.8 * 0.517216);
  const double Omega = std::sqrt(0.366837);
  EXPECT_LT(departure_from_steady_motion(A, Omega, 0), 3e-6) << "six digits";
  EXPECT_LT(departure_from_steady_motion(A, 0, Omega), 3e-6);
  EXPECT_GT(departure_from_steady_motion(A, 1.01 * Omega, 0), 1e-3);
}

/// Riemann's ellipsoids of type S: Ω² + Λ² = 2πGρB₁₂, ΩΛa₁a₂ = πGρ(a₃²A₃ − a₁²a₂²A₁₂), with A_i = α_i,
/// A₁₂ = (A₂ − A₁)/(a₁² − a₂²), B₁₂ = A₂ − a₁²A₁₂ (Chandrasekhar).
TEST(Statement_5_7_12, RiemannEllipsoidsOfTypeS) {
  for (const auto& [a1, a2] : {std::pair{1.3, 0.9}, std::pair{1.1, 1.05}, std::pair{1.4, 1.2}}) {
    const Vector3d a(a1, a2, 1 / (a1 * a2)), a_squared = a.cwiseAbs2(), A = gravity_coefficients(a_squared);
    const double A_12 = (A[1] - A[0]) / (a_squared[0] - a_squared[1]), B_12 = A[1] - a_squared[0] * A_12;
    const double squares = 2 * B_12;
    const double product = (a_squared[2] * A[2] - a_squared[0] * a_squared[1] * A_12) / (a1 * a2);
    ASSERT_GT(squares, 2 * std::abs(product)) << "there is such an ellipsoid";
    const double sum = std::sqrt(squares + 2 * product), difference = std::sqrt(squares - 2 * product);
    const double Omega = (sum + difference) / 2, Lambda = (sum - difference) / 2;
    EXPECT_LT(departure_from_steady_motion(a.asDiagonal(), Omega, Lambda), 1e-12);
    EXPECT_LT(departure_from_steady_motion(a.asDiagonal(), Lambda, Omega), 1e-12) << "its dual";
    EXPECT_GT(departure_from_steady_motion(a.asDiagonal(), Omega, -Lambda), 1e-3);
  }
}

/// Periods of the pulsation from rest at the axis ℓ₀ (one degree of freedom, by quadrature): the fluid comes back.
TEST(Statement_5_7_12, PeriodsOfThePulsation) {
  for (const auto& [l, period] :
       {std::pair{1.1, 6.1075949317888}, std::pair{1.5, 6.5285414433944}, std::pair{2.0, 7.4368532918857}}) {
    const auto start = stretched(l), end = integrate(self_gravitating_fluid(), start, period, 1e-14);
    EXPECT_LT(distance(start, end), 3e-13) << "ℓ₀ = " << l << ", the period to its 14 digits";
    EXPECT_GT(distance(start, integrate(self_gravitating_fluid(), start, period / 2)), 0.1);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
