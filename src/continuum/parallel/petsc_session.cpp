#include "continuum/parallel/petsc_session.h"

#include <deal.II/base/config.h>

#ifndef DEAL_II_WITH_PETSC
#error "the continuum needs a deal.II with PETSc (the package petsc-dev, found when deal.II is configured)"
#endif
#include <petscsys.h>

namespace pseudorigid::continuum {

void start_petsc() {
  if (PetscInitializeCalled) return;
  PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
  struct Session {
    Session() { PetscInitialize(nullptr, nullptr, nullptr, nullptr); }
    ~Session() { PetscFinalize(); }
  };
  static const Session session;
}

}  // namespace pseudorigid::continuum
