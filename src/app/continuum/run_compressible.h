#pragma once
/// The compressible continuum, in a source file of its own, which compiles beside that of the incompressible one.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_compressible(const RunContext& context);

}  // namespace pseudorigid::app
