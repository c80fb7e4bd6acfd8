#pragma once
/// The program behind both executables: `pseudorigid` (no deal.II, no MPI in the process) and `pseudorigid-continuum`,
/// which it becomes for a scene that needs the finite-element ball.

#include <map>
#include <string>

#include "app/run_context.h"

namespace pseudorigid::app {

/// What an executable was linked with.
struct Executable {
  ModelOutcome (*run_continuum)(const RunContext&) = nullptr;  ///< null in `pseudorigid`
  std::map<std::string, std::string> libraries;                ///< name → version, for the manifest
  const Ranks* ranks = &one_rank();
};

/// Runs the command line and returns the exit code: 0 done, 2 wrong input, 3 could not go on, 1 a defect.
int run_program(int argc, char** argv, const Executable& executable);

}  // namespace pseudorigid::app
