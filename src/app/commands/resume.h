#pragma once
/// Checks of a scene and of the files in a directory before a run is resumed. The entries of the section Time and of
/// the pictures may differ from those of the earlier run, but Time/End may only be later. In a sweep, Time/End and the
/// entries of pictures may not differ.

#include <filesystem>
#include <vector>

#include "io/run_directory.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// The paths of all checkpoints in the directory: those of models, systems, sweeps and searches.
std::vector<std::filesystem::path> checkpoints(const io::RunDirectory& directory, const scene::Scene& scene);

/// Sets the number of samples of a resumed scene such that the interval between samples is that of the earlier run.
/// Time/End may be later than in the earlier run. Throws UserError if Time/End is earlier, has another sign, is not a
/// multiple of the interval, or makes more samples than a scene may set. Also throws UserError if the checkpoint or
/// used.prm is damaged. If there is no checkpoint, or if the scene is a sweep, the scene does not change.
void keep_sampling(scene::Scene& scene, const io::RunDirectory& directory);

/// Checks that every checkpoint in the directory is readable and belongs to this scene. Throws UserError if a
/// checkpoint is damaged, or if an entry has changed that must not change. The message names up to five such entries.
void require_same_scene(const io::RunDirectory& directory, const scene::Scene& scene);

/// Checks the files to which a resumed run appends, before the run writes to any of these files. Only the files of
/// models and systems with a checkpoint are checked. Throws UserError if a table of samples is missing. Also throws
/// UserError if a checkpoint, a list of pictures, a table of samples or a table of shapes is damaged. A damaged table
/// has text in place of numbers, or fewer rows than it must have. Does nothing for sweeps and for analyses other than a
/// motion.
void require_sound_files(const io::RunDirectory& directory, const scene::Scene& scene, const scene::Needs& needs);

}  // namespace pseudorigid::app
