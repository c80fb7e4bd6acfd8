/// Bipolar decompositions Q = TᵀAS along gravitating elastic motions: their values, rates, their way through crossings
/// of axes, and the residual of (5.121), with all that depends on time taken from the path.

#include "reduced/bipolar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "mechanics/core/explicit_multiplier.h"
#include "reduced/bipolar_path.h"
#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

using reduced::Bipolar;
using reduced::decompose;
using reduced::rates;

double smallest_gap(const Vector3d& a) {
  return std::min({std::abs(a[0] - a[1]), std::abs(a[1] - a[2]), std::abs(a[2] - a[0])});
}
void expect_decomposition(const Bipolar& b, const Matrix3d& Q) {
  const double size = Q.norm();
  EXPECT_LT((b.T.transpose() * b.a.asDiagonal() * b.S - Q).norm(), 1e-14 * size);
  for (const Matrix3d& R : {b.T, b.S}) EXPECT_NEAR(R.determinant(), 1, 1e-13);
  EXPECT_LT((b.T * b.T.transpose() - Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_GT(b.a.minCoeff(), 0);
}

/// Q = TᵀAS with rotations T and S and falling axes, for generic, nearly and exactly coincident axes, balls included.
TEST(Bipolar, DecompositionReproducesTheBody) {
  std::mt19937 generator(1);
  for (int i = 0; i < 300; ++i) {
    const double gap = std::array{1.0, 1e-4, 1e-9, 1e-15, 0.0}[i % 5];
    const Vector3d a = (i % 2 ? Vector3d(1, 1 + gap, 0.4) : Vector3d(1, 1 + gap, 1 - gap / 2)) * (i % 3 + 0.5);
    const Matrix3d Q = random_rotation(generator) * Matrix3d(a.asDiagonal()) * random_rotation(generator);
    const Bipolar b = decompose(Q);
    expect_decomposition(b, Q);
    EXPECT_LT((b.S * b.S.transpose() - Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_TRUE(b.a[0] >= b.a[1] && b.a[1] >= b.a[2]);
    Vector3d sorted = a;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    EXPECT_LT((b.a - sorted).norm(), 1e-14 * sorted.norm());
  }
  expect_decomposition(decompose(Matrix3d::Identity()), Matrix3d::Identity());
}

/// The decomposition that continues another is the same one if nothing has moved, whatever its order and signs.
TEST(Bipolar, ContinuationKeepsOrderAndSigns) {
  std::mt19937 generator(2);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d Q = random_deformation(generator);
    Bipolar before = decompose(Q);
    reduced::detail::exchange_axes(before, 0, 1);
    reduced::detail::exchange_axes(before, 1, 2);  // a turn of the axes
    reduced::detail::reverse_axis(before, 0);
    reduced::detail::reverse_axis(before, 2);
    const Bipolar again = decompose(Q, before);
    EXPECT_LT((again.T - before.T).norm() + (again.S - before.S).norm() + (again.a - before.a).norm(), 1e-12);
    expect_decomposition(again, Q);
  }
}

/// However far the other state: T and S stay rotations, and no order or signs of the axes are nearer.
TEST(Bipolar, ContinuationOfAFarStateIsADecomposition) {
  std::mt19937 generator(20);
  for (int i = 0; i < 300; ++i) {
    const Matrix3d Q = i % 3 ? random_deformation(generator) : random_rotation(generator);
    const Bipolar before = decompose(random_deformation(generator)), b = decompose(Q, before);
    expect_decomposition(b, Q);
    EXPECT_GT((b.T * before.T.transpose() + b.S * before.S.transpose()).trace(), 0);
  }
}

/// u = TQ̇Sᵀ = Ȧ − Ω*A + AΛ*, Ω* and Λ* skew: what `rates` returns has these properties.
TEST(Bipolar, RatesSolveTheirEquation) {
  std::mt19937 generator(3);
  for (int i = 0; i < 50; ++i) {
    const auto s = random_unimodular_state(generator);
    const Bipolar b = decompose(s.q);
    if (smallest_gap(b.a) < 0.05) continue;
    const auto r = rates(b, s.v);
    const Matrix3d A = b.a.asDiagonal(), A_rate = r.a_rate.asDiagonal();
    EXPECT_LT((r.Omega + r.Omega.transpose()).norm(), 1e-13 * (1 + r.Omega.norm()));
    EXPECT_LT((r.Lambda + r.Lambda.transpose()).norm(), 1e-13 * (1 + r.Lambda.norm()));
    EXPECT_LT((A_rate - r.Omega * A + A * r.Lambda - r.u).norm(), 1e-12 * (1 + r.Omega.norm()));
    EXPECT_LT((b.T.transpose() * r.u * b.S - s.v).norm(), 1e-13 * (1 + s.v.norm()));
  }
}

/// A ball has no axes: Ω* = Λ* = 0 by convention, never infinite.
TEST(Bipolar, RatesOfABallAreFinite) {
  const Matrix3d Qdot = matrix({0.3, 1, 2, -1, 0.2, 0.5, 0.1, 0.4, -0.5});
  for (const Matrix3d& Q : {Matrix3d(Matrix3d::Identity()), rotation_z(0.4), diagonal(2, 2, 0.25)}) {
    const auto r = rates(decompose(Q), Qdot);
    EXPECT_TRUE(r.Omega.allFinite() && r.Lambda.allFinite() && r.a_rate.allFinite());
    EXPECT_EQ(r.Omega(0, 1), 0);
    EXPECT_EQ(r.Lambda(0, 1), 0);
  }
}

/// A motion of a gravitating elastic body with RATTLE of order 8, at equal distances in time.
struct SampledMotion {
  LoadedSl3 body = elastic_sl3({moderate_gravity});
  double h;
  std::vector<BodyState> states;
  std::vector<Matrix3d> positions() const {
    std::vector<Matrix3d> Q;
    for (const auto& s : states) Q.push_back(s.q);
    return Q;
  }
};
SampledMotion sampled_motion(const BodyState& start, double end, double h) {
  SampledMotion motion{.h = h, .states = {}};
  const auto r = run<mechanics::Rattle8>(motion.body, start, end, std::lround(end / h), 2);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  motion.states = r.states;
  return motion;
}
/// Near an ellipsoid of type S, whose spin and circulation keep its axes apart, and off it in all directions.
BodyState generic_start() {
  const Matrix3d A = diagonal(2, 1.1, 1 / 2.2);
  const Matrix3d Qdot = hat({0, 0, 2.2}) * A - A * hat({0, 0, 0.1});
  return {0, A, Qdot + 0.15 * A * matrix({0.3, 0.7, -0.2, 0.5, -0.1, 0.9, 0.4, 0.2, -0.2})};
}
/// The third axis turns with nothing and passes through the others, which turn with spin and circulation; seen from
/// turned axes in space and in the ball, so that no axis is one of the coordinates.
BodyState crossing_start() {
  const Matrix3d Q = diagonal(1.5, 1.2, 1 / 1.8), L = matrix({0.2, -0.8, 0, 0.5, -0.2, 0, 0, 0, 0});
  std::mt19937 generator(4);
  const Matrix3d R = random_rotation(generator), S = random_rotation(generator);
  return {0, R * Q * S, R * Q * L * S};
}
std::vector<Bipolar> followed(const SampledMotion& motion) {
  std::vector<Bipolar> path;
  for (const auto& s : motion.states) path.push_back(path.empty() ? decompose(s.q) : decompose(s.q, path.back()));
  return path;
}
std::vector<Bipolar> sorted(const SampledMotion& motion) {
  std::vector<Bipolar> path;
  for (const auto& s : motion.states) path.push_back(decompose(s.q));
  return path;
}
/// Largest change of T, S and the rate of A from one sample to the next.
double largest_jump(const std::vector<Bipolar>& path, double h) {
  double jump = 0;
  for (std::size_t k = 1; k + 1 < path.size(); ++k)
    jump = std::max({jump, (path[k + 1].T - path[k].T).norm(), (path[k + 1].S - path[k].S).norm(),
                     (path[k + 1].a - 2 * path[k].a + path[k - 1].a).norm() / h});
  return jump;
}
int n_crossings(const std::vector<Bipolar>& path) {
  const auto order = [](const Vector3d& a) { return std::array{a[0] < a[1], a[1] < a[2], a[2] < a[0]}; };
  int n = 0;
  for (std::size_t k = 1; k < path.size(); ++k) n += order(path[k].a) != order(path[k - 1].a);
  return n;
}

/// Through crossings the followed decomposition is smooth: its differences fall with the distance of the samples, and
/// it reproduces Q. In falling order T and S jump and the axes have corners, whatever the distance.
TEST(BipolarPath, IsSmoothThroughCrossingsAndSortedAxesAreNot) {
  double before = 0;
  for (const double h : {0.01, 0.005, 0.0025}) {
    const auto motion = sampled_motion(crossing_start(), 2, h);
    const auto path = followed(motion);
    ASSERT_GE(n_crossings(path), 2);
    for (std::size_t k = 0; k < path.size(); ++k) expect_decomposition(path[k], motion.states[k].q);
    const double jump = largest_jump(path, h);
    EXPECT_LT(jump, 10 * h);
    if (before > 0) {
      EXPECT_NEAR(jump / before, 0.5, 0.1);
    }
    before = jump;
    EXPECT_EQ(n_crossings(sorted(motion)), 0);
    EXPECT_GT(largest_jump(sorted(motion), h), 0.5);
  }
}

/// A sample on the crossing itself, where axes coincide to round-off and the frames in their plane are arbitrary, does
/// not break the path: Q(t) = R diag(1 + t, 1 − t, 0.6) S with R, S at 45° to what the decomposition would choose.
TEST(BipolarPath, GoesOnThroughASampleOnTheCrossing) {
  const Matrix3d R = rotation_z(0.7854) * Eigen::AngleAxisd(0.3, Vector3d::UnitX()).toRotationMatrix();
  const Matrix3d S = Eigen::AngleAxisd(1.1, Vector3d::UnitY()).toRotationMatrix() * rotation_z(-0.5);
  const double h = 0.01;
  std::optional<Bipolar> before;
  for (int k = -10; k <= 10; ++k) {
    const Matrix3d Q = R * diagonal(1 + k * h, 1 - k * h, 0.6) * S;
    const Bipolar b = before ? decompose(Q, *before) : decompose(Q);
    expect_decomposition(b, Q);
    if (before) {
      EXPECT_LT((b.T - before->T).norm() + (b.S - before->S).norm(), 1e-10) << "frames stand still, k = " << k;
      EXPECT_LT((b.a - before->a).norm(), 2 * h) << "k = " << k;
    }
    before = b;
  }
}

/// Samples at a tenth, with the axes apart by `gap` in the samples from k − margin to k + margin.
std::vector<int> samples_apart(const std::vector<Bipolar>& path, int margin, double gap) {
  std::vector<int> samples;
  const int n = static_cast<int>(path.size());
  for (int k = margin; k + margin < n; k += 10) {
    double least = HUGE_VAL;
    for (int j = -margin; j <= margin; ++j) least = std::min(least, smallest_gap(path[k + j].a));
    if (least > gap) samples.push_back(k);
  }
  return samples;
}

/// Ω* = ṪTᵀ, Λ* = ṠSᵀ and Ȧ by differences of order 8 of the followed decomposition are those that Q̇ gives.
TEST(BipolarPath, RatesAreTheDifferencesOfThePath) {
  const auto motion = sampled_motion(generic_start(), 12, 0.005);
  const auto path = followed(motion);
  const auto samples = samples_apart(path, 4, 0.2);
  ASSERT_GT(samples.size(), 50u);
  double largest = 0;
  for (const int k : samples) {
    const auto r = rates(path[k], motion.states[k].v);
    const Matrix3d T_rate = first_difference([&](int j) { return path[k + j].T; }, motion.h);
    const Matrix3d S_rate = first_difference([&](int j) { return path[k + j].S; }, motion.h);
    const Vector3d a_rate = first_difference([&](int j) { return path[k + j].a; }, motion.h);
    EXPECT_LT((r.Omega - T_rate * path[k].T.transpose()).norm(), 1e-9);
    EXPECT_LT((r.Lambda - S_rate * path[k].S.transpose()).norm(), 1e-9);
    EXPECT_LT((r.a_rate - a_rate).norm(), 1e-10);
    largest = std::max(largest, r.Omega.norm());
  }
  EXPECT_GT(largest, 1);
}

/// (5.121) with Ω*, Λ*, A and all their derivatives by differences of the path, which knows no acceleration: the
/// residual against −∂V̄/∂A + λA⁻¹ per m̄ of the body with gravity.
double residual_by_differences(const SampledMotion& motion, BipolarPath::Term term, double gap) {
  const BipolarPath path(motion.positions(), motion.h);
  constexpr int margin = 8;
  double largest = 0;
  int n = 0;
  for (int k = margin; k + margin < path.n_samples(); k += 10) {
    double least = HUGE_VAL;
    for (int j = -margin; j <= margin; ++j) least = std::min(least, path.least_gap(k + j));
    if (least < gap) continue;
    const Matrix3d& A = path.A[k];
    const double lambda = observed(motion.body, motion.states[k]).multiplier;
    const Matrix3d right_side = lambda * A.inverse() - motion.body.energy_density().gradient(A) / motion.body.m_bar();
    largest = std::max(largest, (path.acceleration(k, term) - right_side).norm());
    ++n;
  }
  EXPECT_GT(n, 20);
  return largest;
}

/// The residual is round-off over h² and h⁸ of truncation: ≤ 1e-9 where axes are apart by 0.3; with ΛΛ* in place of AΛ*
/// as the book prints it is of order 1.
TEST(Equation_5_121, HoldsAlongAGravitatingElasticMotionAndThePrintedFormFails) {
  const auto motion = sampled_motion(generic_start(), 12, 0.005);
  EXPECT_LT(residual_by_differences(motion, BipolarPath::Term::corrected, 0.3), 1e-9);
  EXPECT_GT(residual_by_differences(motion, BipolarPath::Term::as_printed, 0.3), 1e-3);
}

/// The program's residual along the dense output of the explicit method of order 8, away from coincident axes: 1e-12
/// from round-off over h, and truncation of order 8 (seen 4e-8 with four times the distance of the samples).
TEST(Equation_5_121, HoldsAlongDenseOutput) {
  for (const auto& body :
       {elastic_sl3({moderate_gravity}), elastic_sl3({moderate_gravity, generic_quadratic()}),
        elastic_sl3({moderate_gravity, Matrix3d::Zero(), reduced::ReferenceBody::ellipsoid({1.3, 1, 0.8})})}) {
    const double h = 0.0025;
    const auto states = integrate_samples(mechanics::ExplicitMultiplier(body), generic_start(), 8, 3200, 1e-15);
    double largest = 0, wrong_multiplier = 0;
    int n = 0;
    for (std::size_t k = 4; k + 4 < states.size(); k += 40) {
      double least = HUGE_VAL;
      for (std::size_t j = k - 4; j <= k + 4; ++j) least = std::min(least, smallest_gap(decompose(states[j].q).a));
      if (least < 0.3) continue;
      std::array<BodyState, 9> around;
      std::copy(states.begin() + static_cast<long>(k) - 4, states.begin() + static_cast<long>(k) + 5, around.begin());
      const Matrix3d gradient = body.energy_density().gradient(states[k].q);
      const double lambda = observed(body, states[k]).multiplier;
      const auto residual = [&](double l) {
        return reduced::residual_of_5_121(around, h, gradient, l, body.E0()).cwiseAbs().maxCoeff();
      };
      largest = std::max(largest, residual(lambda));
      wrong_multiplier = std::max(wrong_multiplier, residual(lambda + 1e-3));
      ++n;
    }
    EXPECT_GT(n, 10);
    EXPECT_LT(largest, 1e-9);
    EXPECT_GT(wrong_multiplier, 1e-4) << "the residual sees what is wrong";
  }
}

/// The observable: its frames are those followed, Ω* and Λ* the entries 12, 13, 23, and its residual is small, at
/// samples as far apart as one looks.
TEST(Equation_5_121, IsAnObservable) {
  const auto body = elastic_sl3({moderate_gravity});
  LoadedSl3::Workspace w;
  std::optional<Bipolar> before;
  const auto motion = sampled_motion(generic_start(), 12, 0.05);
  const auto path = followed(motion);
  int n_apart = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    auto o = observed(body, motion.states[k]);
    ASSERT_TRUE(reduced::observe_bipolar(body, motion.states[k], w, before, o));
    EXPECT_EQ(o.axes, path[k].a);
    EXPECT_EQ(o.T, path[k].T);
    EXPECT_EQ(o.S, path[k].S);
    const auto r = rates(path[k], motion.states[k].v);
    EXPECT_EQ(o.Omega_star, Vector3d(r.Omega(0, 1), r.Omega(0, 2), r.Omega(1, 2)));
    EXPECT_EQ(o.Lambda_star, Vector3d(r.Lambda(0, 1), r.Lambda(0, 2), r.Lambda(1, 2)));
    if (smallest_gap(path[k].a) < 0.15) continue;
    EXPECT_LT(o.bipolar_residual, 1e-9) << "t = " << motion.states[k].t;
    ++n_apart;
  }
  EXPECT_GT(n_apart, 50);
}

}  // namespace
}  // namespace pseudorigid::testing
