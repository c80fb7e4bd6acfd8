/// Each kernel against another one: force = −dV, rate and curvature as derivatives of constraint and rate by central
/// differences, reaction as the transpose of rate, rows as rate, the multiplier of the motion, the pressure basis.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "continuum/balls.h"
#include "continuum/constraint/gram_solver.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

/// A deformed ball: affine part and nodal noise far from inversion.
class Kernels : public ::testing::TestWithParam<int> {
 protected:
  std::mt19937 generator{7};
  ElasticBall ball{half, GetParam(), 0, ciarlet_geymonat};
  Vector x = deformed(), v = noise();

  Vector deformed() {
    Matrix3d Q;
    Q << 1.2, 0.2, 0, -0.1, 0.8, 0, 0, 0, 1.05;
    Vector result = ball.affine_field(Q);
    result.add(0.1, noise());
    return result;
  }
  /// Of the size of the distance between nodes, so that gradients are of the order of 1.
  Vector noise() {
    Vector result = random_field(ball.make_vector(), generator);
    result *= 0.3 / (GetParam() * GetParam());
    return result;
  }

  Vector moved(double s) const {
    Vector result = x;
    result.add(s, v);
    return result;
  }

  /// (y(h) − y(−h)) / 2h, extrapolated: error h⁴.
  template <class Function>
  static auto derivative(const Function& y) {
    const auto difference = [&](double h) {
      auto d = y(h);
      mechanics::axpy(-1.0, y(-h), d);
      mechanics::scale(1 / (2 * h), d);
      return d;
    };
    constexpr double h = 1e-3;
    auto d = difference(h);
    mechanics::scale(4.0 / 3, d);
    mechanics::axpy(-1.0 / 3, difference(2 * h), d);
    return d;
  }

  static void expect_near(Vector a, const Vector& b, double tolerance) {
    const double size = b.linfty_norm();
    ASSERT_GT(size, 1e-3);
    a.add(-1.0, b);
    EXPECT_LT(a.linfty_norm(), tolerance * size);
  }
};

TEST_P(Kernels, RateIsTheDerivativeOfTheConstraint) {
  Vector rate = ball.make_multiplier();
  ball.constraint_rate(x, v, rate);
  expect_near(derivative([&](double s) {
                Vector g = ball.make_multiplier();
                EXPECT_TRUE(ball.constraint(moved(s), g));
                return g;
              }),
              rate, 1e-8);
}

TEST_P(Kernels, CurvatureIsTheDerivativeOfTheRate) {
  Vector curvature = ball.make_multiplier();
  ball.constraint_curvature(x, v, curvature);
  expect_near(derivative([&](double s) {
                Vector r = ball.make_multiplier();
                ball.constraint_rate(moved(s), v, r);
                return r;
              }),
              curvature, 1e-8);
}

TEST_P(Kernels, ForceIsMinusTheDerivativeOfTheEnergy) {
  v.add(1.0, ball.affine_field(diagonal(0.3, -0.2, 0.1)));
  auto workspace = ball.make_workspace();
  Vector f = ball.make_vector();
  ASSERT_TRUE(ball.force(0, x, v, workspace, f));
  const Eigen::Matrix<double, 1, 1> slope =
      derivative([&](double s) { return Eigen::Matrix<double, 1, 1>(ball.kernels().integrals(moved(s), v).elastic); });
  ASSERT_GT(std::abs(f * v), 1e-3);
  EXPECT_NEAR(slope(0), -(f * v), 1e-8 * std::abs(f * v));
}

TEST_P(Kernels, ReactionIsTheTransposeOfTheRate) {
  for (int i = 0; i < 5; ++i) {
    const Vector lambda = random_field(ball.make_multiplier(), generator);
    v = noise();
    Vector rate = ball.make_multiplier(), reaction = ball.make_vector();
    ball.constraint_rate(x, v, rate);
    ball.add_reaction(x, lambda, reaction);
    EXPECT_NEAR(lambda * rate, reaction * v, 1e-13 * lambda.l2_norm() * rate.l2_norm());
  }
}

TEST_P(Kernels, ReactionRateIsTheDerivativeOfTheReaction) {
  const Vector lambda = random_field(ball.make_multiplier(), generator);
  Vector rate = ball.make_vector();
  ball.add_reaction_rate(x, v, lambda, rate);
  expect_near(derivative([&](double s) {
                Vector reaction = ball.make_vector();
                ball.add_reaction(moved(s), lambda, reaction);
                return reaction;
              }),
              rate, 1e-8);
}

/// With the inverse, whose solver takes the tangent at x from the same pass, and with two levels. What follows,
/// reaction and solve, must be what it is without the pass.
TEST_P(Kernels, ForceWithReactionIsTheSumOfTheTwo) {
  const Vector lambda = random_field(ball.make_multiplier(), generator);
  auto workspace = ball.make_workspace();
  Vector sum = ball.make_vector();
  ASSERT_TRUE(ball.force(0, x, v, workspace, sum));
  ball.add_reaction(x, lambda, sum);
  Vector reaction = ball.make_vector();
  ball.add_reaction(x, lambda, reaction);
  for (const auto method : {continuum::GramMethod::dense, continuum::GramMethod::two_level}) {
    ElasticBall::Workspace fused{continuum::GramSolver(ball.space(), ball.kernels(), method), 0};
    Vector f = ball.make_vector(), again = ball.make_vector(), apart = ball.make_vector();
    ASSERT_TRUE(ball.force_with_reaction(0, x, v, lambda, fused, f));
    expect_near(f, sum, 1e-13);
    ball.add_reaction(x, lambda, again, fused);
    expect_near(again, reaction, 1e-13);
    ball.add_reaction(moved(0.1), lambda, again, fused);
    ball.add_reaction(moved(0.1), lambda, apart);
    apart += reaction;
    expect_near(again, apart, 1e-13);
    ElasticBall::Workspace fresh{continuum::GramSolver(ball.space(), ball.kernels(), method), 0};
    Vector solution = ball.make_multiplier(), expected = ball.make_multiplier();
    ASSERT_TRUE(ball.force_with_reaction(0, x, v, lambda, fused, f));
    ASSERT_TRUE(ball.solve_gram(moved(0.01), x, lambda, fused, solution).status);
    ASSERT_TRUE(ball.solve_gram(moved(0.01), x, lambda, fresh, expected).status);
    expect_near(solution, expected, 1e-9);
  }
}

TEST_P(Kernels, RowsAreThoseOfTheRate) {
  Vector rate = ball.make_multiplier(), from_rows = rate;
  ball.constraint_rate(x, v, rate);
  const unsigned int n_pressure = ball.space().n_pressure();
  ball.kernels().constraint_rows(x, [&](unsigned int cell, std::span<const double> rows) {
    const auto& nodes = ball.space().cell_nodes(cell);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::size_t column = k % (3 * nodes.size());
      from_rows[cell * n_pressure + k / (3 * nodes.size())] += rows[k] * v[3 * nodes[column / 3] + column % 3];
    }
  });
  expect_near(from_rows, rate, 1e-12);
}

/// The reaction of λ_h = 1 on X tests ∫tr F⁻¹: the coefficients c of the constant give 1 at every node, |c|² = volume.
TEST_P(Kernels, PressureBasisIsOrthonormalAndHoldsConstants) {
  const Vector& X = ball.space().reference_positions();
  Vector c = ball.make_multiplier();
  ball.constraint_rate(X, X, c);
  c /= 3;
  EXPECT_NEAR(2 * (c * c), ball.volume(), 1e-12);
  std::vector<double> values(ball.space().nodes_per_cell());
  for (unsigned int cell = 0; cell < ball.space().n_cells(); ++cell) {
    ball.kernels().multiplier_at_nodes(c, cell, values);
    for (const double value : values) ASSERT_NEAR(value, 1, 1e-10);
  }
}

TEST_P(Kernels, PressureBasisAtNodesSumsToTheMultiplier) {
  const Vector lambda = random_field(ball.make_multiplier(), generator);
  const unsigned int n_nodes = ball.space().nodes_per_cell(), n_pressure = ball.space().n_pressure();
  std::vector<double> expected(n_nodes);
  unsigned int n_cells = 0;
  ball.kernels().pressure_basis_at_nodes([&](unsigned int cell, std::span<const double> psi) {
    ++n_cells;
    ASSERT_EQ(psi.size(), n_pressure * n_nodes);
    ball.kernels().multiplier_at_nodes(lambda, cell, expected);
    for (unsigned int i = 0; i < n_nodes; ++i) {
      double sum = 0;
      for (unsigned int j = 0; j < n_pressure; ++j) sum += lambda[cell * n_pressure + j] * psi[j * n_nodes + i];
      ASSERT_NEAR(sum, expected[i], 1e-10);
    }
  });
  EXPECT_EQ(n_cells, ball.space().n_cells());
}

TEST_P(Kernels, GramSolverSolvesTheMixedSystem) {
  auto workspace = ball.make_workspace();
  const Vector lambda = random_field(ball.make_multiplier(), generator);
  const Vector q1 = moved(0.02);
  Vector reaction = ball.make_vector(), r = ball.make_multiplier(), solution = r;
  ball.add_reaction(x, lambda, reaction);
  ball.apply_inverse_mass(reaction, reaction);
  ball.constraint_rate(q1, reaction, r);
  const auto report = ball.solve_gram(q1, x, r, workspace, solution);
  ASSERT_TRUE(report.status) << report.status.reason();
  EXPECT_GT(report.iterations, 0);
  reaction = 0.0;
  ball.add_reaction(x, solution, reaction);
  ball.apply_inverse_mass(reaction, reaction);
  Vector residual = r;
  ball.constraint_rate(q1, reaction, residual);
  residual.add(-1.0, r);
  EXPECT_LT(residual.l2_norm(), 2 * continuum::GramSolver::reduction * r.l2_norm());
}

TEST_P(Kernels, MultiplierOfAMotionThatIsNotFiniteFails) {
  auto workspace = ball.make_workspace();
  Vector lambda = ball.make_multiplier();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, 1e200}) {
    v.local_element(0) = bad;
    EXPECT_FALSE(mechanics::multiplier_of_motion(ball, {0, x, v}, workspace, lambda)) << bad;
  }
}

/// The acceleration a = M⁻¹(f + Gᵀλ) keeps the constraint to second order: G a + D²g(v, v) = 0.
TEST_P(Kernels, MultiplierOfMotionKeepsTheConstraint) {
  auto workspace = ball.make_workspace();
  Vector lambda = ball.make_multiplier(), a = ball.make_vector(), rate = lambda, curvature = lambda;
  const auto status = mechanics::multiplier_of_motion(ball, {0, x, v}, workspace, lambda);
  ASSERT_TRUE(status) << status.reason();
  ASSERT_TRUE(ball.force(0, x, v, workspace, a));
  ball.add_reaction(x, lambda, a);
  ball.apply_inverse_mass(a, a);
  ball.constraint_rate(x, a, rate);
  ball.constraint_curvature(x, v, curvature);
  rate.add(1.0, curvature);
  EXPECT_LT(rate.linfty_norm(), 1e-11 * a.linfty_norm());
}

/// Degree 1 has forces and energies, f = −dV in any direction v, and no constraint.
TEST(FirstDegree, HasForcesAndNoConstraint) {
  const continuum::BallSpace space(continuum::BallMesh(octant, 1), 1);
  const auto kernels = continuum::make_cell_kernels(space, ciarlet_geymonat);
  std::mt19937 generator(3);
  Vector x = space.reference_positions(), f = space.make_vector(), g = space.make_multiplier();
  x.add(0.05, random_field(x, generator));
  const Vector v = random_field(x, generator);
  const auto energy = [&](double s) {
    Vector moved = x;
    moved.add(s, v);
    return kernels->integrals(moved, v).elastic;
  };
  ASSERT_GT(kernels->force(x, f), 0);
  constexpr double h = 1e-4;  // differences of fourth order: the error is below 1e-9 of the slope
  const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
  ASSERT_GT(std::abs(f * v), 1e-3);
  EXPECT_NEAR(slope, -(f * v), 1e-8 * std::abs(f * v));
  EXPECT_THROW(kernels->constraint(x, g), std::invalid_argument);
  EXPECT_THROW(kernels->constraint_rate(x, v, g), std::invalid_argument);
  EXPECT_THROW(kernels->constraint_curvature(x, v, g), std::invalid_argument);
  EXPECT_THROW(kernels->add_reaction(x, g, f), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Degree, Kernels, ::testing::Range(2, 9));

}  // namespace
}  // namespace pseudorigid::testing
