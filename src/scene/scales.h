#pragma once
/// The unit of time t of a scene of the ball. In this unit, the numbers of the computation are of order 1:
///
///   1/t² = μ/(ρr²) + πGρ
///
/// with the shear modulus μ, the density ρ, the radius r and the constant of gravity G. Without self-gravity, t = r/c
/// with c = √(μ/ρ). For a fluid, μ = 0, and t = 1/√(πGρ) is about the free-fall time. If a fluid or a body with
/// self-gravity has loads whose rate (rate_of_loads) exceeds 1/t, the unit is the reciprocal of this rate. For a fluid
/// without gravity and with rate_of_loads = 0, the unit is the reciprocal of the largest entry of the initial velocity
/// Q̇₀. If Q̇₀ is also zero, the unit is Time/End.

#include <optional>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The law of the scene, in the units of the user.
materials::AnyLaw law_of(const Scene& scene);

/// Returns true if the law of the scene stores no energy.
bool is_fluid(const Scene& scene);

/// Returns true if the body does not resist changes of its shape. A body of the law `none` with viscoelastic branches
/// resists them.
bool is_ideal_fluid(const Scene& scene);

/// Returns true if no load acts on the ball. The only forces are then elasticity and the pressure that preserves the
/// volume of an incompressible body. Self-gravity and Loads/Pressure are loads. A rise alone is not a load, because it
/// only changes other loads.
bool is_free(const Scene& scene);

/// Returns true if the scene has a load that rises from 0 (loads/rise.h).
bool loads_rise(const Scene& scene);

/// The largest rate, in 1/time of the user, that a single load other than self-gravity would cause in a body without
/// other forces. Tidal matrices, tractions, pressures and viscoelastic branches have such rates, and other loads are
/// not considered. In an incompressible body, pressures are not considered either.
double rate_of_loads(const Scene& scene);

/// The unit of time t, in the units of the user.
double time_scale(const Scene& scene);

/// Refuses a motion until the time `end` if `end` exceeds 1e15 `time_unit`. The round-off of the time would then be
/// comparable with `time_unit`. Both times are in the units of the user.
std::optional<Refusal> refuses_duration(double end, double time_unit);

}  // namespace pseudorigid::scene
