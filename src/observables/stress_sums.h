#pragma once
/// Sums for the mean and the largest von Mises stress of a body whose stress is known at points (mechanics/core/
/// von_mises.h).

#include <algorithm>

#include "mechanics/core/von_mises.h"

namespace pseudorigid::mechanics {

struct StressSums {
  double integral = 0, volume = 0, largest = 0;  ///< ∫σ_v dX and ∫dX over the points with a weight, and the largest σ_v

  /// Adds a point with the Cauchy stress `stress` and the weight of a quadrature over the reference body. A point with
  /// the weight 0 counts for the largest value only.
  void add(const Eigen::Matrix3d& stress, double weight) {
    const double value = von_mises(stress);
    integral += weight * value;
    volume += weight;
    largest = std::max(largest, value);
  }
};

}  // namespace pseudorigid::mechanics
