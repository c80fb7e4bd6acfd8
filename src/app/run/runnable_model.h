#pragma once
/// Interface through which ModelRun integrates a model: the initial state, scales for the choice of the step, and
/// output. Functions with a default are optional. All ranks call the functions together; one rank writes the files.

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

  const std::string name;         ///< name of its files
  const int steps_between_looks;  ///< steps between checks of the clock and the interrupt flag
  const double pilot_reserve;     ///< factor of the tolerance in pilot runs

  virtual double pilot_window(double end) const = 0;  ///< duration of pilot runs for a motion until `end`
  virtual std::vector<std::string> columns() const = 0;

  /// Restores data on earlier samples from the rows of an interrupted run.
  virtual void take_up(const io::Table& /*rows*/) {}
  /// State of the warnings given so far, for checkpoints. The number of values is fixed.
  virtual std::vector<double> remarks() const { return {}; }
  virtual void take_remarks(std::span<const double>) {}

  /// Name of the table of shapes for the report, empty if there are no shapes. The columns of this table follow.
  virtual std::string shape_file() const { return {}; }
  virtual std::vector<std::string> shape_columns() const { return {}; }

 protected:
  RunnableModel(std::string name_of_files, int between_looks, double reserve)
      : name(std::move(name_of_files)), steps_between_looks(between_looks), pilot_reserve(reserve) {}
};

/// Interface for a type of system. Models with distributed vectors also have rank_order() and MemoryLayout
/// (checkpoint_vectors.h).
template <class S>
class RunnableModelOf : public RunnableModel {
 public:
  using System = S;
  using State = mechanics::State<S>;
  using Workspace = typename S::Workspace;

  virtual const S& system() const = 0;
  virtual State initial_state() const = 0;
  /// The numbers whose error Time/Tolerance bounds.
  virtual Eigen::MatrixXd configuration(const State&) const = 0;
  virtual double rate(const State&) const = 0;  ///< rate of change of the motion itself, which is added to ω
  virtual double constraint_scale() const { return 1; }
  /// Kinetic and potential energy, for methods that do not conserve their sum. Used for systems with a costly force.
  virtual Eigen::Vector2d energies(const State&) const { return Eigen::Vector2d::Zero(); }
  /// Checks the state after every step. A failure ends the run.
  virtual mechanics::Status judge(const State&) { return {}; }
  /// Initial state of the pilot runs for a run that begins with `state`.
  virtual State start_of_pilot(const State& state) const { return state; }
  /// Chooses the quadrature rule before the search for the step, and estimates the error of the rule after the search.
  /// `stable_step` is the stable step of RATTLE, 0 if it is not known.
  virtual void choose_quadrature(const State&) {}
  virtual void estimate_quadrature(const State&, double /*stable_step*/) {}
  virtual std::string place_of_least_jacobian(const State&) const { return {}; }  ///< for messages of failure

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
