#pragma once
/// Balls, sectors and affine data of the continuum's tests, in internal units μ = ρ = r = 1.

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "continuum/output/observe.h"
#include "loads/list.h"
#include "support/runs.h"

namespace pseudorigid::testing {

using continuum::BallBody;
using continuum::CompressibleBall;
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
inline continuum::BallState affine_state(const BallBody& ball, const Matrix3d& Q, const Matrix3d& Qdot) {
  return {0, ball.affine_field(Q), ball.affine_field(Qdot)};
}

template <class Ball>
mechanics::ContinuumObservables observed(const Ball& ball, const continuum::BallState& state,
                                         const mechanics::ObservableRequest& request = {}) {
  auto workspace = ball.make_workspace();
  mechanics::ContinuumObservables o;
  const auto status = continuum::observe(ball, state, workspace, request, o);
  EXPECT_TRUE(status) << status.reason();
  return o;
}

/// Σ f_n X_nᵀ over the whole ball.
inline Matrix3d moment_of_force(const BallBody& ball, const continuum::Vector& f) {
  continuum::Vector a = ball.make_vector();
  ball.apply_inverse_mass(f, a);
  return ball.nodal_moment(a, ball.space().reference_positions());
}

inline bool admits_entry(const Sector& sector, int i, int j) {
  return i == j || !(sector.reflect[i] || sector.reflect[j]);
}

/// Every load of the list that finite elements know but planes (contact_test.cpp), with irregular values; of them what
/// a sector admits. They act at once.
inline loads::Loads all_loads(const Sector& sector = whole) {
  loads::Loads loads;
  int n = 0;
  const auto next = [&n] { return std::cos(1.0 + 2.3 * ++n); };
  loads::visit_entries(loads, [&]<class Value, class Kind>(Value& member, const Kind& kind, const scene::About&) {
    if constexpr (std::is_same_v<Value, double>) {
      member = 0.1 + 0.03 * next();
    } else if constexpr (std::is_same_v<Value, scene::Matrix3>) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const double entry = 0.3 * next();
          if (admits_entry(sector, i, j)) member[i][j] = entry;
        }
      if (kind.symmetric)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < i; ++j) member[i][j] = member[j][i];
    } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
      for (std::size_t i = 0; i < member.size(); ++i) member[i] = sector.reflect[i] ? 0 : 0.3 * next();
    }
  });
  loads.get<loads::SelfGravity>() = {};
  loads.get<loads::Rise>() = {};
  return loads;
}

/// Relative errors of a mesh.
struct GeometryError {
  double volume, inertia;
};

}  // namespace pseudorigid::testing
