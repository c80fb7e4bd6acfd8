#pragma once
/// Self-gravity of the homogeneous ellipsoid F B, with the unit ball B, over any scalar type, in particular SIMD lanes.
/// All lanes must take the same branch. The algorithm therefore uses neither principal axes nor branches for a single
/// lane. The corresponding algorithm for a single body is in gravity/ellipsoid_gravity.h. With the potential energy
/// V(F), the mass M, the gravitational constant G and k = (3/5) G M²,
///
///   ∂V/∂F = (k/3) D F,   D = (3/2) ∫₀^∞ (C + s)⁻¹ det(C + s)^(−1/2) ds,   C = FFᵀ.
///
/// The integral is computed by Carlson's duplication for matrices. Let r₁, r₂, r₃ be the elementary symmetric functions
/// of the eigenvalues of R = √C. The equation R³ − r₁R² + r₂R − r₃ = 0 (Cayley and Hamilton) gives R(C + r₂) = r₁C +
/// r₃, and so
///
///   D(C) = 3 (r₁C + r₃)⁻¹ + 2 D(C'),   C' = C + r₂,   r₃' = r₁r₂ − r₃.
///
/// R itself is not computed. The invariants are r₃ = √det C and r₂ = (r₁² − tr C)/2, and r₁ is the largest root of r₂²
/// − 2r₁r₃ − tr cof C. Each duplication makes r₁ about twice as large. Let A = ⅓ tr C and Z = Id − C/A. If Z is small,
/// the series h₀, h₁, h₂ of ellipsoid_integrals.h give D = A^(−3/2) (h₀ Id + h₁ Z + h₂ cof Z).
///
/// All terms of the sum for D are positive definite, so there is no cancellation. For a flat body, D F has relative
/// errors of cond(F) ε, with the round-off ε and the condition number cond(F).

#include <cmath>
#include <type_traits>

#include "gravity/ellipsoid_integrals.h"
#include "materials/tensor.h"

namespace pseudorigid::reduced {

namespace gravity_in_lanes {

/// A symmetric matrix: diagonal[i] is the entry (i, i), and opposite[i] the entry (j, k) with i, j, k all different.
template <class T>
struct SymmetricOf {
  T diagonal[3], opposite[3];
};
template <class T>
[[gnu::always_inline]] inline SymmetricOf<T> cofactor(const SymmetricOf<T>& S) {
  const auto& [d, o] = S;
  return {{d[1] * d[2] - o[0] * o[0], d[2] * d[0] - o[1] * o[1], d[0] * d[1] - o[2] * o[2]},
          {o[1] * o[2] - d[0] * o[0], o[2] * o[0] - d[1] * o[1], o[0] * o[1] - d[2] * o[2]}};
}
template <class T>
[[gnu::always_inline]] inline T trace(const SymmetricOf<T>& S) {
  return S.diagonal[0] + S.diagonal[1] + S.diagonal[2];
}
template <class T>
[[gnu::always_inline]] inline T determinant(const SymmetricOf<T>& S, const SymmetricOf<T>& cof) {
  return S.diagonal[0] * cof.diagonal[0] + S.opposite[1] * cof.opposite[1] + S.opposite[2] * cof.opposite[2];
}
/// Returns s S + t Id.
template <class T>
[[gnu::always_inline]] inline SymmetricOf<T> scaled_and_shifted(const T& s, const SymmetricOf<T>& S, const T& t) {
  SymmetricOf<T> result;
  for (int i = 0; i < 3; ++i) {
    result.diagonal[i] = s * S.diagonal[i] + t;
    result.opposite[i] = s * S.opposite[i];
  }
  return result;
}
/// Adds s X to S.
template <class T>
[[gnu::always_inline]] inline void add(const T& s, const SymmetricOf<T>& X, SymmetricOf<T>& S) {
  for (int i = 0; i < 3; ++i) {
    S.diagonal[i] = S.diagonal[i] + s * X.diagonal[i];
    S.opposite[i] = S.opposite[i] + s * X.opposite[i];
  }
}

/// The elementary symmetric functions r₁ and r₂ of the eigenvalues of √C.
template <class T>
struct RootInvariants {
  T r1, r2;
};

/// Computes r₁ and r₂ from 2r₂ = r₁² − I and r₂² = II + 2r₁r₃, with I = tr C and II = tr cof C. The argument `r1` is
/// the start of the iteration r₁ ↦ √(I + 2√(II + 2r₁r₃)), and `root(x)` is √x. The iteration converges from any start,
/// without cancellation. Near the solution, it reduces the error by the factor r₃/(r₁r₂) ≤ 1/9. Three Newton steps
/// after n_maps iterations give most digits. A last iteration removes the round-off of the Newton steps.
template <class T, class Root>
[[gnu::always_inline]] inline RootInvariants<T> invariants_of_root(T r1, int n_maps, const T& I, const T& II,
                                                                   const T& r3, const Root& root) {
  constexpr int n_newton = 3;
  const auto second = [&](const T& x) { return root(II + 2.0 * x * r3); };
  for (int n = 0; n < n_maps; ++n) r1 = root(I + 2.0 * second(r1));
  for (int n = 0; n < n_newton; ++n) {
    const T r2 = 0.5 * (r1 * r1 - I);
    r1 = r1 - 0.5 * (r2 * r2 - 2.0 * r1 * r3 - II) / (r1 * r2 - r3);
  }
  const T r2 = second(r1);
  return {root(I + 2.0 * r2), r2};
}

/// Functions for the series h_l(E₂, E₃) of ellipsoid_integrals.h over any scalar type, by Horner's rule. `row_of`
/// returns the polynomial in E₂ that is the factor of a power of E₃. `rows_of` sums over the powers of E₃.
template <int l, int n, class T, int... m>
[[gnu::always_inline]] inline T row_of(const T& E2, std::integer_sequence<int, m...>) {
  constexpr int M = sizeof...(m) - 1;
  T sum = T(0.0);
  ((sum = sum * E2 + T(gravity::detail::series_coefficient<l, M - m, n>)), ...);
  return sum;
}
template <int l, class T, int... n>
[[gnu::always_inline]] inline T rows_of(const T& E2, const T& E3, std::integer_sequence<int, n...>) {
  constexpr int N = sizeof...(n) - 1;
  T sum = T(0.0);
  ((sum = sum * E3 +
          row_of<l, N - n>(
              E2, std::make_integer_sequence<int, (gravity::detail::series_degree - l - 3 * (N - n)) / 2 + 1>())),
   ...);
  return sum;
}
template <int l, class T>
[[gnu::always_inline]] inline T series_of(const T& E2, const T& E3) {
  return rows_of<l>(E2, E3, std::make_integer_sequence<int, (gravity::detail::series_degree - l) / 3 + 1>());
}

}  // namespace gravity_in_lanes

/// Returns the derivative ∂V/∂F of the potential energy for the constant k = `strength`. `root(x)` is √x in each lane,
/// and `largest(x)` is the largest lane of x as a number. The norm of F must be between 10⁻²⁰ and 10²⁰. For a singular
/// F, the result is not finite.
template <class T, class Root, class Largest>
materials::Tensor<T> ellipsoid_force(double strength, const materials::Tensor<T>& F, const Root& root,
                                     const Largest& largest) {
  using namespace gravity_in_lanes;
  constexpr int max_duplications = 20;
  // Bound of tr Z² below which the series is accurate to round-off.
  constexpr double close = 0.5 * (3 * gravity::detail::series_spread) * (3 * gravity::detail::series_spread);
  const materials::Tensor<T> cof_F = materials::cofactor(F);
  const auto row = [&](int i, int j) { return F(i, 0) * F(j, 0) + F(i, 1) * F(j, 1) + F(i, 2) * F(j, 2); };
  SymmetricOf<T> C{{row(0, 0), row(1, 1), row(2, 2)}, {row(1, 2), row(2, 0), row(0, 1)}};
  SymmetricOf<T> D = scaled_and_shifted(T(0.0), C, T(0.0));
  T I = trace(C), II = materials::dot(cof_F, cof_F);  // invariants tr C and tr cof C
  T r3 = materials::determinant(F, cof_F), r1 = root(3.0 * I);
  double weight = 1;  // factor 2ⁿ of the term after n duplications
  for (int n = 0;; ++n) {
    // tr Z² = (I² − 2 II)/A² − 3
    const T spread = (I * I - 2.0 * II) * 9.0 / (I * I) - 3.0;
    if (n == max_duplications || !(largest(spread) > close)) break;
    const auto [first, r2] = invariants_of_root(r1, n == 0 ? 3 : 1, I, II, r3, root);
    r1 = first;
    const SymmetricOf<T> K = scaled_and_shifted(r1, C, r3), cof = cofactor(K);
    add(3.0 * weight / determinant(K, cof), cof, D);
    for (T& entry : C.diagonal) entry = entry + r2;
    II = II + r2 * (2.0 * I + 3.0 * r2);
    I = I + 3.0 * r2;
    r3 = r1 * r2 - r3;
    r1 = 2.0 * r1;
    weight *= 2;
  }
  const T A = I / 3.0, inverse = 1.0 / A;
  const SymmetricOf<T> Z = scaled_and_shifted(T(-1.0) * inverse, C, T(1.0)), cof = cofactor(Z);
  const T E2 = trace(cof), E3 = determinant(Z, cof), factor = weight * inverse / root(A);
  const T h0 = series_of<0>(E2, E3), h1 = series_of<1>(E2, E3), h2 = series_of<2>(E2, E3);
  for (int i = 0; i < 3; ++i) {
    D.diagonal[i] = D.diagonal[i] + factor * (h0 + Z.diagonal[i] * h1 + cof.diagonal[i] * h2);
    D.opposite[i] = D.opposite[i] + factor * (Z.opposite[i] * h1 + cof.opposite[i] * h2);
  }
  const materials::Tensor<T> full{{{D.diagonal[0], D.opposite[2], D.opposite[1]},
                                   {D.opposite[2], D.diagonal[1], D.opposite[0]},
                                   {D.opposite[1], D.opposite[0], D.diagonal[2]}}};
  return materials::entrywise([&](const T& x) { return strength / 3 * x; }, materials::product(full, F));
}

}  // namespace pseudorigid::reduced
