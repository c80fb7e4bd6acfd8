#pragma once
/// Interface between the program and the library libpseudorigid-continuum. The program opens the library if a scene
/// needs finite elements (app/commands/open_continuum.h), and calls its function `pseudorigid_continuum`. This function
/// returns a table of further functions.

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "app/ranks/ranks.h"
#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Exception that is thrown if the library cannot be opened. Its text is the reason.
struct NoContinuum : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The functions of the library.
struct ContinuumModule {
  ModelOutcome (*run)(const RunContext& context);     ///< runs the finite-element model; collective
  std::map<std::string, std::string> (*libraries)();  ///< versions of deal.II and, if used, CHOLMOD by name
  /// Returns the SIMD instructions of the kernels. Throws mechanics::NoKernels if the processor cannot run the kernels,
  /// or if the requested build of the kernels does not exist.
  std::string_view (*instructions)();
  /// Starts MPI, and returns the processes that a launcher, for example mpirun, has started. The destructor of the
  /// returned object ends MPI.
  std::unique_ptr<Ranks> (*start_ranks)(int argc, char** argv);
};

}  // namespace pseudorigid::app

/// The only function of the library that the program finds by its name. It returns the table of the other functions,
/// which is valid until the program ends.
extern "C" const pseudorigid::app::ContinuumModule* pseudorigid_continuum();
