/// The faces of the free surface and the Gauss rule on them, on balls and sectors of known area.

#include "continuum/mesh/surface_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "continuum/balls.h"
#include "continuum/mesh/surface_interpolation.h"

namespace pseudorigid::testing {
namespace {

using continuum::CellFace;
using continuum::FacePoint;

constexpr double pi = std::numbers::pi;
/// Of the polynomials of degree 4 on the unrefined mesh from the sphere.
constexpr double geometry = 2e-5;

/// Area, ∮N dA and ∮x·N dA of the surface at the positions x.
struct Surface {
  double area = 0;
  Vector3d vector_area = Vector3d::Zero();
  double flux = 0;
};

Surface surface_at(const continuum::BallSpace& space, const continuum::Vector& x) {
  Surface surface;
  for (const CellFace& face : continuum::free_surface(space))
    for (const FacePoint& point : continuum::quadrature_on(space, face, space.reference_cell().n)) {
      const FacePoint::Jet at = point.jet(x);
      EXPECT_EQ(at.u, point.value(x));
      const Vector3d outward = (face.end == 1 ? 1 : -1) * point.weight * at.by_p.cross(at.by_q);
      surface.area += outward.norm();
      surface.vector_area += outward;
      surface.flux += at.u.dot(outward);
    }
  return surface;
}

TEST(SurfaceFaces, OfEverySectorHaveItsAreaAndLookOutward) {
  for (const Sector& sector : all_sectors) {
    const ElasticBall ball(sector, 4, 0, neo_hookean);
    const double part = 1.0 / sector.n_images();
    EXPECT_EQ(continuum::free_surface(ball.space()).size(), 24 * part);
    const Surface surface = surface_at(ball.space(), ball.affine_field(Matrix3d::Identity()));
    EXPECT_NEAR(surface.area, 4 * pi * part, geometry * 4 * pi);
    EXPECT_NEAR(surface.flux, 4 * pi * part, geometry * 4 * pi);
    // What closes the surface are its plane sides: each the part of a disc, with the normal −e_d.
    for (int d = 0; d < 3; ++d) {
      const double side = sector.reflect[d] ? 2 * pi * part : 0;
      EXPECT_NEAR(surface.vector_area[d], side, geometry) << d;
    }
  }
}

/// N dA ↦ det Q Q⁻ᵀ N dA is linear in it, so that the flux of x is 3 V; the rule carries affine maps exactly.
TEST(SurfaceFaces, FollowAnAffineMotion) {
  std::mt19937 generator(2);
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const Matrix3d Q = Matrix3d::Identity() + 0.3 * random_matrix(generator);
  const double at_rest = surface_at(ball.space(), ball.affine_field(Matrix3d::Identity())).flux;
  const Surface moved = surface_at(ball.space(), ball.affine_field(Q));
  EXPECT_NEAR(moved.flux, Q.determinant() * at_rest, 1e-13 * at_rest);
  EXPECT_LT(moved.vector_area.norm(), 1e-13);
}

/// One direction after the other gives what all nodes at once give.
TEST(SurfaceInterpolation, IsThatOfThePoints) {
  std::mt19937 generator(3);
  for (const int n_points : {3, 6}) {
    const ElasticBall ball(whole, 4, 0, neo_hookean);
    const continuum::Vector u = random_field(ball.make_vector(), generator);
    const continuum::SurfaceInterpolation surface(ball.space(), n_points);
    const continuum::SurfaceInterpolation::Jets jets = surface.jets(u);
    const auto found = [&](const auto& field, std::size_t i) {
      return Vector3d(field[0][i], field[1][i], field[2][i]);
    };
    std::size_t first = 0;
    for (const CellFace& face : continuum::free_surface(ball.space())) {
      const std::vector<FacePoint> points = continuum::quadrature_on(ball.space(), face, n_points);
      for (int p = 0; p < n_points; ++p)
        for (int q = 0; q < n_points; ++q) {
          const FacePoint& point = points[p * n_points + q];
          const FacePoint::Jet expected = point.jet(u);
          const std::size_t i = first + q * n_points + p;
          EXPECT_NEAR(surface.weights()[i], face.end == 1 ? point.weight : -point.weight, 1e-16);
          EXPECT_LT((found(jets.u, i) - expected.u).norm(), 1e-13);
          EXPECT_LT((found(jets.by_p, i) - expected.by_p).norm(), 1e-13 * 10);  // derivatives are of the size 10
          EXPECT_LT((found(jets.by_q, i) - expected.by_q).norm(), 1e-13 * 10);
        }
      first += points.size();
    }
    EXPECT_EQ(surface.n_points(), first);
  }
}

/// What acts on the jets does the work on the nodes that it does on the jets.
TEST(SurfaceInterpolation, CarriesForcesBackByItsTransposed) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const continuum::Vector u = random_field(ball.make_vector(), generator);
  const continuum::SurfaceInterpolation surface(ball.space(), 5);
  const continuum::SurfaceInterpolation::Jets jets = surface.jets(u);
  continuum::SurfaceInterpolation::Jets forces = jets;
  double expected = 0;
  for (const auto part : {&continuum::SurfaceInterpolation::Jets::u, &continuum::SurfaceInterpolation::Jets::by_p,
                          &continuum::SurfaceInterpolation::Jets::by_q})
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < surface.n_points(); ++i) {
        (forces.*part)[c][i] = normal(generator);
        expected += (forces.*part)[c][i] * (jets.*part)[c][i];
      }
  continuum::Vector f = ball.make_vector();
  surface.subtract_derivative(forces, f);
  EXPECT_NEAR(-(f * u), expected, 1e-12 * std::abs(expected));
}

TEST(SurfaceFaces, NodesOfAFaceAreThoseOnItsSide) {
  for (int direction = 0; direction < 3; ++direction)
    for (const int end : {0, 1}) {
      const int n = 4, p = (direction + 1) % 3, q = (direction + 2) % 3;
      const std::vector<int> nodes = continuum::nodes_of({0, direction, end}, n);
      ASSERT_EQ(nodes.size(), 16u);
      for (int k = 0; k < 16; ++k) {
        const int place[] = {nodes[k] % n, nodes[k] / n % n, nodes[k] / n / n};
        EXPECT_EQ(place[direction], end * (n - 1));
        EXPECT_EQ(place[p], k % n);
        EXPECT_EQ(place[q], k / n);
      }
    }
}

}  // namespace
}  // namespace pseudorigid::testing
