#include "io/trajectory.h"

#include <array>
#include <string>
#include <utility>

namespace pseudorigid::io {

namespace {

/// The one list of columns. `emit(name, value)` takes a scalar, a vector (name1…name3) or a matrix (name11…name33).
template <class Emit>
void visit_body(const mechanics::BodyObservables& o, const scene::Quantities& quantities, Emit&& emit) {
  if (quantities.state) {
    emit("Q", o.Q);
    emit("Qdot", o.Qdot);
    emit("x", o.center);
    emit("v", o.velocity);
  }
  if (quantities.energies) {
    emit("kinetic", o.kinetic);
    emit("elastic", o.elastic);
    emit("gravitational", o.gravitational);
    emit("external", o.external);
    emit("dissipated", o.dissipated);
    emit("energy", o.energy());
  }
  if (quantities.momenta) {
    emit("J", o.angular_momentum);
    emit("Z", o.circulation);
  }
  if (quantities.axes) emit("volume_ratio", o.volume_ratio);
  if (quantities.multiplier) emit("multiplier", o.multiplier);
  if (quantities.axes) emit("a", o.semi_axes);
}

template <class Emit>
void visit_reduced(const mechanics::ReducedObservables& o, const scene::Quantities& quantities, Emit&& emit) {
  visit_body(o, quantities, emit);
  if (quantities.pressure) emit("central_pressure", o.central_pressure);
  if (quantities.bipolar) {
    emit("A", o.axes);
    emit("T", o.T);
    emit("S", o.S);
    for (const auto& [name, rates] : {std::pair{"Omega_star", &o.Omega_star}, std::pair{"Lambda_star", &o.Lambda_star}})
      for (int k = 0; k < 3; ++k) emit((std::string(name) + std::array{"12", "13", "23"}[k]).c_str(), (*rates)[k]);
    emit("bipolar_residual", o.bipolar_residual);
  }
}

template <class Emit>
void visit_continuum(const mechanics::ContinuumObservables& o, const scene::Quantities& quantities, Emit&& emit) {
  visit_body(o, quantities, emit);
  if (quantities.state) emit("F", o.F);
  if (quantities.nonaffine) {
    emit("nonaffine_kinetic_fraction", o.nonaffine_kinetic_fraction);
    emit("nonaffine_displacement", o.nonaffine_displacement);
    emit("min_jacobian", o.min_jacobian);
  }
}

struct ColumnNames {
  std::vector<std::string> names{"time"};

  void operator()(const char* name, double) { names.emplace_back(name); }
  void operator()(const std::string& name, const Eigen::Vector3d&) {
    for (const char* i : {"1", "2", "3"}) names.push_back(name + i);
  }
  void operator()(const std::string& name, const Eigen::Matrix3d&) {
    for (const char* i : {"1", "2", "3"})
      for (const char* j : {"1", "2", "3"}) names.push_back(name + i + j);
  }
};

struct RowValues {
  std::vector<double>& row;

  void operator()(const char*, double value) { row.push_back(value); }
  void operator()(const char*, const Eigen::Vector3d& v) { row.insert(row.end(), {v[0], v[1], v[2]}); }
  void operator()(const char*, const Eigen::Matrix3d& A) {
    for (int i = 0; i < 3; ++i) row.insert(row.end(), {A(i, 0), A(i, 1), A(i, 2)});
  }
};

}  // namespace

std::vector<std::string> reduced_columns(const scene::Quantities& quantities) {
  ColumnNames columns;
  visit_reduced({}, quantities, columns);
  return columns.names;
}

std::vector<std::string> continuum_columns(const scene::Quantities& quantities) {
  ColumnNames columns;
  visit_continuum({}, quantities, columns);
  return columns.names;
}

void reduced_row(double physical_time, const mechanics::ReducedObservables& internal, const Units& units,
                 const scene::Quantities& quantities, std::vector<double>& row) {
  row.assign(1, physical_time);
  visit_reduced(to_physical(internal, units), quantities, RowValues{row});
}

void continuum_row(double physical_time, const mechanics::ContinuumObservables& internal, const Units& units,
                   const scene::Quantities& quantities, std::vector<double>& row) {
  row.assign(1, physical_time);
  visit_continuum(to_physical(internal, units), quantities, RowValues{row});
}

}  // namespace pseudorigid::io
