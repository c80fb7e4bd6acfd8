/// Statements of Oliva, Geometric Mechanics, 5.7 on bipolar decompositions Q = TᵀAS along a motion, equation (5.121),
/// and the corrections 6 and 7. Decompositions, their rates and the residual of (5.121) are the program's
/// (reduced/bipolar.h); differences of the decompositions along the path are what they are compared with.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "reduced/bipolar.h"
#include "reduced/bipolar_path.h"
#include "reduced/samples.h"

namespace pseudorigid::testing {
namespace {

using Order = BipolarPath::Order;
using Term = BipolarPath::Term;

/// Samples that the differences of differences need on both sides.
constexpr int margin = 8;
/// Rates by differences, twice: 1e-15 of Q gives 1e-14 of T where the axes are apart by 0.1, and that over h² with
/// h = 0.0025 is 2e-9; seen is 1.3e-9, and 3e-7 with the double spacing (order 8).
constexpr double difference_tolerance = 1e-8;

/// A motion of (5.120) by RATTLE of order 8, which knows no axes.
struct PathMotion {
  std::vector<State<Sl3>> states;
  std::vector<Matrix3d> Q, Qdot;
  std::vector<double> lambda;
  double h;
};
PathMotion path_motion(const State<Sl3>& start, double end, double h) {
  const Sl3 body = neo_hookean_sl3();
  const long n = std::lround(end / h);
  const auto r = run<mechanics::Rattle8>(body, start, end, n, 2);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  PathMotion motion{r.states, {}, {}, {}, h};
  for (const auto& s : r.states) {
    motion.Q.push_back(s.q);
    motion.Qdot.push_back(s.v);
    motion.lambda.push_back(observed(body, s).multiplier);
  }
  return motion;
}
/// Three axes of their own frames, turning in space and in the body.
const PathMotion& generic_motion() {
  static const PathMotion motion = path_motion(benchmark_state<Sl3>(), 12, 0.0025);
  return motion;
}
/// The third axis turns with nothing and passes through the others, which turn with spin and circulation.
PathMotion crossing_motion(double h) {
  const Matrix3d Q = diagonal(1.5, 1.2, 1 / 1.8);
  return path_motion(moving<Sl3>(Q, Q * matrix({0.2, -0.8, 0, 0.5, -0.2, 0, 0, 0, 0})), 2, h);
}

/// −∂V̄/∂A + λA⁻¹ (det A = 1), the right side of (5.121).
Matrix3d right_side(const BipolarPath& path, int k, double lambda) {
  const Matrix3d& A = path.A[k];
  const Matrix3d dV = derivative(potential_per_m_bar(neo_hookean_sl3()), A).diagonal().asDiagonal();
  return lambda * A.inverse() - dV;
}
/// Samples away from coincident axes, a tenth of them.
std::vector<int> samples_apart(const BipolarPath& path) {
  std::vector<int> samples;
  for (int k = margin; k + margin < path.n_samples(); k += 10) {
    double gap = path.least_gap(k);
    for (int j = -margin; j <= margin; ++j) gap = std::min(gap, path.least_gap(k + j));
    if (gap > 0.1) samples.push_back(k);
  }
  return samples;
}
double largest_residual(const BipolarPath& path, const std::vector<double>& lambda, Term term) {
  double residual = 0;
  for (const int k : samples_apart(path))
    residual = std::max(residual, (path.acceleration(k, term) - right_side(path, k, lambda[k])).norm());
  return residual;
}

/// "Q_t = T_tᵀA_tS_t with smooth paths": Q, and Q̇ = Tᵀ(Ȧ − Ω*A + AΛ*)S with skew Ω* and Λ*, along a motion: the
/// program's rates, from Q̇ at the sample alone, are those of the path.
TEST(Statement_Eq5_121, VelocityInThePrincipalAxes) {
  const auto& motion = generic_motion();
  const BipolarPath path(motion.Q, motion.h);
  const auto samples = samples_apart(path);
  ASSERT_GT(samples.size(), 200u);
  double largest_turning = 0;
  for (const int k : samples) {
    const reduced::Bipolar b = path.at(k);
    const reduced::BipolarRates r = reduced::rates(b, motion.Qdot[k]);
    const Matrix3d A_rate = r.a_rate.asDiagonal();
    EXPECT_LT((b.T.transpose() * path.A[k] * b.S - motion.Q[k]).norm(), 1e-14);
    EXPECT_LT((r.Omega + r.Omega.transpose()).norm() + (r.Lambda + r.Lambda.transpose()).norm(), 1e-13);
    EXPECT_LT((r.Omega - path.Omega(k)).norm(), difference_tolerance);
    EXPECT_LT((r.Lambda - path.Lambda(k)).norm(), difference_tolerance);
    EXPECT_LT((A_rate - path.A_rate(k)).norm(), difference_tolerance);
    const Matrix3d u = A_rate - r.Omega * path.A[k] + path.A[k] * r.Lambda;
    EXPECT_LT((b.T.transpose() * u * b.S - motion.Qdot[k]).norm(), 1e-12);
    largest_turning = std::max(largest_turning, r.Omega.norm());
  }
  EXPECT_GT(largest_turning, 1);
}

/// The program's residual of (5.121) at sample k, with the force and a multiplier.
Matrix3d program_residual(const PathMotion& motion, int k, double lambda) {
  const Sl3 body = neo_hookean_sl3();
  std::array<State<Sl3>, 9> around;
  std::copy_n(motion.states.begin() + k - 4, around.size(), around.begin());
  Sl3::Workspace w;
  Matrix3d force = Matrix3d::Zero();
  EXPECT_TRUE(body.force(0, motion.Q[k], motion.Qdot[k], w, force));
  return reduced::residual_of_5_121(around, motion.h, -force, lambda, body.E0());
}

/// (5.120) ⇒ (5.121): "Ä + Ω*(Ω*A − Ȧ − AΛ*) + (−Ω*A + Ȧ + AΛ*)Λ* + d/dt(AΛ* − Ω*A) = −∂V̄/∂A + λA⁻¹", all three
/// diagonal and six other entries, along a generic elastic motion away from coincident axes: the program's residual,
/// and the left side by differences of the path.
TEST(Statement_Eq5_121, MotionsObeyTheEquationInThePrincipalAxes) {
  const auto& motion = generic_motion();
  const BipolarPath path(motion.Q, motion.h);
  EXPECT_LT(largest_residual(path, motion.lambda, Term::corrected), difference_tolerance);
  double residual = 0, with_another_multiplier = 0;
  for (const int k : samples_apart(path)) {
    residual = std::max(residual, program_residual(motion, k, motion.lambda[k]).norm());
    with_another_multiplier =
        std::max(with_another_multiplier, program_residual(motion, k, 1.01 * motion.lambda[k]).norm());
  }
  EXPECT_LT(residual, difference_tolerance);
  EXPECT_GT(with_another_multiplier, 1e-3);
}

/// (5.121) ⇒ (5.120): its left side is TQ̈Sᵀ along any path, a motion or not, so that (5.121) is (5.120) times T and
/// Sᵀ: the program's residual without forces, and the expanded Ä + d/dt(AΛ* − Ω*A) + ȦΛ* − Ω*Ȧ + AΛ*² + Ω*²A − 2Ω*AΛ*.
TEST(Statement_Eq5_121, LeftSideIsTheAccelerationOfAnyPath) {
  const auto Q_at = [](double t) -> Matrix3d {
    const Matrix3d left = rotation_z(t) * Eigen::AngleAxisd(0.4 + t * t, Vector3d::UnitX()).toRotationMatrix();
    const Matrix3d right = Eigen::AngleAxisd(std::sin(2 * t), Vector3d::UnitY()) * rotation_z(0.3 - 0.5 * t);
    return left * diagonal(2 + 0.2 * std::sin(3 * t), 1 + 0.1 * t * t, 0.5 + 0.1 * std::cos(t)) * right;
  };
  const double h = 0.01;
  std::vector<Matrix3d> Q;
  for (int k = 0; k <= 100; ++k) Q.push_back(Q_at(k * h));
  const BipolarPath path(Q, h);
  for (const int k : samples_apart(path)) {
    const Matrix3d Qddot = second_difference([&](int j) -> Matrix3d { return Q[k + j]; }, h);
    const Matrix3d acceleration = path.T[k] * Qddot * path.S[k].transpose();
    EXPECT_LT((path.acceleration(k) - acceleration).norm(), difference_tolerance);

    std::array<State<Sl3>, 9> around;
    for (int j = -4; j <= 4; ++j)
      around[j + 4] = {0, Q[k + j], first_difference([&](int i) { return Q_at((k + j + 0.1 * i) * h); }, 0.1 * h)};
    const reduced::Bipolar b = reduced::decompose(Q[k]);  // the residual's own signs of the axes
    const Matrix3d left_side = reduced::residual_of_5_121(around, h, Matrix3d::Zero(), 0, Matrix3d::Identity());
    EXPECT_LT((left_side - b.T * Qddot * b.S.transpose()).norm(), difference_tolerance);

    const reduced::BipolarRates r = reduced::rates(path.at(k), around[4].v);
    const Matrix3d A = path.A[k], A_rate = r.a_rate.asDiagonal();
    const Matrix3d rate = first_difference(
        [&](int j) -> Matrix3d { return path.A[k + j] * path.Lambda(k + j) - path.Omega(k + j) * path.A[k + j]; }, h);
    const Matrix3d expanded = path.A_second_rate(k) + rate + A_rate * r.Lambda - r.Omega * A_rate +
                              A * r.Lambda * r.Lambda + r.Omega * r.Omega * A - 2 * r.Omega * A * r.Lambda;
    EXPECT_LT((acceleration - expanded).norm(), difference_tolerance);
  }
}

/// "ΛΛ*" is AΛ*: with what is printed (Λ read as Λ*, no other Λ is defined) neither Q̇ nor (5.121) holds.
TEST(Correction_6, PrintedProductOfLambdasIsNotTheMotion) {
  const auto& motion = generic_motion();
  const BipolarPath path(motion.Q, motion.h);
  EXPECT_LT(largest_residual(path, motion.lambda, Term::corrected), difference_tolerance);
  EXPECT_GT(largest_residual(path, motion.lambda, Term::as_printed), 1e-3);
  double velocity_error = 0;
  for (const int k : samples_apart(path)) {
    const Matrix3d Qdot = path.T[k].transpose() * path.velocity(k, Term::as_printed) * path.S[k];
    velocity_error = std::max(velocity_error, (Qdot - motion.Qdot[k]).norm());
  }
  EXPECT_GT(velocity_error, 1e-3);
}

/// Right: T ∂(det Q)/∂Q Sᵀ = A⁻¹ det A, which is the program's reaction to a multiplier 1. The printed ∂(det Q)/∂Q̇ is
/// zero, det being a function of Q: no reaction would be left, (5.121) fails without it, and the motion without it
/// leaves SL(3).
TEST(Correction_6, PrintedDerivativeByTheVelocityLeavesNoReaction) {
  const auto& motion = generic_motion();
  const BipolarPath path(motion.Q, motion.h);
  double without_reaction = 0;
  for (const int k : samples_apart(path)) {
    Matrix3d reaction = Matrix3d::Zero();
    neo_hookean_sl3().add_reaction(motion.Q[k], 1, reaction);
    EXPECT_LT((path.T[k] * reaction * path.S[k].transpose() - Matrix3d(path.A[k].inverse())).norm(), 1e-12);
    without_reaction = std::max(without_reaction, program_residual(motion, k, 0).norm());
  }
  EXPECT_GT(without_reaction, 1e-3);

  const Gl3 unconstrained(neo_hookean_sl3().energy_density(), reduced::ReferenceBody::unit_ball());
  const auto start = benchmark_state<Gl3>();
  const auto free = run<mechanics::Rattle8>(unconstrained, start, 1, 10, 20);
  ASSERT_TRUE(free.finished()) << free.result.reason;
  EXPECT_NEAR(start.q.determinant(), 1, 1e-15);
  EXPECT_GT(std::abs(free.last().q.determinant() - 1), 0.1);
}

/// Right: ē_i = Σ_k T_ik e_k, the principal axes in space. The printed Σ_k T_ki e_k are none.
TEST(Correction_7, PrincipalAxesAreTheRowsOfT) {
  const auto& motion = generic_motion();
  const BipolarPath path(motion.Q, motion.h);
  double error_as_printed = 0;
  for (const int k : samples_apart(path)) {
    const Matrix3d C = motion.Q[k] * motion.Q[k].transpose();
    for (int i = 0; i < 3; ++i) {
      const double a_squared = path.A[k](i, i) * path.A[k](i, i);
      const Vector3d row = path.T[k].row(i), column = path.T[k].col(i);
      EXPECT_LT((C * row - a_squared * row).norm(), 1e-13);
      error_as_printed = std::max(error_as_printed, (C * column - a_squared * column).norm());
    }
  }
  EXPECT_GT(error_as_printed, 0.1);
}

/// Right: Ω* = −(Ω×), with the components of the angular velocity of the axes, dē_i/dt = ω × ē_i, in the axes: the
/// opposite sign to (M*)⁻¹Ṁ* = Ω× of 5.6.
TEST(Correction_7, OmegaStarIsMinusTheAngularVelocityOfTheAxes) {
  const auto& motion = generic_motion();
  const BipolarPath path(motion.Q, motion.h);
  double largest = 0;
  for (const int k : samples_apart(path)) {
    Vector3d omega = Vector3d::Zero();  // ω = ½Σ ē_i × dē_i/dt
    for (int i = 0; i < 3; ++i) {
      const Vector3d e = path.T[k].row(i);
      const Vector3d rate = first_difference([&](int j) -> Vector3d { return path.T[k + j].row(i); }, path.h);
      omega += 0.5 * e.cross(rate);
    }
    const Matrix3d Omega_hat = hat(path.T[k] * omega), Omega_star = reduced::rates(path.at(k), motion.Qdot[k]).Omega;
    EXPECT_LT((Omega_star + Omega_hat).norm(), difference_tolerance);
    largest = std::max(largest, (Omega_star - Omega_hat).norm());
  }
  EXPECT_GT(largest, 1) << "the sign of 5.6";
}

/// Largest change of T, S and Ȧ from one sample to the next.
double largest_jump(const BipolarPath& path) {
  double jump = 0;
  for (int k = 1; k + 1 < path.n_samples(); ++k) {
    jump = std::max({jump, (path.T[k + 1] - path.T[k]).norm(), (path.S[k + 1] - path.S[k]).norm(),
                     (path.A[k + 1] - 2 * path.A[k] + path.A[k - 1]).norm() / path.h});
  }
  return jump;
}
/// Samples between which the order of the axes by length changes.
int n_crossings(const BipolarPath& path) {
  int n = 0;
  const auto order = [&](int k) {
    const auto a = path.A[k].diagonal();
    return std::array{a[0] < a[1], a[1] < a[2], a[2] < a[0]};
  };
  for (int k = 1; k < path.n_samples(); ++k) n += order(k) != order(k - 1);
  return n;
}

/// "0 < a₁ < a₂ < a₃" (5.7.8 IV) and "σ₁ ≥ σ₂ ≥ σ₃" (5.7.1) cannot be asked for along a path: where axes cross, the
/// decomposition that follows them is smooth, and an order of them makes T and S jump.
TEST(Correction_7, AForcedOrderOfTheAxesJumpsWhereTheyCross) {
  double jump_before = 0;
  for (const double h : {0.01, 0.005, 0.0025}) {
    const auto motion = crossing_motion(h);
    const BipolarPath continued(motion.Q, h, Order::continued), falling(motion.Q, h, Order::falling);
    ASSERT_GE(n_crossings(continued), 2);
    EXPECT_EQ(n_crossings(falling), 0);
    EXPECT_GT(largest_jump(falling), 1) << "whatever the spacing of the samples";
    const double jump = largest_jump(continued);
    if (jump_before > 0) {
      EXPECT_NEAR(jump / jump_before, 0.5, 0.1) << "falls with the spacing";
    }
    jump_before = jump;
  }
}

/// (5.121) as a diagnostic: along axes that are followed it holds through the crossing, along ordered ones it does not.
TEST(Correction_7, EquationHoldsThroughACrossingOfAxesThatAreFollowed) {
  const auto motion = crossing_motion(0.005);
  const auto residual_near_crossings = [&](Order order) {
    const BipolarPath continued(motion.Q, motion.h, Order::continued), path(motion.Q, motion.h, order);
    double residual = 0;
    int n_near = 0;
    for (int k = margin; k + margin < path.n_samples(); ++k)
      if (continued.least_gap(k) < 0.02) {
        residual = std::max(residual, (path.acceleration(k) - right_side(path, k, motion.lambda[k])).norm());
        ++n_near;
      }
    EXPECT_GT(n_near, 5);
    return residual;
  };
  EXPECT_LT(residual_near_crossings(Order::continued), difference_tolerance);
  EXPECT_GT(residual_near_crossings(Order::falling), 1);
}

/// "Integrate (5.120), use (5.121) as a diagnostic": with Q = A and Q̇ = [Q̇₁₂], (QQᵀ)˙₁₂ = a₂Q̇₁₂ = −Ω*₁₂(a₂² − a₁²), so
/// that Ω* grows without limit where the axes come together, while Q̇ and Q̈ are smooth.
TEST(Correction_7, RatesOfTheAxesAreSingularWhereAxesCoincide) {
  const Matrix3d Qdot = matrix({0, 1, 0, 0, 0, 0, 0, 0, 0});
  for (const double gap : {1e-1, 1e-2, 1e-3}) {
    const auto r = reduced::rates(reduced::decompose(diagonal(1 + gap, 1, 0.9)), Qdot);
    const double exact = std::sqrt(2.0) / (gap * (2 + gap));  // |Ω*| of both entries
    EXPECT_NEAR(r.Omega.norm(), exact, 1e-11 * exact) << "a₁ − a₂ = " << gap;
    EXPECT_NEAR(r.u.norm(), 1, 1e-15) << "while Q̇ is of order 1";
  }
}

}  // namespace
}  // namespace pseudorigid::testing
