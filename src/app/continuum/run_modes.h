#pragma once
/// Runs `Analysis = modes` for the finite-element model. The file modes.csv has the frequencies of small vibrations
/// about the undeformed ball at rest. If the scene requests pictures, the modes are also written as pictures.

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Computes the modes on the discretisation of the scene, which must set degree and refinements. The outcome is
/// `failed` if the computation fails, if the ball is unstable at rest, or if the mesh is too coarse for a mode. After
/// an interrupt, it is `interrupted`. In all these cases, the run does not write the file.
ModelOutcome run_modes(const RunContext& context);

}  // namespace pseudorigid::app
