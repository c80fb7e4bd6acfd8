#pragma once
/// Opening of the finite-element library. A process loads deal.II, MPI and PETSc only if its scene needs finite
/// elements.

#include "app/run/continuum_module.h"

namespace pseudorigid::app {

/// Opens the library at its path relative to the executable, in the build or the installation. Returns the functions of
/// the library. Throws NoContinuum if the library does not exist or cannot be opened, and std::system_error if the
/// limit of the address space is too low.
const ContinuumModule* open_continuum();

}  // namespace pseudorigid::app
