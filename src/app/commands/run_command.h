#pragma once
/// `pseudorigid run`: the models of a scene one after the other, their comparison, manifest and log.

#include <string>
#include <vector>

#include "app/commands/command_line.h"
#include "app/commands/program.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// `read` is the scene after scene::validate, and `raw` the scene before it; the runs of a sweep are validated one by
/// one. Returns the exit code. Once the directory is ready, the log reports exceptions.
int run_scene(const scene::ReadScene& raw, const scene::ReadScene& read, const Options& options,
              const std::vector<std::string>& command, const Executable& executable);

/// The part of the other ranks: they join the runs of the finite-element model that the first rank begins, write their
/// pieces of the pictures and print nothing. Returns the exit code.
int assist_scene(const scene::ReadScene& read, const Options& options, const Executable& executable);

}  // namespace pseudorigid::app
