#pragma once
/// PETSc and SLEPc, and with them MPI, are started when first needed: a run without them starts 0.3 s sooner.

namespace pseudorigid::continuum {

/// Starts them for the rest of the process, unless that has been done. PETSc takes the options of the environment
/// variable PETSC_OPTIONS; signals remain the program's own.
void start_petsc();

}  // namespace pseudorigid::continuum
