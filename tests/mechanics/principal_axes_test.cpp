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

}  // namespace
}  // namespace pseudorigid::mechanics
