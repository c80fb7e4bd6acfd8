#pragma once
/// Runs of one polynomial scene with several degrees.
///
/// The degrees that the scene lists run one after the other. The run of the last degree represents the model and writes
/// polynomial.csv. The run of any other degree N writes polynomial-<N>.csv, and is compared with the reference as a
/// further model.
///
/// If the scene sets Polynomial/Degree to auto, the program searches for the degree. It runs the scene with the degrees
/// N = 1, 3, 5, …. The only result of these runs is the affine part Q of the motion, a 3×3 matrix, at the samples. In
/// motions with the symmetry of an octant, an even degree is equivalent to the next lower odd degree. The differences
/// of Q between successive runs give the error of the last run (analysis/space_error.h with N as the resolution). From
/// the third degree on, the search ends if the error is at most Polynomial/Tolerance, if the run fails, or at the
/// largest degree. The last degree of the search runs again and writes the results. If its error exceeds the tolerance,
/// the program logs a warning. A checkpoint contains this degree, so that a resumed run does not repeat the search. If
/// the search was interrupted, a resumed run starts it again. The tolerance of the time error is at most a twentieth of
/// Polynomial/Tolerance.
///
/// A body whose degree the scene gives can be the reference of a comparison. If the scene then requests error
/// estimates, a companion run of another degree estimates the error of this body (search/error_estimate.h).
///
/// A search or a companion run adds the counters estimated_space_error (the largest error of an entry of Q) and
/// relative_space_error (the error relative to the Frobenius norm of Q). A search also adds search_runs, the number of
/// its runs, and search_work, their cost (search/silent_run.h). If a resumed run does not repeat the search,
/// search_runs is 0. A companion run also adds companion_degree and companion_work.

#include <functional>

#include "app/polynomial/body_setup.h"

namespace pseudorigid::app {

/// A function that runs the scene with one polynomial body.
using PolynomialRun = std::function<ModelOutcome(const RunContext& context, const PolynomialTask& task)>;

/// Name of the checkpoint that contains the degree chosen by a search.
inline constexpr const char* degree_checkpoint_name = "degree";

/// Runs a scene that lists one or several degrees, and returns the outcome of the last degree. Its member `of_rungs`
/// has the statistics of the other degrees. If another degree fails, logs a warning and continues. After an interrupt,
/// returns the outcome of the interrupted run at once.
ModelOutcome run_listed_degrees(const RunContext& context, const PolynomialRun& run);

/// Runs a scene with Polynomial/Degree = auto. Returns the outcome of the run with the chosen degree, or of an
/// interrupted search.
ModelOutcome run_degree_search(const RunContext& context, const PolynomialRun& run);

}  // namespace pseudorigid::app
