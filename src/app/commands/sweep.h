#pragma once
/// A sweep, which runs the scene for every combination of its parameters (scene/sweep.h) on several cores. The file
/// sweep.csv has a row for each run, with the columns
///
///   run, the parameters, finished (1 or 0), time (of the last sample), steps, forces (evaluations of the force),
///   estimated_time_error (0 if it is not known);
///   for the ball, if its file has the columns of Q: frequency (angular; of the component of C = QᵀQ that varies most;
///   0 if there is none) and amplitude of C, with the definitions of analysis/motion.h;
///   for every column c of the model's own CSV file except the time: the last, least and greatest value over the
///   samples in c_end, c_min, c_max. If the motion conserves c, the columns are c, with the value at the start, and
///   c_drift, the difference of the greatest and the least value.
///
/// If Sweep/Trajectories is true, the program also writes trajectories.csv (kept_trajectories.h).
///
/// The rows have the order of the runs and do not depend on the number of threads. A resumed sweep continues after the
/// last row.
///
/// Runs 8k + 1 … 8k + 8 (k = 0, 1, …) are computed together in SIMD lanes if possible (app/reduced/reduced_in_lanes.h).
/// Otherwise each of these runs is computed separately, like a single run. Runs with finite elements have separate
/// processes (row_processes.h). If the scene has several models, each run compares the models, and sweep.csv has the
/// columns of compared_runs.h. For sweeps of modes, Love numbers and equilibria, it has the columns of table_runs.h.

#include <optional>
#include <utility>

#include "app/commands/program.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Checks a sweep before anything is written. Does nothing without a sweep. `raw` is the scene before validation.
/// Throws UserError if a run with first or last values of the parameters is not valid. Also throws UserError if a
/// parameter is not used, has the name of another column, or changes the columns of sweep.csv. Other runs are validated
/// when they begin. A run that is then not valid ends the sweep as failed; the earlier rows remain in the file.
void check_sweep(const scene::ReadScene& raw);

/// The least and the largest ratio γ of gravity to elasticity (scene/scale_numbers.h) of the runs of a sweep of the
/// ball. In a sweep of more than 1000 runs, only some runs are evaluated. They are at most 1000 equidistant runs, and
/// the runs with first or last values of the parameters. Runs with wrong input are skipped. `raw` is the scene before
/// validation. The result is empty if there is no sweep or no self-gravity, or if the system is not the ball.
std::optional<std::pair<double, double>> gammas_of_sweep(const scene::ReadScene& raw);

/// Computes the runs of the sweep, or of its part Sweep/Part, and writes their rows. `raw` is the scene before
/// validation, and `context` is the context of the first run. The outcome is `failed` if the input of a run is wrong,
/// and `interrupted` after an interrupt. A run that stops early does not end the sweep. Its row has 0 in the column
/// finished, or for compared models in the columns m_finished of the models without all samples. Rethrows the first
/// exception of a run that is not a UserError.
ModelOutcome run_sweep(const scene::ReadScene& raw, const RunContext& context, const Executable& executable);

}  // namespace pseudorigid::app
