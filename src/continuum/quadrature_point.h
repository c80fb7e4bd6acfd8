#pragma once
/// Geometry of a quadrature point of a batch of cells, one lane a cell.

#include "continuum/lanes.h"
#include "materials/tensor.h"

namespace pseudorigid::continuum {

struct QuadraturePoint {
  using L = Lanes<native_lanes>;

  L inverse_jacobian[9];  ///< (∂X/∂ξ)⁻¹, row-major
  L inverse_determinant;  ///< 1 / det ∂X/∂ξ
  L weight;               ///< quadrature weight · det ∂X/∂ξ
  L position[3];          ///< local coordinates of the pressure basis

  /// F = H (∂X/∂ξ)⁻¹ for H = ∂x/∂ξ
  materials::Tensor<L> deformation_gradient(const materials::Tensor<L>& H) const {
    const L* row = inverse_jacobian;
    materials::Tensor<L> F;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F(i, j) = H(i, 0) * row[j] + H(i, 1) * row[3 + j] + H(i, 2) * row[6 + j];
    return F;
  }
};

}  // namespace pseudorigid::continuum
