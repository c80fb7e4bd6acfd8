#pragma once
/// Dimensionless numbers of a scene of the ball, by which the author of the scene can check its values:
///
///   c = √(μ/ρ),   Time/End in r/c,   γ = ρgr/μ with g = (4/3)πGρr,   ω²r²/c²,   v/c
///
/// with the shear modulus μ, the density ρ, the radius r and the constant of gravity G. The initial deformation is Q₀,
/// and its rate is Q̇₀. The spin ω is the axial vector of the antisymmetric part of Q̇₀Q₀⁻¹. The speed v = r|Q̇₀|₂,
/// with the spectral norm, is the largest initial speed in a ball of radius r, relative to the centre of mass. A fluid
/// has μ = 0. For a fluid, the unit of time t of scene/scales.h replaces r/c, and γ is omitted.

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pseudorigid::scene {

/// The number γ of a scene of the ball, which is 0 without self-gravity and for a fluid.
double gamma_of(const Scene& scene);

/// Lines of text about the numbers in the head of this file. The first line contains c and r/c, or the unit of time of
/// a fluid. A line follows for each number that applies to the scene and is not zero.
std::vector<std::string> scale_lines(const Scene& scene);

/// One sentence for each number that is so large or so small that a unit is probably wrong. The checked numbers are
/// Time/End, v/c and γ. A fluid has no such warnings.
std::vector<std::string> unit_warnings(const Scene& scene);

}  // namespace pseudorigid::scene
