#pragma once
/// The discretisation error of a run, estimated by a companion run on another discretisation (scene/discretization.h)
/// with the same method and step, so that time errors cancel (analysis/space_error.h). The motion of the companion goes
/// on to the comparison, for the errors of numbers that are read off the motion.
///
/// Counters: estimated_space_error (largest entry of Q), relative_space_error (|Q − Q'|/|Q|), companion_degree,
/// companion_work, of finite elements companion_refinements.

#include <functional>
#include <string>
#include <string_view>

#include "app/search/continuum_run.h"

namespace pseudorigid::app {

/// A discretisation and its companion.
struct CompanionPair {
  std::string_view model;
  double resolution, resolution_of_companion;
  std::string companion;  ///< in words
  double rate;            ///< assumed rate at which the error of Q falls; errors of other numbers fall at least as fast
  double least_rate;
};

/// A run on a discretisation or on its companion, with a stepping that is known of the companion alone.
using RunOfPair = std::function<ModelOutcome(const RunContext& context, bool is_companion,
                                             const std::optional<Stepping>& stepping, DeformationTrace* trace)>;

/// Both, the companion without files and messages.
ModelOutcome run_with_companion(const RunContext& context, const CompanionPair& pair, const RunOfPair& run);

/// The scene's fixed discretisation, and its companion if the scene needs it.
ModelOutcome run_with_estimate(const RunContext& context, const ContinuumRun& run);

/// Results of the comparison for a motion at another resolution.
analysis::OtherResolution other_resolution(const DeformationTrace& trace, double resolution, double resolution_of_trace,
                                           double least_rate, const RunContext& context);

}  // namespace pseudorigid::app
