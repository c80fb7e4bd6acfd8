#pragma once
/// Limits of the linear solvers for figures of equilibrium of finite elements (continuum/statics/tangent_solver.h). The
/// estimate of memory (app/search/effort.h) needs them without the finite elements.

namespace pseudorigid::mechanics {

/// Largest Lamé modulus and largest ρgr, both over the shear modulus, for V-cycles. The number of their iterations
/// grows with both ratios.
inline constexpr double largest_ratio_of_cycles = 100;
/// Largest number of unknowns of a body that is factorised after V-cycles have failed. For 23,475 unknowns of degree 6,
/// a process with the factors needs about 1 GB.
inline constexpr double most_factorized_unknowns = 25000;

}  // namespace pseudorigid::mechanics
