#!/usr/bin/python3
"""The time of a step of the nonlinear release over the number of unknowns.

    benchmarks/release_sizes.py build/release/bin/pseudorigid > release_sizes.csv
    benchmarks/release_sizes.py build/release/bin/pseudorigid --ranks > release_ranks.csv

The release of benchmarks/ball_release.py with 40 steps of symmetric-4, elements of degree 4, and of degree 6 for more than 10⁶
unknowns. The step is about 0.75 of the limit of stability. The tolerance of the constraint is 1e-8. Columns: degree, refinements,
unknowns, seconds_step (wall time of the one thread over the number of steps, with the preconditioners and the starting steps),
gram_iterations (of a step).

With --ranks: the same steps on one and on two ranks, on the meshes of benchmarks/peers/fenicsx_ranks.py and with its columns. Two ranks
need two idle cores. Columns: program, degree, refinements, unknowns, solver (the method), ranks, seconds_factors (empty: the step has
them), seconds_step (as above, median of five runs). Q33 after the steps must agree on one and on two ranks to 1e-9, or the script ends
with an error.
"""
import argparse
import pathlib
import statistics
import tempfile

import program
from ball_release import SCENE

N_STEPS = 40
SIZES = ((4, 0, 0.01), (4, 1, 0.005), (4, 2, 0.0025), (4, 3, 0.00125), (6, 3, 0.0006))  # degree, refinements, step
SIZES_ON_RANKS = (SIZES[0], SIZES[1], (3, 2, 0.004), SIZES[2])
AGREEMENT = 1e-9


def run(executable, degree, refinements, step, ranks=1):
    """(counters, seconds of a step, Q33 at the end)"""
    launcher = ("mpirun", "-np", ranks) if ranks > 1 else ()
    entries = {"Continuum/Degree": degree, "Continuum/Refinements": refinements, "Time/Method": "symmetric-4", "Time/Step": step,
               "Time/End": N_STEPS * step, "Time/Constraint tolerance": 1e-8, "Output/Samples": 1, "Continuum/Error estimate": "none"}
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "release.prm"
        scene.write_text(SCENE)
        result = program.run(executable, scene, pathlib.Path(folder) / "out", entries, program.ON_RANKS, launcher)
        model = result.manifest["models"]["continuum"]
        return model["counters"], model["timers"]["run"] / N_STEPS, result.table("continuum.csv")["Q33"][-1]


def measure_sizes(executable):
    print("degree,refinements,unknowns,seconds_step,gram_iterations", flush=True)
    for degree, refinements, step in SIZES:
        counters, seconds, _ = run(executable, degree, refinements, step)
        print(degree, refinements, int(counters["unknowns"]), f"{seconds:.4g}", f"{counters['gram_iterations'] / N_STEPS:.1f}",
              sep=",", flush=True)


def measure_ranks(executable):
    print("program,degree,refinements,unknowns,solver,ranks,seconds_factors,seconds_step", flush=True)
    for degree, refinements, step in SIZES_ON_RANKS:
        results = []
        for ranks in (1, 2):
            counters, seconds, Q33 = zip(*(run(executable, degree, refinements, step, ranks) for _ in range(5)))
            results.append(Q33[-1])
            print("pseudorigid", degree, refinements, int(counters[0]["unknowns"]), "symmetric-4", ranks, "",
                  f"{statistics.median(seconds):.4g}", sep=",", flush=True)
        if abs(results[1] - results[0]) > AGREEMENT:
            raise SystemExit(f"error: Q33 is {results} on one and two ranks, degree {degree} refined {refinements}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--ranks", action="store_true")
    arguments = parser.parse_args()
    (measure_ranks if arguments.ranks else measure_sizes)(arguments.program.resolve())


if __name__ == "__main__":
    main()
