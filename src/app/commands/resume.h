#pragma once
/// Checks of a scene and of the files in a directory before a run is resumed. Some parameters may differ from the first
/// run.

#include <filesystem>
#include <vector>

#include "io/run_directory.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// The existing checkpoints of a run of the scene in the directory.
std::vector<std::filesystem::path> checkpoints(const io::RunDirectory& directory, const scene::Scene& scene);

/// Sets the number of samples of a resumed scene, so that the interval between samples remains that of the earlier run.
/// Time/End may be later than in the earlier run. Throws UserError if it is earlier, or if it is not a multiple of the
/// interval. If there is no checkpoint, the scene does not change.
void keep_sampling(scene::Scene& scene, const io::RunDirectory& directory);

/// Checks that every checkpoint in the directory is readable and belongs to this scene. Throws a UserError that names
/// the entries that differ.
void require_same_scene(const io::RunDirectory& directory, const scene::Scene& scene);

/// Throws UserError if a file that the resumed run appends to is damaged. The file is a list of pictures, or a table. A
/// table is damaged if it has fewer samples than its checkpoint, or text in place of numbers. Call this function before
/// writing to any of the files.
void require_sound_files(const io::RunDirectory& directory, const scene::Scene& scene, const scene::Needs& needs);

}  // namespace pseudorigid::app
