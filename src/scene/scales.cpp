#include "scene/scales.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "entries/matrix3.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

materials::AnyLaw law_of(const Scene& scene) {
  return materials::make_law(scene.material.law, scene.material, scene.body.incompressible);
}

bool is_fluid(const Scene& scene) { return materials::is_fluid(law_of(scene)); }

bool is_ideal_fluid(const Scene& scene) {
  return is_fluid(scene) && !loads::present(scene.loads.get<loads::Viscoelasticity>());
}

bool is_free(const Scene& scene) {
  loads::Loads acting = scene.loads;
  acting.get<loads::Rise>() = {};
  return !loads::any_present(acting);
}

bool loads_rise(const Scene& scene) {
  const auto is_present = [](const loads::Forcing& forcing) { return forcing.present(); };
  return loads::present(scene.loads.get<loads::Rise>()) && loads::depend_on_time(scene.loads, is_present);
}

double rate_of_loads(const Scene& scene) {
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

double time_scale(const Scene& scene) {
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

std::optional<Refusal> refuses_duration(double end, double time_unit) {
  const double longest = 1e15 * time_unit;
  if (end <= longest) return {};
  return Refusal{"Time/End", fmt::format("expected at most {}, 1e15 of the scene's own unit of time, got {}; "
                                         "beyond that double precision does not resolve the time",
                                         print_upper_bound(longest), print_number(end))};
}

}  // namespace pseudorigid::scene
