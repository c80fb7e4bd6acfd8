#pragma once
/// A system of the table (systems/table.h), in one of its forms (systems/any_model.h), as a model that ModelRun can
/// integrate.

#include <algorithm>
#include <string>
#include <vector>

#include "app/run/runnable_model.h"
#include "io/column_table.h"
#include "scene/scene.h"
#include "systems/any_model.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

/// A motion of a system in the form `Form`. The object refers to `form` and `model`, which must exist as long as the
/// object.
template <class Form>
class SystemModel final : public RunnableModelOf<Form> {
  using Base = RunnableModelOf<Form>;
  /// Number of steps between two checks of the clock and of the interrupt flag. A step takes less than 1 µs, so a check
  /// after every step would cost too much time.
  static constexpr int between_looks = 256;

 public:
  using typename Base::State;

  SystemModel(const scene::SystemDescription& description, const Form& form, systems::AnyModel& model,
              const systems::Scales& scales, const scene::Scene& scene)
      : Base(std::string(description.file), between_looks, 1),
        form_(form),
        model_(model),
        columns_(time_and(description.columns_of(scene)), scales) {}

  const Form& system() const override { return form_; }
  State initial_state() const override { return model_.start(); }
  Eigen::MatrixXd configuration(const State& state) const override { return state.q; }
  double rate(const State& state) const override { return model_.rate(state); }
  /// The duration of a pilot run, at most 1000 in internal time. Most runs are shorter than 1000, and a pilot run then
  /// covers the whole run in a fraction of a second. A shorter pilot run would not contain the later part of the
  /// motion.
  double pilot_window(double end) const override { return std::min(end, 1000.0); }

  std::vector<std::string> columns() const override { return columns_.names; }

  mechanics::Status row(double time, const State& state, systems::AnyModel::Workspace& workspace,
                        std::vector<double>& row) override {
    row.assign(1, model_.reversed() ? -time : time);
    if (mechanics::Status status = model_.row(state, workspace, row); !status) return status;
    columns_.convert(row);
    return {};
  }

 private:
  /// The columns with the time as the first column. The time of a row is already in the user's units, so its column has
  /// no unit and is not converted.
  static std::vector<scene::Column> time_and(std::vector<scene::Column> columns) {
    columns.insert(columns.begin(), {"time", "", ""});
    return columns;
  }

  const Form& form_;
  systems::AnyModel& model_;
  io::ColumnUnits columns_;
};

}  // namespace pseudorigid::app
