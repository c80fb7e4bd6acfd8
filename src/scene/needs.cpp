#include "scene/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "scene/bulk.h"
#include "scene/contact.h"
#include "scene/discretization.h"
#include "scene/entries.h"
#include "scene/models.h"
#include "scene/scale_numbers.h"
#include "scene/scales.h"
#include "scene/stabilization.h"

namespace pseudorigid::scene {
namespace {

/// Adds the line `needed` to the list of needed parts if `wanted` is true. Otherwise adds the line `skipped` to the
/// list of skipped parts.
void sort_out(Needs& needs, bool wanted, std::string needed, std::string skipped) {
  if (wanted)
    needs.needed.push_back(std::move(needed));
  else
    needs.skipped.push_back(std::move(skipped));
}

/// Adds a line about the estimate of the discretisation error, and sets `needs.companion`. The estimate is for the
/// reference, which is the last model. If a search chooses the discretisation, the search estimates this error.
/// Otherwise a companion run estimates the error if there is a comparison. For finite elements, Continuum/Error
/// estimate must also be auto. Does nothing if the reference has no such error or the analysis is not a motion.
void describe_error_estimate(const Scene& scene, Needs& needs) {
  const ModelDescription& richest = *needs.models.back();
  if (!richest.companion || scene.analysis != Analysis::motion) return;
  const auto companion = richest.companion(scene);
  if (!companion) return needs.needed.push_back("discretisation error: estimated by runs on coarser discretisations");
  const bool asked = !richest.discretized || scene.continuum.error_estimate == ErrorEstimate::automatic;
  needs.companion = needs.comparison && asked;
  sort_out(needs, needs.companion, fmt::format("discretisation error: estimated by a companion run ({})", *companion),
           asked ? "discretisation error: a scene without a comparison does not need it"
                 : "discretisation error: Continuum/Error estimate is none; no companion run");
}

/// Adds a line about the volumetric stabilisation. Requests the column `volumetric` if the stiffness is positive and
/// the scene writes energies. Modes and Love numbers do not write energies. Does nothing if the body is compressible or
/// if all models have only affine motions.
void describe_stabilization(const Scene& scene, Needs& needs) {
  if (!needs.pressure_space) return;
  const bool has_elements =
      std::ranges::any_of(needs.models, [](const ModelDescription* model) { return model->discretized; });
  const double kappa = has_elements ? volumetric_stiffness_of_elements(scene) : volumetric_stiffness(scene);
  needs.quantities.volumetric = kappa > 0 && needs.quantities.energies && !is_linear(scene.analysis);
  sort_out(needs, kappa > 0,
           fmt::format("volumetric stabilisation: kappa = {:.3g}{}", kappa,
                       needs.quantities.volumetric ? ", its energy in the column volumetric" : ""),
           scene.continuum.volumetric_stiffness ? "volumetric stabilisation: Continuum/Volumetric stiffness is 0"
                                                : "volumetric stabilisation: neither self-gravity nor a confining "
                                                  "tidal matrix nor a violent start of elements");
}

/// The number of runs, summed over all models.
std::size_t n_runs_of_models(const Scene& scene, const Needs& needs) {
  std::size_t n = 0;
  for (const ModelDescription* model : needs.models) n += runs_of(*model, scene).size();
  return n;
}

/// Properties of the body that the descriptions of the loads use. One of them is the ratio 3V/tr E₀. For an ellipsoid
/// with the density ρ, the volume V and the semi-axes a_i in radii r, tr E₀ = ρVr²(a₁² + a₂² + a₃²)/5. Here E₀ = ∫ρXXᵀ
/// dV is the second moment. If the scene sets Body/Inertia, E₀ is this matrix.
loads::BodyFacts facts_of_body(const Scene& scene) {
  const auto& [radius, density, incompressible, a, inertia] = scene.body;
  const double volume = 4 * std::numbers::pi / 3 * radius * radius * radius * a[0] * a[1] * a[2];
  const double ellipsoid = density * volume * radius * radius * (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) / 5;
  const double trace = inertia ? (*inertia)[0][0] + (*inertia)[1][1] + (*inertia)[2][2] : ellipsoid;
  return {.incompressible = incompressible, .volume_by_inertia = 3 * volume / trace};
}

void describe_models(const Scene& scene, Needs& needs) {
  for (const ModelDescription& model : catalogue_of(scene).models)
    if (std::ranges::find(needs.models, &model) != needs.models.end())
      needs.needed.push_back(model.needed(scene));
    else
      needs.skipped.push_back(model.skipped(scene));
  sort_out(needs, needs.constraint, "constraint: volume is preserved, det Q = 1 with its multiplier",
           "constraint: the body is compressible");
  if (needs.discretized)
    sort_out(needs, needs.pressure_space,
             fmt::format("pressure space: {}{}",
                         scene.continuum.degree ? fmt::format("degree {}", *scene.continuum.degree - 1)
                                                : "one degree less than the displacement",
                         needs.constraint ? ", volume preserved everywhere" : ""),
             "pressure space: the body is compressible");
  if (!scene.body.incompressible && std::ranges::any_of(needs.models, &ModelDescription::has_nonaffine))
    sort_out(needs, needs.pressure_space, "bulk term: of ln det F on the pressure space, implicit in time",
             "projection of the bulk term: it is pointwise (Material/Bulk)");
  describe_stabilization(scene, needs);
  const loads::BodyFacts facts = facts_of_body(scene);
  scene.loads.for_each([&]<class L>(const L& load) {
    if (!L::skipped.empty()) sort_out(needs, loads::present(load), load.needed(facts), std::string(L::skipped));
  });
  sort_out(needs, loads::constant_forcing(scene.loads).dissipative(), "dissipation, and the energy that it takes",
           "dissipation: neither viscosity nor drag nor branches");
  sort_out(needs, needs.comparison,
           needs.models.size() == 2 && n_runs_of_models(scene, needs) == 2
               ? "comparison of the two models"
               : fmt::format("comparison of {} runs with the last", n_runs_of_models(scene, needs) - 1),
           scene.analysis == Analysis::motion
               ? "comparison: only one model runs"
               : fmt::format("comparison: Analysis is {}", analysis_kind.print(scene.analysis)));
  describe_error_estimate(scene, needs);
  if (needs.quadrature_error)
    needs.needed.push_back("error of the quadrature of polynomial bodies: estimated by pilot runs with another rule");
}

void describe_output(const Scene& scene, Needs& needs) {
  if (is_linear(scene.analysis)) {
    needs.skipped.push_back("time loop, initial state and observables: only small displacements about rest are found");
    sort_out(needs, needs.graphics, fmt::format("graphics: up to {} shapes (vtu)", scene.output.frames),
             "graphics: Output/Graphics is none; no folder is made");
    return;
  }
  const bool finds_figures = scene.analysis == Analysis::equilibrium || starts_from_own_figure(scene);
  if (finds_figures && needs.discretized)
    needs.needed.push_back("tangent stiffness of finite elements: Newton's iteration, GMRES with V-cycles");
  else
    needs.skipped.push_back(
        fmt::format("tangent stiffness and preconditioners for it: every method is explicit in the elastic force{}",
                    needs.pressure_space && !needs.constraint ? " but for the bulk term" : ""));
  if (scene.analysis == Analysis::equilibrium && needs.discretized)
    sort_out(needs, scene.continuum.error_estimate == ErrorEstimate::automatic,
             "error of the elements: figures on a second mesh",
             "error of the elements: Continuum/Error estimate is none; no second mesh");
  if (scene.analysis == Analysis::equilibrium && std::ranges::any_of(needs.models, &ModelDescription::has_nonaffine))
    sort_out(needs, scene.equilibria.small_motions,
             "small motions about each figure: an eigenvalue problem for each class",
             "small motions about figures: Equilibrium/Small motions is false; no rates, no stability");
  std::vector<std::string_view> evaluated, unwanted;
  for (std::size_t i = 0; i < quantities_kind.table.size(); ++i) {
    const auto& [name, member] = quantities_kind.table[i];
    if (needs.quantities.*member)
      evaluated.push_back(name);
    else if (i < quantities_kind.n_in_all && (needs.orbit || member != &Quantities::orbit))
      unwanted.push_back(name);
  }
  const auto nonaffine = names_where(scene, [](const auto& model) { return model.has_nonaffine; });
  if (!evaluated.empty()) needs.needed.push_back("quantities: " + joined(evaluated));
  if (!unwanted.empty())
    needs.skipped.push_back("quantities: " + joined(unwanted) + " (not among Output/Quantities" +
                            (std::ranges::any_of(needs.models, &ModelDescription::has_nonaffine)
                                 ? ")"
                                 : fmt::format(", or of {} only)", the_models(nonaffine))));
  sort_out(needs, needs.graphics, fmt::format("graphics: {} frames (vtu)", scene.output.frames),
           "graphics: Output/Graphics is none; no folder is made");
}

/// The warning about the law for a compressible or an incompressible body, or nothing if the law does not have one.
std::optional<std::string> warning_of_law(const Scene& scene) {
  const materials::NamedLaw& law = materials::find_law(scene.material.law);
  const std::string_view warning = scene.body.incompressible ? law.warning_incompressible : law.warning_compressible;
  if (warning.empty()) return std::nullopt;
  return fmt::format("Material/Law: {}", warning);
}

void describe_report(const Scene& scene, Needs& needs) {
  needs.report = scene.output.report;
  std::vector<std::string_view> with_shapes;
  for (const ModelDescription* model : needs.models)
    if (model->has_nonaffine) with_shapes.push_back(model->name);
  sort_out(needs, needs.report,
           with_shapes.empty() || scene.analysis != Analysis::motion || !scene.sweep.empty()
               ? "report: report.html"
               : fmt::format("report: report.html, and for it shapes of {}", the_models(with_shapes)),
           "report: Output/Report is false");
}

std::string list(const char* title, const std::vector<std::string>& lines) {
  std::string text = std::string(title) + "\n";
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

void describe_system(const SystemDescription& system, const Scene& scene, Needs& needs) {
  needs.needed.push_back(fmt::format("{}: {}", system.name, system.documentation));
  needs.skipped.push_back("ball: another system moves; no mesh, no deal.II, MPI or PETSc");
  const bool manifolds = scene.analysis == Analysis::manifolds;
  sort_out(needs, manifolds || scene.analysis == Analysis::equilibrium,
           "critical points of the potential (equilibria.csv)",
           fmt::format("critical points: Analysis is {}", analysis_kind.print(scene.analysis)));
  if (manifolds)
    needs.needed.push_back("unstable and stable manifolds of the critical points (manifolds.csv, connections.csv)");
  if (scene.analysis == Analysis::section)
    needs.needed.push_back(
        fmt::format("section: {} = {} (section.csv)", scene.section.column, print_number(scene.section.value)));
  needs.skipped.push_back("graphics: offered for the ball");
}

}  // namespace

Needs needs(const Scene& scene) {
  Needs needs;
  if (!scene.sweep.empty())
    needs.needed.push_back(
        fmt::format("sweep: {} runs, {}", n_runs(scene.sweep), SweepParameters{}.print(scene.sweep)));
  if (const SystemDescription* system = catalogue_of(scene).system(scene.system)) {
    needs.system = system;
    describe_system(*system, scene, needs);
    describe_report(scene, needs);
    return needs;
  }
  const bool modes = scene.analysis == Analysis::modes;
  for (const ModelDescription* model : models_of(scene))
    if (offers(*model, scene.analysis)) needs.models.push_back(model);
  needs.discretized = std::ranges::any_of(needs.models, &ModelDescription::discretized);
  needs.constraint = scene.body.incompressible;
  needs.pressure_space = std::ranges::any_of(needs.models, &ModelDescription::has_nonaffine) &&
                         (scene.body.incompressible || projects_bulk(scene));
  needs.comparison = n_runs_of_models(scene, needs) > 1 && scene.analysis == Analysis::motion;
  needs.graphics = scene.output.graphics != Graphics::none;
  needs.quantities = scene.output.quantities;
  needs.contact = loads::present(scene.loads.get<loads::RigidPlanes>());
  const auto n_companions = scene.loads.get<loads::CompanionMasses>().masses.size();
  needs.orbit = n_companions > 0;
  needs.quantities.orbit = needs.quantities.orbit && needs.orbit && scene.analysis == Analysis::motion;
  needs.quantities.second_orbit = needs.quantities.orbit && n_companions > 1;
  needs.quantities.branches = needs.quantities.energies && loads::present(scene.loads.get<loads::Viscoelasticity>()) &&
                              scene.analysis == Analysis::motion;
  needs.quantities.contact = needs.contact && scene.analysis == Analysis::motion;
  const bool nonaffine = std::ranges::any_of(needs.models, &ModelDescription::has_nonaffine);
  needs.quantities.nonaffine = needs.quantities.nonaffine && nonaffine;
  needs.surface_watch = needs.discretized && needs.constraint;
  needs.quadrature_error =
      scene.analysis == Analysis::motion && (scene.sweep.empty() || needs.comparison) &&
      std::ranges::any_of(needs.models, [](const ModelDescription* m) { return m->has_nonaffine && !m->discretized; });
  if (nonaffine) needs.sector = sector(scene);
  describe_models(scene, needs);
  sort_out(needs, scene.analysis == Analysis::equilibrium,
           finds_static_equilibria(scene)
               ? "equilibria at rest (equilibria.csv; of other models equilibria-polynomial.csv and "
                 "equilibria-continuum.csv)"
               : fmt::format("relative equilibria: {} of the family {}", scene.equilibria.number,
                             family_kind.print(scene.equilibria.family)),
           fmt::format("relative equilibria: Analysis is {}", analysis_kind.print(scene.analysis)));
  sort_out(needs, modes,
           fmt::format("modes: the {} lowest frequencies about rest, of all eight parities at the planes of the octant",
                       scene.modes.number),
           fmt::format("modes: Analysis is {}; no eigenvalue solver", analysis_kind.print(scene.analysis)));
  sort_out(needs, scene.analysis == Analysis::love_numbers,
           fmt::format("Love numbers: {} degrees of the tide, up to {}", love_degrees(scene).size(),
                       love_degrees(scene).back()),
           fmt::format("Love numbers: Analysis is {}", analysis_kind.print(scene.analysis)));
  describe_output(scene, needs);
  describe_report(scene, needs);
  if (const auto contact = meshed_contact(scene); contact && scene.analysis == Analysis::motion) {
    needs.needed.push_back(contact->line());
    if (auto warning = contact->warning(); !warning.empty()) needs.warnings.push_back(std::move(warning));
  }
  if (auto warning = warning_of_law(scene)) needs.warnings.push_back(*std::move(warning));
  if (auto warning = warning_of_locking(scene)) needs.warnings.push_back(*std::move(warning));
  for (std::string& warning : unit_warnings(scene)) needs.warnings.push_back(std::move(warning));
  return needs;
}

namespace {
/// The part of the summary about the least and the largest ratio γ of self-gravity to elasticity. The text is empty
/// without self-gravity.
std::string gravity_in_words(const std::pair<double, double>& gammas) {
  const auto [least, largest] = gammas;
  if (largest == 0) return {};
  return least == largest ? fmt::format(", self-gravity gamma = {:.4g}", least)
                          : fmt::format(", self-gravity gamma = {:.4g} to {:.4g}", least, largest);
}
}  // namespace

std::string summary(const Scene& scene, const Needs& needs) {
  const bool moves = scene.analysis == Analysis::motion || scene.analysis == Analysis::section;
  const std::string end = moves ? ", until time " + print_number(scene.time.end) : "";
  if (needs.system) return fmt::format("{} of the {}{}", analysis_kind.print(scene.analysis), scene.system, end);
  return fmt::format("{} of {} ball of radius {}, density {}, {}{}{}", analysis_kind.print(scene.analysis),
                     scene.body.incompressible ? "an incompressible" : "a compressible",
                     print_number(scene.body.radius), print_number(scene.body.density),
                     is_fluid(scene) ? "fluid" : "shear modulus " + print_number(scene.material.shear_modulus),
                     gravity_in_words(needs.gammas.value_or(std::pair(gamma_of(scene), gamma_of(scene)))), end);
}

std::string describe(const Scene& scene, const Needs& needs) {
  std::string text = (scene.title.empty() ? "" : scene.title + "\n") + summary(scene, needs) + "\n";
  if (!needs.system) text += list(scene.sweep.empty() ? "Scales:" : "Scales of the first run:", scale_lines(scene));
  text += list("Needed:", needs.needed) + list("Skipped:", needs.skipped);
  if (!needs.expected.empty()) text += list("Expected:", needs.expected);
  return needs.warnings.empty() ? text : text + list("Warnings:", needs.warnings);
}

}  // namespace pseudorigid::scene
