#pragma once
/// Optional declarations of a law, in addition to energy, stress and tangent.
///
/// If a law does not admit all deformations F with J = det F > 0, it declares
///
///     template <class T> T reserve(const Tensor<T>& F) const;   positive if F is admitted
///     static constexpr std::string_view limit;                  the reason for the user, one clause
///
/// The surface of an incompressible body may wrinkle (continuum/output/surface_stretch.h). A law may declare the ratio
/// λ₁/λ_n at which the surface of a half-space wrinkles. Here λ₁ is the smaller principal stretch within the surface,
/// and λ_n is the stretch along its normal:
///
///     static constexpr double surface_limit;

#include <string>
#include <string_view>

#include "materials/tensor.h"

namespace pseudorigid::materials {

/// Biot's limit of λ₁/λ_n for neo-Hookean and Mooney–Rivlin half-spaces, the root of x³ + x² + 3x = 1 (Biot 1963).
inline constexpr double biot_ratio = 0.29559774252208477;

/// True if the law declares `reserve` and `limit`. A law that declares only one of them does not compile.
template <class Law>
inline constexpr bool is_limited = [] {
  constexpr bool has_reserve = requires(const Law law, Tensor<double> F) { law.reserve(F); };
  constexpr bool has_limit = requires { Law::limit; };
  static_assert(has_reserve == has_limit, "a law with limits declares both reserve(F) and limit");
  return has_reserve;
}();

/// Returns true if a law admits the deformation gradient F, which must have J > 0. `law` can also be a class that adds
/// other energies to a law. Such a class has its own members admits(F) and limit().
template <class Law>
[[gnu::always_inline]] inline bool admits(const Law& law, const Tensor<double>& F) {
  if constexpr (is_limited<Law>)
    return law.reserve(F) > 0;
  else if constexpr (requires { law.admits(F); })
    return law.admits(F);
  else
    return true;
}

/// Returns the reason why the law does not admit some F with J > 0, or an empty text if it admits all F with J > 0.
template <class Law>
constexpr std::string_view limit_of(const Law& law) {
  if constexpr (is_limited<Law>)
    return Law::limit;
  else if constexpr (requires { law.limit(); })
    return law.limit();
  else
    return {};
}

/// Returns the message to the user for a deformation that the law does not admit. `limit` is the reason from limit_of.
[[gnu::cold, gnu::noinline]] inline std::string beyond_limit(std::string_view limit) {
  std::string sentence = "the law of the material admits no such deformation: ";
  sentence += limit;
  return sentence;
}

}  // namespace pseudorigid::materials
