#pragma once
/// A vector of lanes (lanes.h) as a scalar type of Eigen and of automatic differentiation. A function over any scalar
/// type can then be evaluated in all lanes at once.

#include <Eigen/Core>
#include <type_traits>

#include "mechanics/core/gauss_iteration.h"
#include "mechanics/core/lanes_trigonometry.h"

namespace pseudorigid::mechanics {

// `sin` and `cos` are correct only for |x| ≤ 2²⁰. They omit the branch for larger |x|, so that the compiler computes
// the common terms of sin x and cos x only once.
[[gnu::always_inline]] inline Lanes<native_lanes> sin(Lanes<native_lanes> x) { return sine_cosine_of_moderate(x).sine; }
[[gnu::always_inline]] inline Lanes<native_lanes> cos(Lanes<native_lanes> x) {
  return sine_cosine_of_moderate(x).cosine;
}
template <int n>
[[gnu::always_inline]] inline Lanes<n>& operator-=(Lanes<n>& a, const std::type_identity_t<Lanes<n>>& b) {
  return a = a - b;
}
template <int n>
[[gnu::always_inline]] inline Lanes<n>& operator*=(Lanes<n>& a, const std::type_identity_t<Lanes<n>>& b) {
  return a = a * b;
}
[[gnu::always_inline]] inline Lanes<native_lanes> sqrt(Lanes<native_lanes> x) { return detail::root_of_lanes(x); }

}  // namespace pseudorigid::mechanics

template <int n_lanes>
struct Eigen::NumTraits<pseudorigid::mechanics::Lanes<n_lanes>>
    : Eigen::GenericNumTraits<pseudorigid::mechanics::Lanes<n_lanes>> {
  using Real = pseudorigid::mechanics::Lanes<n_lanes>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
