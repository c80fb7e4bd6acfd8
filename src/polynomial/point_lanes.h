#pragma once
/// Fields at quadrature points in SIMD vectors, one point in each lane. For n points, the entry (i, j) of a tensor at
/// point p has the index (3i + j) n + p in its array. This file is compiled for each instruction set of
/// dense_kernels.h.

#include <cstring>

#include "materials/tensor.h"
#include "mechanics/core/lanes.h"
#include "polynomial/dense_kernels.h"

namespace pseudorigid::polynomial {
namespace {

constexpr int n_lanes = mechanics::native_lanes;
using L = mechanics::Lanes<n_lanes>;
using Tensor = materials::Tensor<L>;
static_assert(point_block % n_lanes == 0);

[[gnu::always_inline]] inline L load(const double* x) {
  L lanes;
  std::memcpy(&lanes.v, x, sizeof lanes.v);
  return lanes;
}
[[gnu::always_inline]] inline void store(const L& lanes, double* x) { std::memcpy(x, &lanes.v, sizeof lanes.v); }

/// The functions for tensors read and write a field with n points at the points p, p + 1, …, one in each lane.
[[gnu::always_inline]] inline Tensor load(const double* field, int n, int p) {
  const auto entry = [&](int k) { return load(field + static_cast<long>(k) * n + p); };
  return {{{entry(0), entry(1), entry(2)}, {entry(3), entry(4), entry(5)}, {entry(6), entry(7), entry(8)}}};
}
[[gnu::always_inline]] inline void store(const Tensor& T, double* field, int n, int p) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) store(T(i, j), field + static_cast<long>(3 * i + j) * n + p);
}

[[gnu::always_inline]] inline Tensor add(const Tensor& A, const Tensor& B) {
  return materials::entrywise([](const L& a, const L& b) { return a + b; }, A, B);
}

}  // namespace
}  // namespace pseudorigid::polynomial
