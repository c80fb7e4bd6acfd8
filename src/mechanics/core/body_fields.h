#pragma once
/// Fields over a body at one time, for the picture files (VTU). Their values are given at points of the reference body,
/// in the internal units, in which all quantities are of order 1. All quantities in a picture are computed from these
/// fields (io/body_picture.h), so that they have the same definition for every model.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace pseudorigid::mechanics {

/// Arrangement of the points of a BodyFields in blocks of (degree + 1)³ points. A block is a grid with three
/// coordinates, which are right-handed; the first coordinate varies fastest. The points need not be equidistant. In
/// each coordinate of a block, a field is approximately a polynomial of degree `degree`.
struct PointBlocks {
  int degree = 1;
  std::vector<std::int64_t> points;  ///< indices of points in BodyFields, block by block

  std::size_t points_per_block() const {
    const auto n = static_cast<std::size_t>(degree) + 1;
    return n * n * n;
  }
  std::size_t n_blocks() const { return points.size() / points_per_block(); }
};

/// Values at points, one point after the other. A vector has three entries. A matrix has nine entries, row by row.
struct BodyFields {
  std::vector<double> X, x, v;                       ///< reference position, position, velocity
  std::vector<double> F, stress;                     ///< deformation gradient ∂x/∂X, Cauchy stress
  std::vector<double> energy;                        ///< stored energy W per reference volume
  std::vector<double> potential;                     ///< potential of self-gravity per mass; empty if not known
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< centre of mass x_c
  Eigen::Matrix3d moment = Eigen::Matrix3d::Identity();  ///< ∫ρ (x − x_c) Xᵀ dV over the reference body with density ρ;
                                                         ///< its polar decomposition gives the mean rotation

  /// Appends the values at one point to all fields except `potential`.
  void add(const Eigen::Vector3d& X_of_point, const Eigen::Vector3d& x_of_point, const Eigen::Vector3d& v_of_point,
           const Eigen::Matrix3d& F_of_point, const Eigen::Matrix3d& stress_of_point, double energy_of_point) {
    X.insert(X.end(), X_of_point.begin(), X_of_point.end());
    x.insert(x.end(), x_of_point.begin(), x_of_point.end());
    v.insert(v.end(), v_of_point.begin(), v_of_point.end());
    for (const auto& [matrix, values] : {std::pair{&F_of_point, &F}, std::pair{&stress_of_point, &stress}})
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) values->push_back((*matrix)(i, j));
    energy.push_back(energy_of_point);
  }
  std::size_t n_points() const { return energy.size(); }
};

}  // namespace pseudorigid::mechanics
