#pragma once
/// A scene of the ball measured by its own units, so that its author can check the values:
///
///   c = √(μ/ρ),   Time/End in r/c,   γ = ρgr/μ with g = (4/3)πGρr,   ω²r²/c²,   v/c
///
/// ω: the spin, the axial vector of Q̇₀Q₀⁻¹; v: the largest speed about the centre of mass at the start. A fluid, μ = 0,
/// has its unit of time (scene/scales.h) in place of r/c.

#include <string>
#include <vector>

#include "scene/scene.h"

namespace pseudorigid::scene {

/// A line for each dimensionless number of the scene.
std::vector<std::string> scale_lines(const Scene& scene);

/// A sentence for each number so far from 1 that a unit has probably slipped.
std::vector<std::string> unit_warnings(const Scene& scene);

}  // namespace pseudorigid::scene
