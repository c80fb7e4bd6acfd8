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

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "entries/matrix3.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The law of the scene, in the units of the user.
inline materials::AnyLaw law_of(const Scene& scene) {
  return materials::make_law(scene.material.law, scene.material, scene.body.incompressible);
}

inline bool is_fluid(const Scene& scene) { return materials::is_fluid(law_of(scene)); }

/// Whether the body does not resist changes of its shape. A body of the law `none` with viscoelastic branches resists
/// them.
inline bool is_ideal_fluid(const Scene& scene) {
  return is_fluid(scene) && !loads::present(scene.loads.get<loads::Viscoelasticity>());
}

/// Whether no load acts on the ball. The only forces are then elasticity and the pressure that keeps the volume of an
/// incompressible body. Self-gravity and Loads/Pressure are loads. A rise alone is not a load, because it only changes
/// other loads.
inline bool is_free(const Scene& scene) {
  loads::Loads acting = scene.loads;
  acting.get<loads::Rise>() = {};
  return !loads::any_present(acting);
}

/// Whether the scene has a load that rises from 0 (loads/rise.h).
inline bool loads_rise(const Scene& scene) {
  const auto is_present = [](const loads::Forcing& forcing) { return forcing.present(); };
  return loads::present(scene.loads.get<loads::Rise>()) && loads::depend_on_time(scene.loads, is_present);
}

/// The largest rate, in 1/time of the user, that a single load other than self-gravity would cause in a body without
/// other forces. Only tidal matrices, tractions, pressures and viscoelastic branches count. In an incompressible body,
/// a pressure does not count.
inline double rate_of_loads(const Scene& scene) {
  const double inertia = scene.body.density * scene.body.radius * scene.body.radius;
  double rate = 0;
  const loads::Loads acting = scene.body.incompressible ? loads::at_constant_volume(scene.loads) : scene.loads;
  acting.for_each([&](const auto& load) {
    const loads::Forcing forcing = loads::largest_forcing(load);
    rate = std::max({rate, std::sqrt(forcing.quadratic.cwiseAbs().maxCoeff()),
                     std::sqrt(forcing.nominal_traction.cwiseAbs().maxCoeff() / inertia),
                     std::sqrt(std::abs(forcing.pressure) / inertia),
                     std::sqrt(materials::sum_of_moduli(forcing.branches.list) / inertia)});
  });
  return rate;
}

/// The unit of time t, in the units of the user.
inline double time_scale(const Scene& scene) {
  const auto& body = scene.body;
  const double gravity = std::numbers::pi * loads::constant_forcing(scene.loads).gravity_constant * body.density;
  if (!is_fluid(scene) && gravity == 0) return body.radius * std::sqrt(body.density / scene.material.shear_modulus);
  const double stiffness =
      is_fluid(scene) ? 0 : scene.material.shear_modulus / (body.density * body.radius * body.radius);
  const double rate = std::max(std::sqrt(stiffness + gravity), rate_of_loads(scene));
  if (rate > 0) return 1 / rate;
  const double motion = largest_entry(scene.initial_state.velocity);
  return motion > 0 ? 1 / motion : scene.time.end;
}

/// Refuses a motion until `end` if `end` exceeds 1e15 `time_unit`. The round-off of the time would then be comparable
/// with the unit.
inline std::optional<Refusal> refuses_duration(double end, double time_unit) {
  const double longest = 1e15 * time_unit;
  if (end <= longest) return {};
  return Refusal{"Time/End", fmt::format("expected at most {}, 1e15 of the scene's own unit of time, got {}; "
                                         "beyond that double precision does not resolve the time",
                                         print_upper_bound(longest), print_number(end))};
}

}  // namespace pseudorigid::scene
