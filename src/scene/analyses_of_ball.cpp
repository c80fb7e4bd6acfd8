#include "scene/analyses_of_ball.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "entries/matrix3.h"
#include "materials/rest_moduli.h"
#include "scene/models.h"
#include "scene/scales.h"

namespace pseudorigid::scene {
namespace {

/// The path of the first entry of a load. A refusal of the load names this entry.
template <class Load>
std::string first_entry(const Load& load) {
  std::string path;
  const auto note = [&](const auto&, const auto&, const About& about) {
    if (path.empty()) path = about.path;
  };
  Load::visit_entries(load, note);
  return path;
}

/// Refuses the first load of the scene that is present and for which `is_refused(load)` is true. The sentence is
/// Load::no_equilibria (loads/load.h).
template <class Predicate>
std::optional<Refusal> refuses_load(const Scene& scene, Predicate&& is_refused) {
  std::optional<Refusal> refusal;
  scene.loads.for_each([&]<class Load>(const Load& load) {
    if (!refusal && loads::present(load) && is_refused(load))
      refusal = Refusal{first_entry(load), std::string(Load::no_equilibria)};
  });
  return refusal;
}

/// Returns the violated requirement of relative equilibria, or nothing. Relative equilibria are known for a ball under
/// loads with an empty Load::no_equilibria, such as self-gravity. A fluid must be incompressible and have self-gravity.
std::optional<Refusal> refuses_relative_equilibrium(const Scene& scene) {
  if (scene.body.inertia || scene.body.semi_axes != std::vector<double>{1, 1, 1})
    return Refusal{"Body/Semi-axes",
                   "relative equilibria are offered for a ball",
                   {{{"Body/Semi-axes", "1, 1, 1"}, {"Body/Inertia", "auto"}}}};
  if (auto refusal = refuses_load(scene, []<class Load>(const Load&) { return !Load::no_equilibria.empty(); })) {
    if (scene.analysis == Analysis::equilibrium) refusal->remedies = {{{"Equilibrium/Family", "static"}}};
    return refusal;
  }
  if (is_fluid(scene) && !scene.body.incompressible)
    return Refusal{"Material/Law",
                   "none has no relative equilibrium if Incompressible = false: nothing resists gravity"};
  if (is_fluid(scene) && !loads::present(scene.loads.get<loads::SelfGravity>()))
    return Refusal{"Gravity/Constant", "a fluid without gravity has no relative equilibrium; give it a constant > 0"};
  return {};
}

/// Returns the violated requirement of equilibria at rest, or nothing. Every model of the scene must be able to compute
/// these equilibria. The loads must have a potential that does not depend on time. A fluid needs self-gravity, a tidal
/// matrix, a traction or, if it is compressible, a pressure. Otherwise it is at rest in every shape. Dissipation does
/// not change the equilibria, but changes the rates of small motions about them.
std::optional<Refusal> refuses_static_equilibria(const Scene& scene) {
  const auto finds = [](const ModelDescription& model) { return model.static_equilibria != nullptr; };
  if (!std::ranges::all_of(models_of(scene), [&](const auto* model) { return finds(*model); }))
    return Refusal{"Equilibrium/Family", "static is", {}, names_where(scene, finds)};
  if (auto refusal = refuses_load(scene, []<class Load>(const Load&) {
        if constexpr (requires { Load::has_static_equilibria; }) return !Load::has_static_equilibria;
        return loads::DependsOnTime<Load>;
      }))
    return refusal;
  const loads::Forcing forcing = loads::constant_forcing(scene.loads);
  const bool shaped = forcing.gravity_constant != 0 || !forcing.quadratic.isZero(0) ||
                      !forcing.nominal_traction.isZero(0) || (forcing.pressure != 0 && !scene.body.incompressible);
  if (is_fluid(scene) && !shaped)
    return Refusal{"Material/Law", "a fluid on which nothing acts rests in every shape; give it gravity or a load"};
  return {};
}

std::optional<Refusal> refuses_equilibria(const Scene& scene) {
  if (!std::ranges::all_of(models_of(scene), &ModelDescription::has_equilibria))
    return Refusal{"Analysis", "equilibrium is", {}, names_where(scene, &ModelDescription::has_equilibria)};
  return finds_static_equilibria(scene) ? refuses_static_equilibria(scene) : refuses_relative_equilibrium(scene);
}

/// Refuses initial states and loads that modes and Love numbers ignore. Both analyses compute small displacements of
/// the undeformed ball from rest, without loads other than self-gravity. Also refuses a compressible ball whose law has
/// a stress at Id, because such a ball does not remain undeformed. `what` is the name of the analysis in messages.
std::optional<Refusal> refuses_displaced_start(const Scene& scene, std::string_view what) {
  const auto& state = scene.initial_state;
  const std::string start =
      fmt::format("{} are about small displacements from rest, Q0 = 1; leave the entry out", what);
  if (state.equilibrium != Family::none) return Refusal{"Initial state/Equilibrium", start};
  if (state.deformation != identity3) return Refusal{"Initial state/Deformation", start};
  if (largest_entry(state.velocity) != 0) return Refusal{"Initial state/Velocity", start};
  if (!scene.body.incompressible && materials::pressure_at_rest(law_of(scene)) != 0)
    return Refusal{"Material/Law", fmt::format("{} is stressed at rest, so a compressible ball does not stay there and "
                                               "has no {} about rest",
                                               scene.material.law, what)};
  const std::vector<double> origin{0, 0, 0};
  const std::string moved = fmt::format("{} are those of a ball at rest in the origin; leave the entry out", what);
  if (state.center != origin) return Refusal{"Initial state/Center", moved};
  if (state.center_velocity != origin) return Refusal{"Initial state/Center velocity", moved};
  std::optional<Refusal> refusal;
  scene.loads.for_each([&]<class Load>(const Load& load) {
    if constexpr (!std::is_same_v<Load, loads::SelfGravity>)
      if (!refusal && loads::present(load))
        refusal = Refusal{first_entry(load), fmt::format("{} are those of the ball alone, at most with self-gravity; "
                                                         "leave the entry out",
                                                         what)};
  });
  return refusal;
}

/// Refuses a scene for which the program does not compute modes or Love numbers. Such a scene has a mesh from a file, a
/// fluid, a symmetry other than the octant or `auto`, or an initial state or load that refuses_displaced_start refuses.
/// The function also refuses a scene without a model that offers the analysis. `is_offered` is the member of
/// ModelDescription that is true for a model with this analysis. `what` is the name of the analysis in messages.
std::optional<Refusal> refuses_linear_analysis(const Scene& scene, std::string_view what,
                                               bool ModelDescription::*is_offered) {
  if (has_mesh_file(scene))
    return Refusal{"Continuum/Mesh", fmt::format("{} are those of the ball", what), {{{"Continuum/Mesh", "builtin"}}}};
  if (std::ranges::none_of(models_of(scene), is_offered))
    return Refusal{"Analysis", fmt::format("{} are", what), {}, names_where(scene, is_offered)};
  if (auto refusal = refuses_displaced_start(scene, what)) return refusal;
  if (scene.continuum.symmetry != Symmetry::automatic && scene.continuum.symmetry != Symmetry::octant)
    return Refusal{"Continuum/Symmetry",
                   fmt::format("{} are computed on one octant, with every choice of signs at its planes", what),
                   {{{"Continuum/Symmetry", "auto"}}}};
  if (is_fluid(scene))
    return Refusal{"Material/Law",
                   fmt::format("{} are those of an elastic ball: in a fluid nothing resists inner motions", what)};
  return {};
}

std::optional<Refusal> refuses_modes(const Scene& scene) {
  return refuses_linear_analysis(scene, "modes", &ModelDescription::has_modes);
}

std::optional<Refusal> refuses_love_numbers(const Scene& scene) {
  if (!scene.body.incompressible)
    return Refusal{"Body/Incompressible",
                   "Love numbers are those of an incompressible ball, whose density stays uniform",
                   {{{"Body/Incompressible", "true"}}}};
  if (!loads::present(scene.loads.get<loads::SelfGravity>()))
    return Refusal{"Gravity/Constant",
                   "Love numbers compare displacements with V/g of self-gravity; give it or Gravity/Gamma a value > 0"};
  if (scene.body.semi_axes != std::vector<double>{1, 1, 1} || scene.body.inertia)
    return Refusal{"Body/Semi-axes",
                   "Love numbers are those of a ball",
                   {{{"Body/Semi-axes", "1, 1, 1"}, {"Body/Inertia", "auto"}}}};
  if (scene.output.graphics != Graphics::none)
    return Refusal{"Output/Graphics", "Love numbers are a table without pictures", {{{"Output/Graphics", "none"}}}};
  return refuses_linear_analysis(scene, "Love numbers", &ModelDescription::has_love_numbers);
}

}  // namespace

std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene) {
  if (scene.analysis == Analysis::equilibrium)
    if (auto refusal = refuses_equilibria(scene)) return refusal;
  // The initial state of every analysis may be a member of a family.
  if (scene.initial_state.equilibrium != Family::none)
    if (auto refusal = refuses_relative_equilibrium(scene)) return refusal;
  if (scene.analysis == Analysis::modes) return refuses_modes(scene);
  return scene.analysis == Analysis::love_numbers ? refuses_love_numbers(scene) : std::nullopt;
}

std::optional<Refusal> refuses_vibration(const Scene& scene) {
  if (!scene.output.quantities.vibration || scene.analysis != Analysis::motion) return {};
  const std::string_view reason = "the energy of vibration by degree is that of an incompressible elastic ball";
  if (!scene.body.incompressible)
    return Refusal{"Body/Incompressible", std::string(reason), {{{"Body/Incompressible", "true"}}}};
  if (is_fluid(scene)) return Refusal{"Material/Law", fmt::format("{}, and a fluid has no elastic energy", reason)};
  if (scene.body.semi_axes != std::vector<double>{1, 1, 1} || scene.body.inertia)
    return Refusal{"Body/Semi-axes", std::string(reason), {{{"Body/Semi-axes", "1, 1, 1"}, {"Body/Inertia", "auto"}}}};
  if (has_mesh_file(scene)) return Refusal{"Continuum/Mesh", std::string(reason), {{{"Continuum/Mesh", "builtin"}}}};
  if (loads::present(scene.loads.get<loads::SelfGravity>()))
    return Refusal{"Gravity/Constant", fmt::format("{} without self-gravity", reason), {{{"Gravity/Constant", "0"}}}};
  if (loads::present(scene.loads.get<loads::Viscoelasticity>()))
    return Refusal{"Material/Branch moduli", fmt::format("{} without viscoelastic branches", reason)};
  return {};
}

}  // namespace pseudorigid::scene
