#pragma once
/// Geometry of a quadrature point of a batch of cells, one cell in each lane. This file has the geometry for the
/// constraint. The geometry for the law is separate (stress_points.h), so that each kernel reads only the numbers that
/// it needs.

#include <cstddef>
#include <cstdint>

#include "mechanics/core/lanes.h"

namespace pseudorigid::continuum {

using mechanics::Lanes;
using mechanics::lesser;
using mechanics::native_lanes;

/// Number of lanes if a process has at most this number of cells, such as an octant with four cells. In wider vectors,
/// the other lanes would repeat cells. This constant is not inline, because its value depends on the instruction set
/// for which a source file is compiled.
constexpr int few_lanes = native_lanes > 4 ? 4 : native_lanes;

/// The geometry of a point that the integrals of the constraint need, such as the nodal forces of the pressure.
template <int n_lanes>
struct PressurePoint {
  using L = Lanes<n_lanes>;

  L weight;       ///< quadrature weight · det ∂X/∂ξ
  L position[3];  ///< local coordinates (X − X_c)/h_c of pressure_basis.h
};

/// Prefetches the geometry of a point before its use. `point` may be behind the last point, because a prefetch of any
/// address is permitted.
template <class Point>
[[gnu::always_inline]] inline void prefetch(const Point* point) {
  constexpr std::size_t cache_line = 64;
#pragma GCC unroll 16
  for (std::size_t offset = 0; offset < sizeof(Point); offset += cache_line)
    __builtin_prefetch(reinterpret_cast<const char*>(point) + offset, 0, 2);
}

/// Prefetches the bytes from q · `n_bytes` to (q + 1) · `n_bytes` of an object, which may be behind the last object.
template <int n_bytes>
[[gnu::always_inline]] inline void prefetch_part(const void* object, int q) {
  constexpr int cache_line = 64;
  const auto start = reinterpret_cast<std::uintptr_t>(object) + static_cast<std::uintptr_t>(q * n_bytes);
  for (int offset = 0; offset < n_bytes; offset += cache_line)
    __builtin_prefetch(reinterpret_cast<const char*>(start + offset), 0, 2);
}

}  // namespace pseudorigid::continuum
