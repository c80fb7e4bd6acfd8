/// Statements of Oliva, Geometric Mechanics, 5.7.1–5.7.11: kinematics of the pseudo-rigid body, its law of motion and
/// the invariants. Those about the bipolar decomposition along a path are in statements_bipolar_test.cpp.

#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "mechanics/core/explicit_multiplier.h"
#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/dense.h"
#include "support/differences.h"
#include "support/integrate.h"
#include "support/reaction.h"
#include "support/round_off.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix3cd;

/// "Any real matrix G has a (non unique) bipolar decomposition G = LDR, D = diag(√σ_i), σ_i the eigenvalues of GᵀG in
/// falling order": whatever L and R are, improper ones too, the semi-axes of the program are D.
TEST(Statement_5_7_1, BipolarDecomposition) {
  std::mt19937 generator(571);
  for (const Vector3d& axes : {Vector3d(2, 1, 0.5), Vector3d(1.5, 1.5, 0.4), Vector3d(1, 1, 1), Vector3d(3, 2, 0),
                               Vector3d(1, 0, 0), Vector3d(0, 0, 0), Vector3d(1e3, 1, 1e-9)})
    for (const double sign : {1, -1}) {
      const Matrix3d L = random_rotation(generator), R = sign * random_rotation(generator);
      const Matrix3d G = L * axes.asDiagonal() * R;
      const Vector3d D = mechanics::singular_values(G);
      EXPECT_LT((D - axes).norm(), 1e-15 * 3 * axes[0] + 1e-300) << axes.transpose();
      const Vector3d sigma = symmetric_spectrum(G.transpose() * G).values;
      EXPECT_LT((D.cwiseAbs2().reverse() - sigma).norm(), 1e-14 * axes[0] * axes[0] + 1e-300);
    }
}

/// "It is non unique": repeated axes leave L free, and signs may be moved between L and R.
TEST(Statement_5_7_1, BipolarDecompositionIsNotUnique) {
  std::mt19937 generator(1571);
  const Matrix3d D = diagonal(1.5, 1.5, 0.4), L = random_rotation(generator), R = random_rotation(generator);
  const Matrix3d turn = rotation_z(0.8), flip = diagonal(-1, 1, -1), G = L * D * R;
  EXPECT_LT((L * turn * D * turn.transpose() * R - G).norm(), round_off);
  EXPECT_LT((L * flip * D * flip * R - G).norm(), round_off);
  EXPECT_GT((L * turn - L).norm(), 0.5);
}

/// "E₀ = ρ∫XXᵀdV = (4/15)πρr⁵ Id = m̄ Id."
TEST(Statement_5_7_2, SecondMomentOfTheBall) {
  for (const auto& [r, rho] : {std::pair{1.0, 1.0}, std::pair{2.5, 0.7}}) {
    const Matrix3d E0 = rho * integral_over_ball(r, [](const Vector3d& X) -> Matrix3d { return X * X.transpose(); });
    const double m_bar = 4 * std::numbers::pi / 15 * rho * std::pow(r, 5);
    EXPECT_LT((E0 - m_bar * Matrix3d::Identity()).norm(), 1e-14 * m_bar);
    if (r == 1 && rho == 1) {
      EXPECT_LT((E0 - neo_hookean_sl3().E0()).norm(), 1e-15);
    }
  }
  EXPECT_NEAR(neo_hookean_sl3().m_bar(), 4 * std::numbers::pi / 15, 1e-16);
  const double volume = integral_over_ball(1, [](const Vector3d&) { return 1.0; });
  EXPECT_NEAR(volume, reduced::ReferenceBody::unit_ball().volume, 1e-15 * 10);
}

/// "½ρ∫|Q̇X|²dV = ½ tr(Q̇E₀Q̇ᵀ)" (5.116), for the ball and for a reference ellipsoid SB with E₀ = det S S(m̄ Id)Sᵀ.
TEST(Statement_5_7_3, KineticEnergy) {
  std::mt19937 generator(573);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d S = i == 0 ? Matrix3d(Matrix3d::Identity()) : random_deformation(generator);
    auto reference = reduced::ReferenceBody::unit_ball();
    reference.E0 = S.determinant() * S * reference.E0 * S.transpose();
    const Matrix3d Qdot = random_matrix(generator);
    const double K =
        0.5 * S.determinant() * integral_over_ball(1, [&](const Vector3d& Y) { return (Qdot * S * Y).squaredNorm(); });
    EXPECT_NEAR(Gl3(Law{1, 1}, reference).kinetic_energy(Qdot), K, round_off * K);
    if (i == 0) {
      EXPECT_NEAR(0.5 * neo_hookean_sl3().m_bar() * Qdot.squaredNorm(), K, round_off * K);  // (5.117)
    }
  }
}

/// "div u = tr(Q̇Q⁻¹) = (det Q)˙/det Q": the flux of u = Q̇Q⁻¹x out of the ellipsoid, with n dA = cof Q N dA₀, is its
/// volume times the divergence; the program's rate of ln det Q is that divergence.
TEST(Statement_5_7_6, DivergenceOfTheVelocityField) {
  std::mt19937 generator(576);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d Q = random_deformation(generator), Qdot = random_matrix(generator);
    const Matrix3d cofactor = Q.determinant() * Q.inverse().transpose();
    const double flux = integral_over_sphere([&](const Vector3d& N) { return (Qdot * N).dot(cofactor * N); });
    const double div = flux / (4 * std::numbers::pi / 3 * Q.determinant());
    double rate = 0;
    neo_hookean_sl3().constraint_rate(Q, Qdot, rate);
    EXPECT_NEAR(rate, div, round_off * (1 + std::abs(div)));
    EXPECT_NEAR((Qdot * Q.inverse()).trace(), div, round_off * (1 + std::abs(div)));
    const double det_rate = differential([](const Matrix3cd& Z) { return Z.determinant(); }, Q, Qdot);
    EXPECT_NEAR(det_rate / Q.determinant(), div, round_off * (1 + std::abs(div)));
  }
}

/// "Q_t is a curve in SL(3)": the constraint keeps det Q = 1; without it the volume changes.
TEST(Statement_5_7_6, IncompressibleMotionsStayInSl3) {
  const auto r = run<mechanics::Rattle4>(neo_hookean_sl3(), large_motion(), 5, 100, 10);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (const auto& s : r.states) ASSERT_NEAR(s.q.determinant(), 1, 1e-14);
  const auto start = moving<Gl3>(large_motion().q, large_motion().v);
  const auto free = run<mechanics::Rattle4>(neo_hookean_gl3(), start, 5, 100, 10);
  ASSERT_TRUE(free.finished()) << free.result.reason;
  double departure = 0;
  for (const auto& s : free.states) departure = std::max(departure, std::abs(s.q.determinant() - 1));
  EXPECT_GT(departure, 0.1);
}

/// (5.120) "Q̈ = −∂V/∂Q + λ ∂f/∂Q, det Q = 1" along computed motions, Q̈ by differences of the positions and λ by the
/// explicit multiplier, for E₀ = m̄ Id and for general E₀ (Q̈E₀ = −∂V + λQ⁻ᵀ; here all per m̄). The positions are
/// those of RATTLE, which uses no accelerations.
TEST(Statement_5_7_7, MotionsObeyTheLawWithTheExplicitMultiplier) {
  const double h = 0.02;
  for (const auto& reference : {reduced::ReferenceBody::unit_ball(), triaxial_inertia()}) {
    const Sl3 body(Law{1, 0}, reference);
    const Matrix3d inertia = (reference.E0 / body.m_bar()).inverse();
    const auto V = potential_per_m_bar(body);
    const auto r = run<mechanics::Rattle8>(body, benchmark_state<Sl3>(), 4, 200, 4);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    double residual = 0;
    for (int k = 4; k + 4 <= 200; k += 3) {
      const Matrix3d Qddot = second_difference([&](int j) -> Matrix3d { return r.states[k + j].q; }, h);
      const Matrix3d Q = r.states[k].q, Qi = Q.inverse(), L = Qi * r.states[k].v, dV = derivative(V, Q);
      const double lambda = ((L * L).trace() + (Qi * dV * inertia).trace()) / (Qi * Qi.transpose() * inertia).trace();
      residual = std::max(residual, (Qddot - (lambda * Qi.transpose() - dV) * inertia).norm());
    }
    // Q̈ ~ 10; 1e-15 of positions over h², and h⁸Q⁽¹⁰⁾/3150.
    EXPECT_LT(residual, 1e-9);
  }
}

/// D'Alembert's principle after (5.119): the reaction λdf does no work on the tangent vectors QL, tr L = 0, and any
/// force with that property is a multiple of it.
TEST(Statement_5_7_7, ReactionSatisfiesDAlembertsPrinciple) {
  std::mt19937 generator(577);
  for (const auto& reference : {reduced::ReferenceBody::unit_ball(), triaxial_inertia()}) {
    const Sl3 body(Law{1, 0}, reference);
    for (int i = 0; i < 20; ++i) {
      const auto s = random_unimodular_state(generator);
      Sl3::Workspace w;
      Matrix3d R;
      ASSERT_TRUE(mechanics::reaction_from_multiplier(body, s, w, R));
      Eigen::Matrix<double, 9, 8> tangent;
      for (int k = 0; k < 8; ++k) {
        Matrix3d L = Matrix3d::Zero();
        if (k < 6) L(k / 2, (k / 2 + 1 + k % 2) % 3) = 1;
        if (k >= 6) L(0, 0) = 1, L(k - 5, k - 5) = -1;
        tangent.col(k) = Matrix3d(s.q * L).reshaped();
      }
      EXPECT_LT((tangent.transpose() * R.reshaped()).norm(), round_off * R.norm() * tangent.norm());
      EXPECT_GT(singular_values(tangent)[7], 1e-3) << "eight independent directions: only one is left for R";
    }
  }
}

/// 5.7.8 I: "If f = det Q, then df_Q(B) = (det Q) tr(Q⁻¹B)."
TEST(Statement_5_7_8, I_DifferentialOfTheDeterminant) {
  std::mt19937 generator(5781);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d Q = random_deformation(generator), B = random_matrix(generator);
    const double df = differential([](const Matrix3cd& Z) { return Z.determinant(); }, Q, B);
    EXPECT_NEAR(df, Q.determinant() * (Q.inverse() * B).trace(), round_off * 10);
  }
}

/// 5.7.8 II: "∂φ/∂Q = [dφ_Q(B_ij)]": the force of the program is that matrix of −V, and dV(B) = tr(∂V/∂Q Bᵀ).
TEST(Statement_5_7_8, II_MatrixOfPartialDerivatives) {
  std::mt19937 generator(5782);
  const Gl3 body = neo_hookean_gl3();
  const auto V = potential_per_m_bar(body);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d Q = random_deformation(generator), B = random_matrix(generator);
    Gl3::Workspace w;
    Matrix3d f = Matrix3d::Zero();
    ASSERT_TRUE(body.force(0, Q, Matrix3d::Zero(), w, f));
    const Matrix3d dV = derivative(V, Q);
    EXPECT_LT((f / body.m_bar() + dV).norm(), round_off * dV.norm());
    EXPECT_NEAR(differential(V, Q, B), (dV * B.transpose()).trace(), round_off * dV.norm() * B.norm());
  }
}

/// Q = TᵀAS with random rotations.
struct Bipolar {
  Matrix3d T, A, S;
  Matrix3d Q() const { return T.transpose() * A * S; }
};
Bipolar random_bipolar(std::mt19937& generator) {
  return {random_rotation(generator), mechanics::singular_values(random_deformation(generator)).asDiagonal(),
          random_rotation(generator)};
}

/// 5.7.8 III: "T ∂(det Q)/∂Q Sᵀ = A⁻¹(det A) for any Q = TᵀAS."
TEST(Statement_5_7_8, III_GradientOfTheDeterminantInThePrincipalAxes) {
  std::mt19937 generator(5783);
  for (int i = 0; i < 50; ++i) {
    const Bipolar b = random_bipolar(generator);
    const Matrix3d gradient = derivative([](const Matrix3cd& Z) { return Z.determinant(); }, b.Q());
    EXPECT_LT((b.T * gradient * b.S.transpose() - b.A.determinant() * b.A.inverse()).norm(), round_off * 10);
  }
}

/// 5.7.8 IV: "If V(TᵀAS) = V̄(A), then T ∂V/∂Q Sᵀ = ∂V̄/∂A", diagonal.
TEST(Statement_5_7_8, IV_GradientOfAnIsotropicPotentialInThePrincipalAxes) {
  std::mt19937 generator(5784);
  const auto V = potential_per_m_bar(neo_hookean_gl3());
  for (int i = 0; i < 50; ++i) {
    const Bipolar b = random_bipolar(generator);
    EXPECT_NEAR(V(b.Q()).real(), V(b.A).real(), round_off * 10);
    const Matrix3d dV_bar = derivative(V, b.A).diagonal().asDiagonal();
    EXPECT_LT((b.T * derivative(V, b.Q()) * b.S.transpose() - dV_bar).norm(), round_off * (1 + dV_bar.norm()));
  }
}

/// 5.7.8 IV needs V to depend on A alone: the gradient of |Q − Id|² is not diagonal in the principal axes.
TEST(Statement_5_7_8, IV_FailsForAPotentialThatDependsOnTheTurns) {
  std::mt19937 generator(5785);
  const Bipolar b = random_bipolar(generator);
  Matrix3d g = 2 * b.T * (b.Q() - Matrix3d::Identity()) * b.S.transpose();
  g.diagonal().setZero();
  EXPECT_GT(g.norm(), 0.1);
}

/// 5.7.11: "∂I/∂Q = 2Q, ∂II/∂Q = 2[Id tr C − C]Q, ∂III/∂Q = 2 det C Q⁻ᵀ" with C = QQᵀ (not QᵀQ, in ∂II).
TEST(Statement_5_7_11, DerivativesOfTheInvariants) {
  std::mt19937 generator(5711);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d Q = random_deformation(generator), C = Q * Q.transpose(), Id = Matrix3d::Identity();
    const std::array<Matrix3d, 3> expected{2 * Q, 2 * (C.trace() * Id - C) * Q,
                                           2 * C.determinant() * Q.inverse().transpose()};
    for (int k = 0; k < 3; ++k) {
      const Matrix3d d = derivative([k](const Matrix3cd& Z) { return invariants(Matrix3cd(Z * Z.transpose()))[k]; }, Q);
      EXPECT_LT((d - expected[k]).norm(), round_off * expected[k].norm()) << k;
    }
    const Matrix3d of_other_C = 2 * (C.trace() * Id - Q.transpose() * Q) * Q;
    EXPECT_GT((of_other_C - expected[1]).norm(), 1e-3 * expected[1].norm());
  }
}

/// ∫₀^∞ s^k (s³ + I s² + II s + III)^{−3/2} ds, with s = x² up to 1 and s = 1/x² from there on.
double gravity_integral(int k, const std::array<double, 3>& I) {
  const auto integrand = [&](double x) {
    const double s = x * x, low = ((s + I[0]) * s + I[1]) * s + I[2], high = 1 + s * (I[0] + s * (I[1] + s * I[2]));
    return 2 * x * std::pow(s, k) / std::pow(low, 1.5) + 2 * std::pow(x, 6 - 2 * k) / std::pow(high, 1.5);
  };
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(integrand, 0.0, 1.0, 15, 1e-14);
}

/// Remark 5.7.10: ∂V/∂Q = Σ ∂V̄/∂I_k ∂I_k/∂Q, with ∂V̄/∂I, ∂V̄/∂II, ∂V̄/∂III of the Mooney–Rivlin law per unit volume,
/// W = (μ/2)[(1−b)(I−3) + b(II−3)] − (μ/2)(1+b) ln III + (λ/4)(III − 1 − ln III), and of gravity, 5.7.9(1): the force
/// of the program's body.
TEST(Statement_5_7_10, GradientByTheInvariants) {
  constexpr double mu = 0.8, lambda = 1.3, b = 0.3, G = 0.7;
  const auto body = loaded_body<LoadedGl3>(materials::MooneyRivlin{mu, lambda, b}, {G});
  const double volume = body.reference().volume;
  std::mt19937 generator(5710);
  for (int i = 0; i < 50; ++i) {
    const Matrix3d Q = random_deformation(generator), C = Q * Q.transpose(), Id = Matrix3d::Identity();
    const auto I = invariants(C);
    const double gravity = std::numbers::pi * G * body.m_bar();
    const Vector3d V_bar(
        volume * mu / 2 * (1 - b) + gravity * gravity_integral(2, I),
        volume * mu / 2 * b + gravity * gravity_integral(1, I),
        volume * (lambda / 4 * (1 - 1 / I[2]) - mu / 2 * (1 + b) / I[2]) + gravity * gravity_integral(0, I));
    const Matrix3d dV =
        V_bar[0] * 2 * Q + V_bar[1] * 2 * (C.trace() * Id - C) * Q + V_bar[2] * 2 * I[2] * Q.inverse().transpose();
    LoadedGl3::Workspace w;
    Matrix3d f = Matrix3d::Zero();
    ASSERT_TRUE(body.force(0, Q, Matrix3d::Zero(), w, f));
    EXPECT_LT((f + dV).norm(), 1e-12 * (1 + dV.norm())) << "quadrature";
  }
}

/// Remark 5.7.5, (5.118): "⟨A, B⟩_Q = tr(ABᵀ) for all Q": the metric of the kinetic energy per m̄ does not depend on Q.
TEST(Statement_5_7_5, MetricIsTheTrace) {
  std::mt19937 generator(575);
  const Gl3 body = neo_hookean_gl3();
  for (int i = 0; i < 20; ++i) {
    const Matrix3d A = random_matrix(generator), B = random_matrix(generator);
    const double by_energy = (body.kinetic_energy(A + B) - body.kinetic_energy(A - B)) / 2 / body.m_bar();
    EXPECT_NEAR(by_energy, (A * B.transpose()).trace(), round_off * 10);
    Matrix3d mu_A = Matrix3d::Zero();
    body.apply_mass(A, mu_A);
    EXPECT_NEAR(mechanics::dot(mu_A, B) / body.m_bar(), (A * B.transpose()).trace(), round_off);
  }
}

/// (5.118) is flat: the free motions of GL⁺(3), those of the law none, are straight lines, as long as det Q > 0; those
/// of SL(3), with the same metric, are not.
TEST(Statement_Eq5_118, FreeMotionsOfGl3AreStraightLines) {
  const auto start = benchmark_state<LoadedGl3>();
  const auto body = loaded_body<LoadedGl3>(materials::Fluid{}, {});
  const double end = 0.8;
  const auto r = run<mechanics::Rattle8>(body, start, end, 8, 4);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (const auto& s : r.states) {
    EXPECT_LT((s.q - start.q - s.t * start.v).norm(), 1e-14);
    EXPECT_EQ(s.v, start.v);
  }
  const auto explicit_end = integrate(body, start, end);
  EXPECT_LT((explicit_end.q - start.q - end * start.v).norm(), 1e-14);
  const auto constrained =
      state_at(loaded_body<LoadedSl3>(materials::Fluid{}, {}), benchmark_state<LoadedSl3>(), end, 40);
  EXPECT_GT((constrained.q - start.q - end * start.v).norm(), 0.1);
}

/// A free motion of GL⁺(3) may run into det Q = 0 in finite time: there it ends with a sentence.
TEST(Statement_Eq5_118, FreeMotionsEndWhereTheDeterminantVanishes) {
  const auto body = loaded_body<LoadedGl3>(materials::Fluid{}, {});
  const auto flattening = moving<LoadedGl3>(Matrix3d::Identity(), diagonal(0, 0, -1));
  const auto r = run<mechanics::Rattle>(body, flattening, 2, 20, 1);
  EXPECT_FALSE(r.finished());
  EXPECT_NE(r.result.reason.find("inside out"), std::string::npos) << r.result.reason;
  EXPECT_NEAR(r.states.back().t, 0.9, 0.11);
}

}  // namespace
}  // namespace pseudorigid::testing
