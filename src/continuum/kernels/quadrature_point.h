#pragma once
/// Geometry of a quadrature point of a batch of cells, one lane a cell. What the law reads and what the constraint
/// reads are stored apart: each kernel streams its own numbers and no others.

#include "materials/tensor.h"
#include "mechanics/core/lanes.h"

namespace pseudorigid::continuum {

using mechanics::Lanes;
using mechanics::lesser;
using mechanics::native_lanes;

/// Of a body with so few cells that wider vectors would hold copies: the octant has four.
inline constexpr int few_lanes = native_lanes > 4 ? 4 : native_lanes;

/// For ∫P:∇φ.
template <int n_lanes>
struct QuadraturePoint {
  using L = Lanes<n_lanes>;

  L inverse_jacobian[9];  ///< (∂X/∂ξ)⁻¹, row-major
  L weight;               ///< quadrature weight · det ∂X/∂ξ

  /// F = H (∂X/∂ξ)⁻¹ for H = ∂x/∂ξ
  [[gnu::always_inline]] materials::Tensor<L> deformation_gradient(const materials::Tensor<L>& H) const {
    const L* row = inverse_jacobian;
    const auto entry = [&](int i, int j) { return H(i, 0) * row[j] + H(i, 1) * row[3 + j] + H(i, 2) * row[6 + j]; };
    return {{{entry(0, 0), entry(0, 1), entry(0, 2)},
             {entry(1, 0), entry(1, 1), entry(1, 2)},
             {entry(2, 0), entry(2, 1), entry(2, 2)}}};
  }
};

/// For ∫λ_h F⁻ᵀ:∇φ and its relatives.
template <int n_lanes>
struct PressurePoint {
  using L = Lanes<n_lanes>;

  L weight;       ///< quadrature weight · det ∂X/∂ξ
  L position[3];  ///< local coordinates of the pressure basis
};

/// Asks for the geometry of a point that is needed soon; where there is none, nothing happens.
template <class Point>
[[gnu::always_inline]] inline void prefetch(const Point* point) {
  constexpr std::size_t cache_line = 64;
#pragma GCC unroll 16
  for (std::size_t offset = 0; offset < sizeof(Point); offset += cache_line)
    __builtin_prefetch(reinterpret_cast<const char*>(point) + offset);
}

}  // namespace pseudorigid::continuum
