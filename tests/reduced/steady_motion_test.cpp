/// Steady motions of the pseudo-rigid body: what is a steady motion in the formulas is one of the equation of motion,
/// and its linearisation is that of the equation of motion (PHYSICS sections 4 and 6; Chandrasekhar, Ellipsoidal
/// Figures of Equilibrium, ch. 7).

#include <gtest/gtest.h>

#include <random>

#include "mechanics/core/explicit_multiplier.h"
#include "reduced/samples.h"
#include "reduced/steady_bodies.h"
#include "support/dense.h"
#include "support/index_symbols.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

using namespace reduced;

/// The largest distance of the integrated motion from exp(tω̂)A exp(−tΛ̂), over a number of turns.
template <class Body>
double departure(const Body& body, const SteadyMotion& m, double n_turns, int n_samples = 20) {
  const double end = n_turns * 2 * std::numbers::pi / std::max(m.omega.norm(), m.Lambda.norm());
  const mechanics::ExplicitMultiplier field(body);
  double largest = 0;
  for (const auto& s : integrate_samples(field, moving<Body>(m.position(0), m.velocity(0)), end, n_samples, 1e-14))
    largest = std::max(largest, (s.q - m.position(s.t)).norm());
  return largest;
}

TEST(SteadyMotion, TypesSAndIToIIIAreMotions) {
  const auto body = fluid_of_gravity().isotropic();
  SteadyMotion s, one, two, three;
  ASSERT_TRUE(type_s_motion(body, axes_of_ratios(0.7, 0.5), s));
  ASSERT_TRUE(planar_motion(body, axes_of_ratios(1.3, 0.4), one));    // axis 1 in the middle, 2a₁ ≥ a₂ + a₃
  ASSERT_TRUE(planar_motion(body, axes_of_ratios(2.8, 0.4), two));    // axis 1 in the middle, 2a₁ ≤ a₂ − a₃
  ASSERT_TRUE(planar_motion(body, axes_of_ratios(6.5, 1.2), three));  // axis 1 the shortest, 2a₁ ≤ a₂ − a₃
  for (const SteadyMotion* m : {&one, &two, &three}) {
    EXPECT_GT(m->omega.cross(m->Lambda).norm(), 1e-3) << "omega and Lambda are not parallel";
    EXPECT_GT(m->omega[1] * m->omega[2], 1e-3);
  }
  for (const SteadyMotion* m : {&s, &one, &two, &three}) {
    EXPECT_LT(steady_residual(body, *m).norm(), 4e-14 * steady_residual_scale(body, *m));
    // Type II is unstable, at 0.44: round-off grows by exp(0.44 · 10).
    EXPECT_LT(departure(fluid_of_gravity().moving(), *m, 2), 1e-9);
    EXPECT_LT(departure(fluid_of_gravity().moving(), m->dual(), 2), 1e-9);
    SteadyMotion wrong = *m;
    wrong.Lambda[2] += 0.01;
    EXPECT_GT(departure(fluid_of_gravity().moving(), wrong, 2), 1e-3);
  }
}

TEST(SteadyMotion, OfElasticGravitatingBodiesOfEveryLaw) {
  for (const char* law : {"neo-hookean", "mooney-rivlin", "ciarlet-geymonat", "saint-venant-kirchhoff"}) {
    const SteadyBody body(law, 3);
    SteadyMotion spheroid, s, planar;
    ASSERT_TRUE(spheroid_motion(body.isotropic(), 1 / std::sqrt(0.8), 0.8, spheroid)) << law;
    ASSERT_TRUE(type_s_motion(body.isotropic(), axes_of_ratios(0.8, 0.7), s)) << law;
    EXPECT_LT(departure(body.moving(), spheroid, 3), 1e-9) << law;
    EXPECT_LT(departure(body.moving(), s, 3), 1e-9) << law;
  }
}

TEST(SteadyMotion, OfAFreeBodyWithABulkLaw) {
  const SteadyBody body("ciarlet-geymonat", 0.5, false);
  const auto family = spheroids(body.isotropic(false), SpheroidParameter::eccentricity, {0.3, 0.8, 3});
  ASSERT_EQ(family.points.size(), 3u);
  for (const auto& p : family.points) {
    EXPECT_NE(p.semi_axes.prod(), 1);
    EXPECT_EQ(p.motion.lambda, 0);
    EXPECT_LT(departure(body.moving_freely(), p.motion, 3), 1e-9);
  }
  const auto triaxial = type_s(body.isotropic(false), {0.9, 0.7, 3}, 0.6);
  ASSERT_EQ(triaxial.points.size(), 3u);
  for (const auto& p : triaxial.points) EXPECT_LT(departure(body.moving_freely(), p.motion, 3), 1e-9);
}

/// PHYSICS section 4: Ω² + Λ² = κ, 2ΩΛ(a₁a₂)³ = κ; held over 100 turns.
TEST(SteadyMotion, TriaxialNeoHookeanBodiesAreHeld) {
  const auto family = type_s(neo_hookean().isotropic(), {0.9, 0.5, 5}, 0.45);
  ASSERT_EQ(family.points.size(), 5u);
  for (const auto& p : family.points) {
    const double Omega = p.motion.omega[2], Lambda = p.motion.Lambda[2];
    EXPECT_NEAR(Omega * Omega + Lambda * Lambda, kappa, 1e-13);
    EXPECT_NEAR(2 * Omega * Lambda * std::pow(p.semi_axes[0] * p.semi_axes[1], 3), kappa, 1e-12);
  }
  const SteadyMotion& m = family.points[2].motion;
  EXPECT_LT(departure(neo_hookean().moving(), m, 100, 200), 1e-9);
  const double end = 100 * 2 * std::numbers::pi / m.omega.norm();
  const auto body = neo_hookean().moving();
  const auto r = run<mechanics::Rattle8>(body, moving<decltype(body)>(m.position(0), m.velocity(0)), end, 200, 20);
  ASSERT_TRUE(r.finished());
  for (const auto& s : r.states) EXPECT_LT((s.q - m.position(s.t)).norm(), 1e-9);
}

/// PHYSICS section 1: Q(t) a solution ⇒ Q(t)ᵀ a solution; and of Jacobi's ellipsoids it makes Dedekind's.
TEST(SteadyMotion, DedekindsDuality) {
  const auto body = fluid_of_gravity().moving();
  const auto start = benchmark_state<Sl3>();
  const mechanics::ExplicitMultiplier field(body);
  const auto end = integrate(field, moving<decltype(body)>(start.q, start.v), 20, 1e-14);
  const auto dual = integrate(field, moving<decltype(body)>(start.q.transpose(), start.v.transpose()), 20, 1e-14);
  EXPECT_LT((end.q.transpose() - dual.q).norm(), 1e-12);
  EXPECT_GT((end.q - dual.q).norm(), 0.1);

  SteadyMotion jacobi;
  ASSERT_TRUE(jacobi_motion(fluid_of_gravity().isotropic(), 0.6, jacobi));
  const auto p = described(fluid_of_gravity(), jacobi), d = described(fluid_of_gravity(), jacobi.dual());
  EXPECT_LT(d.residual, 1e-14);
  EXPECT_EQ(d.motion.omega.norm(), 0);
  EXPECT_LT((p.angular_momentum + d.circulation).norm(), 1e-12);
  EXPECT_LT((p.circulation + d.angular_momentum).norm(), 1e-12);
  EXPECT_NEAR(p.energy(), d.energy(), 1e-12);
  ASSERT_EQ(p.stability.rates.size(), d.stability.rates.size());
  for (std::size_t k = 0; k < p.stability.rates.size(); ++k)
    EXPECT_LT(std::abs(p.stability.rates[k].s - d.stability.rates[k].s), 1e-12);
}

TEST(SteadyMotion, NewtonFindsItFromAnyOrientation) {
  std::mt19937 generator(7);
  const auto body = fluid_of_gravity().isotropic();
  SteadyMotion exact;
  ASSERT_TRUE(planar_motion(body, axes_of_ratios(1.3, 0.4), exact));
  for (int k = 0; k < 5; ++k) {
    const Matrix3d R = random_rotation(generator), S = random_rotation(generator);
    SteadyMotion m{R * exact.A * S.transpose() + 0.02 * random_matrix(generator), R * exact.omega, S * exact.Lambda,
                   1.05 * exact.lambda};
    const SteadyMotion guess = to_principal_plane(m);  // axes in an order that the guess decides
    const PlaneVector u = plane_coordinates(guess);
    const auto status = find_steady_motion(body,
                                           {Target{quantities::axis_ratio_21, value_of(quantities::axis_ratio_21, u)},
                                            Target{quantities::axis_ratio_31, value_of(quantities::axis_ratio_31, u)}},
                                           m);
    ASSERT_TRUE(status) << status.reason();
    EXPECT_LT(steady_residual(body, m).norm(), 1e-13);
    EXPECT_GT(std::abs(m.omega[1] * m.omega[2]), 1e-3) << "of the planar kind";
    EXPECT_NEAR(m.A.determinant(), 1, 1e-14);
  }
}

TEST(SteadyMotion, WhatIsNotThereIsSaid) {
  const auto body = fluid_of_gravity().isotropic();
  SteadyMotion m;
  EXPECT_NE(spheroid_motion(body, 0.9, 1 / 0.81, m).reason().find("does not turn"), std::string::npos) << "prolate";
  EXPECT_NE(type_s_motion(body, axes_of_ratios(0.2, 0.4), m).reason().find("no figure"), std::string::npos);
  EXPECT_NE(planar_motion(body, axes_of_ratios(1.8, 0.4), m).reason().find("between"), std::string::npos);
  m = {};
  const auto too_fast =
      find_steady_motion(body, {Target{quantities::omega_3, 0.7}, Target{quantities::Lambda_3, 0}}, m);  // Ω² ≤ 0.4493
  EXPECT_NE(too_fast.reason().find("no steady motion"), std::string::npos);
  m.A = -Matrix3d::Identity();
  EXPECT_FALSE(find_steady_motion(body, {Target{quantities::omega_3, 0.1}, Target{quantities::Lambda_3, 0}}, m));
}

/// Momenta and energies are those of the body's observables.
TEST(SteadyMotion, IsDescribedAsTheBodyIs) {
  SteadyMotion m;
  ASSERT_TRUE(planar_motion(fluid_of_gravity().isotropic(), axes_of_ratios(1.3, 0.4), m));
  const auto p = described(fluid_of_gravity(), m);
  const auto body = fluid_of_gravity().moving();
  const auto o = observed(body, moving<decltype(body)>(m.position(0), m.velocity(0)));
  EXPECT_LT((o.angular_momentum - p.angular_momentum).norm(), 1e-14);
  EXPECT_LT((o.circulation - p.circulation).norm(), 1e-14);
  EXPECT_NEAR(o.energy(), p.energy(), 1e-13);
  EXPECT_NEAR(o.multiplier, m.lambda, 1e-13);
  EXPECT_NEAR(value_of(quantities::angular_momentum_3, plane_coordinates(m)) * m_bar, p.angular_momentum[2], 1e-14);
  EXPECT_NEAR(value_of(quantities::circulation_3, plane_coordinates(m)) * m_bar, p.circulation[2], 1e-14);
}

/// ∂(Ẋ, Ẍ)/∂(X, Ẋ) of Q = exp(tω̂)X exp(−tΛ̂) by central differences of the body's acceleration.
template <class Body>
Eigen::VectorXcd rates_by_differences(const Body& body, const SteadyMotion& m) {
  const Matrix3d w = hat(m.omega), l = hat(m.Lambda);
  const auto acceleration = [&](const Matrix3d& X, const Matrix3d& X_rate) -> Matrix3d {
    typename Body::Workspace workspace;
    Matrix3d a = Matrix3d::Zero();
    EXPECT_TRUE(body.acceleration(0, X, X_rate + w * X - X * l, workspace, a));
    return a - 2 * (w * X_rate - X_rate * l) - (w * w * X - 2 * w * X * l + X * l * l);
  };
  constexpr double h = 1e-5;
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(18, 18);
  L.topRightCorner(9, 9).setIdentity();
  for (int k = 0; k < 9; ++k) {
    Matrix3d E = Matrix3d::Zero();
    E.data()[k] = h;
    const Matrix3d Z = Matrix3d::Zero();
    L.col(k).tail(9) = ((acceleration(m.A + E, Z) - acceleration(m.A - E, Z)) / (2 * h)).reshaped();
    L.col(9 + k).tail(9) = ((acceleration(m.A, E) - acceleration(m.A, -E)) / (2 * h)).reshaped();
  }
  return testing::eigenvalues(L);
}

/// The spectrum on the reduced space is that of the equation of motion without 0, ±i|ω|, ±i|Λ| of the symmetries.
TEST(LinearStability, IsThatOfTheEquationOfMotion) {
  const SteadyBody elastic("mooney-rivlin", 2);
  std::vector<std::pair<const SteadyBody*, SteadyMotion>> motions(5, {&fluid_of_gravity(), {}});
  ASSERT_TRUE(type_s_motion(fluid_of_gravity().isotropic(), axes_of_ratios(0.7, 0.5), motions[0].second));
  ASSERT_TRUE(planar_motion(fluid_of_gravity().isotropic(), axes_of_ratios(1.3, 0.4), motions[1].second));
  ASSERT_TRUE(planar_motion(fluid_of_gravity().isotropic(), axes_of_ratios(2.8, 0.4), motions[2].second));
  ASSERT_TRUE(jacobi_motion(fluid_of_gravity().isotropic(), 0.5, motions[3].second));
  motions[4].first = &elastic;
  ASSERT_TRUE(type_s_motion(elastic.isotropic(), axes_of_ratios(0.8, 0.6), motions[4].second));
  for (const auto& [body, m] : motions) {
    const auto p = described(*body, m);
    const Eigen::VectorXcd all = rates_by_differences(body->moving(), m);
    const auto distance_to = [&](std::complex<double> s) { return (all.array() - s).abs().minCoeff(); };
    ASSERT_EQ(p.stability.rates.size(), 8u);
    for (const Rate& rate : p.stability.rates) {
      EXPECT_LT(distance_to(rate.s), 1e-7) << rate.s << ": differences are good to 1e-9, times a condition";
      EXPECT_GT(std::abs(rate.s), 1e-3) << "no mode of a symmetry is left";
    }
    for (const double f : {m.omega.norm(), m.Lambda.norm()})
      EXPECT_LT(distance_to({0, f}), f == 0 ? 1e-3 : 1e-7) << "of a symmetry; double zeros are split by a square root";
    const double fastest = all.real().maxCoeff();
    EXPECT_NEAR(p.stability.growth_rate, fastest > 1e-2 ? fastest : 0, 1e-7);
  }
}

TEST(LinearStability, OfAFreeBodyIsThatOfItsEquationOfMotion) {
  const SteadyBody body("ciarlet-geymonat", 0.5, false);
  const auto family = type_s(body.isotropic(false), {0.8, 0.8, 1}, 0.6);
  ASSERT_EQ(family.points.size(), 1u);
  const auto& p = family.points[0];
  const Eigen::VectorXcd all = rates_by_differences(body.moving_freely(), p.motion);
  ASSERT_EQ(p.stability.rates.size(), 10u);
  for (const Rate& rate : p.stability.rates)
    EXPECT_LT((all.array() - rate.s).abs().minCoeff(), 1e-7) << rate.s << ": differences are good to 1e-9";
}

TEST(LinearStability, OfTheSphereAtRest) {
  // PHYSICS section 3: √10 for every law, x² = 10 + 0.8γ, Kelvin 16πGρ/15. Five modes, ten rates.
  const auto check = [](const SteadyBody& body, double square) {
    SteadyMotion at_rest;
    ASSERT_TRUE(spheroid_motion(body.isotropic(), 1, 1, at_rest));
    const auto p = described(body, at_rest);
    ASSERT_EQ(p.stability.rates.size(), 10u);
    for (const double f : frequencies(p.stability)) EXPECT_NEAR(f, std::sqrt(square), 1e-13 * std::sqrt(square));
    EXPECT_EQ(frequencies(p.stability).size(), 5u);
    EXPECT_EQ(p.stability.n_negative, 0);
  };
  for (const char* law : {"neo-hookean", "mooney-rivlin", "ciarlet-geymonat", "saint-venant-kirchhoff"})
    check(SteadyBody(law, 0), 10);
  for (const double gamma : {1.0, 5.0, 25.0}) {  // γ = ρga/μ, g = (4/3)πGρa
    check(SteadyBody("neo-hookean", 0.75 * gamma), 10 + 0.8 * gamma);
    check(SteadyBody("mooney-rivlin", 0.75 * gamma), 10 + 0.8 * gamma);
  }
  check(fluid_of_gravity(), 16.0 / 15);
}

/// On GL⁺(3) the sphere has a radial mode as well: three more kinds of directions, nine less three turns.
TEST(LinearStability, OfTheFreeSphereAtRest) {
  const SteadyBody body("ciarlet-geymonat", 0, false);
  EquilibriumPoint p;
  ASSERT_TRUE(describe_equilibrium(body.isotropic(false), {}, 0, p));
  const auto f = frequencies(p.stability);
  ASSERT_EQ(f.size(), 6u);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(f[k], std::sqrt(10.0), 1e-13);
  EXPECT_NEAR(f[5], std::sqrt(5.0 * (2 + 3)), 1e-13) << "5(2μ + 3λ), λ = μ = 1";
}

/// Type S at a₃/a₁ = 0.4 near a₂ = a₁: the turn about axis 3 leaves the figure less and less. The rates of the family
/// stay where they are, down to the limit itself, where a pair more is counted.
TEST(LinearStability, IsContinuousAtCoincidentAxes) {
  const auto at = [](double gap) {
    SteadyMotion m;
    EXPECT_TRUE(type_s_motion(fluid_of_gravity().isotropic(), axes_of_ratios(1 - gap, 0.4), m));
    return described(fluid_of_gravity(), m);
  };
  const auto reference = frequencies(at(1e-5).stability);
  ASSERT_EQ(reference.size(), 4u);
  for (const double gap : {1e-6, 1e-7, 1e-9, 1e-11, 1e-13, 0.0}) {
    const auto p = at(gap);
    EXPECT_LT(p.residual, 1e-14);
    EXPECT_TRUE(p.stability.stable) << gap;
    for (const double f : reference) {
      double nearest = HUGE_VAL;
      for (const double g : frequencies(p.stability)) nearest = std::min(nearest, std::abs(f - g));
      EXPECT_LT(nearest, 1e-4) << gap;
    }
  }
}

/// Discs and needles: finite numbers, and the rates that are known.
TEST(LinearStability, OfDiscsAndNeedles) {
  for (const double flat : {1e-2, 1e-4, 1e-6}) {
    SteadyMotion m;
    const Vector3d a = axes_of_ratios(1, flat);
    ASSERT_TRUE(spheroid_motion(fluid_of_gravity().isotropic(), a[0], a[2], m));
    const auto p = described(fluid_of_gravity(), m);
    const double growth = std::sqrt(m.omega.squaredNorm() - 4 * index_symbols(a).B(0, 0));  // bar mode
    EXPECT_LT(p.residual, 1e-9) << "relative to the pressure term, λ/a₃";
    EXPECT_FALSE(p.stability.stable);
    EXPECT_NEAR(p.stability.growth_rate, growth, 1e-6 * growth) << flat;
  }
  for (const double thin : {0.1, 0.01}) {
    SteadyMotion m;
    ASSERT_TRUE(jacobi_motion(fluid_of_gravity().isotropic(), thin, m));
    const auto p = described(fluid_of_gravity(), m);
    EXPECT_TRUE(p.stability.stable);
    EXPECT_EQ(p.stability.n_negative, 0);
    for (const Rate& rate : p.stability.rates) EXPECT_TRUE(std::isfinite(std::abs(rate.s)));
  }
}

/// Chandrasekhar's symbols against their integrals, u = c e^t by the trapezoidal rule (its error is exp(−2π²/h)).
TEST(IndexSymbols, AreTheIntegrals) {
  for (const Vector3d& a : {Vector3d(1.3, 0.9, 0.7), Vector3d(1, 1, 0.4), Vector3d(1, 1, 1), Vector3d(2, 0.1, 0.1),
                            Vector3d(1, 1 + 1e-9, 0.3)}) {
    const auto symbols = index_symbols(a);
    Vector3d A = Vector3d::Zero();
    Matrix3d A2 = Matrix3d::Zero(), B = Matrix3d::Zero();
    constexpr double h = 0.25;
    for (double t = -45; t <= 45; t += h) {
      const double u = std::exp(t);
      const Vector3d f = (a.cwiseAbs2().array() + u).inverse();
      const double weight = h * u * a.prod() * std::sqrt(f.prod());
      A += weight * f;
      A2 += weight * f * f.transpose();
      B += weight * u * f * f.transpose();
    }
    EXPECT_LT((symbols.A - A).cwiseQuotient(A).cwiseAbs().maxCoeff(), 2e-14);
    EXPECT_LT((symbols.A2 - A2).cwiseQuotient(A2).cwiseAbs().maxCoeff(), 2e-14);
    EXPECT_LT((symbols.B - B).cwiseQuotient(B).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_NEAR(symbols.A.sum(), 2, 1e-14);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
