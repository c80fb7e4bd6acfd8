#include "app/reduced/static_equilibria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/reduced/reduced_scene.h"
#include "app/run/critical_point_rows.h"
#include "io/column_table.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/core/principal_axes.h"
#include "reduced/static_equilibria.h"

namespace pseudorigid::app {
namespace {

/// Number of starting points of the search. If equilibria are known to be missing, the search continues up to
/// n_static_starts_at_most starting points.
constexpr int n_static_starts = 400, n_static_starts_at_most = 20000;

/// The row of a critical point in internal units, in the order of static_equilibria_columns().
std::vector<double> static_row(int index, const mechanics::CriticalPoint& p, const ReducedScene& s,
                               const reduced::Potential& potential) {
  const Eigen::Matrix3d Q = reduced::StaticLandscape::matrix(p.q);
  std::vector<double> row{static_cast<double>(index)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) row.push_back(Q(i, j));
  const Eigen::Vector3d a = mechanics::singular_values(Q * s.body.shape);
  row.insert(row.end(), a.begin(), a.end());
  row.push_back(p.lambda.size() > 0 ? p.lambda[0] / (s.body.E0.trace() / 3) : 0);
  const reduced::PotentialEnergies V = potential.energies(Q);
  row.insert(row.end(), {V.elastic, V.gravitational, V.external, V.total()});
  append_critical_point(p, row);
  const Eigen::Matrix3d gradient = potential.gradient(Q);
  Eigen::Matrix3d rest = gradient;
  if (p.lambda.size() > 0) rest -= p.lambda[0] * Q.inverse().transpose();
  const double left = rest.norm();
  row.push_back(gradient.norm() > 0 ? left / gradient.norm() : left);
  return row;
}

/// Reports the equilibrium of the centre of mass x and its Morse index. At the equilibrium, ẍ = b − Tx = 0 with the
/// acceleration b and the tidal matrix T. The centre of mass moves independently of Q. Warns if there is no
/// equilibrium. Reports nothing if b and T are 0.
void report_center(const ReducedScene& s, const io::Units& units, const RunContext& context, ModelOutcome& outcome) {
  const Eigen::Matrix3d& T = s.forcing.quadratic;
  const Eigen::Vector3d& b = s.forcing.acceleration;
  if (T.isZero(0) && b.isZero(0)) return;
  const mechanics::SymmetricSpectrum of_T = mechanics::symmetric_spectrum(T);
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  // the shortest x of least |Tx − b|
  for (int i = 0; i < 3; ++i)
    if (std::abs(of_T.values[i]) > 1e-14 * of_T.values.cwiseAbs().maxCoeff())
      x += of_T.vectors.col(i).dot(b) / of_T.values[i] * of_T.vectors.col(i);
  if ((T * x - b).norm() > 1e-12 * b.norm()) {
    context.log->warn(
        "these are equilibria of shape and attitude: the acceleration moves the centre of mass, which nothing holds");
    return;
  }
  add_result(
      outcome, context,
      fmt::format("the centre of mass, which moves by itself, is at rest at ({:.9g}, {:.9g}, {:.9g}): Morse "
                  "index {}",
                  x[0] * units.length, x[1] * units.length, x[2] * units.length, (of_T.values.array() < 0).count()));
}

}  // namespace

std::vector<scene::Column> static_equilibria_columns(int n_modes) {
  std::vector<scene::Column> columns{{"index", "", "number of the point, by rising potential"}};
  for (int i = 1; i <= 3; ++i)
    for (int j = 1; j <= 3; ++j)
      columns.push_back(
          {fmt::format("Q{}{}", i, j), "",
           i + j == 2 ? "entry of Q; one of many if the body can be turned without a change" : "as for Q11"});
  for (int i = 1; i <= 3; ++i)
    columns.push_back({fmt::format("a{}", i), "length", i == 1 ? "semi-axis, longest first" : "as for a1"});
  columns.insert(columns.end(), {{"multiplier", "1/time^2", "multiplier per m_bar"},
                                 {"elastic", "mass*length^2/time^2", "stored energy"},
                                 {"gravitational", "mass*length^2/time^2", "energy of self-gravity"},
                                 {"external", "mass*length^2/time^2", "energy of the loads"},
                                 {"potential", "mass*length^2/time^2", "their sum"}});
  for (const scene::Column& column : critical_point_columns(n_modes)) columns.push_back(column);
  columns.push_back({"residual", "", "residual of the equations of rest, over the force"});
  return columns;
}

ModelOutcome run_static_equilibria(const RunContext& context) {
  const ReducedScene s = reduced_scene(context.scene);
  const reduced::Potential potential = potential_of(s);
  const bool incompressible = context.scene.body.incompressible;
  const reduced::StaticLandscape body(potential, s.body, s.dissipation, incompressible);
  const mechanics::AnyLandscape landscape(body);
  auto search = reduced::static_search(incompressible, s.forcing.nominal_traction, n_static_starts);
  search.misses_points = [&](const auto& points) { return reduced::misses_equilibria(body, points); };
  search.n_starts_at_most = n_static_starts_at_most;
  mechanics::CriticalPoints found;
  ModelOutcome outcome;
  const auto status = mechanics::find_equilibria(landscape, s.dissipation.present(), search, found);
  if (!status || found.points.empty()) {
    outcome.end = mechanics::Outcome::failed;
    outcome.message = !status ? "the search for equilibria failed: " + status.reason()
                              : fmt::format("no equilibrium at rest was found from {} starts", found.n_starts);
    return outcome;
  }
  io::ColumnTable table(context.directory.csv("equilibria"), static_equilibria_columns(incompressible ? 8 : 9),
                        context.scales());
  int index = 0;
  for (const mechanics::CriticalPoint& point : found.points) table.append(static_row(++index, point, s, potential));
  table.flush();
  report_search(found, context.scales()("mass*length^2/time^2"), context, outcome);
  if (found.misses_points)
    context.log->warn(
        "equilibria are missing among these: by Morse's count there is at least one each of index 0, 1, 2 and 3, and "
        "as many of even index as of odd index");
  outcome.statistics.counters["misses_equilibria"] = found.misses_points ? 1 : 0;
  report_center(s, context.units, context, outcome);
  return outcome;
}

}  // namespace pseudorigid::app
