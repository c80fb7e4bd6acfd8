#pragma once
/// The start of PETSc and SLEPc, which also start MPI. The program starts them when it first needs them, because a run
/// without them starts 0.3 s sooner.

namespace pseudorigid::continuum {

/// Starts PETSc and SLEPc for the rest of the process. Later calls have no effect. PETSc reads options from the
/// environment variable PETSC_OPTIONS. The program keeps its own handlers of signals.
void start_petsc();

}  // namespace pseudorigid::continuum
