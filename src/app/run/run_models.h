#pragma once
/// The models that a run may call for.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_reduced(const RunContext& context);

ModelOutcome run_polynomial(const RunContext& context);

/// The system of the table that the scene names.
ModelOutcome run_system(const RunContext& context);

/// Declared only in libpseudorigid-continuum, which links deal.II (continuum_module.h).
ModelOutcome run_continuum(const RunContext& context);

}  // namespace pseudorigid::app
