#pragma once
/// Opens the library of the finite elements. A process then has deal.II, MPI and PETSc only if a scene needs them.

#include "app/run/continuum_module.h"

namespace pseudorigid::app {

/// Opens the library at its path in the build or the installation, relative to the executable. Throws NoContinuum if
/// the library does not exist or cannot be opened, std::system_error if the address space is too small.
const ContinuumModule* open_continuum();

}  // namespace pseudorigid::app
