/// One RATTLE substep from a projected state, on a ball without symmetry. The impulse M(vⁿ⁺¹ − vⁿ) is
/// (h/2)(f(qₙ) + f(qₙ₊₁)) and reactions that act only as G(qₙ)ᵀΛ + G(qₙ₊₁)ᵀμ: Λ and μ are found by least squares over
/// all nodes, and nothing is left. With them the discrete moment identity (PHYSICS 7.1) holds,
///
///   (Q̇_Mⁿ⁺¹ − Q̇_Mⁿ)E₀,h = −(h/2)[∫P(qₙ) + ∫P(qₙ₊₁)] + ∫Λ_h F⁻ᵀ(qₙ) + ∫μ_h F⁻ᵀ(qₙ₊₁),
///
/// the right-hand side not by the kernels of force and reaction: ∫λ_h F⁻ᵀ E_ij = λ·G(x)(E_ij X), and for the
/// neo-Hookean law ∫P = ∫F − ∫F⁻ᵀ. Reactions have no torque, whatever their multiplier.

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "continuum/balls.h"
#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

struct MomentIdentity : ::testing::TestWithParam<int> {
  static constexpr double h = 0.02;
  ElasticBall ball{whole, GetParam(), 0, neo_hookean};
  mechanics::RattleWorkspace<ElasticBall> workspace{ball};
  State<ElasticBall> before, after;

  void SetUp() override {
    Matrix3d Q, L;
    Q << 1.1, 0.2, 0, -0.1, 0.9, 0.15, 0.05, 0, 1;
    L << 0.2, -0.7, 0.3, 0.8, -0.3, 0.2, -0.1, 0.4, 0.1;
    Q /= std::cbrt(Q.determinant());
    before = affine_state(ball, Q, L * Q);
    advance(20);  // away from affine fields
    after = before;
    ASSERT_TRUE(mechanics::Rattle::advance(ball, h, after, workspace));
    ASSERT_TRUE(mechanics::Rattle::project_velocity(ball, after, workspace));
  }

  void advance(int n_steps) {
    for (int i = 0; i < n_steps; ++i) ASSERT_TRUE(mechanics::Rattle::advance(ball, h, before, workspace));
    ASSERT_TRUE(mechanics::Rattle::project_velocity(ball, before, workspace));
  }

  Vector force(const State<ElasticBall>& state) {
    Vector f = ball.make_vector();
    EXPECT_TRUE(ball.force(0, state.q, state.v, workspace.system, f));
    return f;
  }

  /// Impulse of the reactions, M(vⁿ⁺¹ − vⁿ) − (h/2)(f + f).
  Vector reaction_impulse() {
    Vector impulse = after.v;
    impulse.add(-1.0, before.v);
    impulse.scale(ball.space().mass());
    impulse.add(-h / 2, force(before), -h / 2, force(after));
    return impulse;
  }

  /// Columns of G(x)ᵀ.
  Eigen::MatrixXd reactions(const Vector& x) {
    Eigen::MatrixXd result(x.size(), ball.make_multiplier().size());
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      Vector unit = ball.make_multiplier(), f = ball.make_vector();
      unit[static_cast<unsigned int>(j)] = 1;
      ball.add_reaction(x, unit, f);
      result.col(j) = Eigen::Map<const Eigen::VectorXd>(f.begin(), result.rows());
    }
    return result;
  }

  /// Λ and μ, and how much of the impulse they leave.
  struct Multipliers {
    Vector Lambda, mu;
    double residual;
  };
  Multipliers multipliers() {
    const Vector impulse = reaction_impulse();
    const Eigen::Map<const Eigen::VectorXd> b(impulse.begin(), impulse.size());
    const Eigen::MatrixXd first = reactions(before.q), second = reactions(after.q);
    Eigen::MatrixXd both(first.rows(), first.cols() + second.cols());
    both << first, second;
    const Eigen::VectorXd solution = mechanics::least_squares(both, b, 1e-12);
    Multipliers result{ball.make_multiplier(), ball.make_multiplier(), (both * solution - b).norm() / b.norm()};
    std::copy_n(solution.data(), first.cols(), result.Lambda.begin());
    std::copy_n(solution.data() + first.cols(), second.cols(), result.mu.begin());
    return result;
  }

  /// ∫λ_h F⁻ᵀ dX
  Matrix3d pressure_moment(const Vector& x, const Vector& lambda) {
    Matrix3d result;
    Vector rate = ball.make_multiplier();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Matrix3d unit = Matrix3d::Zero();
        unit(i, j) = 1;
        ball.constraint_rate(x, ball.affine_field(unit), rate);
        result(i, j) = lambda * rate;
      }
    return result;
  }

  /// ∫P dX of the neo-Hookean law, P = F − F⁻ᵀ.
  Matrix3d stress_moment(const State<ElasticBall>& state) {
    Vector one = ball.make_multiplier();
    const Vector& X = ball.space().reference_positions();
    ball.constraint_rate(X, X, one);
    one /= 3;  // tr Id
    return ball.volume() * observed(ball, state, {{.multiplier = false}}).F - pressure_moment(state.q, one);
  }
};

TEST_P(MomentIdentity, ImpulseIsThatOfForcesAndReactions) {
  EXPECT_GT(reaction_impulse().linfty_norm(), 1e-4);
  EXPECT_LT(multipliers().residual, 1e-12);
}

TEST_P(MomentIdentity, HoldsToRoundOff) {
  const Multipliers found = multipliers();
  const Matrix3d left = ball.nodal_moment(after.v, ball.space().reference_positions()) -
                        ball.nodal_moment(before.v, ball.space().reference_positions());
  const Matrix3d right = -h / 2 * (stress_moment(before) + stress_moment(after)) +
                         pressure_moment(before.q, found.Lambda) + pressure_moment(after.q, found.mu);
  EXPECT_GT(left.norm(), 1e-3);
  EXPECT_LT((left - right).norm(), 1e-13);
}

TEST_P(MomentIdentity, ReactionsHaveNoTorque) {
  std::mt19937 generator(4);
  for (const State<ElasticBall>& state : {before, after}) {
    Vector reaction = ball.make_vector();
    ball.add_reaction(state.q, random_field(ball.make_multiplier(), generator), reaction);
    ball.apply_inverse_mass(reaction, reaction);
    const Matrix3d moment = ball.nodal_moment(reaction, state.q);
    EXPECT_GT(moment.norm(), 1e-3);
    EXPECT_LT(mechanics::axial_vector(moment).norm(), 1e-13 * moment.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Degree, MomentIdentity, ::testing::Values(2, 3));

}  // namespace
}  // namespace pseudorigid::testing
