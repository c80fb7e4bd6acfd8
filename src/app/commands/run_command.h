#pragma once
/// The command `pseudorigid run`. It runs the models of a scene one after the other, compares their motions, and writes
/// the manifest and the log.

#include <string>
#include <vector>

#include "app/commands/command_line.h"
#include "app/commands/program.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Runs a scene. `raw` is the scene before scene::validate, and `read` is the validated scene; the runs of a sweep are
/// validated one by one. Returns the exit code. After the directory is prepared, exceptions are written to the log.
int run_scene(const scene::ReadScene& raw, const scene::ReadScene& read, const Options& options,
              const std::vector<std::string>& command, const Executable& executable);

/// Work of every rank except the first. The rank joins the runs of the finite-element model that the first rank begins,
/// and writes its pieces of the pictures. The rank prints nothing. Returns the exit code.
int assist_scene(const scene::ReadScene& read, const Options& options, const Executable& executable);

}  // namespace pseudorigid::app
