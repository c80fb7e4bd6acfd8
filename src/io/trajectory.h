#pragma once
/// Headers, rows, units and documentation of the models' CSV files, from the columns that are declared in
/// observables/body_observables.h.

#include <string>
#include <string_view>
#include <vector>

#include "entries/units.h"
#include "observables/body_observables.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::io {

/// All columns of a model but `time`, which comes first, as people read of them: `Q11 ... Q33` in one line. Observables
/// are mechanics::ReducedObservables or mechanics::ContinuumObservables.
template <class Observables>
std::vector<scene::Column> documented_columns();

/// The columns that `quantities` asks for, and rows of them.
template <class Observables>
class Trajectory {
 public:
  explicit Trajectory(const scene::Quantities& quantities, const Units& units = {});

  /// The header, `time` first.
  const std::vector<std::string>& names() const { return names_; }
  /// The observables that they need.
  const mechanics::ObservableRequest& request() const { return request_; }
  /// The row of a sample; observables in internal units, the time in the user's (it is known exactly there). `row` is
  /// overwritten and its memory reused.
  void row(double physical_time, const Observables& internal, std::vector<double>& row) const;

 private:
  mechanics::ObservableRequest request_;
  std::vector<const mechanics::BodyColumn<Observables>*> columns_;
  std::vector<std::string> names_{"time"};
  Units units_;
};

}  // namespace pseudorigid::io
