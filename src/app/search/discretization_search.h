#pragma once
/// Search for the cheapest discretisation whose estimated error in space is within Continuum/Tolerance.
///
/// The program runs the scene on discretisations of increasing resolution, which are called the ladder
/// (scene/discretization.h). Let Q be the affine part of the motion, a 3×3 matrix. The differences of Q between
/// successive runs give the error of the last run and predict the error of the next run (analysis/space_error.h). If
/// the predicted error of a run is at most twice the tolerance, the run writes its results. The last run of the ladder
/// also writes its results. The other runs only give their history of Q, which has Q at each sample. If the error that
/// is estimated after a run exceeds the tolerance, the search continues on the next discretisation of the ladder. The
/// next run that writes its results then replaces the files. After two successive runs that end early, the second
/// discretisation is run again and writes its results. The search ends if a run that writes its results ends early.
///
/// Time errors must be much smaller than errors in space. A run that writes its results finds its own method and step.
/// Its tolerance of the time error is the smaller of Time/Tolerance and a twentieth of Continuum/Tolerance. The first
/// run that does not write finds its method and step for a twentieth of Continuum/Tolerance. Later runs that do not
/// write use the method of the first run that reached its end. Their step h is inversely proportional to the resolution
/// N (scene/discretization.h). The highest frequencies ω of Q, which come from shear fronts, are proportional to N. The
/// product hω, which determines the time error, therefore remains constant. If the scene gives the step, all runs use
/// this step and have the same time error.
///
/// No decision depends on the clock, so all ranks of a parallel run make the same decisions. A checkpoint contains the
/// errors and the last two histories of Q. A resumed search therefore does not repeat the runs, and a resumed final run
/// does not repeat the search.
///
/// The run that wrote the results has the counters degree, refinements and work (silent_run.h). Its counter
/// estimated_space_error is the largest error of an entry of Q, and relative_space_error is the error relative to |Q|.
/// If fewer than two runs reached their end, these two errors are missing. The counter search_work is the work of all
/// other runs. The counter search_runs is the number of other discretisations with a run that did not end early.

#include "analysis/space_error.h"
#include "app/search/continuum_run.h"
#include "io/checkpoint.h"

namespace pseudorigid::app {

/// The state of a search: its position in the ladder, and the errors of the earlier runs.
class DiscretizationSearch {
 public:
  static constexpr const char* checkpoint_name = "discretization";

  /// Prepares the search. If the context resumes an earlier run, loads the state of the search from its checkpoint, if
  /// there is one. In a new run, ends the ladder before the first discretisation that does not fit in the memory.
  /// Collective.
  DiscretizationSearch(const RunContext& context, ContinuumRun run);
  /// Runs the search. Returns the outcome of the run that wrote the results, or of an interrupted run. Collective.
  ModelOutcome run();

 private:
  const scene::Discretization& rung() const { return ladder_[position_]; }
  bool is_last() const { return position_ + 1 == ladder_.size(); }
  /// True if the present run writes its results. This is the case if the run is final or the last of the ladder, or if
  /// its predicted error is at most twice the tolerance.
  bool writes() const;
  /// Runs the present discretisation. `trace` receives its history of Q.
  ModelOutcome run_rung(DeformationTrace& trace);
  /// Method and step of a run that does not write results. Empty if no run has reached its end yet, because the run
  /// then finds its own method and step.
  std::optional<Stepping> silent_stepping() const;
  /// Adds the present run to `errors_`, and stores its method, step and history of Q. If the run ended early, only
  /// counts the failure.
  void note(const ModelOutcome& outcome, DeformationTrace trace);
  /// True if the present run is the final one: no further discretisation is tried. A final run that has not written its
  /// results is repeated.
  bool settles() const;
  /// Adds the counters of the search to the outcome, and logs the estimated error. Also adds the history of Q of the
  /// previous run that reached its end. If fewer than two runs have reached their end, adds only the counters without
  /// the two errors.
  void report(ModelOutcome& outcome) const;
  // The next three functions are collective.
  // `start_afresh` prepares the next run of the search. `load` reads the state of the search from its checkpoint, if
  // there is one, and `save` writes it.
  void start_afresh() const;
  void load();
  void save() const;
  // The next three functions do not communicate between the ranks.

  /// Restores the state of the search from a checkpoint.
  void take(const io::Checkpoint& c);
  void write_checkpoint() const;
  /// True on the first rank of a single run. A run of a sweep does not write a checkpoint.
  bool keeps_states() const { return context_.ranks->is_first() && context_.scene.sweep.empty(); }

  const RunContext& context_;
  ContinuumRun run_;
  scene::Scene written_scene_, silent_scene_;  ///< scene of the runs that write results, and of the other runs
  std::vector<scene::Discretization> ladder_;

  // The checkpoint contains these members, the length of ladder_, and the scene of the run.
  std::size_t position_ = 0;  ///< index of the present run in the ladder
  bool settled_ = false;      ///< true if the present run is the final one and writes the results
  int n_failures_ = 0;        ///< number of successive runs, up to the last one, that ended early
  analysis::SpaceErrorLadder errors_;
  /// Factor that converts the largest error of an entry of Q to the relative error. Let Q' be the matrix of the
  /// previous run that reached its end. The factor is max |Q − Q'|/|Q| divided by max |Q_ij − Q'_ij|, with the maxima
  /// over the samples (app/run/deformation_trace.h). The factor is 0 for the first run, and if Q = Q'.
  double relative_to_largest_ = 0;
  DeformationTrace trace_;                  ///< history of Q in the last run that reached its end
  DeformationTrace trace_before_;           ///< history of Q in the last but one run that reached its end
  std::optional<Stepping> first_stepping_;  ///< method and step of the first run that reached its end
  double first_resolution_ = 0,
         search_work_ = 0;  ///< resolution of the first run that reached its end; work of all runs but the final one
};

}  // namespace pseudorigid::app
