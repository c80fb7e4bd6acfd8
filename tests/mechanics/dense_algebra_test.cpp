/// Factorisations of dense matrices against their definitions.

#include "mechanics/core/dense_algebra.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pseudorigid::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double round_off = 1e-12;

MatrixXd entries(Eigen::Index n_rows, Eigen::Index n_columns) {
  return MatrixXd::NullaryExpr(n_rows, n_columns, [](Eigen::Index i, Eigen::Index j) {
    return std::sin(1.0 + 1.7 * static_cast<double>(i * j) + 0.3 * static_cast<double>(i - 2 * j));
  });
}
MatrixXd positive(Eigen::Index n) { return entries(n, n) * entries(n, n).transpose() + MatrixXd::Identity(n, n); }

TEST(DenseAlgebra, InverseOnAKernel) {
  const MatrixXd B = positive(7), G = entries(3, 7);
  MatrixXd T;
  ASSERT_TRUE(mechanics::invert_on_kernel(B, G, T));
  EXPECT_LT((T * G.transpose()).norm(), round_off);
  EXPECT_LT((G * T).norm(), round_off);
  EXPECT_LT((T * B * T - T).norm(), round_off);
  ASSERT_TRUE(mechanics::invert_on_kernel(B, MatrixXd(0, 7), T));
  EXPECT_LT((T * B - MatrixXd::Identity(7, 7)).norm(), round_off);
  EXPECT_FALSE(mechanics::invert_on_kernel(-B, G, T));
  EXPECT_FALSE(mechanics::invert_on_kernel(B, MatrixXd::Zero(3, 7), T));
}

TEST(DenseAlgebra, CholeskyFactor) {
  const MatrixXd A = positive(6), B = entries(6, 2);
  mechanics::CholeskyFactor factor;
  ASSERT_TRUE(factor.compute(A));
  EXPECT_LT((A * factor.solve(B) - B).norm(), round_off);
  VectorXd b = B.col(0);
  factor.solve_in_place(b);
  EXPECT_LT((A * b - B.col(0)).norm(), round_off);
  EXPECT_FALSE(factor.compute(A - 3 * A.norm() * MatrixXd::Identity(6, 6)));
  EXPECT_FALSE(factor.is_valid());
}

TEST(DenseAlgebra, ShortestLeastSquares) {
  MatrixXd A = entries(6, 4);
  A.col(3) = A.col(0);  // x and x + (1, 0, 0, −1) have the same image
  const VectorXd b = VectorXd::LinSpaced(6, -1, 2), x = mechanics::least_squares(A, b, 1e-10);
  EXPECT_LT((A.transpose() * (A * x - b)).norm(), round_off);
  EXPECT_NEAR(x[0], x[3], round_off);
}

TEST(DenseAlgebra, SingularValueDecomposition) {
  const MatrixXd A = entries(3, 5);
  const auto [U, values, V] = mechanics::singular_value_decomposition(A);
  EXPECT_LT((U * values.asDiagonal() * V.leftCols(3).transpose() - A).norm(), round_off);
  EXPECT_LT((V.transpose() * V - MatrixXd::Identity(5, 5)).norm(), round_off);
  EXPECT_TRUE(values[0] >= values[1] && values[1] >= values[2]);
}

TEST(DenseAlgebra, SemidefiniteMatrix) {
  const MatrixXd A = positive(4);
  const VectorXd b = VectorXd::LinSpaced(4, 1, 2);
  for (const double sign : {1, -1})
    EXPECT_LT((sign * A * mechanics::solve_semidefinite(sign * A, b) - b).norm(), round_off);
}

}  // namespace
}  // namespace pseudorigid::testing
