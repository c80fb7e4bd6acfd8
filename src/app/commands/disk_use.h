#pragma once
/// Estimate of the disk space for the files of a run before the run begins, and comparison with the free disk space.
///
/// A number in a table takes about 20 bytes, and a number in a compressed picture about 5 bytes. These sizes are
/// measured for motions without symmetry. A column of zeros takes a tenth of the space, so a symmetric motion needs
/// less.

#include "io/run_directory.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Adds a line to needs.needed: the space for tables, pictures and checkpoints, and the free space. If the space
/// exceeds the free space on the disk of the results directory, also adds a warning to needs.warnings. The directory
/// need not exist yet. The run is not refused, because the estimate may be too high, and --resume continues a run that
/// a full disk has stopped. If the number of rows depends on the motion, the line states this in place of the size, and
/// there is no warning. If the operating system does not give the free space, the line omits it, and there is no
/// warning.
void describe_disk_use(const scene::Scene& scene, const io::RunDirectory& directory, scene::Needs& needs);

/// Throws UserError if the free disk space is too small for trajectories.csv with the samples of all runs of a sweep.
/// Each number counts with its largest size of 25 bytes. Does nothing if the scene is not a sweep, or if
/// Sweep/Trajectories is false. Also does nothing if the free space is not known.
void require_room_for_trajectories(const scene::Scene& scene, const scene::Origins& origins,
                                   const io::RunDirectory& directory);

}  // namespace pseudorigid::app
