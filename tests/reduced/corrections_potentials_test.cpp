/// Corrections 8, 9 and 10 of the book (PHYSICS section 2): the potentials of Example 5.7.9 as the program has them,
/// against what the book prints, written here in the invariants of a complex matrix, so that derivatives are exact.

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string_view>
#include <variant>
#include <vector>

#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/dense.h"
#include "support/differences.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix3cd;
using Complex = std::complex<double>;

/// 5.7.9(1) as printed, per m̄: −2πGρ∫₀^∞ ds/√(s³ + I s² + II s + III), with s = x² up to 1 and s = 1/x² from there on.
Complex gravity_by_quadrature(const Matrix3cd& Q, double G_rho) {
  const auto [I, II, III] = invariants(Matrix3cd(Q * Q.transpose()));
  const auto integrand = [&, I = I, II = II, III = III](double x) -> Complex {
    const double s = x * x;
    return 2 * x / std::sqrt(((s + I) * s + II) * s + III) + 2.0 / std::sqrt(1.0 + s * (I + s * (II + s * III)));
  };
  using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
  return -2 * std::numbers::pi * G_rho * Rule::integrate(integrand, 0.0, 1.0, 15, 1e-14);
}

/// The program's self-gravity of the ball of radius r and density ρ, physical.
reduced::Potential potential_of_gravity(double G, double r = 1, double rho = 1) {
  auto ball = reduced::ReferenceBody::ellipsoid({r, r, r});
  ball.mass *= rho;
  ball.E0 *= rho;
  return {materials::Fluid{}, ball, {.gravity_constant = G}};
}
double m_bar_of(double r = 1, double rho = 1) { return 4 * std::numbers::pi / 15 * rho * std::pow(r, 5); }

/// Random ones, and ones with two and three equal axes, exactly and nearly.
std::vector<Matrix3d> sample_deformations() {
  std::mt19937 generator(5791);
  std::vector<Matrix3d> samples;
  for (int i = 0; i < 20; ++i) samples.push_back(random_deformation(generator));
  for (const double gap : {0.0, 1e-15, 1e-12, 1e-8, 1e-4})
    for (const auto& axes : {Vector3d(1, 1, 1 + gap), Vector3d(1.3, 1.3 + gap, 0.6), Vector3d(0.4, 1.7, 1.7 + gap)})
      samples.push_back(random_rotation(generator) * Matrix3d(axes.asDiagonal()) * random_rotation(generator));
  return samples;
}

/// Right as printed: the program's energy and gradient, in Carlson's form, are those of the integral; where axes
/// coincide too, as nothing is divided by their differences.
TEST(Correction_8, SelfGravityInCarlsonsFormIsTheIntegral) {
  const double G = 0.7;
  const reduced::Potential gravity = potential_of_gravity(G);
  for (const Matrix3d& Q : sample_deformations()) {
    const auto V = [&](const Matrix3cd& Z) { return gravity_by_quadrature(Z, G); };
    const double exact = V(Q).real();
    EXPECT_NEAR(gravity.energies(Q).gravitational / m_bar_of(), exact, 1e-13 * std::abs(exact));
    const Matrix3d gradient = derivative(V, Q);
    EXPECT_LT((gravity.gradient(Q) / m_bar_of() - gradient).norm(), 1e-12 * gradient.norm()) << Q;
  }
}

/// "Identity for checks: α₁ + α₂ + α₃ = 2/(a₁a₂a₃)", with ∂V/∂Q = 2πGρ U diag(α)Uᵀ Q of the program.
TEST(Correction_8, SumOfTheCoefficients) {
  const double G = 0.7;
  for (const Matrix3d& Q : sample_deformations()) {
    const Matrix3d alpha =
        potential_of_gravity(G).gradient(Q) * Q.inverse() / (2 * std::numbers::pi * G * m_bar_of());  // U diag(α)Uᵀ
    EXPECT_NEAR(alpha.trace(), 2 / Q.determinant(), 1e-13 * alpha.trace());
    EXPECT_GT(symmetric_spectrum(0.5 * (alpha + alpha.transpose())).values.minCoeff(), 0);
  }
}

/// A formula with divided differences, ∂V/∂I etc. from the axes by Cramer's rule (Remark 5.7.10), is right for
/// different axes and loses everything where two nearly coincide; the program's is right there.
TEST(Correction_8, DividedDifferencesFailNearRepeatedAxes) {
  const auto exact = [](const Matrix3d& A) -> Matrix3d {
    return derivative([](const Matrix3cd& Z) { return gravity_by_quadrature(Z, 1); }, A);
  };
  const auto by_differences = [](const Matrix3d& A) -> Matrix3d {
    const Vector3d a = A.diagonal(), a2 = a.cwiseAbs2();
    const Vector3d slopes =
        0.5 * potential_of_gravity(1).gradient(A).diagonal().cwiseQuotient(a) / m_bar_of();  // ∂V/∂(a_i²)
    Matrix3d D;  // ∂V/∂(a_i²) = Σ_k ∂V/∂I_k ∂I_k/∂(a_i²)
    for (int i = 0; i < 3; ++i) D.row(i) << 1, a2.sum() - a2[i], a2.prod() / a2[i];
    const Vector3d V_k = D.inverse() * slopes;
    const Matrix3d C = A * A;
    return 2 * V_k[0] * A + 2 * V_k[1] * (C.trace() * Matrix3d::Identity() - C) * A +
           2 * V_k[2] * C.determinant() * A.inverse();
  };
  const auto error_of = [&](const Matrix3d& gradient, const Matrix3d& A) {
    return (gradient - exact(A)).norm() / exact(A).norm();
  };
  const Matrix3d apart = diagonal(1.3, 1.6, 0.6), close = diagonal(1.3, 1.3 + 1e-14, 0.6);
  EXPECT_LT(error_of(by_differences(apart), apart), 1e-12);
  EXPECT_FALSE(error_of(by_differences(close), close) < 1e-4);
  EXPECT_LT(error_of(potential_of_gravity(1).gradient(close) / m_bar_of(), close), 1e-12);
}

/// The coefficient, per m̄ with the reference density: a ball that is blown up or compressed to the radius qr has the
/// energy −(3/5)GM²/(qr). The density of the deformed ball would give another power of q.
TEST(Correction_8, CoefficientIsThatOfABall) {
  const double G = 1.3, rho = 0.7, r = 2.5, M = 4 * std::numbers::pi / 3 * rho * std::pow(r, 3);
  for (const double q : {0.5, 1.0, 1.6}) {
    const Matrix3d Q = q * Matrix3d::Identity();
    const double exact = -0.6 * G * M * M / (q * r);
    EXPECT_NEAR(potential_of_gravity(G, r, rho).energies(Q).gravitational, exact, 1e-14 * std::abs(exact));
    EXPECT_NEAR(m_bar_of(r, rho) * gravity_by_quadrature(Q, G * rho).real(), exact, 1e-14 * std::abs(exact));
    const double with_current_density = m_bar_of(r, rho) * gravity_by_quadrature(Q, G * rho / (q * q * q)).real();
    if (q != 1) {
      EXPECT_GT(std::abs(with_current_density / exact - 1), 0.5);
    }
  }
}

constexpr double lambda = 1.3, mu = 0.8;

/// A law of the program's table, with these moduli.
materials::AnyLaw law(std::string_view name) {
  return materials::make_law(name, {.shear_modulus = mu, .lame_lambda = lambda}, false);
}
double energy(const materials::AnyLaw& law, const Matrix3d& F) {
  return std::visit([&](const auto& l) { return l.energy(materials::to_tensor(F)); }, law);
}
Matrix3d stress(const materials::AnyLaw& law, const Matrix3d& F) {
  return materials::to_matrix(std::visit([&](const auto& l) { return l.stress(materials::to_tensor(F)); }, law));
}
/// The program's energy and stress are those of a formula in the invariants.
template <class Formula>
void expect_law(std::string_view name, const Formula& W) {
  std::mt19937 generator(5792);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d F = random_deformation(generator), P = derivative(W, F);
    const double exact = W(Matrix3cd(F)).real();
    EXPECT_NEAR(energy(law(name), F), exact, 1e-13 * (1 + std::abs(exact))) << name;
    EXPECT_LT((stress(law(name), F) - P).norm(), 1e-13 * (1 + P.norm())) << name;
  }
}

/// λ and μ of P = 2μ sym H + λ tr H Id at small strains, from the program's stress along E₁₁ and E₁₂.
struct Moduli {
  double lambda, mu;
};
Moduli small_strain_moduli(std::string_view name) {
  const double h = 1e-3;
  const auto slope = [&](int j) {
    return first_difference(
        [&](int k) {
          Matrix3d F = Matrix3d::Identity();
          F(0, j) += k * h;
          return stress(law(name), F);
        },
        h);
  };
  return {slope(0)(1, 1), slope(1)(0, 1)};
}

/// (bulk)(III − 1 − ln III) + (μ/2)(I − 3 − ln III): λ/4 is standard, λ/2 printed.
auto ciarlet_geymonat(double bulk) {
  return [bulk](const Matrix3cd& F) -> Complex {
    const auto [I, II, III] = invariants(Matrix3cd(F * F.transpose()));
    return bulk * (III - 1.0 - std::log(III)) + mu / 2 * (I - 3.0 - std::log(III));
  };
}

/// Right: λ/4, which makes λ and μ Lamé's moduli at small strains; the program's law is that one. The printed λ/2
/// doubles the bulk term, and is offered by that name.
TEST(Correction_9, PrintedCiarletGeymonatLawDoublesLamesLambda) {
  expect_law("ciarlet-geymonat", ciarlet_geymonat(lambda / 4));
  expect_law("ciarlet-geymonat (as printed)", ciarlet_geymonat(lambda / 2));
  const auto right = small_strain_moduli("ciarlet-geymonat");
  EXPECT_NEAR(right.lambda, lambda, 1e-12);
  EXPECT_NEAR(right.mu, mu, 1e-12);
  const auto printed = small_strain_moduli("ciarlet-geymonat (as printed)");
  EXPECT_NEAR(printed.lambda, 2 * lambda, 1e-12);
  EXPECT_NEAR(printed.mu, mu, 1e-12);
}

/// W = (λ/8)(I − 3)² + (μ/4)(I² − 2II − 2I + 3)
Complex saint_venant_kirchhoff(const Matrix3cd& F) {
  const auto [I, II, III] = invariants(Matrix3cd(F * F.transpose()));
  return lambda / 8 * (I - 3.0) * (I - 3.0) + mu / 4 * (I * I - 2.0 * II - 2.0 * I + 3.0);
}
/// 5.7.9(3): ½λ(tr(C − Id))² + μ tr(C − Id)
Complex saint_venant_kirchhoff_as_printed(const Matrix3cd& F) {
  const Complex trace = (F * F.transpose()).trace() - 3.0;
  return lambda / 2 * trace * trace + mu * trace;
}

/// Right: W = (λ/2)(tr E)² + μ tr E² with Green's strain E = ½(FᵀF − Id), written in the invariants; at Id no stress,
/// and Lamé's moduli. As printed, Id is under the stress 2μ Id.
TEST(Correction_10, PrintedSaintVenantKirchhoffLawIsStressedAtRest) {
  expect_law("saint-venant-kirchhoff", saint_venant_kirchhoff);
  expect_law("saint-venant-kirchhoff (as printed)", saint_venant_kirchhoff_as_printed);
  std::mt19937 generator(5793);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d F = random_deformation(generator), E = 0.5 * (F.transpose() * F - Matrix3d::Identity());
    const double W = lambda / 2 * E.trace() * E.trace() + mu * (E * E).trace();
    EXPECT_NEAR(energy(law("saint-venant-kirchhoff"), F), W, 1e-13 * (1 + W));
  }
  EXPECT_LT(stress(law("saint-venant-kirchhoff"), Matrix3d::Identity()).norm(), 1e-15);
  const auto moduli = small_strain_moduli("saint-venant-kirchhoff");
  EXPECT_NEAR(moduli.lambda, lambda, 1e-12);
  EXPECT_NEAR(moduli.mu, mu, 1e-12);

  const Matrix3d printed = stress(law("saint-venant-kirchhoff (as printed)"), Matrix3d::Identity());
  EXPECT_LT((printed - 2 * mu * Matrix3d::Identity()).norm(), 1e-14);
}

/// "Loses stability in compression": under a stretch a < 1/√3 in one direction less force is needed for more
/// compression; Ciarlet–Geymonat's law hardens.
TEST(Correction_10, SaintVenantKirchhoffLawSoftensInCompression) {
  const auto stiffness = [](std::string_view name, double a) {
    return first_difference([&](int k) { return stress(law(name), diagonal(a + k * 1e-3, 1, 1))(0, 0); }, 1e-3);
  };
  const double limit = 1 / std::sqrt(3.0);
  EXPECT_GT(stiffness("saint-venant-kirchhoff", 1.02 * limit), 0);
  EXPECT_LT(stiffness("saint-venant-kirchhoff", 0.98 * limit), 0);
  for (const double a : {0.9, 0.5, 0.1}) EXPECT_GT(stiffness("ciarlet-geymonat", a), lambda / 2 + mu);
}

}  // namespace
}  // namespace pseudorigid::testing
