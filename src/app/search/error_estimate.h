#pragma once
/// Estimate of the discretisation error of a run by a companion run on another discretisation (scene/discretization.h).
/// Both runs have the same method and step, so that their time errors cancel (analysis/space_error.h). The comparison
/// of the models uses the motion of the companion to estimate the errors of other numbers.
///
/// The counters are estimated_space_error (largest entry of Q), relative_space_error (|Q − Q'|/|Q|), companion_degree,
/// companion_work, and for finite elements companion_refinements.

#include <functional>
#include <string>
#include <string_view>

#include "app/search/continuum_run.h"

namespace pseudorigid::app {

/// Data of a discretisation and its companion.
struct CompanionPair {
  std::string_view model;
  double resolution, resolution_of_companion;
  std::string companion;  ///< the companion in words
  double rate;            ///< assumed rate p for the error of Q; `least_rate` is assumed for other numbers
  double least_rate;
};

/// Runs the scene on the discretisation or on its companion. `stepping` is empty for the former. The companion gets the
/// method and step of the former.
using RunOfPair = std::function<ModelOutcome(const RunContext& context, bool is_companion,
                                             const std::optional<Stepping>& stepping, DeformationTrace* trace)>;

/// Runs the scene on the discretisation and then on its companion. The companion does not write files or messages.
ModelOutcome run_with_companion(const RunContext& context, const CompanionPair& pair, const RunOfPair& run);

/// Runs the scene's fixed discretisation, and its companion if the scene needs it.
ModelOutcome run_with_estimate(const RunContext& context, const ContinuumRun& run);

/// `trace` as a table, with the factor that converts its difference from the run to an error of the run. The comparison
/// of the models uses both.
analysis::OtherResolution other_resolution(const DeformationTrace& trace, double resolution, double resolution_of_trace,
                                           double least_rate, const RunContext& context);

}  // namespace pseudorigid::app
