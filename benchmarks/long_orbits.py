#!/usr/bin/python3
"""Drift over many orbits of a companion about the pseudo-rigid ball, by RATTLE with a fixed step (docs/planetary.md).

    benchmarks/long_orbits.py build/release/bin/pseudorigid [--orbits N]

One line for each quantity: its first value, its range in the first and in the second half of the run, and the change of its
mean from the first half to the second. For J it is the component along z. 100,000 orbits (the default) take about 25 s.
"""
import argparse
import pathlib
import sys
import tempfile

import program

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "tests/support"))
from program_test import scene_text  # noqa: E402

PERIOD = 44.0  # r/c, nearly that of one orbit
ENTRIES = {"Models": "reduced", "Gravity/Gamma": 1, "Companions/Masses": 40, "Companions/Semi-major axes": 8,
           "Companions/Eccentricities": 0.1, "Companions/Inclinations": 0.2,
           "Initial state/Velocity": "0, -0.14, 0; 0.14, 0, 0; 0, 0, 0", "Time/Method": "rattle", "Time/Step": 0.3,
           "Output/Samples": 2000, "Output/Report": "false"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--orbits", type=int, default=100_000)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.prm"
        scene.write_text(scene_text({}))
        table = program.run(options.program, scene, pathlib.Path(folder) / "out",
                            {**ENTRIES, "Time/End": PERIOD * options.orbits}).table("reduced.csv")
    print("quantity,first,range_first_half,range_second_half,change_of_mean")
    for name in "energy", "total_J3", "semi_major_axis", "eccentricity":
        values = table[name]
        half = len(values) // 2
        first, second = values[:half], values[half:]
        print(name, f"{values[0]:.6g}", f"{max(first) - min(first):.2e}", f"{max(second) - min(second):.2e}",
              f"{sum(second) / len(second) - sum(first) / len(first):.2e}", sep=",")


if __name__ == "__main__":
    main()
