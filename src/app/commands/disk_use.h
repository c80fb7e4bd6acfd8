#pragma once
/// Disk space that the files of a run will take, estimated before it begins, and free disk space.
///
/// A number of a table takes some 20 bytes, one of a picture, compressed, some 5. Both are measured for motions without
/// symmetry; columns of zeros take a tenth of that, so a symmetric motion takes less.

#include "io/run_directory.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Adds a line on tables, pictures and checkpoints, and a warning if they exceed the space on the disk of the
/// directory, which need not exist yet. It does not refuse the run: the estimate may be too high, and --resume
/// continues a run that a full disk has stopped.
void describe_disk_use(const scene::Scene& scene, const io::RunDirectory& directory, scene::Needs& needs);

/// UserError if the disk is too small for the samples of a sweep, which are kept in addition to its rows if the scene
/// requests it.
void require_room_for_trajectories(const scene::Scene& scene, const scene::Origins& origins,
                                   const io::RunDirectory& directory);

}  // namespace pseudorigid::app
