/// Graphics fields: the grid fills the ball, affine states have their exact displacement and stress, a known pressure
/// is found, sectors show the same ball, failures are values.

#include "continuum/output/nodal_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <tuple>

#include "continuum/balls.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::testing {
namespace {

using continuum::NodalFields;
using continuum::NodalGrid;

Vector3d point(const std::vector<double>& values, std::size_t i) { return Eigen::Map<const Vector3d>(&values[3 * i]); }

NodalFields fields_of(const ElasticBall& ball, const State<ElasticBall>& state, const CiarletGeymonat& law) {
  auto workspace = ball.make_workspace();
  NodalFields fields;
  const auto status = nodal_fields(ball, law, state, workspace, fields);
  EXPECT_TRUE(status) << status.reason();
  return fields;
}

/// Volume of a hexahedron in VTK's order from the Jacobian at its centre: exact up to second order in its size.
double volume(const NodalGrid& grid, std::size_t hexahedron) {
  constexpr int signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  Matrix3d jacobian = Matrix3d::Zero();
  for (int v = 0; v < 8; ++v)
    for (int d = 0; d < 3; ++d)
      jacobian.col(d) += signs[v][d] / 4.0 * point(grid.points, grid.connectivity[8 * hexahedron + v]);
  return jacobian.determinant();
}

TEST(NodalGrid, FillsTheBallFromEverySector) {
  for (const Sector& sector : all_sectors) {
    const ElasticBall ball(sector, 4, 0, neo_hookean);
    const NodalGrid grid = continuum::nodal_grid(ball.space());
    EXPECT_EQ(grid.points.size(), 3u * 8 * 4 * 125);
    ASSERT_EQ(grid.connectivity.size(), 8u * 8 * 4 * 64);
    double sum = 0;
    for (std::size_t h = 0; h < grid.connectivity.size() / 8; ++h) {
      EXPECT_GT(volume(grid, h), 0) << "hexahedron " << h;
      sum += volume(grid, h);
    }
    EXPECT_NEAR(sum, 4 * std::numbers::pi / 3, 0.1) << "linear hexahedra inscribed in the ball";
    Vector3d lowest = Vector3d::Zero(), highest = lowest;
    for (std::size_t i = 0; i < grid.points.size() / 3; ++i) {
      lowest = lowest.cwiseMin(point(grid.points, i));
      highest = highest.cwiseMax(point(grid.points, i));
    }
    EXPECT_LT((highest - Vector3d::Ones()).norm() + (lowest + Vector3d::Ones()).norm(), 1e-14);
  }
}

TEST(NodalFields, AffineStateIsExactInEverySector) {
  std::mt19937 generator(3);
  for (const Sector& sector : all_sectors)
    for (const int degree : {2, 5}) {
      const ElasticBall ball(sector, degree, 0, ciarlet_geymonat);
      const Matrix3d Q = admissible(sector, Matrix3d::Identity() + 0.3 * random_matrix(generator));
      const NodalGrid grid = continuum::nodal_grid(ball.space());
      const NodalFields fields = fields_of(ball, affine_state(ball, Q, Matrix3d::Zero()), ciarlet_geymonat);
      const reduced::PseudoRigidBody<CiarletGeymonat, true> body(ciarlet_geymonat, {ball.E0(), ball.volume()});
      const Matrix3d sigma = body.cauchy_stress(Q, 0);
      const double von_mises = std::sqrt(1.5) * (sigma - sigma.trace() / 3 * Matrix3d::Identity()).norm();
      ASSERT_EQ(fields.displacement.size(), grid.points.size());
      for (std::size_t i = 0; i < grid.points.size() / 3; ++i) {
        const Vector3d X = point(grid.points, i), u = Q * X - X;
        ASSERT_LT((point(fields.displacement, i) - u).norm(), 1e-14);
        ASSERT_NEAR(fields.jacobian[i], Q.determinant(), 1e-12);
        ASSERT_NEAR(fields.von_mises[i], von_mises, 1e-11);
      }
    }
}

/// At x = X with ẋ = HX, tr H = 0, nothing is stressed and the pressure stops the spreading of the mass alone:
/// −Δp = ρ tr(H²), p = 0 on the sphere, so that p = tr(H²)(1 − |X|²)/6 (PHYSICS 0: λ = 2p_c/(ρr²), 1: λ = tr(H²)/3).
TEST(NodalFields, PressureOfAffineVelocityIsParabolic) {
  Matrix3d H;
  H << 0.4, 0.3, -0.2, -0.5, -0.6, 0.1, 0.7, 0.2, 0.2;
  const double central = (H * H).trace() / 6;
  const ElasticBall ball(whole, 4, 0, neo_hookean);
  const NodalGrid grid = continuum::nodal_grid(ball.space());
  const NodalFields fields = fields_of(ball, affine_state(ball, Matrix3d::Identity(), H), neo_hookean);
  for (std::size_t i = 0; i < fields.pressure.size(); ++i) {
    const double exact = central * (1 - point(grid.points, i).squaredNorm());
    ASSERT_NEAR(fields.pressure[i], exact, 2e-3 * std::abs(central));
    ASSERT_LT(fields.von_mises[i], 1e-12);
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
  const NodalGrid reference_grid = continuum::nodal_grid(reference_ball.space());
  const NodalFields reference = fields_of(reference_ball, state_after(reference_ball), neo_hookean);
  using Key = std::tuple<long, long, long>;
  const auto key = [](const Vector3d& X) {
    return Key{std::lround(1e6 * X[0]), std::lround(1e6 * X[1]), std::lround(1e6 * X[2])};
  };
  std::map<Key, Vector3d> displacement;
  for (std::size_t i = 0; i < reference_grid.points.size() / 3; ++i)
    displacement[key(point(reference_grid.points, i))] = point(reference.displacement, i);

  for (const Sector& sector : {half, quarter, octant}) {
    const ElasticBall ball(sector, 2, 0, neo_hookean);
    const NodalGrid grid = continuum::nodal_grid(ball.space());
    NodalFields fields = fields_of(ball, state_after(ball), neo_hookean);
    for (std::size_t i = 0; i < grid.points.size() / 3; ++i)
      ASSERT_LT((displacement.at(key(point(grid.points, i))) - point(fields.displacement, i)).norm(), 1e-10);
    for (auto field : {&NodalFields::pressure, &NodalFields::jacobian, &NodalFields::von_mises}) {
      std::vector<double> expected = reference.*field;
      std::sort(expected.begin(), expected.end());
      std::sort((fields.*field).begin(), (fields.*field).end());
      ASSERT_EQ(expected.size(), (fields.*field).size());
      for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(expected[i], (fields.*field)[i], 1e-9);
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
  NodalFields fields;
  mechanics::Status status;
  while (status.ok() && state.q[pole + 2] > 0) {
    state.q[pole + 2] -= 0.01;
    status = nodal_fields(ball, neo_hookean, state, workspace, fields);
  }
  EXPECT_NE(status.reason().find("det F = -"), std::string::npos) << status.reason();
  EXPECT_NE(status.reason().find("node X/r = (0.000, 0.000, 1.000)"), std::string::npos) << status.reason();
}

}  // namespace
}  // namespace pseudorigid::testing
