#include "continuum/parallel/petsc_session.h"

#include <deal.II/base/config.h>

#ifndef DEAL_II_WITH_SLEPC
#error "the continuum needs a deal.II with SLEPc (the package slepc-dev, found when deal.II is configured)"
#endif
#include <slepcsys.h>

namespace pseudorigid::continuum {

void start_petsc() {
  if (SlepcInitializeCalled) return;
  PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
  struct Session {
    Session() { SlepcInitialize(nullptr, nullptr, nullptr, nullptr); }
    ~Session() { SlepcFinalize(); }
  };
  static const Session session;
}

}  // namespace pseudorigid::continuum
