/// The stretch ratio of the surface against affine deformations, where it is known at every point of the sphere.

#include "continuum/output/surface_stretch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

using continuum::least_surface_stretch;

/// Equal stretches are the double root of a quadratic equation, which has half the digits.
TEST(SurfaceStretch, IsOneAtRestAndUnderRotations) {
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized();
  EXPECT_NEAR(least_surface_stretch(ball.space(), ball.affine_field(Matrix3d::Identity())).value, 1, 1e-7);
  EXPECT_NEAR(least_surface_stretch(ball.space(), ball.affine_field(turn.toRotationMatrix())).value, 1, 1e-7);
}

/// Flattened, the ball is nearest to the limit at the equator, drawn out at the poles; there are nodes on both, where
/// the quadratic surface of the cells has the tangents of the sphere to 1e-5. λ₁/λ_n is the least axis over the
/// largest.
TEST(SurfaceStretch, OfSpheroidsIsTheRatioOfAxes) {
  for (const Sector& sector : {whole, octant})
    for (const double a3 : {0.5, 0.9, 1.3, 2.0}) {
      const ElasticBall ball(sector, 2, 1, neo_hookean);
      const double a1 = 1 / std::sqrt(a3);
      const auto least = least_surface_stretch(ball.space(), ball.affine_field(diagonal(a1, a1, a3)));
      EXPECT_NEAR(least.value, a3 < 1 ? a3 / a1 : a1 / a3, 1e-4) << a3;
      EXPECT_NEAR(std::abs(least.where[2]), a3 < 1 ? 0 : 1, 1e-12) << a3;
    }
}

/// Simple shear by γ has the principal stretches s, 1, 1/s with s − 1/s = γ; the direction of the longest axis is no
/// node of the mesh, and the ratio changes with the square of the distance from it.
TEST(SurfaceStretch, OfAShearComesNearTheRatioOfAxes) {
  const ElasticBall ball(whole, 4, 0, neo_hookean);
  Matrix3d Q = Matrix3d::Identity();
  Q(0, 1) = 1.5;  // s = 2
  EXPECT_NEAR(least_surface_stretch(ball.space(), ball.affine_field(Q)).value, 0.25, 0.02);
}

/// Values that differ by round-off, in any order; a clearly smaller one and a NaN are taken wherever they are.
TEST(LeastPlace, OfSymmetricPlacesIsTheGreatest) {
  const std::vector<std::array<double, 3>> places{{-0.7, 0.7, 0}, {0.7, -0.7, 0}, {-0.7, -0.7, 0}, {0.7, 0.7, -0.1}};
  std::vector<int> order{0, 1, 2, 3};
  do {
    continuum::LeastPlace least;
    for (const int i : order) least.take(0.3 + 1e-9 * i, places[i]);
    EXPECT_EQ(least.value, 0.3);
    EXPECT_EQ(least.where, places[3]);
    least.take(0.2, places[2]);
    EXPECT_EQ(least.where, places[2]);
    least.take(NAN, places[0]);
    least.take(0.1, places[1]);
    EXPECT_TRUE(std::isnan(least.value));
    EXPECT_EQ(least.where, places[0]);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(SurfaceStretch, TheLimitIsTheRootOfBiotsEquation) {
  const double x = materials::biot_ratio;
  EXPECT_NEAR(x * x * x + x * x + 3 * x - 1, 0, 1e-15);
}

}  // namespace
}  // namespace pseudorigid::testing
