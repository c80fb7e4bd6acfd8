#pragma once
/// The compressible continuum, in a source file of its own, which compiles at the same time as that of the
/// incompressible one.

#include "app/search/continuum_run.h"

namespace pseudorigid::app {

ModelOutcome run_compressible(const RunContext& context, const ContinuumTask& task);

}  // namespace pseudorigid::app
