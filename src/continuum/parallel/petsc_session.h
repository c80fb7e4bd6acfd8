#pragma once
/// The start of PETSc, which also starts MPI. The program starts it when it first needs it, because a run without it
/// starts 0.3 s sooner.

namespace pseudorigid::continuum {

/// Starts PETSc for the rest of the process. Later calls have no effect. PETSc reads options from the
/// environment variable PETSC_OPTIONS. The program keeps its own handlers of signals.
void start_petsc();

}  // namespace pseudorigid::continuum
