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

/// All columns of a model except `time`, for the documentation. A vector or matrix is one element of the list, for
/// example with the name `Q11 ... Q33`. The type Observables is mechanics::ReducedObservables or
/// mechanics::ContinuumObservables.
template <class Observables>
std::vector<scene::Column> documented_columns();

/// The columns of a model's CSV file: the time, and the columns that `quantities` selects. The class computes rows of
/// these columns from observables.
template <class Observables>
class Trajectory {
 public:
  explicit Trajectory(const scene::Quantities& quantities, const Units& units = {});

  /// Names of the columns. The first is `time`.
  const std::vector<std::string>& names() const { return names_; }
  /// The request for the observables that the columns need.
  const mechanics::ObservableRequest& request() const { return request_; }
  /// Replaces `row` by the values of the columns for a sample, and reuses the memory of `row`. The observables are in
  /// internal units and are converted to the units of the user. The time is already in the units of the user. A value
  /// that the model has not computed is NaN.
  void row(double physical_time, const Observables& internal, std::vector<double>& row) const;

 private:
  mechanics::ObservableRequest request_;
  std::vector<const mechanics::BodyColumn<Observables>*> columns_;
  std::vector<std::string> names_{"time"};
  Units units_;
};

}  // namespace pseudorigid::io
