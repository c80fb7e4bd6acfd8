#include "io/trajectory.h"

#include <iterator>
#include <span>
#include <type_traits>
#include <variant>

namespace pseudorigid::io {

using mechanics::AntisymmetricEntries;
using mechanics::BodyColumn;
using mechanics::ContinuumObservables;
using mechanics::OverPoints;
using mechanics::ReducedObservables;
using scene::Quantities;

namespace {

template <class O>
using Columns = std::vector<BodyColumn<O>>;

/// The columns that all models of the ball have, and then the columns `own` of one model.
template <class O>
Columns<O> common_and(std::span<const BodyColumn<O>> own) {
  Columns<O> columns(std::begin(mechanics::common_columns<O>), std::end(mechanics::common_columns<O>));
  columns.insert(columns.end(), own.begin(), own.end());
  return columns;
}

template <class O>
const Columns<O>& body_columns();
template <>
const Columns<ReducedObservables>& body_columns() {
  static const auto columns = common_and<ReducedObservables>(mechanics::reduced_columns);
  return columns;
}
template <>
const Columns<ContinuumObservables>& body_columns() {
  static const auto columns = common_and<ContinuumObservables>(mechanics::continuum_columns);
  return columns;
}

/// The suffixes that distinguish the entries of a vector or matrix in the header of the CSV file. A scalar has the
/// empty suffix. The elements of `of_kind` belong to the types in the variant BodyColumn::value, in the same order:
/// scalar, vectors of three and four entries, matrix, antisymmetric matrix, and extreme value over points.
template <class O>
const std::vector<std::string>& suffixes(const BodyColumn<O>& column) {
  static const std::vector<std::string> of_kind[] = {{""},
                                                     {"1", "2", "3"},
                                                     {"1", "2", "3", "4"},
                                                     {"11", "12", "13", "21", "22", "23", "31", "32", "33"},
                                                     {"12", "13", "23"},
                                                     {""}};
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
Trajectory<Observables>::Trajectory(const Quantities& quantities, const Units& units)
    : request_{quantities}, units_(units) {
  for (const auto& column : body_columns<Observables>()) {
    if (!(quantities.*column.group)) continue;
    columns_.push_back(&column);
    if (const auto* over_points = std::get_if<OverPoints>(&column.value)) request_.over_points.push_back(*over_points);
    for (const std::string& suffix : suffixes(column)) names_.push_back(std::string(column.name) + suffix);
  }
}

template <class Observables>
void Trajectory<Observables>::row(double physical_time, const Observables& internal, std::vector<double>& row) const {
  row.assign(1, physical_time);
  auto over_points = internal.over_points.begin();
  const auto value_of = [&]<class Value>(const Value& value) {
    if constexpr (std::is_same_v<Value, OverPoints>)
      return over_points == internal.over_points.end() ? mechanics::not_observed : *over_points++;
    else
      return value(internal);
  };
  for (const auto* column : columns_)
    std::visit(
        [&](const auto& value) {
          visit_entries(value_of(value), [&](double entry) { row.push_back(units_.to_physical(entry, column->unit)); });
        },
        column->value);
}

template std::vector<scene::Column> documented_columns<ReducedObservables>();
template std::vector<scene::Column> documented_columns<ContinuumObservables>();
template class Trajectory<ReducedObservables>;
template class Trajectory<ContinuumObservables>;

}  // namespace pseudorigid::io
