#pragma once
/// A system of the table, as ModelRun wants it.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/run_context.h"
#include "io/manifest.h"
#include "mechanics/vector_space.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

template <class SystemScene, class Model>
class SystemModel {
 public:
  using System = typename Model::System;
  using State = mechanics::State<System>;
  static constexpr const char* name = SystemScene::file.data();
  /// Steps take a fraction of a microsecond: the clock and the interrupt flag are looked at this seldom.
  static constexpr int steps_between_looks = 256;
  static constexpr double pilot_reserve = 1;

  SystemModel(const SystemScene& scene, Model model, const systems::Scales& scales) : model_(std::move(model)) {
    for (const scene::Column& column : scene.columns()) {
      columns_.push_back(column.name);
      units_.push_back(scales(column.unit));
    }
  }

  const System& system() const { return model_.system; }
  State initial_state() const { return model_.initial; }
  double constraint_scale() const { return 1; }
  auto configuration(const State& state) const { return state.q; }
  double rate(const State& state) const {
    if constexpr (requires { model_.rate(state); }) return model_.rate(state);
    return mechanics::max_norm(state.v) / (1 + mechanics::max_norm(state.q));
  }
  /// Of most runs the whole, in a fraction of a second: a window does not know what a motion does later.
  double pilot_window(double end) const { return std::min(end, 1000.0); }

  std::vector<std::string> columns(const scene::Quantities&) const {
    auto columns = columns_;
    columns.insert(columns.begin(), "time");
    return columns;
  }

  mechanics::Status row(double time, const State& state, typename System::Workspace& workspace,
                        std::vector<double>& row) {
    row.assign(1, time);
    if (mechanics::Status status = model_.row(state, workspace, row); !status) return status;
    for (std::size_t i = 0; i < units_.size(); ++i) row[i + 1] *= units_[i];
    return {};
  }

  template <class MethodWorkspace>
  void report(const MethodWorkspace&, io::Manifest::Model&) const {}

 private:
  Model model_;
  std::vector<std::string> columns_;
  std::vector<double> units_;
};

}  // namespace pseudorigid::app
