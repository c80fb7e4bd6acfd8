#pragma once
/// Adapter of a system of the table, in one of its forms (systems/any_model.h), to the RunnableModel interface.

#include <algorithm>
#include <string>
#include <vector>

#include "io/column_table.h"
#include "io/manifest.h"
#include "scene/scene.h"
#include "systems/any_model.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

/// Keeps a reference; the model must outlive it.
template <class Form>
class SystemModel {
 public:
  using System = Form;
  using State = mechanics::State<System>;
  /// Steps take less than 1 µs, so the clock and the interrupt flag are polled only once in this many steps.
  static constexpr int steps_between_looks = 256;
  static constexpr double pilot_reserve = 1;
  const char* const name;

  SystemModel(const scene::SystemDescription& description, const Form& form, systems::AnyModel& model,
              const systems::Scales& scales, const scene::Scene& scene)
      : name(description.file.data()),
        form_(form),
        model_(model),
        columns_(time_and(description.columns_of(scene)), scales) {}

  const System& system() const { return form_; }
  State initial_state() const { return model_.start(); }
  double constraint_scale() const { return 1; }
  Eigen::VectorXd configuration(const State& state) const { return state.q; }
  double rate(const State& state) const { return model_.rate(state); }
  /// For most runs it is the whole run, which takes a fraction of a second: a shorter window does not contain the later
  /// motion.
  double pilot_window(double end) const { return std::min(end, 1000.0); }

  const std::vector<std::string>& columns() const { return columns_.names; }

  mechanics::Status row(double time, const State& state, systems::AnyModel::Workspace& workspace,
                        std::vector<double>& row) {
    row.assign(1, model_.reversed() ? -time : time);
    if (mechanics::Status status = model_.row(state, workspace, row); !status) return status;
    columns_.convert(row);
    return {};
  }

  template <class MethodWorkspace>
  void report(const MethodWorkspace&, io::Manifest::Model&) const {}

 private:
  /// The time of a row is in the user's units.
  static std::vector<scene::Column> time_and(std::vector<scene::Column> columns) {
    columns.insert(columns.begin(), {"time", "", ""});
    return columns;
  }

  const System& form_;
  systems::AnyModel& model_;
  io::ColumnUnits columns_;
};

}  // namespace pseudorigid::app
