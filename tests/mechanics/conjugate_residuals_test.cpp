/// Conjugate residuals beside a direct solution: with a preconditioner close to the matrix, for which they keep few
/// directions, and with one that is not, for a symmetric matrix and a slightly unsymmetric one.

#include "mechanics/core/conjugate_residuals.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using mechanics::ConjugateResiduals;

constexpr int n = 60;

/// Eigenvalues 1 … 100, evenly in their logarithm; orthogonal eigenvectors.
MatrixXd symmetric_matrix() {
  const MatrixXd entries = MatrixXd::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) {
    return std::sin(1.0 + 1.7 * static_cast<double>(i * j) + 0.3 * static_cast<double>(i - 2 * j));
  });
  const MatrixXd Q = mechanics::span_of(entries, 0);
  const VectorXd eigenvalues = VectorXd::LinSpaced(n, 0, 2).unaryExpr([](double x) { return std::pow(10, x); });
  return Q * eigenvalues.asDiagonal() * Q.transpose();
}

struct Solved {
  int n_iterations;
  bool converged;
  double residual, claimed, error;  ///< |r₀ − A x|, |r|, |x − A⁻¹r₀|, relative
};

Solved solve(const MatrixXd& A, const MatrixXd& inverse_preconditioner, double tolerance) {
  const VectorXd r0 = VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::cos(2.0 * static_cast<double>(i)); });
  VectorXd r = r0, x = VectorXd::Constant(n, 7);
  ConjugateResiduals<VectorXd> iteration;
  const auto result = iteration.solve([&](const VectorXd& z, VectorXd& y) { y = A * z; },
                                      [&](const VectorXd& from, VectorXd& z) { z = inverse_preconditioner * from; },
                                      r0.norm(), tolerance * r0.norm(), 400, r, x);
  const VectorXd exact = mechanics::solve(A, r0);
  return {result.n_iterations, result.converged, (r0 - A * x).norm() / r0.norm(), r.norm() / r0.norm(),
          (x - exact).norm() / exact.norm()};
}

/// The inverse of the matrix with its eigenvalues changed by up to a factor of 3 either way.
MatrixXd close_to_inverse(const MatrixXd& A) {
  const auto [values, vectors] = mechanics::symmetric_spectrum(A);
  const VectorXd factors =
      VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::pow(3, std::sin(5.0 * static_cast<double>(i))); });
  return vectors * factors.cwiseQuotient(values).asDiagonal() * vectors.transpose();
}

MatrixXd inverse_diagonal(const MatrixXd& A) { return A.diagonal().cwiseInverse().asDiagonal(); }

MatrixXd not_quite_symmetric() {
  return symmetric_matrix() + 0.01 * MatrixXd::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) {
                                return std::sin(3.0 * static_cast<double>(i) - 5.0 * static_cast<double>(j));
                              });
}

/// The residual is carried on, with round-off; the condition of the matrices is 100.
void expect_solved(const Solved& solved) {
  EXPECT_TRUE(solved.converged);
  EXPECT_LT(solved.residual, 1.01e-6);
  EXPECT_LT(solved.error, 1.01e-4);
}

TEST(ConjugateResiduals, FewDirectionsAreEnoughForACloseOne) {
  const MatrixXd M = close_to_inverse(symmetric_matrix());
  for (const MatrixXd& A : {symmetric_matrix(), not_quite_symmetric()}) {
    const Solved solved = solve(A, M, 1e-6);
    expect_solved(solved);
    EXPECT_GT(solved.n_iterations, 2 * ConjugateResiduals<VectorXd>::n_kept);
    EXPECT_LT(solved.n_iterations, ConjugateResiduals<VectorXd>::n_with_few);
  }
}

TEST(ConjugateResiduals, MoreDirectionsAreKeptForOneThatIsNot) {
  for (const MatrixXd& A : {symmetric_matrix(), not_quite_symmetric()}) {
    const Solved solved = solve(A, inverse_diagonal(A), 1e-6);
    expect_solved(solved);
    EXPECT_GT(solved.n_iterations, ConjugateResiduals<VectorXd>::n_with_few);
  }
}

TEST(ConjugateResiduals, WhereNothingHelpsTheResidualIsStillWhatItSays) {
  MatrixXd A = symmetric_matrix();
  A.row(n - 1).setZero();  // r₀ is not in its range
  A(n - 1, n - 1) = 1e-300;
  const Solved solved = solve(A, close_to_inverse(symmetric_matrix()), 1e-6);
  EXPECT_FALSE(solved.converged);
  EXPECT_NEAR(solved.claimed, solved.residual, 1e-9);
}

TEST(ConjugateResiduals, NothingToDo) {
  const Solved solved = solve(symmetric_matrix(), MatrixXd::Identity(n, n), 2);
  EXPECT_TRUE(solved.converged);
  EXPECT_EQ(solved.n_iterations, 0);
  EXPECT_EQ(solved.residual, 1);  // x = 0
}

}  // namespace
}  // namespace pseudorigid::testing
