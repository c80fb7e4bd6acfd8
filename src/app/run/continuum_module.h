#pragma once
/// Interface of the library libpseudorigid-continuum to the program, which opens it when a scene needs finite elements
/// (app/commands/open_continuum.h). It has one function for the program, and takes all else from it.

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "app/ranks/ranks.h"
#include "app/run/run_context.h"

namespace pseudorigid::app {

/// The library cannot be opened, and why.
struct NoContinuum : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ContinuumModule {
  ModelOutcome (*run)(const RunContext& context);
  std::map<std::string, std::string> (*libraries)();  ///< name → version, for the manifest
  std::string_view (*instructions)();                 ///< of its kernels. Throws mechanics::NoKernels.
  /// Starts MPI, which ends with the object: the processes that a launcher has started.
  std::unique_ptr<Ranks> (*start_ranks)(int argc, char** argv);
};

}  // namespace pseudorigid::app

extern "C" const pseudorigid::app::ContinuumModule* pseudorigid_continuum();
