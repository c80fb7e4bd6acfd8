#pragma once
/// Functions that run a model of the ball or another system, one for each kind of model.

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Runs the pseudo-rigid model: a motion, relative or static equilibria, or Love numbers, as the scene requires.
ModelOutcome run_reduced(const RunContext& context);

/// Runs polynomial bodies, as the scene requires: a motion, modes, equilibria or Love numbers.
ModelOutcome run_polynomial(const RunContext& context);

/// Runs the system, for example a pendulum, that the scene selects from the table in systems/table.h.
ModelOutcome run_system(const RunContext& context);

/// Runs the finite-element model: a motion, modes, equilibria or Love numbers, as the scene requires. The function is
/// defined only in libpseudorigid-continuum, which links deal.II (continuum_module.h).
ModelOutcome run_continuum(const RunContext& context);

}  // namespace pseudorigid::app
