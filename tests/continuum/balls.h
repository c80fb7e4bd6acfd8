#pragma once
/// Balls, sectors and affine data of the continuum's tests, in internal units μ = ρ = r = 1.

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "continuum/elastic_ball.h"
#include "support/runs.h"

namespace pseudorigid::testing {

using continuum::ElasticBall;
using continuum::Sector;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using materials::CiarletGeymonat;
using mechanics::State;

inline constexpr Sector whole{}, half{{false, false, true}}, quarter{{true, true, false}}, octant{{true, true, true}};
inline constexpr Sector all_sectors[] = {whole, half, quarter, octant};
inline constexpr CiarletGeymonat neo_hookean{1, 0}, ciarlet_geymonat{1, 1.7};

inline Matrix3d diagonal(double a, double b, double c) { return Vector3d(a, b, c).asDiagonal(); }

/// Entries that are odd under a reflection of the sector set to zero: the affine fields that the sector admits.
inline Matrix3d admissible(const Sector& sector, Matrix3d A) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j && (sector.reflect[i] || sector.reflect[j])) A(i, j) = 0;
  return A;
}

/// Entries uniform in (−1, 1).
inline Matrix3d random_matrix(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix3d::NullaryExpr([&] { return uniform(generator); });
}

inline continuum::Vector random_field(const continuum::Vector& like, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  continuum::Vector field = like;
  for (double& value : mechanics::local_values(field)) value = uniform(generator);
  return field;
}

/// x = QX, ẋ = Q̇X at t = 0.
inline State<ElasticBall> affine_state(const ElasticBall& ball, const Matrix3d& Q, const Matrix3d& Qdot) {
  return {0, ball.affine_field(Q), ball.affine_field(Qdot)};
}

inline mechanics::ContinuumObservables observed(const ElasticBall& ball, const State<ElasticBall>& state,
                                                const mechanics::ObservableRequest& request = {}) {
  auto workspace = ball.make_workspace();
  mechanics::ContinuumObservables o;
  const auto status = continuum::observe(ball, state, workspace, request, o);
  EXPECT_TRUE(status) << status.reason();
  return o;
}

}  // namespace pseudorigid::testing
