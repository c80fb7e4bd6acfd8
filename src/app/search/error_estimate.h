#pragma once
/// Estimate of the discretisation error of a run by a companion run on another discretisation (scene/discretization.h).
/// Both runs have the same method and step, so that their time errors cancel (analysis/space_error.h). The companion
/// has a shorter step only if this step exceeds 0.8 of the companion's stability limit. The comparison of the models
/// uses the motion of the companion to estimate the error of the frequency.
///
/// Q is the affine part of the motion, a 3×3 matrix. The counters are estimated_space_error, the largest error of an
/// entry of Q, and relative_space_error, the error relative to |Q|. Further counters are companion_degree,
/// companion_work, and for finite elements companion_refinements.

#include <functional>
#include <string>
#include <string_view>

#include "app/search/continuum_run.h"

namespace pseudorigid::app {

/// A discretisation and its companion.
struct CompanionPair {
  std::string_view model;                      ///< name of the model for messages
  double resolution, resolution_of_companion;  ///< resolution of each run, N in analysis/space_error.h
  std::string companion;                       ///< description of the companion for messages
  double rate;  ///< rate p at which the error of Q decreases with the resolution (analysis/space_error.h)
  /// Rate for the error of the frequency. A smaller rate gives larger estimates, so this rate is a lower bound of the
  /// usual rates.
  double least_rate;
};

/// Runs the scene on the discretisation, or on the companion if `is_companion` is true. For the discretisation,
/// `stepping` is empty. For the companion, `stepping` is the method and step of the run on the discretisation. `trace`
/// receives the history of Q.
using RunOfPair = std::function<ModelOutcome(const RunContext& context, bool is_companion,
                                             const std::optional<Stepping>& stepping, DeformationTrace* trace)>;

/// Runs the scene on the discretisation, and then on its companion if the first run has finished. The companion does
/// not write files or messages. Returns the outcome of the first run with the estimate of its error. If the companion
/// fails, a warning replaces the estimate. If the companion is interrupted, the outcome is `interrupted`.
ModelOutcome run_with_companion(const RunContext& context, const CompanionPair& pair, const RunOfPair& run);

/// Runs the scene on its fixed discretisation, and also on the companion if the scene requests error estimates. The
/// scene must set degree and refinements. Returns the outcome of the first run. Collective.
ModelOutcome run_with_estimate(const RunContext& context, const ContinuumRun& run);

/// Returns the history `trace` of Q as a table, with a factor. The factor converts the difference between the run and
/// `trace` to an error of the run. It assumes that this error decreases with the resolution at the rate `least_rate`.
/// `resolution` is the resolution of the run. The comparison of the models uses the table and the factor.
analysis::OtherResolution other_resolution(const DeformationTrace& trace, double resolution, double resolution_of_trace,
                                           double least_rate, const RunContext& context);

}  // namespace pseudorigid::app
