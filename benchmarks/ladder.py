#!/usr/bin/python3
"""The ladder of models: error against run time of polynomial bodies and of finite elements, whole processes.

    benchmarks/ladder.py build/release/bin/pseudorigid [--quick] > ladder.csv

The release of ball_release.py, by polynomial bodies of the odd degrees N (an even one adds nothing in an octant) and by
finite elements of the cheaper discretisations. All rungs take turns, for ROUNDS rounds. Columns: model, degree,
refinements, tolerance (Time/Tolerance; the method is symmetric-4), unknowns, seconds (processor time from the start of
the process to its end, the search for the step included; median), megabytes (largest resident set), error (the largest
difference of Q33 from the reference over the samples), frequency_error (of S2, relative, by Analysis = modes; of
polynomial bodies, whose modes need no mesh).
"""
import argparse
import pathlib
import statistics
import sys
import tempfile

import program
from ball_release import SCENE, largest_difference, read_reference

ROUNDS = 5
METHOD = "symmetric-4"
TOLERANCES = [5e-3, 1e-3, 1e-4]
DEGREES = [1, 3, 5, 7, 9, 11, 13]
DISCRETIZATIONS = [(3, 0), (4, 0), (5, 0), (6, 0)]
S2 = 2.665622189235601  # of the incompressible sphere, 9 digits beyond any error here (tests/analysis)
SPHEROIDAL = 1  # modes.csv, column kind


def entries_of(model, degree, refinements):
    own = {"polynomial": {"Polynomial/Degree": degree},
           "continuum": {"Continuum/Degree": degree, "Continuum/Refinements": refinements}}
    return {"Models": model, **own[model]}


class Ladder:
    def __init__(self, executable, folder):
        self.executable, self.folder = executable, pathlib.Path(folder)
        self.release, self.modes = self.folder / "release.prm", self.folder / "modes.prm"
        self.release.write_text(SCENE)
        self.modes.write_text("set Models = polynomial\nset Analysis = modes\n")
        _, self.reference = read_reference(False)

    def run(self, model, degree, refinements, tolerance):
        """(error, unknowns, run)"""
        entries = {**entries_of(model, degree, refinements), "Time/Method": METHOD, "Time/Tolerance": tolerance}
        run = program.run(self.executable, self.release, self.folder / "out", entries)
        error = largest_difference(run.table(f"{model}.csv")["Q33"], self.reference)
        return error, int(run.manifest["models"][model]["counters"]["unknowns"]), run

    def frequency_error(self, degree):
        run = program.run(self.executable, self.modes, self.folder / "modes", {"Polynomial/Degree": degree})
        modes = run.table("modes.csv")
        of_S2 = [omega for omega, kind, n in zip(modes["omega"], modes["kind"], modes["degree"])
                 if (kind, n) == (SPHEROIDAL, 2)]
        return abs(min(of_S2) / S2 - 1)


def measure(ladder, quick):
    rungs = [("polynomial", N, 0) for N in (DEGREES[:4] if quick else DEGREES)]
    rungs += [("continuum", *d) for d in (DISCRETIZATIONS[:2] if quick else DISCRETIZATIONS)]
    runs = {(*rung, tolerance): [] for rung in rungs for tolerance in TOLERANCES}
    for _ in range(1 if quick else ROUNDS):
        for job, done in runs.items():
            done.append(ladder.run(*job))
            print(*job, f"{done[-1][2].cpu:.4f} s, error {done[-1][0]:.2e}", file=sys.stderr)
    frequencies = {N: f"{ladder.frequency_error(N):.3g}" for model, N, _ in rungs if model == "polynomial"}
    print("model,degree,refinements,tolerance,unknowns,seconds,megabytes,error,frequency_error")
    for (model, degree, refinements, tolerance), done in runs.items():
        error, n_unknowns, _ = done[-1]
        print(model, degree, refinements, tolerance, n_unknowns,
              f"{statistics.median(run.cpu for *_, run in done):.4g}",
              f"{max(run.megabytes for *_, run in done):.3g}", f"{error:.4g}",
              frequencies[degree] if model == "polynomial" else "", sep=",")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        measure(Ladder(arguments.program.resolve(), folder), arguments.quick)


if __name__ == "__main__":
    main()
