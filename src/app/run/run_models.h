#pragma once
/// Functions that run the model of a scene, one for each kind of model.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_reduced(const RunContext& context);

ModelOutcome run_polynomial(const RunContext& context);

/// Runs the system that the scene names, a row of the table in systems/table.h.
ModelOutcome run_system(const RunContext& context);

/// This function is defined only in libpseudorigid-continuum, which links deal.II (continuum_module.h).
ModelOutcome run_continuum(const RunContext& context);

}  // namespace pseudorigid::app
