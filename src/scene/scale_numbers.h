#pragma once
/// Dimensionless numbers of a scene of the ball, by which the author of the scene can check its values:
///
///   c = √(μ/ρ),   Time/End in r/c,   γ = ρgr/μ with g = (4/3)πGρr,   ω²r²/c²,   v/c
///
/// with the shear modulus μ, the density ρ, the radius r and the constant of gravity G. The spin ω is the axial vector
/// of Q̇₀Q₀⁻¹. The largest initial speed of the ball relative to the centre of mass is v. A fluid has μ = 0. For a
/// fluid, the unit of time t of scene/scales.h replaces r/c, and γ is omitted.

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pseudorigid::scene {

/// γ of a scene of the ball; 0 for a fluid.
double gamma_of(const Scene& scene);

/// Lines of text about the scales and numbers. The first line contains c and r/c, or the unit of time of a fluid. A
/// line follows for each number that applies to the scene and is not zero.
std::vector<std::string> scale_lines(const Scene& scene);

/// One sentence for each number that is so large or so small that a unit is probably wrong. A fluid has no such
/// warnings.
std::vector<std::string> unit_warnings(const Scene& scene);

}  // namespace pseudorigid::scene
