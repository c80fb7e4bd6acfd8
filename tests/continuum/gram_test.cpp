/// The solves of G(q₁)M⁻¹G(q₀)ᵀλ = r: what they are preconditioned with changes their cost, not their result.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "continuum/sheared.h"

namespace pseudorigid::testing {
namespace {

using continuum::GramMethod;
using continuum::Vector;

/// Iterations of one solve for a residual of all frequencies, with a preconditioner of the same position.
int n_iterations(const ElasticBall& ball, const Vector& x, Vector& lambda) {
  auto workspace = ball.make_workspace();
  std::mt19937 generator(7);
  const Vector r = random_field(ball.make_multiplier(), generator);
  const auto report = ball.solve_gram(x, x, r, workspace, lambda);
  EXPECT_TRUE(report.status) << report.status.reason();
  Vector remainder = ball.make_vector(), product = ball.make_multiplier();
  ball.add_reaction(x, lambda, remainder);
  ball.apply_inverse_mass(remainder, remainder);
  ball.constraint_rate(x, remainder, product);
  product -= r;
  EXPECT_LE(product.l2_norm(), 1.01 * continuum::GramSolver::reduction * r.l2_norm());
  return report.iterations;
}

TEST(GramSolver, TwoLevelsAndADenseInverseFindTheSameMultiplier) {
  for (const Sector& sector : {octant, half}) {
    const ElasticBall dense(sector, 3, 1, neo_hookean, {}, MPI_COMM_SELF, GramMethod::dense);
    const ElasticBall two_level(sector, 3, 1, neo_hookean, {}, MPI_COMM_SELF, GramMethod::two_level);
    const State<ElasticBall> state{0, sheared(two_level, 0.2), two_level.affine_field(diagonal(0.3, 0.2, -0.5))};
    Vector of_factor = dense.make_multiplier(), of_two_levels = of_factor;
    auto factor = dense.make_workspace(), levels = two_level.make_workspace();
    ASSERT_TRUE(mechanics::multiplier_of_motion(dense, state, factor, of_factor));
    ASSERT_TRUE(mechanics::multiplier_of_motion(two_level, state, levels, of_two_levels));
    of_two_levels -= of_factor;
    // Both refine until round-off, which the condition of S (1e4) magnifies.
    EXPECT_LT(of_two_levels.linfty_norm(), 1e-10 * of_factor.linfty_norm());
  }
}

class TwoLevels : public ::testing::TestWithParam<int> {};

TEST_P(TwoLevels, TakeAboutAsManyIterationsOnEveryMesh) {
  const int degree = GetParam(), coarsest = 1, finest = degree <= 3 ? 3 : 2;
  for (const double deformation : {0.0, 0.4}) {
    int least = 1000, most = 0;
    for (int n_refinements = coarsest; n_refinements <= finest; ++n_refinements) {
      const ElasticBall ball(octant, degree, n_refinements, neo_hookean, {}, MPI_COMM_SELF, GramMethod::two_level);
      Vector lambda = ball.make_multiplier();
      const int n = n_iterations(ball, sheared(ball, deformation), lambda);
      RecordProperty("iterations_" + std::to_string(n_refinements) + (deformation > 0 ? "_sheared" : ""), n);
      std::printf("k = %d, refined %d, shear %.1f: %d iterations\n", degree, n_refinements, deformation, n);
      least = std::min(least, n);
      most = std::max(most, n);
    }
    EXPECT_LE(most, 30);
    EXPECT_LE(most, 1.5 * least);
  }
}
INSTANTIATE_TEST_SUITE_P(Degree, TwoLevels, ::testing::Values(2, 3, 4, 5, 6));

TEST(GramSolver, AStalePreconditionerIsMadeAnew) {
  const ElasticBall ball(octant, 3, 1, neo_hookean, {}, MPI_COMM_SELF, GramMethod::two_level);
  auto workspace = ball.make_workspace();
  std::mt19937 generator(3);
  const Vector r = random_field(ball.make_multiplier(), generator);
  Vector lambda = ball.make_multiplier();
  const Vector rest = ball.affine_field(Matrix3d::Identity()), flat = ball.affine_field(diagonal(2, 2, 0.25));
  ASSERT_TRUE(ball.solve_gram(rest, rest, r, workspace, lambda).status);
  for (int i = 0; i < 30; ++i) {
    const auto report = ball.solve_gram(flat, flat, r, workspace, lambda);
    ASSERT_TRUE(report.status) << report.status.reason();
  }
  EXPECT_EQ(workspace.gram.statistics().n_renewals, 2);
}

}  // namespace
}  // namespace pseudorigid::testing
