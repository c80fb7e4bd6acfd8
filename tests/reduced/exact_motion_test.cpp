/// Exact motions and identities of the pseudo-rigid body (PHYSICS sections 0, 1 and 4).

#include <gtest/gtest.h>

#include <random>

#include "reduced/bodies.h"

namespace pseudorigid::testing {
namespace {

/// A state of SL(3) far from Id, always the same for the same seed.
State<Sl3> some_state(unsigned seed) {
  std::mt19937 bits(seed);
  const auto number = [&bits] { return static_cast<double>(bits()) / 4294967296.0 - 0.5; };
  Matrix3d Q = Matrix3d::Identity(), L;
  for (int k = 0; k < 9; ++k) {
    Q(k / 3, k % 3) += 0.8 * number();
    L(k / 3, k % 3) = 3 * number();
  }
  if (Q.determinant() < 0) Q.row(0) *= -1;
  Q /= std::cbrt(Q.determinant());
  L -= L.trace() / 3 * Matrix3d::Identity();
  return moving<Sl3>(Q, Q * L);
}

/// ∂V/∂Q per unit of m̄ of the neo-Hookean law, (κ/2)(tr C − 3) − κ ln det Q (PHYSICS section 0).
Matrix3d potential_gradient(const Matrix3d& Q) { return kappa * (Q - Q.inverse().transpose()); }

TEST(Multiplier, IsTheExplicitOne) {  // (5.120): λ = [tr((Q⁻¹Q̇)²) + tr(Q⁻¹∂V)]/|Q⁻¹|²
  const Sl3 body = neo_hookean_sl3();
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto s = some_state(seed);
    const Matrix3d Qi = s.q.inverse(), L = Qi * s.v;
    const double exact = ((L * L).trace() + (Qi * potential_gradient(s.q)).trace()) / Qi.squaredNorm();
    EXPECT_NEAR(observed(body, s).multiplier, exact, 1e-13 * std::max(1.0, std::abs(exact)));
  }
}

TEST(Multiplier, OfAGeneralReferenceBody) {  // PHYSICS section 0, physical V
  reduced::ReferenceBody reference = reduced::ReferenceBody::unit_ball();
  reference.E0 *= matrix({1.5, 0.2, 0, 0.2, 1, -0.1, 0, -0.1, 0.7});
  const Sl3 body(Law{1, 0}, reference);
  const Matrix3d E0_inverse = reference.E0.inverse();
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto s = some_state(seed);
    const Matrix3d Qi = s.q.inverse(), L = Qi * s.v, dV = reference.volume / kappa * potential_gradient(s.q);
    const double exact =
        ((L * L).trace() + (Qi * dV * E0_inverse).trace()) / (Qi * Qi.transpose() * E0_inverse).trace();
    Sl3::Workspace w;
    double Lambda = 0;
    ASSERT_TRUE(mechanics::multiplier_of_motion(body, s, w, Lambda));
    EXPECT_NEAR(Lambda, exact, 1e-12 * std::max(1.0, std::abs(exact)));
  }
}

TEST(Observables, SemiAxesFallAndBelongToTheState) {
  const auto o = observed(neo_hookean_sl3(), moving<Sl3>(rotation_z(0.4) * diagonal(0.5, 1.25, 1.6), Matrix3d::Zero()));
  EXPECT_LT((o.semi_axes - Vector3d(1.6, 1.25, 0.5)).norm(), 1e-15);
  EXPECT_NEAR(o.volume_ratio, 1, 1e-15);
}

TEST(ExactMotion, SpinningSpheroidIsARelativeEquilibrium) {  // PHYSICS section 4: Ω² = κ(1 − ℓ³)
  const Sl3 body = neo_hookean_sl3();
  for (const double l : {0.9, 0.6}) {
    const double spin = std::sqrt(kappa * (1 - l * l * l)), end = 5 * 2 * std::numbers::pi / spin;
    const Matrix3d Q = diagonal(1 / std::sqrt(l), 1 / std::sqrt(l), l);
    const auto r = run<mechanics::Rattle8>(body, moving<Sl3>(Q, hat({0, 0, spin}) * Q), end, 40, 8);
    ASSERT_TRUE(r.finished());
    for (const auto& s : r.states) EXPECT_LT((s.q - rotation_z(spin * s.t) * Q).norm(), 1e-9);
  }
}

TEST(ExactMotion, TriaxialEllipsoidOfTypeS) {
  // PHYSICS section 4: Q = exp(−Ωt𝒥) diag(a) exp(Λt𝒥), Ω² + Λ² = κ, 2ΩΛ(a₁a₂)³ = κ; exp(−φ𝒥) turns by +φ.
  const Sl3 body = neo_hookean_sl3();
  const double a1 = 1.5, a2 = 0.9, product = kappa / std::pow(a1 * a2, 3);  // 2ΩΛ
  const double sum = std::sqrt(kappa + product), difference = std::sqrt(kappa - product);
  const double Omega = (sum + difference) / 2, Lambda = (sum - difference) / 2;
  const Matrix3d A = diagonal(a1, a2, 1 / (a1 * a2));
  const auto exact = [&](double t) -> Matrix3d { return rotation_z(Omega * t) * A * rotation_z(-Lambda * t); };
  const Matrix3d Qdot = hat({0, 0, Omega}) * A - A * hat({0, 0, Lambda});

  const double end = 4 * 2 * std::numbers::pi / Lambda;
  const auto r = run<mechanics::Rattle8>(body, moving<Sl3>(A, Qdot), end, 200, 8);
  ASSERT_TRUE(r.finished());
  for (const auto& s : r.states) EXPECT_LT((s.q - exact(s.t)).norm(), 1e-9);
}

/// The reaction to det Q = 1 is a pressure, λ m̄/Vol in the reference state, m̄/Vol = 1/5 for the ball.
TEST(ExactMotion, StressHasThePressureOfTheConstraint) {
  const Matrix3d Q = matrix({1.2, 0.3, 0, -0.1, 0.9, 0.2, 0, 0.1, 1}), F = Q / std::cbrt(Q.determinant());
  const Sl3 body = neo_hookean_sl3();
  for (const double lambda : {-2.0, 0.7}) {
    const Matrix3d expected = F * F.transpose() - (1 + lambda / 5) * Matrix3d::Identity();  // σ = FFᵀ − Id − p Id
    EXPECT_LT((body.cauchy_stress(F, lambda) - expected).norm(), 1e-14);
  }
}

TEST(ExactMotion, StressOfTheBallAtRestVanishes) {
  const Sl3 body = neo_hookean_sl3();
  const auto o = observed(body, stretched(1));
  EXPECT_EQ(o.multiplier, 0);
  EXPECT_EQ(o.elastic, 0);
  EXPECT_EQ(body.cauchy_stress(Matrix3d::Identity(), o.multiplier), Matrix3d::Zero());
}

}  // namespace
}  // namespace pseudorigid::testing
