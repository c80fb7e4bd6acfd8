/// Families of steady motions, their special points and their stability (PHYSICS sections 4 and 6, all printed digits;
/// Chandrasekhar, Ellipsoidal Figures of Equilibrium).

#include <gtest/gtest.h>

#include "mechanics/core/explicit_multiplier.h"
#include "reduced/steady_bodies.h"
#include "support/continuation.h"
#include "support/index_symbols.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

using namespace reduced;

double square(double x) { return x * x; }
double eccentricity(const EquilibriumPoint& p) { return std::sqrt(1 - square(p.semi_axes[2] / p.semi_axes[0])); }

/// PHYSICS section 6: Ω²/πGρ = 2√(1−e²)(3−2e²) asin(e)/e³ − 6(1−e²)/e².
TEST(Maclaurin, SpinAndPulsation) {
  const auto family = spheroids(fluid_of_gravity().isotropic(), SpheroidParameter::eccentricity, {0.05, 0.999, 40});
  ASSERT_EQ(family.points.size(), 40u);
  for (const auto& p : family.points) {
    const double e = p.parameter, flat = std::sqrt(1 - e * e);
    const double spin = 2 * flat * (3 - 2 * e * e) * std::asin(e) / (e * e * e) - 6 * (1 - e * e) / (e * e);
    EXPECT_NEAR(square(p.motion.omega[2]), spin, 1e-15 / square(square(e))) << "the formula cancels like 1/e⁴";
    EXPECT_LT(p.residual, 1e-14);
    EXPECT_NEAR(p.semi_axes.prod(), 1, 1e-14);
    EXPECT_EQ(p.vorticity_ratio(), 0);
  }
}

/// PHYSICS section 6: bifurcation e = 0.812670011 (0.374229675), fold 0.929955685 (0.449331412), dynamic instability
/// 0.952886702 (0.440219895) with Ω² = 4B₁₁, whatever the points that are looked at on the way.
TEST(Maclaurin, SpecialPointsToAllPrintedDigits) {
  for (const int n : {5, 23, 60}) {
    const auto family = spheroids(fluid_of_gravity().isotropic(), SpheroidParameter::eccentricity, {0.3, 0.99, n});
    const auto index = special_points(family, SpecialKind::index), fold = special_points(family, SpecialKind::fold),
               onset = special_points(family, SpecialKind::instability);
    ASSERT_EQ(index.size(), 1u);
    ASSERT_EQ(fold.size(), 1u);
    ASSERT_EQ(onset.size(), 1u);
    EXPECT_NEAR(index[0].parameter, 0.812670011, 5e-10);
    EXPECT_NEAR(square(index[0].motion.omega[2]), 0.374229675, 5e-10);
    EXPECT_NEAR(fold[0].parameter, 0.929955685, 6e-10) << "0.92995568545…, rounded down on the page";
    EXPECT_NEAR(square(fold[0].motion.omega[2]), 0.449331412, 5e-10);
    EXPECT_NEAR(onset[0].parameter, 0.952886702, 5e-10);
    EXPECT_NEAR(square(onset[0].motion.omega[2]), 0.440219895, 5e-10);
    EXPECT_NEAR(square(onset[0].motion.omega[2]), 4 * index_symbols(onset[0].semi_axes).B(0, 0), 1e-12);
    EXPECT_NEAR(square(index[0].motion.omega[2]), 2 * index_symbols(index[0].semi_axes).B(0, 0), 1e-12);
  }
}

/// σ = Ω ± √(4B₁₁ − Ω²) in the turning frame (Chandrasekhar §33, bar modes), Im σ beyond the onset; and before it the
/// body is stable although its second variation is not positive beyond Jacobi's point.
TEST(Maclaurin, BarModes) {
  const auto family = spheroids(fluid_of_gravity().isotropic(), SpheroidParameter::eccentricity, {0.4, 0.98, 30});
  for (const auto& p : family.points) {
    const double Omega = p.motion.omega[2], root = 4 * index_symbols(p.semi_axes).B(0, 0) - Omega * Omega;
    EXPECT_EQ(p.stability.stable, root > 0) << p.parameter;
    EXPECT_EQ(p.stability.n_negative, p.parameter < 0.812670011 ? 0 : 2);
    EXPECT_EQ(p.stability.rates.size(), 10u);
    if (root > 0) {
      for (const double sigma : {Omega + std::sqrt(root), std::abs(Omega - std::sqrt(root))}) {
        double nearest = HUGE_VAL;
        for (const double f : frequencies(p.stability)) nearest = std::min(nearest, std::abs(f - sigma));
        EXPECT_LT(nearest, 1e-11);
      }
    } else {
      EXPECT_NEAR(p.stability.growth_rate, std::sqrt(-root), 1e-12);
    }
  }
}

/// The same points on the curve Λ = 0 of all steady motions, followed by arclength; at the branch point it is crossed
/// by Jacobi's ellipsoids, whose index symbols obey a₁²a₂²A₁₂ = a₃²A₃, Ω² = 2B₁₂.
TEST(Maclaurin, ContinuationFindsJacobi) {
  const auto body = fluid_of_gravity().isotropic();
  const auto start = spheroids(body, SpheroidParameter::eccentricity, {0.3, 0.3, 1});
  ASSERT_EQ(start.points.size(), 1u);
  const Continuation continuation(body, Target{quantities::Lambda_3, 0}, quantities::omega_3);
  const auto maclaurin = continuation.follow(start.points[0].motion, 1, {.n_steps = 60});
  EXPECT_EQ(maclaurin.end, "");
  const auto branch = special_points(maclaurin, SpecialKind::branch_point),
             fold = special_points(maclaurin, SpecialKind::fold),
             onset = special_points(maclaurin, SpecialKind::instability);
  ASSERT_EQ(branch.size(), 1u);
  ASSERT_EQ(maclaurin.branch_points.size(), 1u);
  ASSERT_EQ(fold.size(), 1u);
  ASSERT_EQ(onset.size(), 1u);
  EXPECT_NEAR(eccentricity(branch[0]), 0.812670011, 5e-10);
  EXPECT_NEAR(eccentricity(fold[0]), 0.929955685, 6e-10);
  EXPECT_NEAR(eccentricity(onset[0]), 0.952886702, 5e-10);

  for (const int side : {1, -1}) {
    const auto jacobi = continuation.follow_branch(maclaurin.branch_points[0], side, {.n_steps = 30});
    EXPECT_EQ(jacobi.end, "");
    EXPECT_EQ(jacobi.points.size(), 31u);
    for (const auto& p : jacobi.points) {
      const Vector3d& a = p.semi_axes;
      const auto symbols = index_symbols(a);
      EXPECT_GT(side * (a[0] - a[1]), 0);
      EXPECT_NEAR(square(a[0] * a[1]) * symbols.A2(0, 1), square(a[2]) * symbols.A[2], 1e-12);
      EXPECT_NEAR(square(p.motion.omega[2]), 2 * symbols.B(0, 1), 1e-12);
      EXPECT_TRUE(p.stability.stable);
      EXPECT_EQ(p.stability.n_negative, 0);
    }
  }
}

/// A perturbed spheroid beyond the onset departs at the computed rate. Its bar mode is a turning pattern of A₁₁ − A₂₂
/// and A₁₂ + A₂₁, whose size is exactly exponential while small.
TEST(Maclaurin, AnUnstableOneGrowsAtItsRate) {
  for (const double e : {0.956, 0.97}) {
    const auto p = spheroids(fluid_of_gravity().isotropic(), SpheroidParameter::eccentricity, {e, e, 1}).points.at(0);
    ASSERT_GT(p.stability.growth_rate, 0.05);
    const double epsilon = 1e-7, doubling = std::log(2) / p.stability.growth_rate;
    const Matrix3d bar = diagonal(1 + epsilon, 1 / (1 + epsilon), 1);
    const auto body = fluid_of_gravity().moving();
    const auto growth = [&](const auto& states, auto&& position) {
      std::vector<double> size;
      for (const auto& s : states) {
        const Matrix3d H = position(-s.t) * s.q;
        size.push_back(std::hypot(H(0, 0) - H(1, 1), H(0, 1) + H(1, 0)));
      }
      EXPECT_LT(size.back(), 1e-3) << "still linear";
      EXPECT_GT(size.back(), 100 * epsilon);
      return std::log(size.back() / size[size.size() / 2]) / (states.back().t - states[size.size() / 2].t);
    };
    const auto back = [&](double t) { return rotation_z(p.motion.omega[2] * t); };
    const auto start = moving<decltype(body)>(bar * p.motion.A, bar * p.motion.velocity(0));
    const mechanics::ExplicitMultiplier field(body);
    const double rate = growth(integrate_samples(field, start, 9 * doubling, 24), back);
    EXPECT_NEAR(rate, p.stability.growth_rate, 0.002 * p.stability.growth_rate);
    const auto r = run<mechanics::Rattle8>(body, start, 9 * doubling, 24, 10);
    ASSERT_TRUE(r.finished());
    EXPECT_NEAR(growth(r.states, back), p.stability.growth_rate, 0.002 * p.stability.growth_rate);
  }
}

/// PHYSICS section 6: a₂/a₁ = 0.8: a₃/a₁ = 0.517216, Ω² = 0.366837; the family begins at Maclaurin's bifurcation.
TEST(Jacobi, TableAndBifurcation) {
  const auto family = jacobi(fluid_of_gravity().isotropic(), {1, 0.1, 10});
  ASSERT_EQ(family.points.size(), 10u);
  const auto& p = family.points[2];
  EXPECT_NEAR(p.parameter, 0.8, 1e-15);
  EXPECT_NEAR(p.semi_axes[2] / p.semi_axes[0], 0.517216, 5e-7);
  EXPECT_NEAR(square(p.motion.omega[2]), 0.366837, 5e-7);
  EXPECT_NEAR(eccentricity(family.points[0]), 0.812670011, 5e-10);
  for (const auto& q : family.points) {
    EXPECT_LT(q.residual, 1e-13);
    EXPECT_EQ(q.vorticity_ratio(), 0);
    EXPECT_TRUE(q.stability.stable);
  }
  const auto dual = dedekind(fluid_of_gravity().isotropic(), {1, 0.1, 10});
  for (std::size_t k = 0; k < dual.points.size(); ++k) {
    EXPECT_EQ(dual.points[k].semi_axes, family.points[k].semi_axes);
    EXPECT_EQ(dual.points[k].motion.Lambda, family.points[k].motion.omega);
    EXPECT_EQ(dual.points[k].motion.omega.norm(), 0);
  }
}

/// PHYSICS section 6: Ω² + Λ² = 2πGρB₁₂, ΩΛa₁a₂ = πGρ(a₃²A₃ − a₁²a₂²A₁₂); f = ζ/Ω; the dual has f' with
/// ff' = (a₁² + a₂²)²/(a₁a₂)².
TEST(RiemannS, Relations) {
  const auto family = type_s(fluid_of_gravity().isotropic(), {1, 0.3, 15}, 0.4),
             dual = type_s(fluid_of_gravity().isotropic(), {1, 0.3, 15}, 0.4, true);
  ASSERT_EQ(family.points.size(), 15u);
  for (std::size_t k = 0; k < family.points.size(); ++k) {
    const auto& p = family.points[k];
    const Vector3d& a = p.semi_axes;
    const double Omega = p.motion.omega[2], Lambda = p.motion.Lambda[2], ratio = a[0] / a[1] + a[1] / a[0];
    const auto s = index_symbols(a);
    EXPECT_NEAR(square(Omega) + square(Lambda), 2 * s.B(0, 1), 1e-14);
    EXPECT_NEAR(Omega * Lambda * a[0] * a[1], square(a[2]) * s.A[2] - square(a[0] * a[1]) * s.A2(0, 1), 1e-14);
    EXPECT_NEAR(p.vorticity_ratio(), -ratio * Lambda / Omega, 1e-14);
    EXPECT_NEAR(p.vorticity_ratio() * dual.points[k].vorticity_ratio(), ratio * ratio, 1e-11);
    // f = −2: no vorticity in space, Z = 0
    EXPECT_EQ(p.circulation[2] > 0, p.vorticity_ratio() > -2);
  }
}

/// Type III leaves type S where (Ω² + Λ²)/(2ΩΛ) = (4a₁² + a₂² − a₃²)/(4a₁a₂), the planes of ω and Λ being neutral
/// there; the branch that continuation finds is that of the closed form.
TEST(RiemannPlanar, BranchesOffTypeS) {
  const auto body = fluid_of_gravity().isotropic();
  const double a3_to_a1 = 1.2;
  const auto start = type_s(body, {5.5, 5.5, 1}, a3_to_a1);
  ASSERT_EQ(start.points.size(), 1u);
  const Continuation continuation(body, Target{quantities::axis_ratio_31, a3_to_a1}, quantities::axis_ratio_21);
  const ContinuationOptions options{.n_steps = 20, .parameter_most = 6.5};
  const auto s = continuation.follow(start.points[0].motion, 1, options);
  const auto branch = special_points(s, SpecialKind::branch_point);
  ASSERT_EQ(branch.size(), 1u);
  const auto narrow = continuation.follow(start.points[0].motion, 1, {.n_steps = 20, .parameter_most = 5.52});
  EXPECT_EQ(narrow.end, "");
  EXPECT_LT(narrow.points.size(), s.points.size());
  for (const auto& p : narrow.points) EXPECT_LE(p.parameter, 5.52);
  const Vector3d a = branch[0].semi_axes;
  const double Omega = branch[0].motion.omega[2], Lambda = branch[0].motion.Lambda[2];
  EXPECT_NEAR((square(Omega) + square(Lambda)) / (2 * Omega * Lambda),
              (4 * square(a[0]) + square(a[1]) - square(a[2])) / (4 * a[0] * a[1]), 1e-10);

  SteadyMotion at_branch;
  (void)planar_motion(body, axes_of_ratios(branch[0].parameter * (1 + 1e-9), a3_to_a1), at_branch);
  EXPECT_LT(std::min(std::abs(at_branch.omega[1]), std::abs(at_branch.omega[2])), 1e-3) << "√1e-9 and a factor";

  const auto three = continuation.follow_branch(s.branch_points.at(0), 1, {.n_steps = 15});
  EXPECT_EQ(three.end, "");
  for (const auto& p : three.points) {
    SteadyMotion exact;
    ASSERT_TRUE(planar_motion(body, p.semi_axes, exact));
    const SteadyMotion dual = exact.dual();
    // Up to the sense of axes 2 and 3
    const auto same = [&](const SteadyMotion& m) {
      return (m.omega.cwiseAbs() - p.motion.omega.cwiseAbs()).norm() +
             (m.Lambda.cwiseAbs() - p.motion.Lambda.cwiseAbs()).norm();
    };
    EXPECT_LT(std::min(same(exact), same(dual)), 1e-6) << "squares to 1e-13, roots near the branch point to 1e-7";
    EXPECT_GT(std::abs(p.motion.omega[1]) + std::abs(p.motion.Lambda[1]), 1e-3);
  }
}

/// PHYSICS section 4: Ω² = κ(1 − ℓ³) < κ, pulsation ω² = 2κ(ℓ³ + 2)/(2ℓ³ + 1).
TEST(SpinningNeoHookean, SpinAndPulsation) {
  const auto family = spheroids(neo_hookean().isotropic(), SpheroidParameter::polar_axis, {1, 0.05, 20});
  ASSERT_EQ(family.points.size(), 20u);
  for (const auto& p : family.points) {
    const double l3 = std::pow(p.parameter, 3), pulsation = std::sqrt(2 * kappa * (l3 + 2) / (2 * l3 + 1));
    EXPECT_NEAR(p.semi_axes[2], p.parameter, 1e-15);
    EXPECT_NEAR(square(p.motion.omega[2]), kappa * (1 - l3), 1e-13);
    double nearest = HUGE_VAL;
    for (const double f : frequencies(p.stability)) nearest = std::min(nearest, std::abs(f - pulsation));
    EXPECT_LT(nearest, 1e-11);
    EXPECT_TRUE(p.stability.stable);
    EXPECT_EQ(p.stability.n_negative, 0);
  }
  // By the spin, which has no fold and ends at √κ.
  const auto by_spin = spheroids_of_spin(neo_hookean().isotropic(), {0, 2.2, 12});
  ASSERT_EQ(by_spin.points.size(), 12u);
  for (const auto& p : by_spin.points) EXPECT_NEAR(std::pow(p.semi_axes[2], 3), 1 - square(p.parameter) / kappa, 1e-13);
}

/// PHYSICS section 4: surface ellipticity (1/10)Ω²a²/c² of small spins, for every law; with gravity
/// h₂ = (5/2)/(1 + 25μ/(2ρga)), that is (h₂/2)Ω²a/g.
TEST(SmallSpin, Ellipticity) {
  const double Omega = 1e-3;
  const auto ellipticity = [&](const SteadyBody& body) {
    const auto family = spheroids_of_spin(body.isotropic(), {Omega, Omega, 1});
    EXPECT_EQ(family.points.size(), 1u);
    const Vector3d& a = family.points.at(0).semi_axes;
    return (a[0] - a[2]) / square(Omega);
  };
  // Round-off 1e-16/Ω² and the next order, Ω² ≈ 1e-6.
  for (const char* law : {"neo-hookean", "mooney-rivlin", "ciarlet-geymonat", "saint-venant-kirchhoff"})
    EXPECT_NEAR(ellipticity(SteadyBody(law, 0)), 0.1, 1e-7) << law;
  for (const double g : {0.1, 1.0, 10.0}) {
    const double h2 = 2.5 / (1 + 25 / (2 * g));
    EXPECT_NEAR(ellipticity(SteadyBody("neo-hookean", 0.75 * g)), h2 / (2 * g), 1e-7) << g;
  }
  EXPECT_NEAR(ellipticity(fluid_of_gravity()), 2.5 / (2 * 4.0 / 3), 4e-6) << "g = (4/3)πGρ, h₂ = 5/2";
}

/// PHYSICS section 6: bifurcation at Ω²/πGρ = k + 2B₁₁, dynamic instability at 2k + 4B₁₁, k = κ/πGρ.
TEST(ElasticMaclaurin, BifurcationAndInstability) {
  double last_bifurcation = 0.812670011, last_onset = 0.952886702;
  for (const double k : {0.001, 0.01, 0.03, 0.1}) {
    const SteadyBody body("neo-hookean", kappa / k);
    const double pi_G_rho = kappa / k;
    const auto family = spheroids(body.isotropic(), SpheroidParameter::eccentricity, {0.5, 0.998, 40});
    const auto index = special_points(family, SpecialKind::index);
    ASSERT_GE(index.size(), 1u) << k;
    EXPECT_NEAR(square(index[0].motion.omega[2]) / pi_G_rho, k + 2 * index_symbols(index[0].semi_axes).B(0, 0), 1e-12);
    EXPECT_GT(index[0].parameter, last_bifurcation) << "elasticity stabilises";
    last_bifurcation = index[0].parameter;
    const auto onset = special_points(family, SpecialKind::instability);
    if (onset.empty()) continue;
    EXPECT_NEAR(square(onset[0].motion.omega[2]) / pi_G_rho, 2 * k + 4 * index_symbols(onset[0].semi_axes).B(0, 0),
                1e-11);
    EXPECT_GT(onset[0].parameter, last_onset);
    last_onset = onset[0].parameter;
  }
  EXPECT_GT(last_onset, 0.953) << "some were found";
}

TEST(Families, WhatIsMissingIsReported) {
  const auto maclaurin = spheroids_of_spin(fluid_of_gravity().isotropic(), {0.6, 0.8, 5});
  EXPECT_EQ(maclaurin.points.size(), 2u);  // 0.6, 0.65; the fold is at √0.4493
  ASSERT_EQ(maclaurin.missing.size(), 3u);
  EXPECT_FALSE(maclaurin.missing[0].reason.empty());
  const auto at_once = spheroids_of_spin(fluid_of_gravity().isotropic(), {0.67, 0.67, 1});  // near the fold
  ASSERT_EQ(at_once.points.size(), 1u);
  EXPECT_LT(eccentricity(at_once.points[0]), 0.93) << "the flatter one of that spin is not meant";
  const auto needles = type_s(fluid_of_gravity().isotropic(), {0.1, 0.2, 2}, 0.4);
  EXPECT_EQ(needles.points.size(), 0u);
  EXPECT_EQ(needles.missing.size(), 2u);
}

}  // namespace
}  // namespace pseudorigid::testing
