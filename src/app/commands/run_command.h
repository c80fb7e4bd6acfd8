#pragma once
/// `pseudorigid run`: the models of a scene one after the other, their comparison, manifest and log.

#include <string>
#include <vector>

#include "app/commands/command_line.h"
#include "app/commands/program.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Takes a scene that scene::validate returned (in `read`), and as it was before (`raw`; the runs of a sweep are
/// validated each). Returns the exit code; an exception that is thrown once the directory is ready is said by the log.
int run_scene(const scene::ReadScene& raw, const scene::ReadScene& read, const Options& options,
              const std::vector<std::string>& command, const Executable& executable);

/// What the other ranks do meanwhile: they take part in the continuum's runs when the first begins one, write their
/// pieces of the pictures and say nothing. Returns the exit code.
int assist_scene(const scene::ReadScene& read, const Options& options, const Executable& executable);

}  // namespace pseudorigid::app
