/// The parts of the principal axes: the closed form from which the rotations start, so that few of them are needed.

#include "mechanics/core/principal_axes.h"
#include "support/dense.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace pseudorigid::mechanics {
namespace {

using detail::axes::Symmetric;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d full(const Symmetric& C) {
  Matrix3d m = C.diagonal.asDiagonal();
  m(1, 2) = m(2, 1) = C.opposite[0];
  m(2, 0) = m(0, 2) = C.opposite[1];
  m(0, 1) = m(1, 0) = C.opposite[2];
  return m;
}

TEST(PrincipalAxes, CosineOfAThirdIsRightToEightDigits) {
  for (int i = 0; i <= 1000; ++i) {
    const double q = i / 1000.0;
    EXPECT_NEAR(detail::axes::cosine_of_third(q), std::cos(std::acos(q) / 3), 8e-9) << q;
  }
}

TEST(PrincipalAxes, PlaneRotationTakesTheProductAway) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 0; n < 200; ++n) {
    const double alpha = uniform(generator), beta = uniform(generator), gamma = uniform(generator);
    const auto r = detail::axes::diagonalizing(alpha, beta, gamma);
    const double c = r.cosine, s = r.sine;
    EXPECT_NEAR(c * c + s * s, 1, 1e-15);
    EXPECT_GE(c, std::sqrt(0.5) - 1e-15) << "the smaller angle";
    EXPECT_NEAR(c * s * (alpha - beta) + (c * c - s * s) * gamma, 0, 1e-15);
  }
}

TEST(PrincipalAxes, ClosedFormIsRightToEightDigits) {
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 0; n < 2000; ++n) {
    Symmetric C{{uniform(generator), uniform(generator), uniform(generator)},
                {uniform(generator), uniform(generator), uniform(generator)}};
    // Where two eigenvalues come close, what is left of the third direction is magnified.
    const Vector3d eigenvalues = testing::symmetric_spectrum(full(C)).values;
    if (std::min(eigenvalues[1] - eigenvalues[0], eigenvalues[2] - eigenvalues[1]) < 0.05) continue;
    const Matrix3d U = detail::axes::eigenvectors(C), D = U.transpose() * full(C) * U;
    EXPECT_LT((U.transpose() * U - Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_LT((D - Matrix3d(D.diagonal().asDiagonal())).norm(), 1e-7);
  }
}

/// A matrix with these singular values and random directions.
Matrix3d with_singular_values(const Vector3d& sigma, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto rotation = [&] {
    return Eigen::Quaterniond(uniform(generator), uniform(generator), uniform(generator), uniform(generator))
        .normalized()
        .toRotationMatrix();
  };
  return rotation() * sigma.asDiagonal() * rotation();
}

TEST(PrincipalAxes, BoundsOfSingularValuesHoldAndAreClose) {
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int n = 0; n < 20000; ++n) {
    // The differences of the singular values are of every size, and every third pair or triple is nearly equal.
    const double size = std::pow(10, -8 + 7.7 * n / 20000);
    Vector3d sigma(1, 1 + size * uniform(generator), 1 + size * uniform(generator));
    if (n % 3 == 0) sigma[1] = sigma[0] + 1e-6 * size * uniform(generator);
    if (n % 3 == 1) sigma[2] = sigma[1] + 1e-9 * size * uniform(generator);
    const Matrix3d F = with_singular_values(std::pow(10, 3 * uniform(generator)) * sigma, generator);
    const Vector3d exact = singular_values(F);
    const double most = largest_singular_value_bound(F), least = least_singular_value_bound(F);
    EXPECT_GE(most, exact[0]) << n;
    EXPECT_LE(least, exact[2]) << n;
    const double width = exact[0] - exact[2];
    if (width > 1e-5 * exact[0]) {
      EXPECT_LE(most - exact[0], 1e-3 * width) << n;
      EXPECT_LE(exact[2] - least, 1e-3 * width) << n;
    }
  }
}

TEST(PrincipalAxes, BoundsHoldForThinAndRigidAndInfiniteMatrices) {
  std::mt19937 generator(10);
  for (int n = 0; n < 200; ++n)
    for (const Vector3d& sigma :
         {Vector3d(1, 1, 1), Vector3d(1e4, 1, 1e-4), Vector3d(1, 1, 0), Vector3d(1e3, 1e3, 1)}) {
      const Matrix3d F = with_singular_values(sigma, generator);
      const Vector3d exact = singular_values(F);
      EXPECT_GE(largest_singular_value_bound(F), exact[0]);
      EXPECT_LE(least_singular_value_bound(F), exact[2]);
    }
  EXPECT_TRUE(std::isnan(largest_singular_value_bound(Matrix3d::Constant(NAN))));
  EXPECT_EQ(least_singular_value_bound(Matrix3d::Constant(NAN)), 0);
  EXPECT_EQ(largest_singular_value_bound(Matrix3d::Zero()), 0);
}

}  // namespace
}  // namespace pseudorigid::mechanics
