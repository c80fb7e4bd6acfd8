#pragma once
/// Estimate of the disk space that the files of a run need, before the run begins, and the free disk space.
///
/// A number in a table takes about 20 bytes, and a number in a compressed picture about 5. Both are measured for
/// motions without symmetry. Columns of zeros take a tenth of this, so a symmetric motion needs less.

#include "io/run_directory.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Adds a line on tables, pictures and checkpoints. If they exceed the free space on the disk of the directory, it also
/// adds a warning. The directory need not exist yet. The run is not refused, because the estimate may be too high, and
/// --resume continues a run that a full disk has stopped.
void describe_disk_use(const scene::Scene& scene, const io::RunDirectory& directory, scene::Needs& needs);

/// Throws UserError if the disk is too small for the samples of a sweep, which are kept if the scene requests it.
void require_room_for_trajectories(const scene::Scene& scene, const scene::Origins& origins,
                                   const io::RunDirectory& directory);

}  // namespace pseudorigid::app
