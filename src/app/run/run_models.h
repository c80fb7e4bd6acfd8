#pragma once
/// Functions that run the model of a scene, one for each kind of model.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_reduced(const RunContext& context);

ModelOutcome run_polynomial(const RunContext& context);

/// Runs the scene's system, which is one of the table (systems/table.h).
ModelOutcome run_system(const RunContext& context);

/// Defined only in libpseudorigid-continuum, which links deal.II (continuum_module.h).
ModelOutcome run_continuum(const RunContext& context);

}  // namespace pseudorigid::app
