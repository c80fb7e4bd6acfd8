/// The product with a packed symmetric matrix. Where it is wrong, the Krylov iteration around it only takes longer.

#include "continuum/constraint/packed_symmetric.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

namespace pseudorigid::testing {
namespace {

TEST(PackedSymmetric, ProductIsThatOfTheMatrixToSinglePrecision) {
  for (int n = 1; n < 80; ++n) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [](Eigen::Index i, Eigen::Index j) {
      return std::sin(1.0 + static_cast<double>(i * j) + 0.3 * static_cast<double>(i + j));
    });
    const Eigen::VectorXd x =
        Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::cos(2.0 * static_cast<double>(i)); });
    Eigen::VectorXd y = Eigen::VectorXd::Constant(n, 7);
    continuum::PackedSymmetric(A.data(), static_cast<std::size_t>(n)).multiply(x.data(), y.data());
    EXPECT_LT((y - A * x).lpNorm<Eigen::Infinity>(), 4.0 * n * std::numeric_limits<float>::epsilon()) << n;
  }
}

}  // namespace
}  // namespace pseudorigid::testing
