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
/// the first run of a sweep, whose other runs are validated when they begin. Until the results directory and the log
/// are ready, exceptions leave this function. Later exceptions are written to the log and determine the exit code.
int run_scene(const scene::ReadScene& raw, const scene::ReadScene& read, const Options& options,
              const std::vector<std::string>& command, const Executable& executable);

/// Work of every rank except the first. The rank joins the runs of the finite-element model that the first rank begins,
/// and writes its pieces of the pictures. The rank prints nothing. Returns the exit code.
int assist_scene(const scene::ReadScene& read, const Options& options, const Executable& executable);

}  // namespace pseudorigid::app
