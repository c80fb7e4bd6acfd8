#include "app/figures/figure_families.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "app/ranks/on_all_ranks.h"
#include "app/reduced/ball_equilibria.h"
#include "app/run/scene_to_model.h"
#include "reduced/equilibrium_families.h"
#include "scene/choices.h"
#include "scene/sector.h"

namespace pseudorigid::app {
namespace {

using mechanics::ClassStability, mechanics::Figure, mechanics::FigureCondition, mechanics::FigureMember;
using mechanics::FigureParameter;
using scene::Family;

/// ln(a₂/a₁) of the semi-axes a₁ and a₂ of a member of Jacobi's family, or −1e-5 if the logarithm is smaller in
/// magnitude. The family bifurcates from the spheroids at a₂ = a₁, and the ratio a₂/a₁ does not determine the figure
/// there. Near this point the figure is an even function of the logarithm, because a change of sign exchanges the axes.
/// The replacement therefore changes the spin and the axes by terms of order 1e-10.
double log_ratio_of_axes(double a2_to_a1) {
  constexpr double apart = 1e-5;
  const double value = std::log(a2_to_a1);
  return std::abs(value) < apart ? -apart : value;
}

/// The number of directions in which the second variation of the energy of a figure is negative, added over all classes
/// of small motions.
int negative_directions(const FigureMember& member) {
  int n = 0;
  for (const ClassStability& of_class : member.classes) n += of_class.stability.n_negative;
  return n;
}

/// The indices of the columns that the table of the scene has.
std::vector<std::size_t> kept_columns(const scene::Scene& scene, const std::vector<scene::Column>& columns) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (has_figure_column(scene, columns[i].name)) kept.push_back(i);
  return kept;
}

template <class T>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<std::size_t>& indices) {
  std::vector<T> result;
  for (const std::size_t i : indices) result.push_back(all[i]);
  return result;
}

}  // namespace

bool needs_own_figures(const scene::Scene& scene) {
  // After the equilibrium has been replaced by explicit values, its family has been checked.
  return scene.analysis == scene::Analysis::equilibrium ||
         (scene::starts_from_own_figure(scene) && scene.initial_state.equilibrium != Family::none);
}

std::optional<scene::Refusal> refuses_family(const scene::Scene& scene, std::string_view model,
                                             const std::vector<Family>& offered) {
  const bool is_of_start = scene.analysis != scene::Analysis::equilibrium;
  const Family family = is_of_start ? scene.initial_state.equilibrium : scene.equilibria.family;
  if (std::ranges::find(offered, family) != offered.end()) return {};
  std::string names;
  for (const Family one : offered)
    if (!is_of_start || one != Family::at_rest)  // no motion starts from a figure at rest
      names += (names.empty() ? "" : ", ") + scene::family_kind.print(one);
  return scene::Refusal{is_of_start ? "Initial state/Equilibrium" : "Equilibrium/Family",
                        fmt::format("{} take {}; {} is", model, names, scene::family_kind.print(family)),
                        {},
                        affine_models(scene)};
}

std::vector<std::string_view> affine_models(const scene::Scene& scene) {
  return scene::names_where(scene, [](const auto& model) { return !model.has_nonaffine; });
}

std::optional<scene::Refusal> refuses_loads_at_rest(const scene::Scene& scene, std::string_view model) {
  const loads::Forcing forcing = loads::constant_forcing(scene.loads);
  const bool finds_motions = scene.analysis != scene::Analysis::equilibrium || scene.equilibria.small_motions;
  if (finds_motions && (forcing.viscosity > 0 || forcing.drag > 0)) {
    const char* entry = forcing.viscosity > 0 ? "Material/Viscosity" : "Material/Drag";
    return scene::Refusal{entry,
                          fmt::format("small motions about equilibria of {} are those without dissipation; the "
                                      "equilibria do not depend on it",
                                      model),
                          {{{entry, "0"}}}};
  }
  if (!scene::finds_static_equilibria(scene)) return {};
  scene::Scene with_loads = scene;  // equilibria do not depend on the initial state
  with_loads.initial_state = {};
  for (int i = 0; i < 3; ++i)
    if (const auto broken = scene::breaks_plane(with_loads, i))
      return scene::Refusal{
          "Equilibrium/Family",
          fmt::format("static, under loads for which the plane with normal {} is no symmetry plane, as {}, is",
                      scene::axis_names[i], *broken),
          {},
          affine_models(scene)};
  return {};
}

std::string name_of(const mechanics::MotionClass& motions, Figure figure) {
  const char* in_z = motions.odd_in_z ? "odd" : "even";
  if (figure == Figure::spheroid) return fmt::format("{} in z, m = {}", in_z, motions.m);
  return fmt::format("{} in z, {} under the half turn", in_z, motions.m == 0 ? "even" : "odd");
}

mechanics::FamilyOfFigures family_of_figures(const scene::Scene& scene, Family family) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();  // no figure has this parameter
  const double time_unit = units_of(scene).time;
  switch (family) {
    case Family::maclaurin:
      return {Figure::spheroid, [](double e) -> FigureCondition {
                return {FigureParameter::log_ratio_31, e < 0 ? none : 0.5 * std::log((1 - e) * (1 + e))};
              }};
    case Family::spheroids:
      return {Figure::spheroid, [](double polar_axis) -> FigureCondition {
                return {FigureParameter::log_ratio_31, 1.5 * std::log(polar_axis)};
              }};
    case Family::spinning:
      return {Figure::spheroid, [time_unit](double spin) -> FigureCondition {
                return {FigureParameter::drive, spin < 0 ? none : spin * time_unit * spin * time_unit};
              }};
    case Family::at_rest:
      return {Figure::ellipsoid, [](double factor) -> FigureCondition { return {FigureParameter::drive, factor}; }};
    default:
      return {Figure::ellipsoid,
              [](double ratio) -> FigureCondition {
                return {FigureParameter::log_ratio_21, log_ratio_of_axes(ratio)};
              },
              [&scene](double& ratio_of_spheroid) {
                reduced::SteadyMotion m;
                auto status = figure_of_family(scene, Family::jacobi, std::exp(log_ratio_of_axes(1)), m);
                ratio_of_spheroid = m.A(2, 2) / m.A(0, 0);
                return status;
              }};
  }
}

bool has_figure_column(const scene::Scene& scene, std::string_view name) {
  constexpr std::array of_small_motions{"growth_rate", "stable", "n_negative", "odd_in_z", "m", "rates_error"};
  const bool is_of_small_motions =
      name.starts_with("rate_") || std::ranges::find(of_small_motions, name) != of_small_motions.end();
  if (is_of_small_motions && !scene.equilibria.small_motions) return false;
  return !name.ends_with("_error") || scene.continuum.error_estimate == scene::ErrorEstimate::automatic;
}

std::vector<double> parameters_of(const scene::Scene::Equilibria& asked) {
  const reduced::ParameterRange range{asked.first, asked.last, asked.number};
  std::vector<double> values;
  for (int k = 0; k < asked.number; ++k) values.push_back(range.value(k));
  return values;
}

const ClassStability* fastest_growing(const FigureMember& member) {
  const ClassStability* fastest = nullptr;
  for (const ClassStability& of_class : member.classes)
    if (of_class.stability.growth_rate > (fastest ? fastest->stability.growth_rate : 0)) fastest = &of_class;
  return fastest;
}

std::vector<RateOfClass> rates_by_frequency(const FigureMember& member) {
  double largest = 0;
  std::vector<RateOfClass> upper;  // Im s > 0, or s real
  for (const ClassStability& of_class : member.classes)
    for (const mechanics::Rate& rate : of_class.stability.rates) largest = std::max(largest, std::abs(rate.s));
  const double round_off = 1e-9 * largest;
  for (std::size_t k = 0; k < member.classes.size(); ++k)
    for (const mechanics::Rate& rate : member.classes[k].stability.rates)
      if (rate.s.imag() > -round_off) upper.push_back({rate.s, k});
  std::ranges::sort(upper, [&](const RateOfClass& a, const RateOfClass& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() > b.s.real();
  });
  std::vector<RateOfClass> rates;
  for (const RateOfClass& rate : upper) {
    rates.push_back(rate);
    if (rate.s.imag() > round_off) rates.push_back({std::conj(rate.s), rate.of_class});
  }
  return rates;
}

std::vector<std::complex<double>> slowest_rates(const FigureMember& member) {
  std::vector<std::complex<double>> rates;
  for (const RateOfClass& rate : rates_by_frequency(member)) rates.push_back(rate.s);
  rates.resize(n_slowest_rates);  // missing rates are 0
  return rates;
}

std::vector<scene::Column> figure_columns(std::string_view degree, std::string_view m) {
  std::vector<scene::Column> columns{
      {"index", "", "number of the row: degree by degree, by rising parameter"},
      {"degree", "", degree},
      {"kind", "",
       "0: a member of the family. Special points between two members: 1 fold (its spin has an extremum), 3 index "
       "(n_negative changes: a branch may leave, and dissipation decides), 4 instability (a growth rate begins or "
       "ends)"},
      {"parameter", "",
       "parameter of the family: eccentricity (maclaurin), a3 in radii at volume 1 (spheroids), spin [1/time] "
       "(spinning), a2/a1 (jacobi), factor of the loads (static). For spheroids it follows from a3/a1."},
      {"omega3", "1/time", "rate at which the figure turns about its axis 3"}};
  const auto vector = [&](const char* name, scene::Unit unit, const char* documentation) {
    for (int i = 1; i <= 3; ++i)
      columns.push_back({fmt::format("{}{}", name, i), unit, i == 1 ? documentation : "as for axis 1"});
  };
  vector("a", "length", "semi-axis along axis 1 of the ellipsoid x = Q X nearest in the mean");
  vector("surface", "length", "point at which the surface cuts axis 1");
  columns.insert(
      columns.end(),
      {{"kinetic", "mass*length^2/time^2", "kinetic energy"},
       {"potential", "mass*length^2/time^2", "potential energy"},
       {"energy", "mass*length^2/time^2", "their sum"},
       {"J3", "mass*length^2/time", "angular momentum"},
       {"Z3", "mass*length^2/time", "circulation"},
       {"multiplier", "1/time^2", "integral of the pressure per m_bar: the multiplier of the pseudo-rigid body"},
       {"nonaffine_displacement", "", "|x - Q X| / |x|, norms weighted with the mass"},
       {"min_jacobian", "", "least det F at the integration points"},
       {"growth_rate", "1/time", "largest real part of the rates; 0 if stable"},
       {"stable", "", "1: no disturbance grows; to first order, among the motions of this degree"},
       {"n_negative", "",
        "negative directions of the energy at fixed J and Z if the loads keep them, of a fluid at fixed circulations; "
        "0: stable even with dissipation"},
       {"odd_in_z", "",
        "of the motions in which a special point happens, or that grow fastest: 1 if odd under the reflection of axis "
        "3, otherwise 0; -1 if none grows"},
       {"m", "", m}});
  for (std::size_t k = 1; k <= n_slowest_rates; ++k) {
    columns.push_back(
        {fmt::format("rate_{}_re", k), "1/time",
         k > 1 ? "as for rate_1_re"
               : "real part of a rate s of small motions exp(s t) in the turning frame: the slowest, by rising "
                 "frequency, 0 beyond the last. Turns and exchanges of matter within a fluid are left out"});
    columns.push_back({fmt::format("rate_{}_im", k), "1/time", k > 1 ? "as for rate_1_im" : "its imaginary part"});
  }
  columns.push_back({"residual", "",
                     "residual of the equations of the figure, in their largest term; for a fluid the error of the "
                     "quadrature of gravity"});
  return columns;
}

std::vector<double> figure_row(int index, const FigureMember& member, const mechanics::SpecialFigure* special,
                               const FigureNumbers& numbers) {
  const mechanics::ContinuumObservables& o = numbers.observables;
  std::vector<double> row{static_cast<double>(index), static_cast<double>(numbers.degree),
                          special ? 1.0 + static_cast<int>(special->kind) : 0.0, member.parameter, numbers.spin};
  row.insert(row.end(), numbers.axes.begin(), numbers.axes.end());
  row.insert(row.end(), numbers.surface.begin(), numbers.surface.end());
  const ClassStability* growing = fastest_growing(member);
  std::optional<mechanics::MotionClass> motions;
  if (special)
    motions = special->motions;
  else if (growing)
    motions = growing->motions;
  row.insert(
      row.end(),
      {o.kinetic, o.energy() - o.kinetic, o.energy(), o.angular_momentum[2], o.circulation[2], o.multiplier,
       o.nonaffine_displacement, o.min_jacobian, growing ? growing->stability.growth_rate : 0.0, growing ? 0.0 : 1.0,
       static_cast<double>(negative_directions(member)), motions ? static_cast<double>(motions->odd_in_z) : -1.0,
       motions ? static_cast<double>(motions->m) : -1.0});
  for (const auto& s : slowest_rates(member)) row.insert(row.end(), {s.real(), s.imag()});
  row.push_back(member.figure.residual);
  return row;
}

FigureRun::FigureRun(const RunContext& context, std::string_view file, const std::vector<scene::Column>& columns,
                     std::size_t n_families)
    : context_(context),
      file_(file),
      parameter_(parameter_name(context.scene.equilibria.family)),
      is_row_(context.tables && context.ranks->is_first()),
      n_families_(static_cast<double>(n_families)),
      progress_(file_, context.shows_progress && !context.tables, "figures"),
      checkpoint_(context, file_),
      kept_(kept_columns(context.scene, columns)) {
  on_all_ranks(*context.ranks, [&] { table_.emplace(table_of(context, file_, chosen(columns, kept_))); });
}

void FigureRun::end(mechanics::Outcome how, std::string message) {
  outcome_.end = how;
  outcome_.is_over = how == mechanics::Outcome::failed;
  outcome_.message = std::move(message);
}

void FigureRun::add(const std::string& of_degree, const mechanics::FigureFamily& family, const NameOfClass& name_of,
                    const RowOf& row_of) {
  for (const auto& missing : family.missing) {
    const std::string sentence =
        fmt::format("{}: {}: {}", of_degree, missing_in_words(family, missing), missing.reason);
    context_.log->warn("{}", sentence);
    if (reason_.empty()) reason_ = sentence;
  }
  for (const double parameter : family.without_special)
    context_.log->warn(
        "{}: the number of negative directions changes before {} = {:.9g}, but its special point was not "
        "located",
        of_degree, parameter_, parameter);
  // A row of a sweep has the figure under the full loads, or none.
  if (!is_row_ || family.missing.empty()) on_all_ranks(*context_.ranks, [&] { write(family, row_of); });
  const auto n_stable =
      std::ranges::count_if(family.members, [](const FigureMember& member) { return !fastest_growing(member); });
  add_result(outcome_, context_,
             fmt::format("{}: {} equilibria{}", of_degree, family.members.size(),
                         context_.scene.equilibria.small_motions ? fmt::format(", {} of them stable", n_stable) : ""));
  for (const auto& special : family.special)
    add_result(outcome_, context_,
               fmt::format("  {} at {} = {:.10g} ({})", mechanics::name_of(special.kind), parameter_,
                           special.member.parameter, name_of(special.motions)));
  n_members_ += static_cast<double>(family.members.size());
  n_special_ += static_cast<double>(family.special.size());
  const auto n_values = static_cast<int>(family.members.size() + family.missing.size());
  const bool is_at_rest = scene::finds_static_equilibria(context_.scene);
  const int n_wanted = is_at_rest ? 1 : context_.scene.equilibria.number;
  if (n_values < n_wanted && goes_on() && context_.interrupted())
    end(mechanics::Outcome::interrupted,
        fmt::format("equilibria interrupted after {} of {} values of {} of {}; those before are in {}.csv", n_values,
                    n_wanted, parameter_, of_degree, file_));
}

/// The beginning of the sentence about a figure that was not found.
std::string FigureRun::missing_in_words(const mechanics::FigureFamily& family,
                                        const mechanics::NoFigure& missing) const {
  if (!scene::finds_static_equilibria(context_.scene))
    return fmt::format("no equilibrium at {} = {:.9g}", parameter_, missing.parameter);
  if (family.members.empty()) return "no equilibrium at rest was found";
  return fmt::format("no equilibrium at rest was found beyond {:.6g} of the loads{}", family.members.front().parameter,
                     is_row_ ? "" : fmt::format(", whose figure is in {}.csv", file_));
}

void FigureRun::write(const mechanics::FigureFamily& family, const RowOf& row_of) {
  std::vector<std::pair<const FigureMember*, const mechanics::SpecialFigure*>> sorted;
  for (const auto& member : family.members) sorted.emplace_back(&member, nullptr);
  for (const auto& special : family.special) sorted.emplace_back(&special.member, &special);
  std::ranges::stable_sort(sorted, {}, [](const auto& entry) { return entry.first->parameter; });
  for (const auto& [member, special] : sorted) {
    std::vector<double> row;
    if (const auto status = row_of(++index_, *member, special, row); !status)
      return end(mechanics::Outcome::failed, status.reason());
    table_->append(chosen(row, kept_));
  }
}

ModelOutcome FigureRun::finish() {
  progress_.finish();
  on_all_ranks(*context_.ranks, [&] { table_->flush(); });
  auto& counters = outcome_.statistics.counters;
  counters["equilibria"] = n_members_;
  counters["special_points"] = n_special_;
  outcome_.statistics.timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const bool each_is_needed = is_row_ || scene::finds_static_equilibria(context_.scene);
  if (goes_on() && each_is_needed && !reason_.empty()) end(mechanics::Outcome::failed, reason_);
  if (goes_on() && n_members_ == 0)
    end(mechanics::Outcome::failed, "the family has no member in this range: " + reason_);
  return outcome_;
}

}  // namespace pseudorigid::app
