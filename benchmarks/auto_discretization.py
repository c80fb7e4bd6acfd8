#!/usr/bin/python3
"""What Continuum/Degree = auto, Refinements = auto finds and costs, beside the cheapest discretisation found by hand.

    benchmarks/auto_discretization.py build/release/bin/pseudorigid [--quick] > auto_discretization.csv

Scenes and references are those of tests/app/auto_degree_test.py; Time/Tolerance is a twentieth of Continuum/Tolerance.
By hand: of BY_HAND, in the order of their cost, the first two whose error is at most the tolerance, and of these the
one of less time. Times are medians of three to fifteen runs; --quick takes the tolerance 1e-3 and one to five runs.

Columns: scene, tolerance, degree, refinements (found), estimate (of the error), error (largest difference of an entry
of Q from the reference), hand_degree, hand_refinements, hand_error, seconds and hand_seconds (wall_seconds of the
manifest: without what loading the libraries takes), work and hand_work (unknowns × forces by the manifest's counters, pilots and search
included).
"""
import argparse
import json
import pathlib
import statistics
import sys
import tempfile

import program

TESTS = pathlib.Path(__file__).resolve().parents[1] / "tests"
sys.path += [str(TESTS / "app"), str(TESTS / "support")]
from auto_degree_test import AUTO, COMMON, Q, REFERENCES, SCENES, TOLERANCE_OF_TIME  # noqa: E402
from program_test import scene_text  # noqa: E402

BY_HAND = [(2, 0), (3, 0), (2, 1), (4, 0), (5, 0), (3, 1), (6, 0), (7, 0), (4, 1), (8, 0)]  # degree, refinements


class Runs:
    def __init__(self, executable, folder):
        self.executable, self.folder = executable, pathlib.Path(folder)
        self.scene = self.folder / "scene.prm"
        self.scene.write_text(scene_text(COMMON))
        self.references = json.loads(REFERENCES.read_text())

    def run(self, scene, entries):
        """(seconds, error, counters of the continuum)"""
        result = program.run(self.executable, self.scene, self.folder / "out", {**SCENES[scene], **entries})
        table = result.table("continuum.csv")
        motion = zip(*(table[name] for name in Q))
        error = max(abs(x - y) for row, other in zip(motion, self.references[scene]) for x, y in zip(row, other))
        return result.manifest["wall_seconds"], error, result.manifest["models"]["continuum"]["counters"]

    def repeated(self, scene, entries, n_runs, done=()):
        """(median of the seconds, error, counters) of n_runs runs, those that are done among them; up to five times
        as many of short ones."""
        runs = [*done]
        while len(runs) < n_runs or (len(runs) < 5 * n_runs and sum(run[0] for run in runs) < 0.5 * n_runs):
            runs.append(self.run(scene, entries))
        return statistics.median(seconds for seconds, _, _ in runs), *runs[0][1:]

    def by_hand(self, scene, tolerance, n_runs):
        """((degree, refinements), seconds, error, counters)"""
        found = []
        for degree, refinements in BY_HAND:
            entries = {"Time/Tolerance": tolerance * TOLERANCE_OF_TIME, "Continuum/Degree": degree,
                       "Continuum/Refinements": refinements}
            first = self.run(scene, entries)
            if first[1] <= tolerance:
                found.append(((degree, refinements), *self.repeated(scene, entries, n_runs, [first])))
            if len(found) == 2:
                break
        return min(found, key=lambda case: case[1])


def measure(runs, scene, tolerance, n_runs):
    hand, hand_seconds, hand_error, hand_counters = runs.by_hand(scene, tolerance, n_runs)
    entries = {**AUTO, "Time/Tolerance": tolerance * TOLERANCE_OF_TIME, "Continuum/Tolerance": tolerance}
    seconds, error, counters = runs.repeated(scene, entries, n_runs)
    print(scene, f"{tolerance:.0e}", int(counters["degree"]), int(counters["refinements"]),
          f"{counters['estimated_space_error']:.3g}", f"{error:.3g}", *hand, f"{hand_error:.3g}", f"{seconds:.4g}",
          f"{hand_seconds:.4g}", f"{counters['work'] + counters['search_work']:.4g}", f"{hand_counters['work']:.4g}",
          sep=",", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    print("scene,tolerance,degree,refinements,estimate,error,hand_degree,hand_refinements,hand_error,seconds,"
          "hand_seconds,work,hand_work")
    with tempfile.TemporaryDirectory() as folder:
        runs = Runs(arguments.program.resolve(), folder)
        for scene in SCENES:
            for tolerance in (1e-3,) if arguments.quick else (1e-3, 1e-4, 1e-5):
                measure(runs, scene, tolerance, 1 if arguments.quick else 3)


if __name__ == "__main__":
    main()
