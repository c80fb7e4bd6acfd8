#!/usr/bin/python3
"""The time of a step of the nonlinear release over the number of unknowns.

    benchmarks/release_sizes.py build/release/bin/pseudorigid > release_sizes.csv

The release of benchmarks/ball_release.py with 40 steps of symmetric-4, elements of degree 4. The step without refinement is 0.74 of
the limit of stability, and halves with each refinement. The tolerance of the constraint is 1e-8. Columns: degree, refinements,
unknowns, seconds_step (wall time of the one thread over the number of steps, with the preconditioners and the starting steps),
gram_iterations (of a step).
"""
import pathlib
import sys
import tempfile

from ball_release import Release

N_STEPS, DEGREE = 40, 4
STEPS = (0.01, 0.005, 0.0025, 0.00125)  # by refinements


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    print("degree,refinements,unknowns,seconds_step,gram_iterations", flush=True)
    for refinements, step in enumerate(STEPS):
        with tempfile.TemporaryDirectory() as folder:
            release = Release(pathlib.Path(sys.argv[1]).resolve(), folder, False)
            model = release.run_with({"Continuum/Degree": DEGREE, "Continuum/Refinements": refinements, "Time/Method": "symmetric-4",
                                      "Time/Step": step, "Time/End": N_STEPS * step, "Time/Constraint tolerance": 1e-8,
                                      "Output/Samples": 1, "Continuum/Error estimate": "none"}).manifest["models"]["continuum"]
        print(DEGREE, refinements, int(model["counters"]["unknowns"]), f"{model['timers']['run'] / N_STEPS:.4g}",
              f"{model['counters']['gram_iterations'] / N_STEPS:.1f}", sep=",", flush=True)


if __name__ == "__main__":
    main()
