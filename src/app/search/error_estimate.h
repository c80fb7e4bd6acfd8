#pragma once
/// Estimate of the discretisation error of a run by a companion run on another discretisation (scene/discretization.h).
/// Both runs have the same method and step, so that their time errors cancel (analysis/space_error.h). The companion
/// has a shorter step only if this step exceeds 0.8 of the companion's stability limit. The comparison of the models
/// uses the motion of the companion to estimate the error of the frequency. If the time error of the run is not known,
/// a run with more steps estimates it (time_error.h).
///
/// Q is the affine part of the motion, a 3×3 matrix. The counters are estimated_space_error, the largest error of an
/// entry of Q, and relative_space_error, the error relative to |Q|. Further counters are work and companion_work, the
/// costs of both runs (silent_run.h). The discretisation of the companion has the counters companion_degree, and for
/// finite elements companion_refinements. A caller of run_with_companion adds these two counters itself.

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
/// `stepping` is empty, and the run finds its method and step. For the companion, `stepping` has the method and step of
/// the first run. `trace` receives the history of Q, which has Q at each sample.
using RunOfPair = std::function<ModelOutcome(const RunContext& context, bool is_companion,
                                             const std::optional<Stepping>& stepping, DeformationTrace* trace)>;

/// Runs the scene on the discretisation, and then on its companion if the first run has finished. The companion does
/// not write files or messages. Returns the outcome of the first run with the estimate of its error and the motion of
/// the companion. If the companion fails, the program logs a warning and does not estimate the error. If the companion
/// is interrupted, the outcome is `interrupted`.
ModelOutcome run_with_companion(const RunContext& context, const CompanionPair& pair, const RunOfPair& run);

/// Runs the scene on its fixed discretisation, and also on the companion if the scene requests error estimates
/// (`needs.companion`). The scene must set degree and refinements. Returns the outcome of the run on the fixed
/// discretisation. Collective.
ModelOutcome run_with_estimate(const RunContext& context, const ContinuumRun& run);

/// Data for the comparison of the models: the history `trace` of Q as a table, and a factor. Consider a quantity of a
/// run with the given resolution. The factor times its difference from the quantity of `trace` estimates its error. The
/// factor assumes that this error decreases with the resolution at the rate `least_rate`.
analysis::OtherResolution other_resolution(const DeformationTrace& trace, double resolution, double resolution_of_trace,
                                           double least_rate, const RunContext& context);

}  // namespace pseudorigid::app
