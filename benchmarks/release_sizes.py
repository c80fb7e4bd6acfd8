#!/usr/bin/python3
"""The time of a step of the nonlinear release over the number of unknowns.

    benchmarks/release_sizes.py build/release/bin/pseudorigid > release_sizes.csv

The release of benchmarks/ball_release.py with 40 steps of symmetric-4, elements of degree 4, and of degree 6 for more than 10⁶
unknowns. The step is about 0.75 of the limit of stability. The tolerance of the constraint is 1e-8. Columns: degree, refinements,
unknowns, seconds_step (wall time of the one thread over the number of steps, with the preconditioners and the starting steps),
gram_iterations (of a step).
"""
import pathlib
import sys
import tempfile

from ball_release import Release

N_STEPS = 40
SIZES = ((4, 0, 0.01), (4, 1, 0.005), (4, 2, 0.0025), (4, 3, 0.00125), (6, 3, 0.0006))  # degree, refinements, step


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    print("degree,refinements,unknowns,seconds_step,gram_iterations", flush=True)
    for degree, refinements, step in SIZES:
        with tempfile.TemporaryDirectory() as folder:
            release = Release(pathlib.Path(sys.argv[1]).resolve(), folder, False)
            model = release.run_with({"Continuum/Degree": degree, "Continuum/Refinements": refinements, "Time/Method": "symmetric-4",
                                      "Time/Step": step, "Time/End": N_STEPS * step, "Time/Constraint tolerance": 1e-8,
                                      "Output/Samples": 1, "Continuum/Error estimate": "none"}).manifest["models"]["continuum"]
        print(degree, refinements, int(model["counters"]["unknowns"]), f"{model['timers']['run'] / N_STEPS:.4g}",
              f"{model['counters']['gram_iterations'] / N_STEPS:.1f}", sep=",", flush=True)


if __name__ == "__main__":
    main()
