#pragma once
/// Dimensionless numbers of a scene of the ball, by which the author of the scene can check its values:
///
///   c = √(μ/ρ),   Time/End in r/c,   γ = ρgr/μ with g = (4/3)πGρr,   ω²r²/c²,   v/c
///
/// with the spin ω, which is the axial vector of Q̇₀Q₀⁻¹, and the largest initial speed v relative to the centre of
/// mass. For a fluid, μ = 0, the unit of time of scene/scales.h replaces r/c.

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pseudorigid::scene {

/// One line of text for each dimensionless number of the scene.
std::vector<std::string> scale_lines(const Scene& scene);

/// One sentence for each number that is so far from 1 that a unit is probably wrong.
std::vector<std::string> unit_warnings(const Scene& scene);

}  // namespace pseudorigid::scene
