/// The constraint ∫ψ ln J = 0 of polynomial bodies: its derivatives, their duals, and the solution of Gram systems.

#include <gtest/gtest.h>

#include "mechanics/core/dense_algebra.h"
#include "mechanics/core/memory.h"
#include "polynomial/samples.h"
#include "support/dense.h"
#include "systems/conservative_checks.h"

namespace pseudorigid::testing {
namespace {

using polynomial::constraint_matrix;

IncompressibleBody body_of(int degree, const Planes& planes) {
  return IncompressibleBody(BodySetup{.degree = degree, .reflect = planes, .semi_axes = {1.2, 0.9, 1}});
}

TEST(Constraint, DerivativesAgree) {
  std::mt19937 generator(1);
  for (int N = 1; N <= 4; ++N)
    for (const Planes& planes : {no_planes, Planes{false, true, false}, Planes{true, false, true}, all_planes}) {
      const IncompressibleBody body = body_of(N, planes);
      const VectorXd v = 0.1 * random_direction(body, generator);
      const VectorXd lambda = random_vector(body.space().n_pressures(), generator);
      expect_constraint_derivatives_agree(body, random_position(body, generator), v, lambda);
    }
}

/// Point by point, with the sum over functions as it stands.
TEST(Constraint, IsTheIntegralOfTheLogarithm) {
  std::mt19937 generator(2);
  const IncompressibleBody body = body_of(3, no_planes);
  const auto& space = body.space();
  const VectorXd q = random_position(body, generator);
  VectorXd g = body.make_multiplier(), expected = g;
  ASSERT_TRUE(body.constraint(q, g));
  for (int p = 0; p < space.n_points(); ++p) {
    const auto jets = space.functions_at(space.points()[p]);
    const double log_J = std::log(space.gradient(jets, q).determinant());
    for (int b = 0; b < space.n_functions(); ++b)
      if (const int place = space.pressure_place(b); place >= 0)
        expected[place] += space.weights()[p] * jets[b].value * log_J;
  }
  EXPECT_LT((g - expected).norm(), 1e-13);
}

TEST(Constraint, MatrixIsThatOfRateAndReaction) {
  std::mt19937 generator(3);
  for (const Planes& planes : {no_planes, Planes{true, false, false}, all_planes}) {
    const IncompressibleBody body = body_of(3, planes);
    const VectorXd q = random_position(body, generator), v = random_direction(body, generator);
    const VectorXd lambda = random_vector(body.space().n_pressures(), generator);
    const Eigen::MatrixXd G = constraint_matrix(body.space(), q);
    VectorXd r = body.make_multiplier(), f = body.make_vector();
    body.constraint_rate(q, v, r);
    body.add_reaction(q, lambda, f);
    EXPECT_LT((G * v - r).norm(), 1e-12);
    EXPECT_LT((G.transpose() * lambda - f).norm(), 1e-12);
  }
}

/// The least singular value of G at rest, in orthonormal bases: √15 for N = 1; 3.15 and 3.142 of PHYSICS section 10.
TEST(Constraint, DivergenceMapsOntoThePressures) {
  const std::pair<int, double> expected[]{{1, std::sqrt(15.0)}, {3, 3.15}, {5, 3.142}, {7, 3.142}};
  for (const auto& [N, least] : expected) {
    const IncompressibleBody body(BodySetup{.degree = N, .reflect = all_planes});
    const Eigen::MatrixXd G = constraint_matrix(body.space(), body.affine(Matrix3d::Identity()));
    const double found = singular_values(G).minCoeff();
    EXPECT_NEAR(found, least, N == 1 ? 1e-14 : 0.005) << N;
  }
}

/// In the linear limit G v = 0 is div v = 0 at every point.
TEST(Constraint, SmallMotionsAreFreeOfDivergenceEverywhere) {
  std::mt19937 generator(4);
  const IncompressibleBody body(BodySetup{.degree = 4});
  const auto& space = body.space();
  const VectorXd rest = body.affine(Matrix3d::Identity());
  const Eigen::MatrixXd G = constraint_matrix(space, rest);
  VectorXd v = random_direction(body, generator);
  v -= G.transpose() * mechanics::solve(G * G.transpose(), G * v);
  ASSERT_GT(v.norm(), 0.5);
  for (const std::array<double, 3>& xi : {std::array{0.1, 0.2, 0.3}, {0.9, 0.1, -0.3}, {0.0, 0.0, 1.0}})
    EXPECT_NEAR(space.gradient(space.functions_at(xi), v).trace(), 0, 1e-13);
}

TEST(GramSystem, ProductsWithoutAMatrixAreThoseOfTheMatrix) {
  std::mt19937 generator(5);
  for (const Planes& planes : {no_planes, all_planes}) {
    const IncompressibleBody body = body_of(3, planes);
    const VectorXd q1 = random_position(body, generator), q0 = random_position(body, generator);
    const VectorXd lambda = random_vector(body.space().n_pressures(), generator);
    const auto G = [&](const VectorXd& q) { return constraint_matrix(body.space(), q); };
    VectorXd product = body.make_multiplier();
    polynomial::ReactionsBetween(body.space(), q1, q0).multiply(lambda, product);
    EXPECT_LT((product - G(q1) * (G(q0).transpose() * lambda)).norm(), 1e-11);
    polynomial::ReactionsBetween(body.space(), q1, q1).multiply(lambda, product);
    EXPECT_LT((product - G(q1) * (G(q1).transpose() * lambda)).norm(), 1e-11);
  }
}

class GramSolve : public ::testing::Test {
 protected:
  /// Positions along a path; from one to the next the gradient changes by some hundredths.
  VectorXd position(int k) const { return rest + 0.001 * k * direction; }
  double residual(int k1, int k0, const VectorXd& lambda) const {
    VectorXd product = body.make_multiplier();
    polynomial::ReactionsBetween(body.space(), position(k1), position(k0)).multiply(lambda, product);
    return (r - product).norm();
  }

  std::mt19937 generator{6};
  IncompressibleBody body = body_of(5, Planes{false, true, false});
  VectorXd rest = body.affine(Matrix3d::Identity()), direction = random_direction(body, generator);
  VectorXd r = random_vector(body.space().n_pressures(), generator).normalized();
};

TEST_F(GramSolve, LeavesWhatItsCallerAdmits) {
  auto workspace = body.make_workspace();
  VectorXd lambda = body.make_multiplier();
  const double size = r.norm();
  for (int k = 0; k < 8; ++k) {
    const auto report = body.solve_gram(position(k + 1), position(k), r, workspace, lambda);
    ASSERT_TRUE(report.status) << report.status.reason();
    EXPECT_GT(report.iterations, 0);
    EXPECT_LE(residual(k + 1, k, lambda), 1.0001e-4 * size);
    workspace.residual_sought = 0.01 * size;
    ASSERT_TRUE(body.solve_gram(position(k + 1), position(k), r, workspace, lambda).status);
    EXPECT_LE(residual(k + 1, k, lambda), 1.0001e-2 * size);
    workspace.residual_sought = 0;
  }
}

TEST_F(GramSolve, FactorsSeldomerThanItSolvesAndAnewWhereTheFactorIsOld) {
  auto workspace = body.make_workspace();
  VectorXd lambda = body.make_multiplier();
  for (int k = 0; k < 40; ++k) {
    const VectorXd q0 = rest + 1e-4 * k * direction, q1 = rest + 1e-4 * (k + 1) * direction;
    ASSERT_TRUE(body.solve_gram(q1, q0, r, workspace, lambda).status);
  }
  const long n_slow = workspace.gram.n_factorizations();
  EXPECT_LT(n_slow, 10);
  // Far away at once: the old factor serves until its iterations have cost as much as a new one.
  const VectorXd far = body.affine(Vector3d(1.8, 0.8, 0.7).asDiagonal());
  mechanics::SolveReport report;
  for (int k = 0; k < 20; ++k) {
    report = body.solve_gram(far, far, r, workspace, lambda);
    ASSERT_TRUE(report.status);
  }
  EXPECT_EQ(workspace.gram.n_factorizations(), n_slow + 1);
  EXPECT_EQ(report.iterations, 1);
}

TEST_F(GramSolve, FailsWithASentenceWhereThereIsNoSolution) {
  auto workspace = body.make_workspace();
  VectorXd lambda = body.make_multiplier();
  const VectorXd broken = VectorXd::Constant(rest.size(), NAN);
  const auto report = body.solve_gram(broken, broken, r, workspace, lambda);
  ASSERT_FALSE(report.status);
  EXPECT_NE(report.status.reason().find("use a smaller step"), std::string::npos) << report.status.reason();
}

/// A solver that has been restored factors where the other one has, and so finds the same numbers, bit by bit.
TEST_F(GramSolve, ContinuesBitByBitAfterItsMemoryIsRestored) {
  auto one = body.make_workspace(), other = body.make_workspace();
  VectorXd lambda = body.make_multiplier(), of_other = lambda;
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(body.solve_gram(position(k + 1), position(k), r, one, lambda).status);
  std::vector<double> memory;
  mechanics::save_memory(one, memory);
  ASSERT_TRUE(mechanics::restore_memory(other, memory));
  for (int k = 5; k < 20; ++k) {
    ASSERT_TRUE(body.solve_gram(position(k + 1), position(k), r, one, lambda).status);
    ASSERT_TRUE(body.solve_gram(position(k + 1), position(k), r, other, of_other).status);
    ASSERT_EQ(lambda, of_other) << k;
  }
  bool matters = false;  // not where the factor has just become too old
  for (int k = 20; k < 25; ++k) {
    auto fresh = body.make_workspace();
    ASSERT_TRUE(body.solve_gram(position(k + 1), position(k), r, fresh, of_other).status);
    ASSERT_TRUE(body.solve_gram(position(k + 1), position(k), r, one, lambda).status);
    matters = matters || lambda != of_other;
  }
  EXPECT_TRUE(matters) << "what is restored matters";
}

}  // namespace
}  // namespace pseudorigid::testing
