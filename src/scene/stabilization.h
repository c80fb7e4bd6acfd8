#pragma once
/// The stiffness κ of the volumetric stabilisation of incompressible bodies (continuum/kernels/stored_energy.h). It is
/// a pressure in the units of the user. If the scene does not set κ, its value is
///
///   κ = (2π/3) G ρ² r² + ½ρ t r² + κ_v.
///
/// Here G is the constant of gravity. The first term is the pressure at the centre of a ball of radius r and density ρ
/// at rest under its own gravity. The second term is the pressure under the potential ½t|x|² per mass. The number t is
/// the largest eigenvalue of the tidal matrix (Loads/Tidal matrix, in 1/time²) if all eigenvalues are positive, and 0
/// otherwise. If the loads rise from 0, the tidal matrix has its full value here.
///
/// The third term is only for motions of finite elements with an elastic law. Let W be the stored energy of the law, μ
/// its shear modulus at rest, and D = sym(Q̇₀Q₀⁻¹) with the initial deformation Q₀ and its rate Q̇₀. The energy density
/// of deformation at the start, in units of μ, is
///
///   e = [W(Q₀) − W(Id)]/μ + ρ r² |D Q₀|²/(10 μ).
///
/// The start is violent if e > 0.06, and then κ_v = 3μ; otherwise κ_v = 0. If the motion starts from the own figure of
/// equilibrium, Q₀ and Q̇₀ are the deformation and velocity that disturb the figure. Without them, the motion has the κ
/// of the figure. The release with the velocity diag(a, a, −2a)x, a = 0.3 c/r and the speed of shear waves c has e =
/// 0.054. The threshold is slightly above this value, so the cost of this release does not increase.
///
/// The value κ_v = 3μ was measured for a neo-Hookean ball and unrefined elements, with κ/μ = 0, 1, 3, 10 and 30. The
/// error of the deformation Q is the difference from elements of degree 8 with κ = 0. The ball was released from the
/// stretches 1.2 and 1.35, and the pairs of numbers below are for these two stretches. For degree 4, κ = 3μ divides the
/// error by 2.2 and 3.2 until the time 5 r/c. Until 10 r/c it divides the error by 1.7 and 1.4. For degree 5, the
/// divisors are 1.2 and 1.2 until 5 r/c, and 1.5 and 0.9 until 10 r/c. No other κ is better for all of these. The least
/// determinant of the deformation gradient at degree 4 rises from 0.80 and 0.68 to 0.92 and 0.77. The number of
/// evaluations of the force, including pilot runs, changes by −17 to +3 %.

#include "scene/scene.h"

namespace pseudorigid::scene {

/// Returns true if all eigenvalues of the tidal matrix are positive. The tidal load alone then keeps the body together.
bool is_confined(const Scene& scene);

/// The stiffness κ that the scene sets. If the scene does not set κ, the result is κ without κ_v. For a compressible
/// body it is 0. Models other than finite elements use this value. If it is 0, the stored energy has no volumetric
/// term.
double volumetric_stiffness(const Scene& scene);

/// The energy density e of the deformation at the start, in units of μ; 0 for a fluid.
double violence_of_start(const Scene& scene);

/// Returns true if the motion of an elastic body starts violently, as defined above.
bool starts_violently(const Scene& scene);

/// The stiffness κ of finite elements. It includes κ_v if the scene does not set κ and the motion starts violently.
double volumetric_stiffness_of_elements(const Scene& scene);

}  // namespace pseudorigid::scene
