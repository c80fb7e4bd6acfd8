#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/models/ball_models.h"
#include "app/polynomial/equilibrium_rows.h"
#include "app/polynomial/run_equilibria.h"
#include "app/run/refuses_method.h"
#include "app/run/run_models.h"
#include "io/trajectory.h"
#include "polynomial/incompressible_body.h"
#include "scene/discretization.h"
#include "scene/models.h"
#include "scene/sector.h"

namespace pseudorigid::app {
namespace {

using scene::Refusal;
using scene::Scene;

/// The line for the user about the degrees and the part of the ball that is computed (scene/sector.h).
std::string polynomial_needed(const Scene& scene) {
  const auto& degrees = scene.polynomial.degrees;
  std::string of_degree = "degree";
  for (const int N : degrees) of_degree += (N == degrees.front() ? " " : ", ") + std::to_string(N);
  if (degrees.empty())
    of_degree = fmt::format("the lowest degree with an estimated error of Q up to {}",
                            scene::print_number(scene.polynomial.tolerance));
  if (scene::is_linear(scene.analysis))
    return fmt::format("polynomial body: {}, the whole ball in all its parities", of_degree);
  if (scene.analysis == scene::Analysis::equilibrium)
    return fmt::format("polynomial body: {}, figures in one octant, small motions of the whole ball", of_degree);
  const scene::Sector sector = scene::sector(scene);
  return fmt::format("polynomial body: {}, {}, one of {} ({})", of_degree, sector.name(), sector.n_images(),
                     sector.reason);
}

/// The degree of the companion run as text; empty if a search chooses the degree. The companion run estimates the error
/// in space of the run with the last degree that the scene lists.
std::optional<std::string> polynomial_companion(const Scene& scene) {
  const auto& degrees = scene.polynomial.degrees;
  return degrees.empty() ? std::nullopt
                         : std::optional(fmt::format("degree {}", scene::companion_degree(degrees.back())));
}

std::string polynomial_skipped(const Scene&) { return "polynomial body: not among Models"; }

/// Name of the files of a run of degree N, if N is not the last degree that the scene lists.
std::string rung(int N) { return fmt::format("polynomial-{}", N); }

/// All possible results of `rung`.
std::vector<std::string> rungs() {
  std::vector<std::string> names;
  for (int N = 1; N < scene::largest_polynomial_degree; ++N) names.push_back(rung(N));
  return names;
}

/// One run for each degree that the scene lists, or a single run if a search chooses the degree. The last run has the
/// name of the model.
std::vector<scene::ModelRun> runs(const Scene& scene) {
  const auto& degrees = scene.polynomial.degrees;
  if (degrees.empty()) return {{"polynomial", "polynomial", true}};
  std::vector<scene::ModelRun> runs;
  for (const int N : degrees)
    runs.push_back({N == degrees.back() ? "polynomial" : rung(N), fmt::format("polynomial N = {}", N)});
  return runs;
}

scene::EquilibriaTable polynomial_equilibria(int) {
  return {
      "equilibria-polynomial",
      "These are figures of polynomial bodies that turn as a whole (Equilibrium/Family), for each degree of the "
      "scene, a row each. With static, they are the figures at rest that are reached as the loads rise from 0. Then "
      "omega3 is 0 and the parameter is the factor of the loads.",
      polynomial_equilibria_columns()};
}

/// Refuses bodies and loads that other models offer but the polynomial model does not offer.
std::optional<Refusal> refuses_body(const Scene& scene) {
  const auto others = scene::names_where(scene, [](const auto& model) { return model.name != "polynomial"; });
  if (scene.body.inertia)
    return Refusal{"Body/Inertia",
                   "a polynomial body is a ball or an ellipsoid with the inertia of its Semi-axes",
                   {{{"Body/Inertia", "auto"}}}};
  if (scene::has_mesh_file(scene))
    return Refusal{"Continuum/Mesh", "a polynomial body is a ball or an ellipsoid; a mesh from a file is", {}, others};
  if (!scene.body.incompressible && loads::present(scene.loads.get<loads::SelfGravity>()))
    return Refusal{
        "Gravity/Constant", "self-gravity of a compressible body, whose density is not uniform, is", {}, others};
  return {};
}

/// Refuses modes and Love numbers if the scene does not set the degree N, or if the body is not a ball. Also refuses
/// modes of several degrees N, and Love numbers of tides of a degree that no polynomial body resolves.
std::optional<Refusal> refuses_modes(const Scene& scene) {
  if (!scene::is_linear(scene.analysis)) return {};
  if (scene.polynomial.degrees.empty())
    return Refusal{"Polynomial/Degree", "auto is offered for motions; for modes give a number, and for Love numbers"};
  if (scene.analysis == scene::Analysis::love_numbers &&
      scene::love_degrees(scene).back() >= scene::largest_polynomial_degree)
    return Refusal{"Love numbers/Degrees", "a polynomial body, whose degree is up to 13, has those of 2 to 12"};
  if (scene.analysis == scene::Analysis::modes && scene.polynomial.degrees.size() != 1)
    return Refusal{"Polynomial/Degree", "modes are those of one body: expected one whole number from 1 to 13"};
  if (scene.body.semi_axes != std::vector<double>{1, 1, 1})
    return Refusal{"Body/Semi-axes", "modes are those of the ball; leave the entry out"};
  return {};
}

/// The first reason to refuse the scene; empty if the model accepts the scene.
std::optional<Refusal> refuses(const Scene& scene) {
  if (auto refusal = refuses_body(scene)) return refusal;
  if (auto refusal = refuses_modes(scene)) return refusal;
  if (auto refusal = refuses_polynomial_equilibria(scene)) return refusal;
  return refuses_motion(scene);
}

}  // namespace

BallModel polynomial_model() {
  using Observables = mechanics::ContinuumObservables;
  return {
      {.name = "polynomial",
       .adjective = "polynomial",
       .documentation =
           "A body whose positions are polynomials of degree N in the reference positions: between the pseudo-rigid "
           "body, N = 1, and the continuum.",
       .discretized = false,
       .has_nonaffine = true,
       .has_modes = true,
       .has_love_numbers = true,
       .has_equilibria = true,
       .equilibria = polynomial_equilibria(0),
       .static_equilibria = polynomial_equilibria,
       .columns = io::documented_columns<Observables>(),
       .rungs = rungs(),
       .runs = runs,
       .header = [](const scene::Quantities& q) { return io::Trajectory<Observables>(q).names(); },
       .companion = polynomial_companion,
       .needed = polynomial_needed,
       .skipped = polynomial_skipped,
       .takes_method = method_can_run<polynomial::IncompressibleBody>,
       .refuses = refuses},
      run_polynomial};
}

}  // namespace pseudorigid::app
