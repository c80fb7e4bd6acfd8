#pragma once
/// Strains computed from H = F − Id. If H is small, the computation of the strain has no cancellation. If the body is
/// rotated, H is not small, and the absolute error of the strain is of the order of round-off. With C = FᵀF, I = tr C
/// and a variation K of F,
///
///   D = C − Id = FᵀF − Id = H + Hᵀ + HᵀH  (twice Green's strain),   tr D = I − 3 = 2 tr H + |H|²
///   DD(F)[K] = KᵀF + FᵀK, with the trace 2 F:K

#include <type_traits>

#include "materials/tensor.h"

namespace pseudorigid::materials {

/// Returns the displacement gradient H = F − Id.
template <class T>
[[gnu::always_inline]] inline Tensor<T> displacement_gradient(const Tensor<T>& F) {
  return {{{F(0, 0) - 1.0, F(0, 1), F(0, 2)}, {F(1, 0), F(1, 1) - 1.0, F(1, 2)}, {F(2, 0), F(2, 1), F(2, 2) - 1.0}}};
}

/// Returns the symmetric tensor with the entries entry(i, j). Only the six entries with i ≤ j are computed.
template <class Entry>
[[gnu::always_inline]] inline auto symmetric_tensor(Entry entry) {
  const auto a = entry(0, 1), b = entry(0, 2), c = entry(1, 2);
  return Tensor<std::decay_t<decltype(entry(0, 0))>>{{{entry(0, 0), a, b}, {a, entry(1, 1), c}, {b, c, entry(2, 2)}}};
}

/// Returns the strain D = FᵀF − Id, from H, without cancellation if H is small.
template <class T>
[[gnu::always_inline]] inline Tensor<T> strain(const Tensor<T>& F) {
  const Tensor<T> H = displacement_gradient(F);
  return symmetric_tensor(
      [&](int i, int j) { return (H(i, j) + H(j, i)) + (H(0, i) * H(0, j) + H(1, i) * H(1, j) + H(2, i) * H(2, j)); });
}

/// Returns the trace tr D = I − 3, from H, without cancellation if H is small.
template <class T>
[[gnu::always_inline]] inline T trace_of_strain(const Tensor<T>& F) {
  const Tensor<T> H = displacement_gradient(F);
  return 2.0 * trace(H) + dot(H, H);
}

/// Returns the derivative DD(F)[K] = KᵀF + FᵀK of the strain along K.
template <class T>
[[gnu::always_inline]] inline Tensor<T> strain_rate(const Tensor<T>& F, const Tensor<T>& K) {
  const Tensor<T> half = transposed_product(F, K);
  return symmetric_tensor([&](int i, int j) { return half(i, j) + half(j, i); });
}

}  // namespace pseudorigid::materials
