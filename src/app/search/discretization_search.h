#pragma once
/// The cheapest discretisation whose estimated error in space meets Continuum/Tolerance.
///
/// The scene is run on the ladder of scene/discretization.h from its coarsest member on. The differences of Q between
/// successive runs give the error of the last one and predict that of the next (analysis/space_error.h). A run that is
/// predicted to meet the tolerance writes its results as it goes; the others are run for their trace alone. If the
/// estimate that the run itself brings does not confirm the prediction, the search goes on, and the files are replaced.
///
/// Time errors must not be taken for errors in space. A run that writes has the smaller of Time/Tolerance and
/// a twentieth of Continuum/Tolerance, and finds its own method and step. Of the others the first finds them for that
/// twentieth; the next take over its method, and its step in inverse proportion to the resolution N: the highest
/// frequencies that a shear front carries into Q are those of the resolution, so hω stays as it was. A step that the
/// scene gives is taken as it is, and its error is common to all runs.
///
/// Nothing depends on the clock, so all ranks of a parallel run take the same way. The results of each run are kept in
/// a checkpoint of their own, so that a resumed search repeats no run, and a resumed run no search.
///
/// Counters: degree, refinements, estimated_space_error, relative_space_error, work (of the run that wrote), and of all
/// others search_runs and search_work.

#include "analysis/space_error.h"
#include "app/search/continuum_run.h"
#include "io/checkpoint.h"

namespace pseudorigid::app {

class DiscretizationSearch {
 public:
  static constexpr const char* checkpoint_name = "discretization";

  DiscretizationSearch(const RunContext& context, ContinuumRun run);
  ModelOutcome run();

 private:
  const scene::Discretization& rung() const { return ladder_[position_]; }
  bool is_last() const { return position_ + 1 == ladder_.size(); }
  bool writes() const;
  ModelOutcome run_rung(DeformationTrace& trace);
  std::optional<Stepping> silent_stepping() const;
  void note(const ModelOutcome& outcome, DeformationTrace trace);
  bool settles() const;
  void report(ModelOutcome& outcome) const;
  // Collective.
  void start_afresh() const;
  void load();
  void save() const;
  // The number for one rank.
  void take(const io::Checkpoint& c);
  void write_checkpoint() const;
  /// On the first rank; sweeps keep none.
  bool keeps_states() const { return context_.ranks->is_first() && context_.scene.sweep.empty(); }

  const RunContext& context_;
  ContinuumRun run_;
  scene::Scene written_scene_, silent_scene_;  ///< the scene with the tolerances of time that the search needs
  std::vector<scene::Discretization> ladder_;

  // Contents of the checkpoint.
  std::size_t position_ = 0;  ///< of the run in hand
  bool settled_ = false;      ///< the present run is final and its error is known, so it is written
  int n_failures_ = 0;        ///< successive runs that ended early, before the present one
  analysis::SpaceErrorLadder errors_;
  double relative_to_largest_ = 0;  ///< |Q − Q'|/|Q| over the largest entry of the last difference
  DeformationTrace trace_;          ///< the last run that reached its end
  DeformationTrace trace_before_;   ///< of the last but one
  std::optional<Stepping> first_stepping_;
  double first_resolution_ = 0, search_work_ = 0;
};

}  // namespace pseudorigid::app
