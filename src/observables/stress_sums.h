#pragma once
/// Sums over the quadrature points of a body for the columns of the von Mises stress (mechanics/core/von_mises.h). They
/// contain the Cauchy stresses at the points nearest to the centre, whose mean is the stress at the centre.

#include <algorithm>
#include <limits>

#include "mechanics/core/von_mises.h"

namespace pseudorigid::mechanics {

struct StressSums {
  static constexpr double same_distance = 1 + 1e-6;  ///< ratio of distances that count as equal

  double integral = 0, volume = 0, largest = 0;  ///< ∫σ_v dX, ∫dX, and the largest σ_v
  double least_distance = std::numeric_limits<double>::infinity();
  Eigen::Matrix3d central = Eigen::Matrix3d::Zero();  ///< sum of the stresses at the least distance from the centre
  double n_central = 0;                               ///< number of these points

  /// Adds a point with the Cauchy stress `stress`, the weight of the quadrature over the reference body, and the
  /// distance from the centre in the reference body.
  void add(const Eigen::Matrix3d& stress, double weight, double distance) {
    const double value = von_mises(stress);
    integral += weight * value;
    volume += weight;
    largest = std::max(largest, value);
    if (distance * same_distance < least_distance) {
      least_distance = distance;
      central.setZero();
      n_central = 0;
    }
    if (distance > least_distance * same_distance) return;
    central += stress;
    ++n_central;
  }
};

}  // namespace pseudorigid::mechanics
