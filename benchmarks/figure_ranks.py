#!/usr/bin/python3
"""Figures of equilibrium of finite elements on one and on two ranks, alone: without small motions and companion mesh.

    benchmarks/figure_ranks.py build/release/bin/pseudorigid [--quick] > figure_ranks.csv

The ball at rest in the trap of static_figure.py, and a spheroid with self-gravity, γ = 4 and the eccentricity 0.5. Runs on one and on
two ranks alternate. Columns: figure, degree, refinements, unknowns, gmres_iterations, seconds_1, seconds_2 (wall time of the run on one
and on two ranks without the start of MPI, median of five pairs), ratio (median of the ratios of the pairs).
"""
import argparse
import pathlib
import statistics
import tempfile

import program
import static_figure

FIGURES = {"trap": static_figure.ENTRIES,
           "spheroid": {"Analysis": "equilibrium", "Models": "continuum", "Equilibrium/Family": "maclaurin", "Gravity/Gamma": 4,
                        "Equilibrium/First": 0.5, "Equilibrium/Last": 0.5, "Equilibrium/Number": 1}}
CASES = (("trap", 4, 2), ("trap", 2, 4), ("trap", 4, 3), ("trap", 8, 2), ("spheroid", 4, 2))
LAUNCHER = ("mpirun", "-np", "2")


def run(executable, entries, launcher=()):
    """(model of the manifest, seconds)"""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "figure.prm"
        scene.write_text("")
        done = program.run(executable, scene, pathlib.Path(folder) / "out", {**entries, **static_figure.ALONE}, program.ON_RANKS, launcher)
        model = done.manifest["models"]["continuum"]
        return model, model["timers"]["run"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--quick", action="store_true", help="one figure, once")
    arguments = parser.parse_args()
    print("figure,degree,refinements,unknowns,gmres_iterations,seconds_1,seconds_2,ratio", flush=True)
    for figure, degree, refinements in CASES[:1] if arguments.quick else CASES:
        entries = {**FIGURES[figure], "Continuum/Degree": degree, "Continuum/Refinements": refinements}
        pairs = []
        for _ in range(1 if arguments.quick else 5):
            model, alone = run(arguments.program, entries)
            pairs.append((alone, run(arguments.program, entries, LAUNCHER)[1]))
        print(figure, degree, refinements, *(int(model["counters"][name]) for name in ("unknowns", "gmres_iterations")),
              *(f"{statistics.median(of_ranks):.4g}" for of_ranks in zip(*pairs)),
              f"{statistics.median(one / two for one, two in pairs):.3g}", sep=",", flush=True)


if __name__ == "__main__":
    main()
