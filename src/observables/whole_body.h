#pragma once
/// Functions for observables of the whole body if only a sector between symmetry planes is computed.

#include <Eigen/Core>
#include <array>

namespace pseudorigid::mechanics {

/// Returns `integral`, a 3×3 integral over the whole body such as ∫ρ x xᵀ dV, with 0 in the entries that vanish by
/// symmetry. `reflect[i]` is true if the motion is symmetric under the reflection x_i ↦ −x_i. This reflection changes
/// the sign of the entries (i, j) and (j, i) with j ≠ i, so these entries are 0.
inline Eigen::Matrix3d without_odd_entries(Eigen::Matrix3d integral, const std::array<bool, 3>& reflect) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j && (reflect[i] || reflect[j])) integral(i, j) = 0;
  return integral;
}

/// Returns part/whole, or 0 if the whole is 0.
inline double share(double part, double whole) { return whole == 0 ? 0 : part / whole; }

}  // namespace pseudorigid::mechanics
