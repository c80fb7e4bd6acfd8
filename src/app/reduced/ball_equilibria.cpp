#include "app/reduced/ball_equilibria.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <string>
#include <string_view>

#include "app/reduced/reduced_scene.h"
#include "app/run/scene_to_model.h"
#include "io/column_table.h"
#include "mechanics/equilibria/small_motion.h"
#include "reduced/equilibrium_families.h"
#include "scene/entries.h"
#include "scene/initial_state.h"
#include "scene/models.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

using reduced::EquilibriumFamily;
using reduced::EquilibriumPoint;
using scene::Family;

/// Computes the families of a scene. The potential is a member of the object, because the body refers to the potential.
class FamilyMaker {
 public:
  explicit FamilyMaker(const scene::Scene& scene)
      : scene_(reduced_scene(scene)),
        potential_(potential_of(scene_)),
        body_{potential_, scene_.body.E0.trace() / 3, scene.body.incompressible} {}

  /// Computes a family; `none` and `at_rest` give an empty family. `range` is the range of the parameter of the family.
  /// If the parameter is a spin, it has the user's unit in `range` and in the result. The internal unit of time,
  /// measured in the user's unit, is `time_unit`. `ratio` is a₃/a₁ of the semi-axes, which only Riemann's families use.
  EquilibriumFamily make(Family family, reduced::ParameterRange range, double ratio, double time_unit) const {
    switch (family) {
      case Family::none:
      case Family::at_rest:
        break;
      case Family::maclaurin:
        return reduced::spheroids(body_, reduced::SpheroidParameter::eccentricity, range);
      case Family::spheroids:
        return reduced::spheroids(body_, reduced::SpheroidParameter::polar_axis, range);
      case Family::spinning: {
        range.first *= time_unit;
        range.last *= time_unit;
        EquilibriumFamily found = reduced::spheroids_of_spin(body_, range);
        for (EquilibriumPoint& point : found.points) point.parameter /= time_unit;
        for (auto& special : found.special) special.point.parameter /= time_unit;
        for (auto& missing : found.missing) missing.parameter /= time_unit;
        return found;
      }
      case Family::jacobi:
        return reduced::jacobi(body_, range);
      case Family::dedekind:
        return reduced::dedekind(body_, range);
      case Family::riemann_s:
      case Family::riemann_s_dual:
        return reduced::type_s(body_, range, ratio, family == Family::riemann_s_dual);
      case Family::riemann_planar:
      case Family::riemann_planar_dual:
        return reduced::planar(body_, range, ratio, family == Family::riemann_planar_dual);
    }
    return {};
  }

  /// Sets `motion` to the small motion Re(H exp(st)) about a figure whose rate s is nearest to `rate`, in internal
  /// units. `motion.shape` has the entries of the matrix H, column by column (add_motion below). Fails if the motion is
  /// not found.
  mechanics::Status small_motion(const reduced::SteadyMotion& figure, std::complex<double> rate,
                                 mechanics::SmallMotion& motion) const {
    const reduced::SmallMotionEquation of = reduced::linearisation(body_, figure);
    auto status = mechanics::motion_near(of.K, of.G, rate, motion);
    motion.shape = of.T * motion.shape;
    return status;
  }
  /// The second moment ∫ρX₁² dX of the ball, divided by its mass.
  double moment_by_mass() const { return body_.m_bar / scene_.body.volume; }

 private:
  ReducedScene scene_;
  reduced::Potential potential_;
  reduced::IsotropicBody<reduced::Potential> body_;
};

/// Number of rates in a row. An incompressible spheroid has 10 rates, and any other incompressible figure has 8.
/// Missing rates are 0. A compressible figure has two more rates; a row then omits the fastest two rates of a spheroid.
constexpr int most_rates = 10;

/// The rates of a figure by rising frequency. Of two conjugate rates, the one with the positive frequency is first.
std::vector<mechanics::Rate> rates_of_point(const EquilibriumPoint& p) {
  auto rates = p.stability.rates;
  std::sort(rates.begin(), rates.end(), [](const auto& a, const auto& b) {
    return std::abs(a.s.imag()) != std::abs(b.s.imag()) ? std::abs(a.s.imag()) < std::abs(b.s.imag())
                                                        : a.s.imag() > b.s.imag();
  });
  return rates;
}

enum Kind { member = 0 };  // column `kind` of an ordinary member; a special point has 1 + SpecialKind

/// The row of a figure in the order of ball_equilibria_columns(). All values are in internal units except the
/// parameter, which has the unit of its family. A ratio that is not defined is replaced by 0.
std::vector<double> equilibria_row(int index, int kind, const EquilibriumPoint& p) {
  const reduced::SteadyMotion& m = p.motion;
  std::vector<double> row{static_cast<double>(index), static_cast<double>(kind), p.parameter};
  const auto add = [&](const Eigen::Vector3d& v) { row.insert(row.end(), {v[0], v[1], v[2]}); };
  add(m.omega);
  add(m.Lambda);
  add(p.semi_axes);
  row.insert(row.end(), {p.kinetic, p.potential, p.energy()});
  add(p.angular_momentum);
  add(p.circulation);
  row.push_back(m.lambda);
  add(p.vorticity);
  row.insert(row.end(), {p.vorticity_ratio(), p.stability.growth_rate, p.stability.stable ? 1.0 : 0.0,
                         static_cast<double>(p.stability.n_negative)});
  const auto rates = rates_of_point(p);
  for (std::size_t k = 0; k < most_rates; ++k)
    row.insert(row.end(), {k < rates.size() ? rates[k].s.real() : 0, k < rates.size() ? rates[k].s.imag() : 0});
  row.push_back(p.residual);
  for (double& value : row)
    if (!std::isfinite(value)) value = 0;  // a ratio that is not defined
  return row;
}

/// Writes the members and the special points of the family into equilibria.csv, by increasing parameter.
void write_family(const EquilibriumFamily& family, const RunContext& context) {
  std::vector<std::pair<int, const EquilibriumPoint*>> rows;
  for (const EquilibriumPoint& point : family.points) rows.emplace_back(member, &point);
  for (const auto& special : family.special) rows.emplace_back(1 + static_cast<int>(special.kind), &special.point);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.second->parameter < b.second->parameter; });
  io::ColumnTable table = table_of(context, "equilibria", ball_equilibria_columns());
  int index = 0;
  for (const auto& [kind, point] : rows) table.append(equilibria_row(++index, kind, *point));
  table.flush();
}

}  // namespace

std::string parameter_name(Family family) {
  switch (family) {
    case Family::maclaurin:
      return "e";
    case Family::spheroids:
      return "a3/r";
    case Family::spinning:
      return "spin";
    case Family::at_rest:
      return "factor of the loads";
    default:
      return "a2/a1";
  }
}

std::vector<scene::Column> ball_equilibria_columns() {
  std::vector<scene::Column> columns{
      {"index", "", "number of the row, by rising parameter"},
      {"kind", "",
       "0: a member of the family. Special points between two members: 1 fold (its spin or circulation has an "
       "extremum), 3 index (n_negative changes: a branch may leave, and dissipation decides), 4 instability (a growth "
       "rate begins or ends)"},
      {"parameter", "",
       "the family's: eccentricity (maclaurin), a3 in radii (spheroids), spin [1/time] (spinning), a2/a1 of the "
       "others"}};
  const auto vector = [&](const char* name, scene::Unit unit, const char* documentation) {
    for (int i = 1; i <= 3; ++i)
      columns.push_back({fmt::format("{}{}", name, i), unit, i == 1 ? documentation : "as for axis 1"});
  };
  vector("omega", "1/time", "rate at which the figure turns in space, along its axis 1");
  vector("Lambda", "1/time", "rate of the motion within, Q(t) = exp(t omega^) diag(a) exp(-t Lambda^), along axis 1");
  vector("a", "length", "semi-axis along axis 1");
  columns.insert(columns.end(), {{"kinetic", "mass*length^2/time^2", "kinetic energy"},
                                 {"potential", "mass*length^2/time^2", "potential energy"},
                                 {"energy", "mass*length^2/time^2", "their sum"}});
  vector("J", "mass*length^2/time", "angular momentum");
  vector("Z", "mass*length^2/time", "circulation");
  columns.push_back({"multiplier", "1/time^2", "multiplier per m_bar"});
  vector("zeta", "1/time", "vorticity of the motion within, seen from the figure");
  columns.insert(
      columns.end(),
      {{"f", "", "zeta3/omega3, Riemann's ratio; 0 if the figure does not turn about axis 3"},
       {"growth_rate", "1/time", "largest real part of the rates; 0 if stable"},
       {"stable", "", "1: no disturbance grows; to first order, among affine ones"},
       {"n_negative", "", "negative directions of the energy at fixed J and Z; 0: stable even with dissipation"}});
  for (int k = 1; k <= most_rates; ++k) {
    columns.push_back(
        {fmt::format("rate_{}_re", k), "1/time",
         k > 1 ? "as for rate_1_re"
               : "real part of a rate s of small motions exp(s t) in the turning frame, those of turns left "
                 "out; by rising frequency, 0 beyond the last"});
    columns.push_back({fmt::format("rate_{}_im", k), "1/time", k > 1 ? "as for rate_1_im" : "its imaginary part"});
  }
  columns.push_back({"residual", "", "residual of the equations of the steady motion, in their largest term"});
  return columns;
}

ModelOutcome run_ball_equilibria(const RunContext& context) {
  const scene::Scene::Equilibria& asked = context.scene.equilibria;
  const FamilyMaker maker(context.scene);
  const EquilibriumFamily family =
      maker.make(asked.family, {asked.first, asked.last, asked.number, [&] { return context.interrupted(); }},
                 asked.ratio, context.units.time);
  ModelOutcome outcome;
  const std::string name = parameter_name(asked.family);
  for (const auto& missing : family.missing)
    context.log->warn("no equilibrium at {} = {:.9g}: {}", name, missing.parameter, missing.reason);
  const auto n_values = static_cast<int>(family.points.size() + family.missing.size());
  const bool interrupted = n_values < asked.number;
  if (family.points.empty() && !interrupted) {
    outcome.end = mechanics::Outcome::failed;
    outcome.message = fmt::format("the family has no member in this range: {}",
                                  family.missing.empty() ? "it is empty" : family.missing.front().reason);
    return outcome;
  }
  write_family(family, context);
  const auto n_stable = std::count_if(family.points.begin(), family.points.end(),
                                      [](const EquilibriumPoint& p) { return p.stability.stable; });
  add_result(outcome, context, fmt::format("{} equilibria, {} of them stable", family.points.size(), n_stable));
  for (const auto& special : family.special)
    add_result(outcome, context,
               fmt::format("  {} at {} = {:.10g}", mechanics::name_of(special.kind), name, special.point.parameter));
  outcome.statistics.counters["equilibria"] = static_cast<double>(family.points.size());
  outcome.statistics.counters["special_points"] = static_cast<double>(family.special.size());
  if (interrupted) {
    outcome.end = mechanics::Outcome::interrupted;
    outcome.message =
        fmt::format("equilibria interrupted after {} of {} values of {}; those before are in equilibria.csv", n_values,
                    asked.number, name);
  }
  return outcome;
}

namespace {

/// Sets `point` to the member of the family with this parameter. Fails if there is no such member.
mechanics::Status find_member(const FamilyMaker& maker, const scene::Scene& scene, Family family, double parameter,
                              EquilibriumPoint& point) {
  const EquilibriumFamily found =
      maker.make(family, {parameter, parameter, 1}, scene.equilibria.ratio, units_of(scene).time);
  if (found.points.empty())
    return mechanics::Status::failure(found.missing.empty() ? "the family is empty" : found.missing.front().reason);
  point = found.points.front();
  return {};
}

/// The matrix in the form of scene entries.
scene::Matrix3 entries_of(const Eigen::Matrix3d& A) {
  scene::Matrix3 entries;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) entries[i][j] = A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return entries;
}

/// A with the entries set to 0 that are round-off of numbers of the given size. Symmetry planes require exact zeros.
template <class Matrix>
Matrix without_round_off(const Matrix& A, double size) {
  return A.unaryExpr([&](double entry) { return std::abs(entry) <= 1e-14 * size ? 0 : entry; });
}

/// Deformation Q and its rate, in internal units.
struct Start {
  Eigen::Matrix3d Q, Qdot;
};

/// Sets `start` to the start from a figure with the scene's small motion Re(H exp(st)) at t = 0,
///
///   Q = A + Re H,   Q̇ = ω̂Q − QΛ̂ + Re(sH),
///
/// with the constants A, ω and Λ of the figure. If the body is incompressible, Q and Q̇ are then projected onto the
/// constraint det Q = 1. Fails if the figure does not have the small motion.
mechanics::Status add_motion(const FamilyMaker& maker, const scene::Scene& scene, const EquilibriumPoint& figure,
                             Start& start) {
  const std::optional<int>& number = scene.initial_state.mode;
  const auto rates = rates_of_point(figure);
  if (!number && figure.stability.stable) return mechanics::Status::failure("no small motion about the figure grows");
  if (number && static_cast<std::size_t>(*number) > rates.size())
    return mechanics::Status::failure(fmt::format("the figure has {} rates of small motions", rates.size()));
  const mechanics::Rate& rate =
      number ? rates[static_cast<std::size_t>(*number) - 1]
             : *std::ranges::max_element(rates, {}, [](const mechanics::Rate& of) { return of.s.real(); });
  mechanics::SmallMotion motion;
  if (auto status = maker.small_motion(figure.motion, rate.s, motion); !status) return status;
  Eigen::Matrix3cd H = motion.shape.reshaped(3, 3);
  mechanics::PhaseDisplacements displacements;
  Eigen::Index k = 0;
  for (const Eigen::Vector3d& X : mechanics::phase_points()) displacements.col(k++) = H * X;
  H *= mechanics::factor_of_shape(scene.initial_state.mode_amplitude, maker.moment_by_mass() * H.squaredNorm(),
                                  displacements);
  const reduced::SteadyMotion& m = figure.motion;
  start.Q = m.A + H.real();
  if (scene.body.incompressible) start.Q = to_eigen(scene::project_deformation(entries_of(start.Q)));
  start.Qdot = mechanics::cross_matrix(m.omega) * start.Q - start.Q * mechanics::cross_matrix(m.Lambda) +
               (motion.rate * H).real();
  if (scene.body.incompressible)
    start.Qdot = to_eigen(scene::project_velocity(entries_of(start.Q), entries_of(start.Qdot)));
  return {};
}

}  // namespace

mechanics::Status figure_of_family(const scene::Scene& scene, Family family, double parameter,
                                   reduced::SteadyMotion& figure) {
  EquilibriumPoint point;
  auto status = find_member(FamilyMaker(scene), scene, family, parameter, point);
  figure = point.motion;
  return status;
}

scene::Scene with_equilibrium(scene::Scene scene, const scene::Origins& origins) {
  auto& initial = scene.initial_state;
  if (initial.equilibrium == Family::none) return scene;
  const FamilyMaker maker(scene);
  EquilibriumPoint figure;
  const auto refuse = [&](const std::string& path, std::string_view sentence, const std::string& reason) {
    throw UserError(fmt::format("{}: {}: {}: {}", origins.of(path), path, sentence, reason));
  };
  if (const auto status = find_member(maker, scene, initial.equilibrium, initial.equilibrium_parameter, figure);
      !status)
    refuse("Initial state/Equilibrium parameter", "there is no such equilibrium", status.reason());
  reduced::SteadyMotion& m = figure.motion;
  const double rate = m.omega.norm() + m.Lambda.norm();
  m.A = without_round_off(m.A, m.A.norm());
  m.omega = without_round_off(m.omega, rate);
  m.Lambda = without_round_off(m.Lambda, rate);
  Start start{m.A, m.co_moving_velocity()};
  const bool has_affine_model =
      std::ranges::any_of(scene::models_of(scene), [](const auto* model) { return !model->has_nonaffine; });
  if (initial.mode != 0 && has_affine_model && scene.analysis == scene::Analysis::motion)
    if (const auto status = add_motion(maker, scene, figure, start); !status)
      refuse("Initial state/Mode", "there is no such small motion", status.reason());
  initial.origin = {initial.equilibrium, initial.equilibrium_parameter, initial.deformation, initial.velocity};
  const Eigen::Matrix3d D = to_eigen(initial.deformation), V = to_eigen(initial.velocity);
  initial.deformation = entries_of(D * start.Q);
  initial.velocity = entries_of(D * start.Qdot / units_of(scene).time + V);
  initial.equilibrium = Family::none;
  return scene;
}

}  // namespace pseudorigid::app
