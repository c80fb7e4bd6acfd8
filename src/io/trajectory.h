#pragma once
/// Header, rows, units and documentation of the CSV files of the models of the ball. The columns are declared in
/// observables/body_observables.h.

#include <string>
#include <string_view>
#include <vector>

#include "entries/units.h"
#include "observables/body_observables.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::io {

/// All columns of a model except `time`, for the documentation. The columns of a vector or matrix are one element of
/// the list, for example with the name `Q11 ... Q33`. The type Observables is mechanics::ReducedObservables or
/// mechanics::ContinuumObservables.
template <class Observables>
std::vector<scene::Column> documented_columns();

/// The columns of the CSV file of a model: the time, and the columns of the groups that `quantities` selects. The class
/// computes the rows of the file from observables.
template <class Observables>
class Trajectory {
 public:
  /// `units` converts the values of the rows to the units of the user. By default, they remain in internal units.
  explicit Trajectory(const scene::Quantities& quantities, const Units& units = {});

  /// Names of the columns. The first name is `time`.
  const std::vector<std::string>& names() const { return names_; }
  /// The request for the observables that the columns need. The caller passes the request to the function `observe` of
  /// the model.
  const mechanics::ObservableRequest& request() const { return request_; }
  /// Replaces `row` by the values of the columns for a sample, and reuses the memory of `row`. The observables
  /// `internal` are in internal units, and `physical_time` is in the units of the user. The row is in the units of the
  /// user. A value that the model has not computed is NaN.
  void row(double physical_time, const Observables& internal, std::vector<double>& row) const;

 private:
  mechanics::ObservableRequest request_;
  std::vector<const mechanics::BodyColumn<Observables>*> columns_;
  std::vector<std::string> names_{"time"};
  Units units_;
};

}  // namespace pseudorigid::io
