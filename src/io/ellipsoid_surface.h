#pragma once
/// The reduced body as a surface for ParaView: the unit sphere, cubed, mapped by X = S ê, x = x_c + r Q X.
///
/// Fields: displacement x − rX, pressure −tr σ/3, jacobian det Q, von_mises √(3/2 |dev σ|²); all but the first are
/// homogeneous, as everything in a pseudo-rigid body is.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/vtu.h"

namespace pseudorigid::io {

/// Six faces of n×n quadrilaterals, equiangular, without double points: 6n² cells, 6n² + 2 points.
struct CubedSphere {
  explicit CubedSphere(int n_cells_per_edge);
  std::vector<Eigen::Vector3d> points;     ///< |X| = 1
  std::vector<std::int64_t> connectivity;  ///< four points per cell, counter-clockwise seen from outside
};

/// One state of the reduced body in the user's units.
struct HomogeneousState {
  Eigen::Matrix3d Q = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d shape = Eigen::Matrix3d::Identity();  ///< S, of the reference ellipsoid; Id is the ball
  Eigen::Matrix3d cauchy_stress = Eigen::Matrix3d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1;
};

UnstructuredGrid ellipsoid_surface(const CubedSphere& sphere, const HomogeneousState& state);

inline void write_ellipsoid_vtu(const std::filesystem::path& path, const CubedSphere& sphere,
                                const HomogeneousState& state) {
  write_vtu(path, ellipsoid_surface(sphere, state));
}

}  // namespace pseudorigid::io
