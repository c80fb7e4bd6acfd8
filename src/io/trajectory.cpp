#include "io/trajectory.h"

#include <utility>

#include "mechanics/core/principal_axes.h"

namespace pseudorigid::io {

using mechanics::ContinuumObservables;
using mechanics::ReducedObservables;
using scene::Quantities;

namespace {

template <class Observables>
using Columns = std::vector<BodyColumn<Observables>>;

/// What every model of the ball has.
template <class O>
Columns<O> common_columns() {
  constexpr scene::Unit energy{"mass*length^2/time^2"};
  return {
      {"Q", &Quantities::state, "",
       "deformation; of the continuum the mass moment Q_M, the affine motion nearest to it",
       [](const O& o) { return o.Q; }},
      {"Qdot", &Quantities::state, "1/time", "its rate", [](const O& o) { return o.Qdot; }},
      {"x", &Quantities::state, "length", "centre of mass", [](const O& o) { return o.center; }},
      {"v", &Quantities::state, "length/time", "velocity of the centre of mass", [](const O& o) { return o.velocity; }},
      {"kinetic", &Quantities::energies, energy, "kinetic energy", [](const O& o) { return o.kinetic; }},
      {"elastic", &Quantities::energies, energy, "stored energy", [](const O& o) { return o.elastic; }},
      {"gravitational", &Quantities::energies, energy, "energy of the self-gravity",
       [](const O& o) { return o.gravitational; }},
      {"external", &Quantities::energies, energy,
       "energy of all loads, minus the energy that time-dependent loads have given to the body",
       [](const O& o) { return o.external; }},
      {"dissipated", &Quantities::energies, energy, "energy dissipated by viscosity and drag",
       [](const O& o) { return o.dissipated; }},
      {"energy", &Quantities::energies, energy, "their sum", [](const O& o) { return o.energy(); }},
      {"J", &Quantities::momenta, "mass*length^2/time", "angular momentum about the centre of mass",
       [](const O& o) { return o.angular_momentum; }},
      {"Z", &Quantities::momenta, "mass*length^2/time",
       "circulation, the integral of rho X x (F^T v) about the centre of mass; a rigid spin of the undeformed ball has "
       "J = Z",
       [](const O& o) { return o.circulation; }},
      {"volume_ratio", &Quantities::axes, "", "current volume / reference volume",
       [](const O& o) { return o.volume_ratio; }},
      {"multiplier", &Quantities::multiplier, "1/time^2",
       "multiplier of det Q = 1 per tr E0/3 (of the ball, lambda of Oliva 5.120); of the continuum the integral of the "
       "Kirchhoff pressure per tr E0/3. Positive is pressure",
       [](const O& o) { return o.multiplier; }},
      {"a", &Quantities::axes, "length", "semi-axes of Q, in descending order", [](const O& o) { return o.semi_axes; }},
  };
}

template <class O>
void append(Columns<O>& columns, Columns<O> further) {
  for (auto& column : further) columns.push_back(std::move(column));
}

Columns<ReducedObservables> reduced_columns() {
  using O = ReducedObservables;
  Columns<O> columns = common_columns<O>();
  append<O>(
      columns,
      {
          {"central_pressure", &Quantities::pressure, "pressure",
           "p_c of p = p_c (1 - |X|^2/r^2), the reaction to det Q = 1", [](const O& o) { return o.central_pressure; }},
          {"A", &Quantities::bipolar, "length", "semi-axes of Q = T^T A S, followed along the motion, in no order",
           [](const O& o) { return o.axes; }},
          {"T", &Quantities::bipolar, "", "rotation T of the bipolar decomposition", [](const O& o) { return o.T; }},
          {"S", &Quantities::bipolar, "", "rotation S of the bipolar decomposition", [](const O& o) { return o.S; }},
          {"Omega_star", &Quantities::bipolar, "1/time", "T' T^T",
           [](const O& o) { return AntisymmetricEntries{o.Omega_star}; }},
          {"Lambda_star", &Quantities::bipolar, "1/time", "S' S^T",
           [](const O& o) { return AntisymmetricEntries{o.Lambda_star}; }},
          {"bipolar_residual", &Quantities::bipolar, "1/time^2",
           "largest entry of the residual of Oliva (5.121), per tr E0/3",
           [](const O& o) { return o.bipolar_residual; }},
          {"stretch", &Quantities::stretches, "", "principal stretches of Q, in descending order",
           [](const O& o) { return mechanics::singular_values(o.Q); }},
      });
  return columns;
}

Columns<ContinuumObservables> continuum_columns() {
  using O = ContinuumObservables;
  Columns<O> columns = common_columns<O>();
  append<O>(
      columns,
      {
          {"F", &Quantities::state, "", "mean deformation gradient", [](const O& o) { return o.F; }},
          {"nonaffine_kinetic_fraction", &Quantities::nonaffine, "",
           "share of the kinetic energy that is not in the affine motion",
           [](const O& o) { return o.nonaffine_kinetic_fraction; }},
          {"nonaffine_displacement", &Quantities::nonaffine, "", "|x - Q X| / |x|, norms weighted with the mass",
           [](const O& o) { return o.nonaffine_displacement; }},
          {"min_jacobian", &Quantities::nonaffine, "", "least det F at the integration points",
           [](const O& o) { return o.min_jacobian; }},
          {"volumetric", &Quantities::volumetric, "mass*length^2/time^2",
           "part of the elastic energy that the volumetric stabilisation stores; with the energies, where it is on",
           [](const O& o) { return o.volumetric; }},
          {"stretch", &Quantities::stretches, "",
           "principal stretches of the mean deformation gradient, in descending order",
           [](const O& o) { return mechanics::singular_values(o.F); }},
          {"max_stretch", &Quantities::stretches, "", "largest principal stretch at the integration points",
           [](const O& o) { return o.max_stretch; }},
          {"min_stretch", &Quantities::stretches, "", "least principal stretch at the integration points",
           [](const O& o) { return o.min_stretch; }},
      });
  return columns;
}

/// What follows the name of a column in the header, by the kind of its value.
template <class O>
const std::vector<std::string>& suffixes(const BodyColumn<O>& column) {
  static const std::vector<std::string> of_kind[] = {
      {""}, {"1", "2", "3"}, {"11", "12", "13", "21", "22", "23", "31", "32", "33"}, {"12", "13", "23"}};
  return of_kind[column.value.index()];
}

template <class Visit>
void visit_entries(double value, Visit&& visit) {
  visit(value);
}
template <class Visit>
void visit_entries(const AntisymmetricEntries& A, Visit&& visit) {
  for (int i = 0; i < 3; ++i) visit(A.values[i]);
}
template <class Derived, class Visit>
void visit_entries(const Eigen::MatrixBase<Derived>& A, Visit&& visit) {
  for (int i = 0; i < A.rows(); ++i)
    for (int j = 0; j < A.cols(); ++j) visit(A(i, j));
}

}  // namespace

template <>
const std::vector<BodyColumn<ReducedObservables>>& body_columns() {
  static const auto columns = reduced_columns();
  return columns;
}
template <>
const std::vector<BodyColumn<ContinuumObservables>>& body_columns() {
  static const auto columns = continuum_columns();
  return columns;
}

template <class Observables>
std::vector<scene::Column> documented_columns() {
  std::vector<scene::Column> documented;
  for (const auto& column : body_columns<Observables>()) {
    const auto& ends = suffixes(column);
    std::string name = std::string(column.name) + ends.front();
    if (ends.size() > 1) name.append(" ... ").append(column.name).append(ends.back());
    documented.push_back({std::move(name), column.unit, column.documentation});
  }
  return documented;
}

template <class Observables>
Trajectory<Observables>::Trajectory(const Quantities& quantities, const Units& units) : units_(units) {
  for (const auto& column : body_columns<Observables>()) {
    if (!(quantities.*column.group)) continue;
    columns_.push_back(&column);
    for (const std::string& suffix : suffixes(column)) names_.push_back(std::string(column.name) + suffix);
  }
}

template <class Observables>
void Trajectory<Observables>::row(double physical_time, const Observables& internal, std::vector<double>& row) const {
  row.assign(1, physical_time);
  for (const auto* column : columns_)
    std::visit(
        [&](const auto value) {
          visit_entries(value(internal), [&](double entry) { row.push_back(units_.to_physical(entry, column->unit)); });
        },
        column->value);
}

template std::vector<scene::Column> documented_columns<ReducedObservables>();
template std::vector<scene::Column> documented_columns<ContinuumObservables>();
template class Trajectory<ReducedObservables>;
template class Trajectory<ContinuumObservables>;

}  // namespace pseudorigid::io
