#include "materials/maxwell_branch.h"

#include <gtest/gtest.h>

#include <random>

namespace pseudorigid::materials {
namespace {

using Metric = Symmetric<double>;
constexpr int n_lanes = mechanics::native_lanes;
using L = mechanics::Lanes<n_lanes>;

double det(const Metric& m) { return determinant(m, adjugate(m)); }
double energy(const Metric& strain, const Metric& metric) { return 0.5 * (dot(strain, adjugate(metric)) - 3); }

/// Random deformations with entries of Id + `size` (−1 … 1) and a positive determinant.
class Deformations {
 public:
  Tensor<double> next(double size) {
    for (;;) {
      Tensor<double> F;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) F(i, j) = (i == j) + size * uniform_(random_);
      if (determinant(F) > 0.1) return F;
    }
  }
  Metric metric(double size) { return isochoric_strain(next(size)); }

 private:
  std::mt19937_64 random_{20261127};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// The flow by n steps of the classical method of Runge and Kutta. Returns the dissipated energy over the modulus.
double integrate(const Metric& strain, double x, int n, Metric& metric) {
  struct Rate {
    Metric of_metric;
    double power;
  };
  const auto rate = [&](const Metric& C) {
    const Metric inverse = (1 / det(C)) * adjugate(C);
    const double trace = dot(strain, inverse);
    Tensor<double> B;  // strain · inverse
    const auto full = [](const Metric& m, int i, int j) {
      constexpr int place[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
      return m.a[place[i][j]];
    };
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        B(i, j) = 0;
        for (int k = 0; k < 3; ++k) B(i, j) += full(strain, i, k) * full(inverse, k, j);
      }
    return Rate{plus(strain, -trace / 3, C), 0.5 * (trace_of_square(B) - trace * trace / 3)};
  };
  double dissipated = 0;
  const double h = x / n;
  for (int i = 0; i < n; ++i) {
    const Rate k1 = rate(metric), k2 = rate(plus(metric, h / 2, k1.of_metric)),
               k3 = rate(plus(metric, h / 2, k2.of_metric)), k4 = rate(plus(metric, h, k3.of_metric));
    for (const auto& [k, weight] : {std::pair{&k1, h / 6}, {&k2, h / 3}, {&k3, h / 3}, {&k4, h / 6}}) {
      metric = plus(metric, weight, k->of_metric);
      dissipated += weight * k->power;
    }
  }
  return dissipated;
}

void expect_equal(const Metric& a, const Metric& b, double tolerance) {
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(a.a[k], b.a[k], tolerance) << k;
}

TEST(MaxwellBranch, FlowAndDissipationAreThoseOfTheDifferentialEquation) {
  Deformations random;
  for (const double size : {0.01, 0.3, 0.6})
    for (const double x : {0.003, 0.02, 0.3, 2.0, 9.0}) {
      const Metric strain = random.metric(size), start = random.metric(size);
      Metric exact = start, metric = start;
      const double stiff = 4 + dot(strain, adjugate(start)) + dot(adjugate(strain), start);
      const double dissipated = integrate(strain, x, static_cast<int>(200 + 400 * x * stiff), exact);
      EXPECT_NEAR(relax(strain, x, metric), dissipated, 1e-10 * (1 + dissipated)) << size << " " << x;
      expect_equal(metric, exact, 1e-9 * stiff);
    }
}

TEST(MaxwellBranch, FlowIsAGroupAndTendsToTheStrain) {
  Deformations random;
  for (int n = 0; n < 200; ++n) {
    const double size = n % 2 ? 0.7 : 0.05;
    const Metric strain = random.metric(size), start = random.metric(size);
    Metric once = start, twice = start, parts = start;
    relax(strain, 0.5, once);
    for (const double x : {0.2, 0.3}) relax(strain, x, twice);
    for (int i = 0; i < 500; ++i) relax(strain, 1e-3, parts);  // the branch for short times
    const double condition = (1 + dot(strain, strain)) * (1 + dot(start, start));
    expect_equal(once, twice, 1e-14 * condition);
    expect_equal(once, parts, 1e-13 * condition);
    relax(strain, 1e3, once);
    expect_equal(once, strain, 1e-14 * condition);
  }
}

TEST(MaxwellBranch, LosesItsEnergyAndNeverGains) {
  Deformations random;
  double worst_balance = 0;
  for (int n = 0; n < 1'000'000; ++n) {
    const double size = std::pow(10.0, -4 + 4 * (n % 1000) / 1000.0), x = std::pow(10.0, -6 + 8 * (n % 337) / 337.0);
    const Metric strain = random.metric(size);
    Metric metric = random.metric(size);
    const double before = energy(strain, metric), condition = (1 + dot(strain, strain)) * (1 + dot(metric, metric));
    const double lost = relax(strain, x, metric);
    ASSERT_GE(lost, 0) << n;
    worst_balance = std::max(worst_balance, std::abs(before - energy(strain, metric) - lost) / condition);
    ASSERT_GT(metric.a[0], 0) << n;
  }
  EXPECT_LT(worst_balance, 1e-13);
}

TEST(MaxwellBranch, DeterminantStaysOneInManySteps) {
  Deformations random;
  Metric metric = identity_metric;
  for (int n = 0; n < 100'000; ++n) relax(random.metric(0.3), 0.01, metric);
  EXPECT_NEAR(det(metric), 1, 1e-14);
}

TEST(MaxwellBranch, StressIsTheDerivativeOfTheEnergy) {
  Deformations random;
  for (int n = 0; n < 50; ++n) {
    const Tensor<double> F = random.next(0.4);
    Metric A{};
    add_branch(0.7, random.metric(0.3), A);
    add_branch(2.0, random.metric(0.3), A);
    const Tensor<double> P = stress_of_branches(F, A);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        constexpr double h = 1e-5;
        Tensor<double> more = F, less = F;
        more(i, j) += h;
        less(i, j) -= h;
        const double slope = (energy_of_branches(more, A, 2.7) - energy_of_branches(less, A, 2.7)) / (2 * h);
        EXPECT_NEAR(P(i, j), slope, 1e-7 * (1 + std::abs(slope)) / determinant(F));
      }
  }
}

TEST(MaxwellBranch, MeanStrainIgnoresRotations) {
  Deformations random;
  const Tensor<double> F = random.next(0.5);
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Tensor<double> turn{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
  expect_equal(mean_strain(F, product(turn, F)), isochoric_strain(F), 1e-14);
}

TEST(MaxwellBranch, LanesAreNumbersSideBySide) {
  Deformations random;
  for (const double x : {0.01, 0.5}) {
    Symmetric<L> strain, metric;
    Metric strains[n_lanes], metrics[n_lanes];
    for (int l = 0; l < n_lanes; ++l) {
      strains[l] = random.metric(0.2);
      metrics[l] = random.metric(0.2);
      for (int k = 0; k < 6; ++k) {
        strain.a[k].set(l, strains[l].a[k]);
        metric.a[k].set(l, metrics[l].a[k]);
      }
    }
    const L lost = relax(strain, x, metric);
    for (int l = 0; l < n_lanes; ++l) {
      EXPECT_NEAR(lost[l], relax(strains[l], x, metrics[l]), 1e-15);
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(metric.a[k][l], metrics[l].a[k], 1e-15);
    }
  }
}

}  // namespace
}  // namespace pseudorigid::materials
