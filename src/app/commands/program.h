#pragma once
/// The entry point of the program, and the parts of the program that differ between executables.

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/models/ball_models.h"
#include "app/ranks/ranks.h"
#include "app/run/continuum_module.h"

namespace pseudorigid::app {

/// The parts of the program that differ between executables.
struct Executable {
  std::vector<BallModel> models;                   ///< all models that scenes may name, in the order of the catalogue
  std::map<std::string, std::string> libraries{};  ///< maps the name of a library to its version, for the manifest
  /// Returns the SIMD instructions of the kernels, or "" if there are no kernels. Throws mechanics::NoKernels if the
  /// processor cannot run the kernels, or if the requested build of the kernels does not exist.
  std::string_view (*instructions)() = [] { return std::string_view(); };
  /// Opens the finite-element library and returns its functions. Throws NoContinuum if the library cannot be opened,
  /// and std::system_error if the limit of the address space is too low.
  const ContinuumModule* (*open_continuum)() = []() -> const ContinuumModule* {
    throw NoContinuum("this program has none");
  };
  const Ranks* ranks = &one_rank();  ///< processes that share the run; by default this process alone

  /// The model with this description, which must be one of `models`.
  const BallModel& model(const scene::ModelDescription& description) const {
    return *std::ranges::find(models, description.name, [](const BallModel& m) { return m.description.name; });
  }
};

/// Executes the command line and returns the exit code: 0 if the command is done, 2 for wrong input, and 1 for a defect
/// of the program. The code is 3 if the run stopped early, or if a resource such as memory or disk space is exhausted.
/// Exceptions do not leave this function.
int run_program(int argc, char** argv, const Executable& executable);

}  // namespace pseudorigid::app
