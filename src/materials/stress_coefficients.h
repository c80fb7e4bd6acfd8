#pragma once
/// Coefficients of a stress that depend only on J = det F. A law with
///
///   P = a F + c cof F,   a and c functions of J,
///
/// may declare its coefficients a (`of_F`) and c (`of_cofactor`):
///
///     template <class T> StressCoefficients<T> stress_coefficients(const T& J) const;
///
/// The finite-element model then needs fewer numbers and operations at a quadrature point
/// (continuum/kernels/stress_points.h).

namespace pseudorigid::materials {

template <class T>
struct StressCoefficients {
  T of_F, of_cofactor;
};

/// True if the law declares `stress_coefficients`.
template <class Law>
inline constexpr bool has_stress_coefficients = requires(const Law law, double J) {
  law.stress_coefficients(J);
};

}  // namespace pseudorigid::materials
