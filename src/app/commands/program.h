#pragma once
/// The program behind both executables: `pseudorigid` (no deal.II, no MPI in the process) and `pseudorigid-continuum`,
/// which it becomes for a scene with a discretized model.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/models/catalogue.h"
#include "app/run/run_context.h"

namespace pseudorigid::app {

using RunModel = ModelOutcome (*)(const RunContext&);
/// Runs at the same time, as a sweep has many; nothing where each has to run by itself.
using RunTogether = std::optional<std::vector<ModelOutcome>> (*)(std::span<const RunContext>);

/// What an executable was linked with.
struct Executable {
  std::map<std::string_view, RunModel> models;       ///< those that it can run, by their names in the catalogue
  std::map<std::string_view, RunTogether> together;  ///< those of them that can run several times at once
  std::map<std::string, std::string> libraries;      ///< name → version, for the manifest
  /// Those that its kernels are compiled for, "" without kernels. Throws mechanics::NoKernels.
  std::string_view (*instructions)() = [] { return std::string_view(); };
  bool runs_discretized = false;  ///< it is pseudorigid-continuum
  const Ranks* ranks = &one_rank();
  const scene::Catalogue* catalogue = &program_catalogue();
};

/// Runs the command line and returns the exit code: 0 done, 2 wrong input, 3 could not go on, 1 a defect.
int run_program(int argc, char** argv, const Executable& executable);

}  // namespace pseudorigid::app
