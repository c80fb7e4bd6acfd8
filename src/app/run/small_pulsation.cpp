#include "app/run/small_pulsation.h"

#include <algorithm>
#include <cmath>

#include "analysis/sphere_frequencies.h"
#include "app/run/scene_to_model.h"
#include "materials/rest_moduli.h"
#include "scene/discretization.h"
#include "scene/scales.h"

namespace pseudorigid::app {
namespace {

bool is_sphere(const scene::Scene& scene) {
  const auto is_one = [](double a) { return a == 1; };
  return !scene.body.inertia && std::ranges::all_of(scene.body.semi_axes, is_one) && !scene::has_mesh_file(scene);
}

/// True if F = Id is an equilibrium without loads, with the deformation gradient F. This holds if the law has no
/// pressure at F = Id. It also holds for an incompressible body, whose multiplier balances this pressure.
bool rests(const materials::AnyLaw& law, bool incompressible) {
  return incompressible || materials::pressure_at_rest(law) == 0;
}

}  // namespace

std::optional<SmallPulsation> small_pulsation(const scene::Scene& scene) {
  loads::Loads others = scene.loads;
  others.get<loads::SelfGravity>() = {};
  others.get<loads::Rise>() = {};
  if (!is_sphere(scene) || scene::is_fluid(scene) || loads::any_present(others)) return {};
  const bool incompressible = scene.body.incompressible;
  const materials::AnyLaw law = internal_law(scene);
  if (!rests(law, incompressible)) return {};
  const materials::RestModuli moduli = materials::moduli_at_rest(law, incompressible);
  const double gamma = gravity_to_elasticity(scene);
  constexpr double largest_gamma = 18;
  if (gamma > largest_gamma || (!incompressible && gamma > 0)) return {};  // gravity compresses a compressible ball
  const double exact = incompressible ? analysis::sphere_frequency(true, 2, 0, gamma)
                                      : analysis::compressible_sphere_frequency(
                                            true, 2, 0, std::sqrt(moduli.shear / (moduli.lame + 2 * moduli.shear)));
  return SmallPulsation{exact, std::sqrt(10 + 0.8 * gamma)};
}

}  // namespace pseudorigid::app
