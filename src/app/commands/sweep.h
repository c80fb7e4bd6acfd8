#pragma once
/// A sweep: the scene once for every combination of its parameters (scene/sweep.h), all cores, no files but sweep.csv
/// with a row for each run:
///
///   run, the parameters, finished (1 or 0), time reached, steps, forces, estimated_time_error;
///   of the ball, frequency (of the component of C = QᵀQ that varies most, 0 if there is none) and amplitude of C, as
///   in analysis/motion.h;
///   of every column c of the model's own CSV file  c_end, c_min, c_max  over the samples, or of one that the motion
///   conserves  c  at the start and  c_drift = c_max − c_min.
///
/// If the scene asks for it, kept_trajectories.h, the samples themselves are kept as well.
///
/// Rows come in the order of the runs and do not depend on the number of threads. A resumed sweep goes on after the
/// last row.
///
/// Runs 8k + 1 … 8k + 8 move together in SIMD lanes if they can (app/reduced/reduced_in_lanes.h). The others run one
/// by one, each the whole path of a single run. Runs with finite elements have processes of their own
/// (row_processes.h). Several models are compared: compared_runs.h has the columns.

#include "app/commands/program.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// `raw` is the scene as it was read, before validation, which belongs to each run. Throws UserError, before anything
/// is written, if a combination of first and last values is not a scene that can run. Others are judged as their turn
/// comes: one that cannot run ends the sweep as failed, and the rows before it are kept.
void check_sweep(const scene::ReadScene& raw);

/// `context` is that of the first run.
ModelOutcome run_sweep(const scene::ReadScene& raw, const RunContext& context, const Executable& executable,
                       bool shows_progress);

}  // namespace pseudorigid::app
