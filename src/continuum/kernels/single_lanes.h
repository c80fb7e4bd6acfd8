#pragma once
/// SIMD vectors of n_lanes numbers in single precision, which need half the memory. For arithmetic, they are converted
/// to Lanes, which have double precision (mechanics/core/lanes.h).

#include "mechanics/core/lanes.h"

namespace pseudorigid::continuum {

namespace detail {
template <int n_lanes>
struct SingleVector;  // specialised for each size, as in mechanics/core/lanes.h
template <>
struct SingleVector<2> {
  typedef float Native __attribute__((vector_size(8)));
};
template <>
struct SingleVector<4> {
  typedef float Native __attribute__((vector_size(16)));
};
template <>
struct SingleVector<8> {
  typedef float Native __attribute__((vector_size(32)));
};
}  // namespace detail

template <int n_lanes>
struct SingleLanes {
  using Wide = mechanics::Lanes<n_lanes>;
  using Native = typename detail::SingleVector<n_lanes>::Native;
  Native v;

  SingleLanes() = default;
  SingleLanes(const Wide& x) : v(__builtin_convertvector(x.v, Native)) {}
  operator Wide() const { return Wide(__builtin_convertvector(v, typename Wide::Native)); }
};

}  // namespace pseudorigid::continuum
