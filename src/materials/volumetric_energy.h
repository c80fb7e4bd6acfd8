#pragma once
/// The energy U of the volumetric stabilisation per reference volume, with the stiffness κ and J = det F:
///
///   U = (κ/8)(J − 1/J)²,   U' = (κ/4)(J − 1/J³),   U'' = (κ/4)(1 + 3/J⁴),   U''(1) = κ,
///   ∂U/∂F = U' cof F.
///
/// The scalar type S is double or a SIMD vector.

namespace pseudorigid::materials {

template <class S>
[[gnu::always_inline]] inline S volumetric_energy(double kappa, const S& J) {
  const S difference = J - 1.0 / J;
  return (0.125 * kappa) * difference * difference;
}

/// Returns U'(J).
template <class S>
[[gnu::always_inline]] inline S volumetric_pressure(double kappa, const S& J) {
  const S inverse = 1.0 / J;
  return (0.25 * kappa) * (J - inverse * inverse * inverse);
}

/// Returns U''(J).
template <class S>
[[gnu::always_inline]] inline S volumetric_curvature(double kappa, const S& J) {
  const S inverse = 1.0 / J, square = inverse * inverse;
  return (0.25 * kappa) * (1.0 + 3.0 * square * square);
}

}  // namespace pseudorigid::materials
