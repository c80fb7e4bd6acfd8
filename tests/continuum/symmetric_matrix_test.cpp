/// The product with a symmetric matrix, kept whole or as a triangle. Where it is wrong, the Krylov iteration around it
/// only takes longer.

#include "continuum/constraint/symmetric_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

namespace pseudorigid::testing {
namespace {

/// For sizes from the first to the last.
void check_products(int first, int last) {
  for (int n = first; n <= last; ++n) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) {
      return std::sin(1.0 + static_cast<double>(i * j) + 0.3 * static_cast<double>(i + j));
    });
    const Eigen::VectorXd x =
        Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::cos(2.0 * static_cast<double>(i)); });
    Eigen::VectorXd y = Eigen::VectorXd::Constant(n, 7);
    continuum::SymmetricMatrix(A.data(), static_cast<std::size_t>(n)).multiply(x.data(), y.data());
    EXPECT_LT((y - A * x).lpNorm<Eigen::Infinity>(), 4.0 * n * std::numeric_limits<float>::epsilon()) << n;
  }
}

TEST(SymmetricMatrix, ProductOfOneKeptWholeIsRightToSinglePrecision) {
  static_assert(continuum::SymmetricMatrix::n_whole >= 80);
  check_products(1, 80);
}

TEST(SymmetricMatrix, ProductOfOneKeptAsATriangleIsRightToSinglePrecision) {
  constexpr int n = continuum::SymmetricMatrix::n_whole;
  check_products(n + 1, n + 17);
}

}  // namespace
}  // namespace pseudorigid::testing
