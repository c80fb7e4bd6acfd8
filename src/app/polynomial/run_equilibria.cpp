#include "app/polynomial/run_equilibria.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/polynomial/body_setup.h"
#include "app/polynomial/equilibrium_rows.h"
#include "app/reduced/ball_equilibria.h"
#include "io/column_table.h"
#include "reduced/equilibrium_families.h"
#include "scene/choices.h"
#include "scene/models.h"

namespace pseudorigid::app {
namespace {

using polynomial::Figure;
using polynomial::FigureCondition;
using polynomial::FigureParameter;
using scene::Family;

/// True for the families of figures that rotate as a rigid body. Polynomial bodies have only these families.
bool is_offered(Family family) {
  return family == Family::maclaurin || family == Family::spheroids || family == Family::spinning ||
         family == Family::jacobi;
}

/// ln(a₂/a₁) for a member of Jacobi's family, or −1e-5 if the logarithm is smaller in magnitude. At a₂ = a₁ the family
/// bifurcates from the spheroids, and the ratio does not determine the figure. Near this point the figure is an even
/// function of the logarithm, because a change of sign exchanges the axes. The replacement therefore changes the spin
/// and the axes by terms of order 1e-10.
double log_ratio_of_axes(double a2_to_a1) {
  constexpr double apart = 1e-5;
  const double value = std::log(a2_to_a1);
  return std::abs(value) < apart ? -apart : value;
}

/// The family of the scene for RotationFinder. It maps a value of the parameter, in the unit of the family, to a
/// condition on the figure. For Jacobi's family, the pseudo-rigid figure is the initial guess.
polynomial::FamilyOfRotations family_of(const scene::Scene& scene) {
  const double time_unit = units_of(scene).time;
  switch (scene.equilibria.family) {
    case Family::maclaurin:
      return {Figure::spheroid, [](double e) -> FigureCondition {
                return {FigureParameter::log_ratio_31, 0.5 * std::log((1 - e) * (1 + e))};
              }};
    case Family::spheroids:
      return {Figure::spheroid, [](double polar_axis) -> FigureCondition {
                return {FigureParameter::log_ratio_31, 1.5 * std::log(polar_axis)};
              }};
    case Family::spinning:
      return {Figure::spheroid, [time_unit](double spin) -> FigureCondition {
                return {FigureParameter::spin_squared, spin * time_unit * spin * time_unit};
              }};
    default:
      return {Figure::ellipsoid,
              [](double ratio) -> FigureCondition {
                return {FigureParameter::log_ratio_21, log_ratio_of_axes(ratio)};
              },
              [&scene](double ratio, polynomial::NearbyFigure& nearby) {
                reduced::SteadyMotion m;
                const double nearly = std::exp(log_ratio_of_axes(ratio));
                auto status = figure_of_family(scene, Family::jacobi, nearly, m);
                nearby = {m.A.diagonal(), m.omega.squaredNorm()};
                return status;
              }};
  }
}

/// The values of the parameter that the scene requests.
std::vector<double> parameters_of(const scene::Scene::Equilibria& asked) {
  const reduced::ParameterRange range{asked.first, asked.last, asked.number};
  std::vector<double> values;
  for (int k = 0; k < asked.number; ++k) values.push_back(range.value(k));
  return values;
}

/// The run of all degrees, and its table and results.
class EquilibriaRun {
 public:
  explicit EquilibriaRun(const RunContext& context)
      : context_(context),
        table_(context.directory.csv("equilibria-polynomial"), polynomial_equilibria_columns(), context.scales()) {}

  ModelOutcome run() {
    for (const int degree : context_.scene.polynomial.degrees) {
      add_degree(degree);
      if (outcome_.end != mechanics::Outcome::finished) break;
    }
    table_.flush();
    auto& counters = outcome_.statistics.counters;
    auto& timers = outcome_.statistics.timers;
    counters["equilibria"] = n_members_;
    counters["special_points"] = n_special_;
    timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (outcome_.end == mechanics::Outcome::finished && n_members_ == 0)
      end(mechanics::Outcome::failed, "the family has no member in this range");
    return outcome_;
  }

 private:
  /// Sets the outcome and its message.
  void end(mechanics::Outcome how, std::string message) {
    outcome_.end = how;
    outcome_.message = std::move(message);
  }

  /// Computes the family of one degree, and writes its rows and results. After an interrupt, writes the figures found
  /// so far.
  void add_degree(int degree) {
    const scene::Scene& scene = context_.scene;
    const polynomial::BodySetup setup = body_setup(scene, {}, degree);
    const polynomial::FamilyOfRotations described = family_of(scene);
    polynomial::RotationFinder finder(setup, scene.body.incompressible, described);
    const polynomial::RotationFamily family =
        finder.family(parameters_of(scene.equilibria), [&] { return context_.interrupted(); });
    const std::string name = parameter_name(scene.equilibria.family);
    for (const auto& missing : family.missing)
      context_.log->warn("no equilibrium of degree {} at {} = {:.9g}: {}", degree, name, missing.parameter,
                         missing.reason);
    write(family, EquilibriumRows(setup, scene.body.incompressible, finder.spectrum()));
    report(degree, family, described.figure, name);
    const auto n_values = static_cast<int>(family.members.size() + family.missing.size());
    if (n_values < scene.equilibria.number && outcome_.end == mechanics::Outcome::finished)
      end(mechanics::Outcome::interrupted,
          fmt::format("equilibria interrupted after {} of {} values of {} of degree {}; those before are in "
                      "equilibria-polynomial.csv",
                      n_values, scene.equilibria.number, name, degree));
  }

  /// Writes the members and the special points of a family by rising parameter.
  void write(const polynomial::RotationFamily& family, const EquilibriumRows& rows) {
    std::vector<std::pair<const polynomial::RotationMember*, const polynomial::SpecialRotation*>> sorted;
    for (const auto& member : family.members) sorted.emplace_back(&member, nullptr);
    for (const auto& special : family.special) sorted.emplace_back(&special.member, &special);
    std::ranges::stable_sort(sorted, {}, [](const auto& entry) { return entry.first->parameter; });
    for (const auto& [member, special] : sorted) {
      std::vector<double> row;
      if (const auto status = rows.row(++index_, *member, special, row); !status)
        return end(mechanics::Outcome::failed, status.reason());
      table_.append(row);
    }
  }

  /// Adds the lines about a degree to the results.
  void report(int degree, const polynomial::RotationFamily& family, Figure figure, const std::string& name) {
    const auto n_stable = std::ranges::count_if(
        family.members, [](const polynomial::RotationMember& member) { return !fastest_growing(member); });
    add_result(outcome_, context_,
               fmt::format("degree {}: {} equilibria, {} of them stable", degree, family.members.size(), n_stable));
    for (const auto& special : family.special)
      add_result(outcome_, context_,
                 fmt::format("  {} at {} = {:.10g} ({})", mechanics::name_of(special.kind), name,
                             special.member.parameter, app::name_of(special.motions, figure)));
    n_members_ += static_cast<double>(family.members.size());
    n_special_ += static_cast<double>(family.special.size());
  }

  const RunContext& context_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  io::ColumnTable table_;
  ModelOutcome outcome_;
  int index_ = 0;
  double n_members_ = 0, n_special_ = 0;
};

}  // namespace

std::optional<scene::Refusal> refuses_polynomial_equilibria(const scene::Scene& scene) {
  if (scene.analysis != scene::Analysis::equilibrium) return {};
  if (!is_offered(scene.equilibria.family))
    return scene::Refusal{
        "Equilibrium/Family",
        fmt::format("polynomial bodies take maclaurin, spheroids, spinning and jacobi; {}, whose figures have "
                    "circulation within, is",
                    scene::family_kind.print(scene.equilibria.family)),
        {},
        scene::names_where(scene, [](const auto& model) { return model.name != "polynomial"; })};
  if (scene.polynomial.degrees.empty())
    return scene::Refusal{"Polynomial/Degree",
                          "equilibria are those of named degrees: expected whole numbers from 1 to 13, as 1, 3, 5"};
  return {};
}

ModelOutcome run_polynomial_equilibria(const RunContext& context) { return EquilibriaRun(context).run(); }

}  // namespace pseudorigid::app
