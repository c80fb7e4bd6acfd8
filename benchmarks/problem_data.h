#pragma once
/// The numbers that define the benchmark problems, shared by the benchmarks and the generator of their references.

#include <array>

namespace pseudorigid::benchmarks {

/// Every method delivers the samples t_k = k T/N, k = 1 … N.
inline constexpr double end_time = 100;
inline constexpr int n_samples = 100;

/// (i) Neo-Hookean pseudo-rigid ball on SL(3), μ = ρ = r = 1 (κ = 5): Q₀ = diag(1.3, 1, 1/1.3), Q̇₀ = Q₀L. By rows.
namespace sl3 {
inline constexpr double kappa = 5, stretch = 1.3;
inline constexpr std::array<double, 9> L{0.2, -0.8, 0.1, 0.6, -0.3, 0.2, 0, -0.1, 0.1};
}  // namespace sl3

/// (ii) Free rigid body about its centre of mass: principal moments of inertia, Ω at R = Id, near the separatrix of the
/// intermediate axis without being on it.
namespace rigid_body {
inline constexpr std::array<double, 3> A{1, 2, 2.5}, Omega{0.4, 1.0, 0.6};
}

/// (iii) Planar double pendulum, m₁ = m₂ = l₁ = l₂ = g = 1, released from rest: regular motion (the greatest Lyapunov
/// exponent is not measurable over T).
namespace double_pendulum {
inline constexpr double theta = 0.6, phi = 0.8;
}

/// (v) A fluid ellipsoid under its own gravity (Dirichlet, Riemann), time in 1/√(πGρ): Q̈ = −(4/3) D Q + λQ⁻ᵀ with
/// D = (3/2) ∫₀^∞ (C + s)⁻¹ det(C + s)^(−1/2) ds, C = QQᵀ. Q₀ = diag(1.2, 1, 1/1.2), Q̇₀ = Q₀L. By rows.
namespace gravitating {
inline constexpr double stretch = 1.2;
inline constexpr std::array<double, 9> L{0.1, -0.4, 0.05, 0.3, -0.15, 0.1, 0, -0.05, 0.05};
}  // namespace gravitating

}  // namespace pseudorigid::benchmarks
