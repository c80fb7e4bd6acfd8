#pragma once
/// The command `pseudorigid run`. It runs the models of a scene one after the other, compares their motions, and writes
/// the manifest and the log.

#include <string>
#include <vector>

#include "app/commands/command_line.h"
#include "app/commands/program.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Runs a scene and returns the exit code. `raw` is the scene before scene::validate. `read` is the validated scene, or
/// for a sweep the validated scene of its first run. The other runs of a sweep are validated when they begin. `command`
/// is the command line, for the manifest. Until the results directory and the log are ready, exceptions leave this
/// function. Later exceptions are written to the log and determine the exit code.
int run_scene(const scene::ReadScene& raw, const scene::ReadScene& read, const Options& options,
              const std::vector<std::string>& command, const Executable& executable);

/// Work of every rank except the first, while the first rank calls run_scene. The rank takes part in the runs of the
/// finite-element model that the first rank starts, and writes its own pieces of the pictures of motions. The rank does
/// not print anything. The function ends when the first rank calls ranks.of_first(false) after its run. Returns the
/// exit code.
int assist_scene(const scene::ReadScene& read, const Options& options, const Executable& executable);

}  // namespace pseudorigid::app
