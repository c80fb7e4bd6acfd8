#pragma once
/// The columns of reduced.csv and continuum.csv, and their rows. A column is declared in one place (trajectory.cpp):
/// its name, its group, its unit, what it means, and how it is had from the observables. Headers, rows, units and
/// documentation follow from that.

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "entries/units.h"
#include "mechanics/core/body_observables.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::io {

/// The entries 12, 13 and 23 of an antisymmetric matrix.
struct AntisymmetricEntries {
  Eigen::Vector3d values;
};

template <class Observables>
struct BodyColumn {
  std::string_view name;
  bool scene::Quantities::*group;  ///< the part of Output/Quantities that asks for it
  scene::Unit unit;
  std::string_view documentation;
  /// In internal units: a scalar, a vector (name1 … name3), a matrix (name11 … name33, row by row) or an antisymmetric
  /// one (name12, name13, name23).
  std::variant<double (*)(const Observables&), Eigen::Vector3d (*)(const Observables&),
               Eigen::Matrix3d (*)(const Observables&), AntisymmetricEntries (*)(const Observables&)>
      value;
};

/// All columns of a model but `time`, which comes first. Observables are mechanics::ReducedObservables or
/// mechanics::ContinuumObservables.
template <class Observables>
const std::vector<BodyColumn<Observables>>& body_columns();

/// The same as people read of them, `Q11 ... Q33` in one line.
template <class Observables>
std::vector<scene::Column> documented_columns();

/// The columns that `quantities` asks for, and rows of them.
template <class Observables>
class Trajectory {
 public:
  explicit Trajectory(const scene::Quantities& quantities, const Units& units = {});

  /// The header, `time` first.
  const std::vector<std::string>& names() const { return names_; }
  /// The row of a sample; observables in internal units, the time in the user's (it is known exactly there). `row` is
  /// overwritten and its memory reused.
  void row(double physical_time, const Observables& internal, std::vector<double>& row) const;

 private:
  std::vector<const BodyColumn<Observables>*> columns_;
  std::vector<std::string> names_{"time"};
  Units units_;
};

}  // namespace pseudorigid::io
