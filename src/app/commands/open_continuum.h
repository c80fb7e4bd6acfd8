#pragma once
/// The library of the finite elements is opened by the program, so that deal.II, MPI and PETSc are in a process only if
/// a scene needs them.

#include "app/run/continuum_module.h"

namespace pseudorigid::app {

/// Its place relative to the directory of the executable is that of the build or of the installation. Throws
/// NoContinuum without it, std::system_error if its libraries find no room.
const ContinuumModule* open_continuum();

}  // namespace pseudorigid::app
