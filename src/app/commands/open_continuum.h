#pragma once
/// The library of the finite elements is opened by the program, so that deal.II, MPI and PETSc are in a process only if
/// a scene needs them.

#include "app/run/continuum_module.h"

namespace pseudorigid::app {

/// It lies where it was built or installed, as seen from the directory of the executable. Throws NoContinuum without
/// it, std::system_error if its libraries find no room.
const ContinuumModule* open_continuum();

}  // namespace pseudorigid::app
