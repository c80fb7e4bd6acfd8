#pragma once
/// Which parameters may differ between a run and its resumption.

#include <filesystem>
#include <vector>

#include "io/run_directory.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// The checkpoints that a run of the scene has left in the directory.
std::vector<std::filesystem::path> checkpoints(const io::RunDirectory& directory, const scene::Scene& scene);

/// Gives a resumed scene, perhaps with a later Time/End, the number of samples that keeps the distance between samples
/// of the run in the directory. UserError if the end is not a whole number of intervals, or an earlier one. Without a
/// checkpoint the scene does not change.
void keep_sampling(scene::Scene& scene, const io::RunDirectory& directory);

/// Every checkpoint in the directory can be read and belongs to this scene: UserError names the entries that differ.
void require_same_scene(const io::RunDirectory& directory, const scene::Scene& scene);

/// UserError if a file that the resumed run appends to is damaged. It may be a list of pictures, or a table with fewer
/// samples than its checkpoint or with text in place of numbers. Call this before writing to any of them.
void require_sound_files(const io::RunDirectory& directory, const scene::Scene& scene, const scene::Needs& needs);

}  // namespace pseudorigid::app
