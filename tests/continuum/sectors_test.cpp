/// Meshes and sectors: volume and inertia converge to those of the ball, meshes are conforming, and the ball, its half,
/// quarter and octant move alike.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

GeometryError geometry_error(const Sector& sector, int degree, int n_refinements) {
  const ElasticBall ball(sector, degree, n_refinements, neo_hookean);
  const double volume = 4 * std::numbers::pi / 3, m_bar = 4 * std::numbers::pi / 15;  // PHYSICS 0
  return {std::abs(ball.volume() / volume - 1), (ball.E0() / m_bar - Matrix3d::Identity()).norm()};
}

TEST(Mesh, VolumeAndInertiaConvergeWithTheDegree) {
  constexpr double volume_bound[] = {2e-3, 1e-5, 5e-8, 2e-9, 5e-11}, inertia_bound[] = {4e-3, 1e-5, 6e-7, 1e-8, 2e-10};
  for (int degree = 2; degree <= 6; ++degree) {
    const GeometryError error = geometry_error(octant, degree, 0);
    EXPECT_LT(error.volume, volume_bound[degree - 2]) << degree;
    EXPECT_LT(error.inertia, inertia_bound[degree - 2]) << degree;
  }
}

/// Order 2k: a refinement divides the errors by 4^k.
TEST(Mesh, VolumeAndInertiaConvergeWithRefinement) {
  for (const int degree : {2, 3, 4}) {
    const GeometryError coarse = geometry_error(octant, degree, 1), fine = geometry_error(octant, degree, 2);
    EXPECT_GT(coarse.volume / fine.volume, 0.75 * std::pow(4, degree)) << degree;
    EXPECT_GT(coarse.inertia / fine.inertia, 0.75 * std::pow(4, degree)) << degree;
  }
}

TEST(Mesh, InertiaIsTheSameInEverySector) {
  const ElasticBall ball(octant, 3, 0, neo_hookean);
  for (const Sector& sector : all_sectors) {
    const ElasticBall other(sector, 3, 0, neo_hookean);
    EXPECT_NEAR(other.volume(), ball.volume(), 1e-13);
    EXPECT_LT((other.E0() - ball.E0()).norm(), 1e-13);
  }
}

/// A cube of (2m)³ intervals and m layers around it.
std::size_t n_nodes_of_whole_ball(std::size_t m) {
  const std::size_t n = 2 * m;
  return (n + 1) * (n + 1) * (n + 1) + m * (6 * n * n + 2);
}

/// No two nodes share a place, none lies off the planes that cut the sector, and those of the surface lie on the
/// sphere. (That neighbours agree on a node's place is checked by the constructor, which throws otherwise.)
TEST(Mesh, NodesAreConforming) {
  for (const Sector& sector : all_sectors)
    for (const int n_refinements : {0, 1}) {
      const ElasticBall ball(sector, 3, n_refinements, neo_hookean);
      const continuum::Vector& X = ball.space().reference_positions();
      std::vector<std::array<long, 3>> places;
      for (unsigned int i = 0; i < X.size(); i += 3) {
        auto& place = places.emplace_back();
        for (int c = 0; c < 3; ++c) {
          place[c] = std::lround(1e9 * X[i + c]);
          EXPECT_TRUE(X[i + c] == 0 || std::abs(X[i + c]) > 1e-3);
          EXPECT_TRUE(X[i + c] >= 0 || !sector.reflect[c]);
        }
        EXPECT_LT(Vector3d(X[i], X[i + 1], X[i + 2]).norm(), 1 + 1e-14);
      }
      std::sort(places.begin(), places.end());
      EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end());
      if (sector.n_images() == 1) {
        EXPECT_EQ(places.size(), n_nodes_of_whole_ball(3 << n_refinements));
      }
    }
}

TEST(Sectors, MoveAlike) {
  const auto moments = [](const Sector& sector) {
    const ElasticBall ball(sector, 3, 0, neo_hookean);
    const auto start = affine_state(ball, diagonal(1.2, 1, 1 / 1.2), diagonal(1.2 * 0.3, 0.1, -0.4 / 1.2));
    const auto r = run<mechanics::Rattle>(ball, start, 2, 8, 10);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    std::vector<Matrix3d> result;
    for (const auto& state : r.states) result.push_back(ball.mass_moment(state.q));
    return result;
  };
  const auto reference = moments(whole);
  ASSERT_EQ(reference.size(), 9u);
  EXPECT_GT((reference.back() - reference.front()).norm(), 0.1);
  for (const Sector& sector : {half, quarter, octant}) {
    const auto other = moments(sector);
    for (std::size_t k = 0; k < reference.size(); ++k) EXPECT_LT((other[k] - reference[k]).norm(), 1e-10) << k;
  }
}

}  // namespace
}  // namespace pseudorigid::testing
