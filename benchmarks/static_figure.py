#!/usr/bin/python3
"""A ball at rest in a trap: error against run time.

    benchmarks/static_figure.py build/release/bin/pseudorigid > static_figure.csv

The problem of benchmarks/peers/fenicsx_static.py, with Analysis = equilibrium and Family = static. A run also computes the small
motions about the figure, and both again on the companion mesh for the error bars.

Columns: degree, refinements, unknowns, newton_steps, factorizations (of the mesh without its companion), seconds (processor time of
the process less that of a start after it, median of three), run_seconds (wall time of the analysis, median), Q33 (the semi-axis a3),
uncertainty (axes_error).
"""
import pathlib
import statistics
import sys
import tempfile

import program

ENTRIES = {"Analysis": "equilibrium", "Models": "continuum", "Equilibrium/Family": "static",
           "Loads/Tidal matrix": "0.6, 0, 0; 0, 0.6, 0; 0, 0, 0", "Continuum/Volumetric stiffness": 0}
MESHES = ((3, 0), (4, 0), (3, 1), (5, 0), (4, 1), (6, 0), (5, 1))


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    executable = pathlib.Path(sys.argv[1]).resolve()
    print("degree,refinements,unknowns,newton_steps,factorizations,seconds,run_seconds,Q33,uncertainty", flush=True)
    for degree, refinements in MESHES:
        seconds, run_seconds = [], []
        for _ in range(3):
            with tempfile.TemporaryDirectory() as folder:
                scene = pathlib.Path(folder) / "figure.prm"
                scene.write_text("")
                entries = {**ENTRIES, "Continuum/Degree": degree, "Continuum/Refinements": refinements}
                run = program.run(executable, scene, pathlib.Path(folder) / "out", entries)
                seconds.append(run.cpu - program.start_up(executable))
                model = run.manifest["models"]["continuum"]
                run_seconds.append(model["timers"]["run"])
                table = run.table("equilibria-continuum.csv")
        print(degree, refinements, *(int(model["counters"][name]) for name in ("unknowns", "newton_steps", "factorizations")),
              f"{statistics.median(seconds):.4g}", f"{statistics.median(run_seconds):.4g}", f"{table['a3'][0]:.12f}",
              f"{table['axes_error'][0]:.2g}", sep=",", flush=True)


if __name__ == "__main__":
    main()
