#include <fmt/format.h>

#include <string>

#include "app/figures/continuum_figure_columns.h"
#include "app/models/ball_models.h"
#include "app/reduced/reduced_scene.h"
#include "app/run/refuses_method.h"
#include "io/trajectory.h"
#include "scene/discretization.h"
#include "scene/models.h"
#include "scene/scales.h"
#include "scene/sector.h"
#include "scene/stabilization.h"

namespace pseudorigid::app {
namespace {

using scene::Family;
using scene::Refusal;
using scene::Scene;

/// The line for the user about the mesh, the discretisation and the part of the ball that is computed (scene/sector.h).
std::string continuum_needed(const Scene& scene) {
  const auto found = [](const std::optional<int>& value) { return value ? std::to_string(*value) : "auto"; };
  const auto fixed = scene::fixed_discretization(scene);
  const scene::Sector sector = scene::sector(scene);
  return fmt::format("continuum: finite elements on the {}, {}",
                     scene::has_mesh_file(scene) ? "mesh " + scene.continuum.mesh : "builtin mesh",
                     fixed
                         ? scene::describe(*fixed)
                         : fmt::format("degree {}, refinements {}: the cheapest with an estimated error of Q up to {}",
                                       found(scene.continuum.degree), found(scene.continuum.refinements),
                                       scene::print_number(scene.continuum.tolerance))) +
         (scene.analysis != scene::Analysis::motion ? ", one octant in all its parities"
          : scene::has_mesh_file(scene)
              ? ", the whole body"
              : fmt::format(", {}, one of {} ({})", sector.name(), sector.n_images(), sector.reason));
}

/// The discretisation of the companion run as text; empty if a search chooses the discretisation. The companion run
/// estimates the error in space.
std::optional<std::string> continuum_companion(const Scene& scene) {
  const auto fixed = scene::fixed_discretization(scene);
  return fixed ? std::optional(scene::describe(scene::companion(*fixed))) : std::nullopt;
}

std::string continuum_skipped(const Scene&) { return "continuum: not among Models; no mesh, no deal.II, MPI or PETSc"; }

/// Refuses modes, Love numbers and equilibria if the scene does not set degree and refinements, or if the mesh is
/// graded. Also refuses Love numbers of tides of a degree that the mesh does not resolve.
std::optional<Refusal> refuses_modes(const Scene& scene) {
  if (scene.analysis == scene::Analysis::motion) return {};
  if (!scene::fixed_discretization(scene))
    return Refusal{scene.continuum.degree ? "Continuum/Refinements" : "Continuum/Degree",
                   "auto is offered for motions; for modes give a number, and for Love numbers and equilibria (their "
                   "tables have an error of the mesh)"};
  if (scene.analysis == scene::Analysis::love_numbers &&
      scene::love_degrees(scene).back() > scene::resolved_degree(scene))
    return Refusal{"Love numbers/Degrees",
                   fmt::format("a mesh of degree k, refined r times, resolves tides up to the degree k 2^r = {}; raise "
                               "Continuum/Degree or Continuum/Refinements",
                               scene::resolved_degree(scene))};
  if (scene.continuum.grading != 1)
    return Refusal{"Continuum/Grading",
                   "modes, Love numbers and equilibria are computed on the even mesh",
                   {{{"Continuum/Grading", "1"}}}};
  return {};
}

/// Refuses families, meshes, bodies and loads whose equilibria the finite-element model cannot compute. The function
/// applies to the analysis of equilibria and to a motion that starts from a figure of the model. For the analysis, the
/// function also refuses dissipation, and values of Continuum/Symmetry other than auto and octant. The model computes
/// figures on one octant only, so the reflection of every axis must be a symmetry of the loads. The symmetry planes of
/// the octant exclude rigid motions of the body.
std::optional<Refusal> refuses_equilibria(const Scene& scene) {
  if (!needs_own_figures(scene)) return {};
  if (auto refusal =
          refuses_family(scene, "finite elements",
                         {Family::maclaurin, Family::spheroids, Family::spinning, Family::jacobi, Family::at_rest}))
    return refusal;
  if (scene::has_mesh_file(scene))
    return Refusal{"Continuum/Mesh", "equilibria are those of the ball", {{{"Continuum/Mesh", "builtin"}}}};
  if (scene::is_fluid(scene))
    return Refusal{"Material/Law",
                   "an equilibrium of a fluid, in which nothing resists inner motions, is",
                   {},
                   scene::names_where(scene, [](const auto& model) { return !model.discretized; })};
  if (scene.analysis == scene::Analysis::motion) {
    if (scene.continuum.grading == 1) return {};
    return Refusal{"Continuum/Grading", "figures are computed on the even mesh", {{{"Continuum/Grading", "1"}}}};
  }
  if (scene.continuum.symmetry != scene::Symmetry::automatic && scene.continuum.symmetry != scene::Symmetry::octant)
    return Refusal{"Continuum/Symmetry",
                   "equilibria of finite elements are computed on one octant",
                   {{{"Continuum/Symmetry", "auto"}}}};
  return refuses_loads_at_rest(scene, "finite elements");
}

/// Refuses degree 1 for an incompressible body and for a mesh file. For a mesh file, also refuses a grading and
/// symmetry planes.
std::optional<Refusal> refuses_discretization(const Scene& scene) {
  if (scene.body.incompressible && scene.continuum.degree == 1)
    return Refusal{"Continuum/Degree", "expected a whole number from 2 to 8 for an incompressible body, got 1"};
  if (!scene::has_mesh_file(scene)) return {};
  if (scene.continuum.grading != 1)
    return Refusal{"Continuum/Grading", "a mesh from a file is taken as it is", {{{"Continuum/Grading", "1"}}}};
  if (scene.continuum.degree == 1)
    return Refusal{"Continuum/Degree", "expected a whole number from 2 to 8 for a mesh from a file, got 1"};
  if (scene.continuum.symmetry != scene::Symmetry::automatic && scene.continuum.symmetry != scene::Symmetry::none)
    return Refusal{"Continuum/Symmetry", "a mesh from a file is the whole body", {{{"Continuum/Symmetry", "auto"}}}};
  return {};
}

/// True if self-gravity or a positive definite tidal matrix acts. Such a load can keep the pressure in a fluid
/// positive.
bool is_held_together(const Scene& scene) {
  return loads::present(scene.loads.get<loads::SelfGravity>()) || scene::is_confined(scene);
}

/// Refuses bodies and loads that other models offer but the finite-element model does not offer. Also refuses an ideal
/// fluid without volumetric stiffness, because no other force limits the distortion of its elements.
std::optional<Refusal> refuses_body(const Scene& scene) {
  const auto offered_for_others = [&](const char* path, const char* what) {
    return Refusal{path, fmt::format("{} is", what), {}, scene::names_where(scene, [](const auto& model) {
                     return !model.discretized;
                   })};
  };
  if (scene::is_fluid(scene) && !scene.body.incompressible)
    return offered_for_others("Material/Law", "none, where nothing resists a change of volume,");
  if (scene::is_ideal_fluid(scene) && !is_held_together(scene))
    return offered_for_others("Material/Law",
                              "a fluid with neither self-gravity nor a positive definite Loads/Tidal matrix");
  if (scene::is_ideal_fluid(scene) && scene::volumetric_stiffness(scene) == 0)
    return Refusal{"Continuum/Volumetric stiffness",
                   "expected a number > 0 for a fluid: nothing else holds its elements; or auto"};
  const bool builtin = !scene::has_mesh_file(scene);
  if (builtin && scene.body.semi_axes != std::vector<double>{1, 1, 1})
    return offered_for_others("Body/Semi-axes", "a reference body that is not a ball");
  if (builtin && scene.body.inertia)
    return offered_for_others("Body/Inertia", "an inertia other than that of the ball");
  if (!scene.body.incompressible && loads::present(scene.loads.get<loads::SelfGravity>()))
    return offered_for_others("Gravity/Constant", "self-gravity of a compressible body, whose density is not uniform,");
  return {};
}

/// Refuses a symmetry plane of Continuum/Symmetry that the motion does not preserve.
std::optional<Refusal> refuses_symmetry(const Scene& scene) {
  const auto planes = scene::planes_of(scene.continuum.symmetry);
  for (int i = 0; i < 3; ++i) {
    if (!planes[i]) continue;
    const auto broken = scene::breaks_plane(scene, i);
    if (!broken) continue;
    return Refusal{"Continuum/Symmetry",
                   fmt::format("the plane with normal {} is no symmetry plane of this motion, as {}",
                               scene::axis_names[i], *broken),
                   {{{"Continuum/Symmetry", "auto"}}}};
  }
  return {};
}

/// The first reason to refuse the scene; empty if the model accepts the scene.
std::optional<Refusal> refuses(const Scene& scene) {
  for (const auto judge :
       {refuses_discretization, refuses_modes, refuses_equilibria, refuses_body, refuses_symmetry, refuses_motion})
    if (auto refusal = judge(scene)) return refusal;
  return {};
}

/// True for "auto" and for the methods that the finite-element model can use. These are the methods of the
/// incompressible pseudo-rigid body that accept any type of vector.
bool continuum_takes_method(std::string_view name) {
  const auto id = mechanics::find_method(name);
  return method_can_run<ElasticBody<true>>(name) &&
         (!id || mechanics::with_method(*id, []<class Method>(Method) { return mechanics::takes_any_vector<Method>; }));
}

/// The table of figures. Its columns do not depend on the number of degrees of freedom, which other models need.
scene::EquilibriaTable continuum_equilibria(int) {
  return {"equilibria-continuum",
          "These are figures of the finite-element ball that turn as a whole (Equilibrium/Family), a row each. With "
          "static, it is the figure at rest under the loads that is reached as they rise from 0; omega3 is then 0 and "
          "the parameter is the factor of the loads.",
          continuum_figure_columns()};
}

}  // namespace

BallModel continuum_model() {
  using Observables = mechanics::ContinuumObservables;
  return {{.name = "continuum",
           .adjective = "elastic",
           .documentation = "Finite elements, with a pressure that preserves volume if the body is incompressible: the "
                            "ball itself, to the error of its mesh.",
           .by_default = true,
           .discretized = true,
           .has_nonaffine = true,
           .has_modes = true,
           .has_love_numbers = true,
           .has_equilibria = true,
           .equilibria = continuum_equilibria(1),
           .static_equilibria = continuum_equilibria,
           .columns = io::documented_columns<Observables>(),
           .header = [](const scene::Quantities& q) { return io::Trajectory<Observables>(q).names(); },
           .companion = continuum_companion,
           .needed = continuum_needed,
           .skipped = continuum_skipped,
           .takes_method = continuum_takes_method,
           .refuses = refuses},
          nullptr};
}

}  // namespace pseudorigid::app
