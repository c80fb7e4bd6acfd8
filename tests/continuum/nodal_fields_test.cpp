/// Fields of pictures: the blocks fill the ball, affine states have their exact fields, a known pressure is found,
/// equidistant points are on the same polynomials, sectors show the same ball, failures are values.

#include "continuum/output/nodal_fields.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <tuple>

#include "continuum/balls.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::testing {
namespace {

using mechanics::BodyFields;
using mechanics::PointBlocks;

Vector3d point(const std::vector<double>& values, std::size_t i) { return Vector3d::Map(&values[3 * i]); }
Matrix3d matrix(const std::vector<double>& values, std::size_t i) {
  return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(&values[9 * i]);
}

BodyFields fields_of(const ElasticBall& ball, const State<ElasticBall>& state) {
  auto workspace = ball.make_workspace();
  BodyFields fields;
  const auto status = nodal_fields(ball, state, workspace, fields);
  EXPECT_TRUE(status) << status.reason();
  return fields;
}

/// Volume of the cube of neighbours whose first point has this place in a block, from the Jacobian at its centre: exact
/// up to second order in its size.
double volume(const PointBlocks& blocks, const std::vector<double>& points, std::size_t first_place) {
  const std::size_t n = blocks.degree + 1;
  Matrix3d jacobian = Matrix3d::Zero();
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const Vector3d X = point(points, blocks.points[first_place + (k * n + j) * n + i]);
    jacobian += X * Vector3d(i ? 1 : -1, j ? 1 : -1, k ? 1 : -1).transpose() / 4;
  }
  return jacobian.determinant();
}

TEST(NodalBlocks, FillTheBallFromEverySector) {
  constexpr std::size_t n = 5;
  for (const Sector& sector : all_sectors) {
    const ElasticBall ball(sector, n - 1, 0, neo_hookean);
    const PointBlocks blocks = continuum::nodal_blocks(ball.space());
    const std::vector<double> points = continuum::nodal_positions(ball.space());
    EXPECT_EQ(points.size(), 3u * 8 * 4 * 125);
    ASSERT_EQ(blocks.n_blocks(), 8u * 4);
    double sum = 0;
    for (std::size_t place = 0; place < blocks.points.size(); ++place) {
      const std::size_t i = place % n, j = place / n % n, k = place / (n * n) % n;
      if (i + 1 == n || j + 1 == n || k + 1 == n) continue;
      EXPECT_GT(volume(blocks, points, place), 0) << "place " << place;
      sum += volume(blocks, points, place);
    }
    EXPECT_NEAR(sum, 4 * std::numbers::pi / 3, 0.1) << "hexahedra with straight edges, inscribed in the ball";
    Vector3d lowest = Vector3d::Zero(), highest = lowest;
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
      lowest = lowest.cwiseMin(point(points, i));
      highest = highest.cwiseMax(point(points, i));
    }
    EXPECT_LT((highest - Vector3d::Ones()).norm() + (lowest + Vector3d::Ones()).norm(), 1e-14);
  }
}

/// x = QX and ẋ = HX have their polynomials' exact values, at the nodes and at equidistant points.
TEST(NodalFields, AffineStateIsExactInEverySector) {
  std::mt19937 generator(3);
  for (const Sector& sector : all_sectors)
    for (const int degree : {2, 5}) {
      const ElasticBall ball(sector, degree, 0, ciarlet_geymonat);
      const Matrix3d Q = admissible(sector, Matrix3d::Identity() + 0.3 * random_matrix(generator));
      const Matrix3d H = admissible(sector, random_matrix(generator));
      BodyFields fields = fields_of(ball, affine_state(ball, Q, H));
      const BodyFields rest = fields_of(ball, affine_state(ball, Q, Matrix3d::Zero()));
      const reduced::PseudoRigidBody<CiarletGeymonat, true> body(ciarlet_geymonat, {ball.E0(), ball.volume()});
      const std::vector<double> reference = continuum::nodal_positions(ball.space());
      EXPECT_LT((fields.moment - Q * ball.E0()).norm(), 1e-13);
      for (const bool equidistant : {false, true}) {
        if (equidistant) continuum::make_equidistant(ball.space(), fields);
        for (std::size_t i = 0; i < fields.n_points(); ++i) {
          const Vector3d X = point(fields.X, i);
          if (!equidistant) {
            ASSERT_EQ(X, point(reference, i));
          }
          ASSERT_LT((point(fields.x, i) - Q * X).norm(), 1e-14);
          ASSERT_LT((point(fields.v, i) - H * X).norm(), 1e-13);
          ASSERT_LT((matrix(fields.F, i) - Q).norm(), 1e-12);
          ASSERT_NEAR(fields.energy[i], ciarlet_geymonat.energy(materials::to_tensor(Q)), 1e-11);
        }
      }
      // The elements' pressure is their own, as no affine one stops a motion that is not affine.
      const auto deviator = [](const Matrix3d& s) -> Matrix3d { return s - s.trace() / 3 * Matrix3d::Identity(); };
      for (std::size_t i = 0; i < rest.n_points(); ++i)
        ASSERT_LT((deviator(matrix(rest.stress, i)) - deviator(body.cauchy_stress(Q, 0))).norm(), 1e-11);
    }
}

/// Between the nodes the equidistant points of a surface stay on the sphere as near as its polynomials do.
TEST(NodalFields, EquidistantPointsAreOnTheSameCurvedElements) {
  const ElasticBall ball(octant, 4, 0, neo_hookean);
  std::vector<double> points = continuum::nodal_positions(ball.space());
  continuum::make_equidistant(ball.space(), points);
  const int n = 5;
  int n_on_surface = 0;
  for (std::size_t i = 0; i < points.size() / 3; ++i) {
    const double radius = point(points, i).norm();
    EXPECT_LT(radius, 1 + 1e-4);
    n_on_surface += std::abs(radius - 1) < 1e-4;
  }
  EXPECT_EQ(n_on_surface, 8 * 3 * n * n) << "three of the four cells of an octant have a face on the sphere";
}

/// At x = X with ẋ = HX, tr H = 0, nothing is stressed and the pressure stops the spreading of the mass alone:
/// −Δp = ρ tr(H²), p = 0 on the sphere, so that p = tr(H²)(1 − |X|²)/6 (PHYSICS 0: λ = 2p_c/(ρr²), 1: λ = tr(H²)/3).
TEST(NodalFields, PressureOfAffineVelocityIsParabolic) {
  Matrix3d H;
  H << 0.4, 0.3, -0.2, -0.5, -0.6, 0.1, 0.7, 0.2, 0.2;
  const double central = (H * H).trace() / 6;
  const ElasticBall ball(whole, 4, 0, neo_hookean);
  const BodyFields fields = fields_of(ball, affine_state(ball, Matrix3d::Identity(), H));
  for (std::size_t i = 0; i < fields.n_points(); ++i) {
    const double exact = central * (1 - point(fields.X, i).squaredNorm());
    const Matrix3d stress = matrix(fields.stress, i);
    ASSERT_NEAR(-stress.trace() / 3, exact, 2e-3 * std::abs(central));
    ASSERT_LT((stress - stress.trace() / 3 * Matrix3d::Identity()).norm(), 1e-12);
  }
}

TEST(NodalFields, SectorsShowTheSameBall) {
  const auto state_after = [](const ElasticBall& ball) {
    const auto start = affine_state(ball, diagonal(1.25, 0.8, 1), diagonal(0, 0.3, -0.3));
    const auto r = run<mechanics::Rattle>(ball, start, 0.5, 1, 20);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    return r.last();
  };
  const ElasticBall reference_ball(whole, 2, 0, neo_hookean);
  const BodyFields reference = fields_of(reference_ball, state_after(reference_ball));
  using Key = std::tuple<long, long, long>;
  const auto key = [](const Vector3d& X) {
    return Key{std::lround(1e6 * X[0]), std::lround(1e6 * X[1]), std::lround(1e6 * X[2])};
  };
  // Neighbours share the place of a node, and have stresses of their own there: the sum is the same in every sector.
  struct Seen {
    Vector3d x, v;
    Matrix3d stress = Matrix3d::Zero();
  };
  const auto by_place = [&](const BodyFields& fields) {
    std::map<Key, Seen> seen;
    for (std::size_t i = 0; i < fields.n_points(); ++i) {
      Seen& here = seen[key(point(fields.X, i))];
      here.x = point(fields.x, i);
      here.v = point(fields.v, i);
      here.stress += matrix(fields.stress, i);
    }
    return seen;
  };
  const auto expected = by_place(reference);
  for (const Sector& sector : {half, quarter, octant}) {
    const ElasticBall ball(sector, 2, 0, neo_hookean);
    const auto seen = by_place(fields_of(ball, state_after(ball)));
    ASSERT_EQ(seen.size(), expected.size());
    for (const auto& [place, here] : seen) {
      const Seen& there = expected.at(place);
      ASSERT_LT((there.x - here.x).norm(), 1e-10);
      ASSERT_LT((there.v - here.v).norm(), 1e-9);
      ASSERT_LT((there.stress - here.stress).norm(), 1e-8);
    }
  }
}

/// A surface corner pushed inwards inverts its node before the quadrature points notice.
TEST(NodalFields, InvertedNodeIsAStatusWithItsPlace) {
  const ElasticBall ball(octant, 3, 0, neo_hookean);
  auto workspace = ball.make_workspace();
  auto state = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
  const continuum::Vector& X = ball.space().reference_positions();
  unsigned int pole = 0;
  for (unsigned int i = 0; i < X.size(); i += 3)
    if (X[i + 2] > 1 - 1e-12) pole = i;
  ASSERT_GT(X[pole + 2], 0.99);
  BodyFields fields;
  mechanics::Status status;
  while (status.ok() && state.q[pole + 2] > 0) {
    state.q[pole + 2] -= 0.01;
    status = nodal_fields(ball, state, workspace, fields);
  }
  EXPECT_NE(status.reason().find("det F = -"), std::string::npos) << status.reason();
  EXPECT_NE(status.reason().find("X/r = (0.000, 0.000, 1.000)"), std::string::npos) << status.reason();
}

}  // namespace
}  // namespace pseudorigid::testing
