#include "analysis/comparison.h"

#include <gtest/gtest.h>

#include <limits>

#include "analysis/comparison_report.h"
#include "scene/user_error.h"
#include "synthetic_runs.h"

namespace {

using namespace pseudorigid::analysis;
using namespace synthetic;
using pseudorigid::UserError;

TEST(Comparison, TwoPulsationsHaveTheKnownRatio) {
  const Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten));
  EXPECT_EQ(c.signal, "C33");
  ASSERT_TRUE(c.ratio) << c.model.frequency.reason << c.reference.frequency.reason;
  EXPECT_NEAR(c.ratio->value, incompressible_ball_ratio, 1e-10);
  EXPECT_NEAR(incompressible_ball_ratio, 1.186319, 5e-7);  // PHYSICS.md, section 3
  EXPECT_LT(*c.ratio->error.total(), 1e-9);
  EXPECT_NEAR(c.model.frequency.dominant().amplitude, 0.02, 1e-5);  // of C33 = (1 + ε cos ωt)²
  EXPECT_TRUE(c.not_compared.empty());
}

TEST(Comparison, PhasesDriftApartWithTheFrequencies) {
  const std::vector<double> t = times(2001, 100);
  const Comparison c = compare(reduced_run(reduced_pulsation, t), continuum_run(exact_pulsation, t));
  const Series* phase = c.find("phase_difference");
  ASSERT_TRUE(phase);
  // C33 = (1 + ε cos ωt)² has a harmonic of the amplitude ε²/2, 0.25 % of the line; it disturbs a fit of one period.
  for (std::size_t n = 0; n < t.size(); ++n)
    EXPECT_NEAR(phase->values[n], (pseudo_rigid_omega - exact_omega) * t[n] / (2 * std::numbers::pi), 1e-3) << t[n];
  EXPECT_EQ(phase->time_of_max, 100);
  ASSERT_EQ(c.phase_after_periods.size(), 5u);  // 42 periods: 1, 2, 5, 10, 20
  for (const auto& [n, periods] : c.phase_after_periods)
    EXPECT_NEAR(periods, n * (incompressible_ball_ratio - 1), 1e-3) << n;
}

TEST(Comparison, HasNoPhaseWithoutARatio) {
  const Comparison c = compare(reduced_run(pulsation(1, 0), ten), continuum_run(exact_pulsation, ten));
  EXPECT_FALSE(c.ratio);
  EXPECT_FALSE(c.find("phase_difference"));
  EXPECT_TRUE(c.phase_after_periods.empty());
}

TEST(Comparison, SeriesFollowTheirDefinitions) {
  const Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten));
  double departure = 0;
  for (const double t : ten)
    for (const double omega : {pseudo_rigid_omega, exact_omega})
      departure = std::max(departure, 0.01 * std::sqrt(1.5) * (1 - std::cos(omega * t)));
  for (const std::size_t n : {0ul, 57ul, 200ul}) {
    const double t = ten[n], r = std::cos(pseudo_rigid_omega * t), e = std::cos(exact_omega * t);
    const double apart = 0.01 * std::sqrt(1.5) * std::abs(e - r);
    const double K_r = 0.5 * m_bar * 1.5 * std::pow(0.01 * pseudo_rigid_omega, 2) * (1 - r * r);
    const double K_e = 0.5 * m_bar * 1.5 * std::pow(0.01 * exact_omega, 2) * (1 - e * e);
    EXPECT_NEAR(c.find("q_difference")->values[n], apart / reduced_pulsation.Q(t).norm(), 1e-15);
    EXPECT_NEAR(c.find("q_difference_of_departure")->values[n], apart / departure, 1e-13);
    EXPECT_NEAR(c.find("kinetic_difference")->values[n], K_e - K_r, 1e-15);
    EXPECT_NEAR(c.find("elastic_difference")->values[n], K_r - K_e, 1e-15);
    const Eigen::Vector3d ratio =
        (1 + 0.01 * e * Eigen::Array3d(-0.5, -0.5, 1)) / (1 + 0.01 * r * Eigen::Array3d(-0.5, -0.5, 1));
    if (r > 0 && e > 0) {
      EXPECT_NEAR(c.find("a1_difference")->values[n], ratio[2] - 1, 1e-14);  // prolate: the 3-axis is the longest
    }
  }
  EXPECT_NEAR(c.find("energy_difference")->max, 0, 1e-15);
  // √2 rms of C over its mean: ε√(4 + 1 + 1) cos ωt to first order; the record holds no whole number of periods.
  EXPECT_NEAR(c.model.strain_amplitude, 0.01 * std::sqrt(6.0), 1e-3);
  const Series& strain = *c.find("strain_difference");
  EXPECT_GT(strain.max, 1.9);
  EXPECT_EQ(strain.max, strain.values[std::size_t(std::lround(strain.time_of_max / 0.05))]);
  EXPECT_GT(strain.rms, 0.5);
  EXPECT_LT(strain.rms, strain.max);
}

TEST(Comparison, IdenticalRunsDifferByNothing) {
  const Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(reduced_pulsation, ten));
  for (const Series& s : c.series) EXPECT_EQ(s.max, 0) << s.name;
  ASSERT_TRUE(c.ratio);
  EXPECT_EQ(c.ratio->value, 1);
}

TEST(Comparison, RigidRotationIsNoPulsation) {
  const Motion still = pulsation(1, 0);
  const Comparison c = compare(reduced_run(turning(still, 1), ten), continuum_run(turning(still, 1.001), ten));
  EXPECT_TRUE(c.model.turns);
  EXPECT_FALSE(c.model.deforms || c.reference.deforms);
  EXPECT_FALSE(c.ratio);
  EXPECT_EQ(c.model.frequency.reason, "the shape is constant");
  EXPECT_NEAR(c.find("q_difference")->max, 0.01 * std::sqrt(2.0 / 3), 1e-6);  // angle 0.01 at the end, |Q| = √3
  EXPECT_LT(c.find("strain_difference")->max, 1e-4);
  EXPECT_NEAR(c.find("angular_momentum_difference")->max, 0.001, 1e-12);
  EXPECT_NEAR(c.find("angular_momentum_difference")->reference, 2 * m_bar, 1e-12);
  EXPECT_LT(*c.model.angular_momentum_drift, 1e-14);
}

TEST(Comparison, SpinDoesNotHideThePulsation) {
  const ComparisonOptions options{.exact_frequency_ratio = incompressible_ball_ratio};
  const Comparison c = compare(reduced_run(turning(reduced_pulsation, 0.7), ten),
                               continuum_run(turning(exact_pulsation, 0.71), ten), options);
  ASSERT_TRUE(c.ratio);
  EXPECT_NEAR(c.ratio->value, incompressible_ball_ratio, 1e-9);
  EXPECT_FALSE(c.exact_ratio);  // it is the value of a ball that does not spin
  const Comparison still = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten), options);
  EXPECT_TRUE(still.exact_ratio);
}

TEST(Comparison, RoundOffMomentaAreNoDifference) {
  const auto noise = [](double t, ContinuumObservables& o) { o.angular_momentum = {1e-17 * std::sin(99 * t), 0, 0}; };
  const Comparison c =
      compare(reduced_run(reduced_pulsation, ten), continuum_run(reduced_pulsation, ten, {.orbit = false}, noise));
  EXPECT_LT(c.find("angular_momentum_difference")->max, 1e-14);
  EXPECT_LT(*c.reference.angular_momentum_drift, 1e-14);
}

TEST(Comparison, DriftsAreDeparturesFromTheInitialValue) {
  const auto leak = [](double t, ContinuumObservables& o) {
    o.elastic -= 1e-4 * t;
    o.circulation[2] *= 1 + 1e-3 * t;
  };
  const Motion spinning = turning(pulsation(1, 0), 1);
  const Comparison c = compare(reduced_run(spinning, ten), continuum_run(spinning, ten, {.orbit = false}, leak));
  EXPECT_NEAR(*c.reference.energy_drift, 1e-3, 1e-9);
  EXPECT_NEAR(*c.reference.circulation_drift, 1e-2, 1e-12);
  EXPECT_LT(*c.model.energy_drift, 1e-14);
}

TEST(Comparison, NonaffineMeanIsWeightedByTheKineticEnergy) {
  // Non-affine energy 0.03 K, and everything non-affine where the ball rests: instants that must not count.
  const auto change = [](double, ContinuumObservables& o) {
    o.nonaffine_kinetic_fraction = o.kinetic < 1e-8 ? 1 : 0.03;
    o.min_jacobian = 0.9 + o.kinetic;
    o.volume_error = 0.01 - 1e-3 * o.kinetic;
    o.max_volume_error = 0.1 - o.kinetic;
  };
  const Comparison c =
      compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten, {.orbit = false}, change));
  EXPECT_NEAR(*c.mean_nonaffine_kinetic_fraction, 0.03, 1e-5);
  EXPECT_EQ(c.find("nonaffine_kinetic_fraction")->max, 1);
  EXPECT_EQ(c.min_jacobian, 0.9);
  EXPECT_EQ(c.volume_error, 0.01);
  EXPECT_EQ(c.max_volume_error, 0.1);
}

TEST(Comparison, WhatIsMissingIsNamedAndTheRestCompared) {
  const auto lacking = [](bool Quantities::*group) {
    Quantities q{.orbit = false};
    q.*group = false;
    return compare(reduced_run(reduced_pulsation, ten, q), continuum_run(exact_pulsation, ten, q));
  };
  const auto check = [](const Comparison& c, std::vector<std::string> absent, const std::string& note) {
    for (const std::string& name : absent) EXPECT_EQ(c.find(name), nullptr) << name;
    ASSERT_FALSE(c.not_compared.empty());
    EXPECT_EQ(c.not_compared.front(), note);
    EXPECT_FALSE(c.series.empty());
    EXPECT_FALSE(terminal_table(c).empty());
    EXPECT_FALSE(comparison_json(c).dump().empty());
  };
  check(lacking(&Quantities::state), {"q_difference", "strain_difference"},
        "deformation and frequency (no column Q11 in reduced.csv)");
  check(lacking(&Quantities::energies), {"kinetic_difference"}, "energies (no column kinetic in reduced.csv)");
  check(lacking(&Quantities::momenta), {"circulation_difference"}, "angular momentum (no column J1 in reduced.csv)");
  check(lacking(&Quantities::multiplier), {"multiplier_difference"},
        "multiplier (no column multiplier in reduced.csv)");
  check(lacking(&Quantities::axes), {"a1_difference", "volume_ratio_difference"},
        "semi-axes (no column a1 in reduced.csv)");
  check(lacking(&Quantities::nonaffine), {"nonaffine_displacement"},
        "non-affine motion (no column nonaffine_kinetic_fraction in continuum.csv)");
}

TEST(Comparison, TimeAloneIsStillAComparison) {
  const Quantities none{false, false, false, false, false, false, false};
  const Comparison c = compare(reduced_run(reduced_pulsation, ten, none), continuum_run(exact_pulsation, ten, none));
  EXPECT_TRUE(c.series.empty());
  EXPECT_EQ(c.not_compared.size(), 8u);
  EXPECT_FALSE(terminal_table(c).empty());
  EXPECT_EQ(comparison_table(c).n_rows(), 201u);
}

TEST(Comparison, TablesThatDoNotBelongTogetherAreRefused) {
  const auto message = [](const Table& r, const Table& c) -> std::string {
    try {
      (void)compare(r, c);
    } catch (const UserError& error) {
      return error.what();
    }
    return {};
  };
  const Table r = reduced_run(reduced_pulsation, ten);
  EXPECT_NE(message(r, continuum_run(exact_pulsation, times(200, 10))).find("201 samples, continuum.csv 200"),
            std::string::npos);
  const std::string shifted = message(r, continuum_run(exact_pulsation, times(201, 10.1)));
  EXPECT_NE(shifted.find("sample 2 is at t = 0.05 in reduced.csv"), std::string::npos) << shifted;
  EXPECT_NE(message(r, continuum_run(exact_pulsation, {})), "");
  Table broken = continuum_run(exact_pulsation, ten);
  broken.values[1234] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(r, broken).find("not finite"), std::string::npos);
  EXPECT_EQ(message(r, continuum_run(exact_pulsation, ten)), "");
}

TEST(Comparison, AnySamplingIsComparedOnlyAnEvenOneIsFitted) {
  std::vector<double> uneven = ten;
  uneven[100] += 0.01;
  const Comparison c = compare(reduced_run(reduced_pulsation, uneven), continuum_run(exact_pulsation, uneven));
  EXPECT_FALSE(c.ratio);
  EXPECT_EQ(c.model.frequency.reason, "the samples are not equally spaced");
  EXPECT_GT(c.find("strain_difference")->max, 1);
  const Comparison one = compare(reduced_run(reduced_pulsation, {0}), continuum_run(exact_pulsation, {0}));
  EXPECT_EQ(one.find("q_difference")->max, 0);
}

}  // namespace
