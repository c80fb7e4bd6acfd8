#pragma once
/// Interface through which ModelRun integrates a model: the initial state, scales for the choice of the step, and the
/// output. Functions with a default definition are optional. All ranks call the functions together.

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

  const std::string name;         ///< name of the files of the run
  const int steps_between_looks;  ///< number of steps between checks of the clock and the interrupt flag
  const double pilot_reserve;     ///< the search for the step uses Time/Tolerance times this factor

  /// The duration of the pilot runs for a run of duration `end`, both in internal time.
  virtual double pilot_window(double end) const = 0;
  /// True if the body has shear fronts, whose focus has larger time errors than pilot runs see.
  virtual bool has_fronts() const { return false; }
  /// The names of the columns of a row, in their order. The first column is the time.
  virtual std::vector<std::string> columns() const = 0;

  /// Restores data of the model about earlier samples, for example a time of first tension, from the rows of an
  /// interrupted run.
  virtual void take_up(const io::Table& /*rows*/) {}
  /// Data that a checkpoint contains for the model, for example about earlier warnings and contacts. The number of
  /// elements does not change during a run.
  virtual std::vector<double> remarks() const { return {}; }
  /// Restores the data that `remarks` returned when the checkpoint was written.
  virtual void take_remarks(std::span<const double>) {}

  /// Name of the table of shapes for the report; empty if the model does not have shapes. A shape contains positions of
  /// points on the surface and on the coordinate planes of the body (mechanics/core/shape_columns.h).
  virtual std::string shape_file() const { return {}; }
  /// The names of the columns of this table, in their order; empty if the model does not have shapes.
  virtual std::vector<std::string> shape_columns() const { return {}; }

 protected:
  RunnableModel(std::string name_of_files, int between_looks, double reserve)
      : name(std::move(name_of_files)), steps_between_looks(between_looks), pilot_reserve(reserve) {}
};

/// Interface for one type of system. A model that distributes its vectors over the ranks also has the function
/// rank_order() and the type MemoryLayout. They give the order of the entries in a checkpoint (checkpoint_vectors.h).
template <class S>
class RunnableModelOf : public RunnableModel {
 public:
  using System = S;
  using State = mechanics::State<S>;
  using Workspace = typename S::Workspace;

  /// The system of the model. The reference is valid as long as the model exists.
  virtual const S& system() const = 0;
  /// The state at the start of the run, in internal units.
  virtual State initial_state() const = 0;
  /// The configuration as a matrix. Time/Tolerance bounds the time error of its entries.
  virtual Eigen::MatrixXd configuration(const State&) const = 0;
  /// Rate at which the present motion rotates and stretches the body, in internal units. The stable step is computed
  /// for the frequency ω + rate, with the largest frequency ω of small vibrations about the motion.
  virtual double rate(const State&) const = 0;
  /// Size of the constraints. The constraint and its rate are divided by this number in tolerances and statistics.
  virtual double constraint_scale() const { return 1; }
  /// Kinetic and potential energy in internal units, in this order. Methods that are not symplectic can change their
  /// sum. For systems with a costly force, the search for the step bounds this change.
  virtual Eigen::Vector2d energies(const State&) const { return Eigen::Vector2d::Zero(); }
  /// Checks the state after every step. A failure ends the run.
  virtual mechanics::Status judge(const State&) { return {}; }
  /// The undeformed body at rest with the centre of mass of `state`; by default `state` itself.
  virtual State at_rest(const State& state) const { return state; }
  /// Least det F in the body, with the deformation gradient F; 1 if the model does not resolve the local volume.
  virtual double least_jacobian(const State&) const { return 1; }
  /// True if the least det F remains above half of its present value after a step h forwards and after a step h
  /// backwards. Both steps have the present velocity.
  virtual bool keeps_volume(const State&, double /*h*/) const { return true; }
  /// The state at the start of the pilot runs, for a run that begins with `state`.
  virtual State start_of_pilot(const State& state) const { return state; }
  /// A state of the body at rest in its first contact, in which friction has its largest rate of damping; by default
  /// `state` itself. Called only for systems with friction.
  virtual State in_contact(const State& state) const { return state; }
  /// `choose_quadrature` chooses the quadrature rule before the search for the step. `estimate_quadrature` estimates
  /// the error of the rule after the search. `stable_step` is the stable step of RATTLE in internal units, or 0 if this
  /// step is not known. By default both functions do nothing.
  virtual void choose_quadrature(const State&) {}
  virtual void estimate_quadrature(const State&, double /*stable_step*/) {}
  /// Text about the place of the least det F, for messages; may be empty.
  virtual std::string place_of_least_jacobian(const State&) const { return {}; }

  /// Writes the observables of a sample into `row`, in the order of columns() and in the user's units. `time` is the
  /// time in the user's units. Fails if an observable cannot be computed.
  virtual mechanics::Status row(double time, const State&, Workspace&, std::vector<double>& row) = 0;
  /// Writes a picture of the state into a file. `time` is in the user's units. Fails if the fields cannot be computed.
  /// By default writes nothing.
  virtual mechanics::Status write_frame(const std::filesystem::path&, double /*time*/, const State&, Workspace&) {
    return {};
  }
  /// The rows of the table of shapes for this state, one for each point; `time` is in the user's units.
  virtual std::vector<std::vector<double>> shape(double /*time*/, const State&) const { return {}; }
  /// Adds the counters of the model to the statistics. `workspace` is the part of the method's workspace that belongs
  /// to the system; null if the method's workspace has no such part.
  virtual void report(const mechanics::Counters&, const Workspace* /*workspace*/, io::Manifest::Model&) const {}

 protected:
  using RunnableModel::RunnableModel;
};

}  // namespace pseudorigid::app
