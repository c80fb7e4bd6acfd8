#pragma once
/// From `pseudorigid` to `pseudorigid-continuum`, which stands beside it: the process becomes the other program, with
/// the same arguments. What cannot be read a second time, a scene from a pipe, it is handed.

#include <optional>
#include <string>

#include "scene/read_scene.h"

namespace pseudorigid::app {

/// If it returns, the other program cannot be started, and errno says why.
void try_to_become_continuum_executable(char** argv);

/// With a scene that has been read and checked. Throws if it cannot be.
[[noreturn]] void become_continuum_executable(char** argv, const scene::ReadScene& read);

/// The text of the scene, if this process was handed one. It is there once.
std::optional<std::string> scene_text_handed_over();

}  // namespace pseudorigid::app
