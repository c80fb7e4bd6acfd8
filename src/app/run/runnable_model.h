#pragma once
/// Interface of a model to ModelRun: the start of its motion, its largest frequency, and its output. Functions with a
/// default are optional. All ranks run the model together; one of them writes.

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/csv.h"
#include "io/manifest.h"
#include "mechanics/methods/rattle.h"

namespace pseudorigid::app {

/// The part of the interface that does not depend on the system.
class RunnableModel {
 public:
  virtual ~RunnableModel() = default;
  RunnableModel(const RunnableModel&) = delete;

  const std::string name;         ///< of its files
  const int steps_between_looks;  ///< steps between checks of the clock and the interrupt flag
  const double pilot_reserve;     ///< the part of the tolerance that a pilot gets

  virtual double pilot_window(double end) const = 0;  ///< length of the pilots of a motion until `end`
  virtual std::vector<std::string> columns() const = 0;

  /// Restores the history from the rows of an interrupted run.
  virtual void take_up(const io::Table& /*rows*/) {}
  /// The warnings given so far as a fixed count of numbers, for checkpoints.
  virtual std::vector<double> remarks() const { return {}; }
  virtual void take_remarks(std::span<const double>) {}

  /// Shapes for the report: the name of their table, empty if there are none, and its columns.
  virtual std::string shape_file() const { return {}; }
  virtual std::vector<std::string> shape_columns() const { return {}; }

 protected:
  RunnableModel(std::string name_of_files, int between_looks, double reserve)
      : name(std::move(name_of_files)), steps_between_looks(between_looks), pilot_reserve(reserve) {}
};

/// The model of a system. Models with distributed vectors also have rank_order() and MemoryLayout
/// (checkpoint_vectors.h).
template <class S>
class RunnableModelOf : public RunnableModel {
 public:
  using System = S;
  using State = mechanics::State<S>;
  using Workspace = typename S::Workspace;

  virtual const S& system() const = 0;
  virtual State initial_state() const = 0;
  /// The numbers to which Time/Tolerance applies.
  virtual Eigen::MatrixXd configuration(const State&) const = 0;
  virtual double rate(const State&) const = 0;  ///< rate of the motion itself, in addition to its largest frequency
  virtual double constraint_scale() const { return 1; }
  /// Kinetic and potential energy, for methods that need not keep their sum; of systems with a costly force.
  virtual Eigen::Vector2d energies(const State&) const { return Eigen::Vector2d::Zero(); }
  /// A failure ends the run. Called after every step.
  virtual mechanics::Status judge(const State&) { return {}; }
  /// The state with which pilot runs begin, if the run begins with this one.
  virtual State start_of_pilot(const State& state) const { return state; }
  /// Chooses the rule of quadrature before the search for the step, and estimates the error of the rule after it.
  /// `stable_step` is that of RATTLE, 0 if it is not known.
  virtual void choose_quadrature(const State&) {}
  virtual void estimate_quadrature(const State&, double /*stable_step*/) {}
  virtual std::string place_of_least_jacobian(const State&) const { return {}; }  ///< for a run that cannot go on

  virtual mechanics::Status row(double time, const State&, Workspace&, std::vector<double>& row) = 0;
  virtual mechanics::Status write_frame(const std::filesystem::path&, double /*time*/, const State&, Workspace&) {
    return {};
  }
  virtual std::vector<std::vector<double>> shape(double /*time*/, const State&) const { return {}; }
  /// `workspace`: the part of the method's workspace that belongs to the system; null if there is none.
  virtual void report(const mechanics::Counters&, const Workspace* /*workspace*/, io::Manifest::Model&) const {}

 protected:
  using RunnableModel::RunnableModel;
};

}  // namespace pseudorigid::app
