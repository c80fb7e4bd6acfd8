#!/usr/bin/python3
"""A ball at rest in a trap: error against run time.

    benchmarks/static_figure.py build/release/bin/pseudorigid [--quick] > static_figure.csv

The problem of benchmarks/peers/fenicsx_static.py, with Analysis = equilibrium and Family = static. By default a run also computes the
small motions about the figure, and both again on the companion mesh for the error bars. A run of the figure alone does neither.

Columns: degree, refinements, unknowns, newton_steps, factorizations (of the mesh without its companion), seconds (processor time of
the process less that of a start after it, median of three), seconds_figure (of the figure alone, in the same way), Q33 (the semi-axis
a3), uncertainty (axes_error). The last row is the reference: only its figure alone is computed, and both other columns are empty.
"""
import pathlib
import statistics
import sys
import tempfile

import program

ENTRIES = {"Analysis": "equilibrium", "Models": "continuum", "Equilibrium/Family": "static",
           "Loads/Tidal matrix": "0.6, 0, 0; 0, 0.6, 0; 0, 0, 0", "Continuum/Volumetric stiffness": 0}
ALONE = {"Equilibrium/Small motions": "false", "Continuum/Error estimate": "none"}
MESHES = ((3, 0), (4, 0), (3, 1), (5, 0), (4, 1), (6, 0), (5, 1))
QUICK = ((3, 0), (4, 0))
REFERENCE = (4, 2)


def measure(executable, entries):
    """(median of the seconds of three runs, the last run's model in its manifest, its table)"""
    seconds = []
    for _ in range(3):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "figure.prm"
            scene.write_text("")
            run = program.run(executable, scene, pathlib.Path(folder) / "out", {**ENTRIES, **entries})
            seconds.append(run.cpu - program.start_up(executable))
            model, table = run.manifest["models"]["continuum"], run.table("equilibria-continuum.csv")
    return statistics.median(seconds), model, table


def main():
    if sys.argv[2:] not in ([], ["--quick"]) or len(sys.argv) < 2:
        raise SystemExit(__doc__)
    executable = pathlib.Path(sys.argv[1]).resolve()
    print("degree,refinements,unknowns,newton_steps,factorizations,seconds,seconds_figure,Q33,uncertainty", flush=True)
    for degree, refinements in (*(QUICK if sys.argv[2:] else MESHES), REFERENCE):
        mesh = {"Continuum/Degree": degree, "Continuum/Refinements": refinements}
        alone, model, table = measure(executable, {**ALONE, **mesh})
        of_run = ["", ""]
        if (degree, refinements) != REFERENCE:
            seconds, _, with_error = measure(executable, mesh)
            of_run = [f"{seconds:.4g}", f"{with_error['axes_error'][0]:.2g}"]
        print(degree, refinements, *(int(model["counters"][name]) for name in ("unknowns", "newton_steps", "factorizations")),
              of_run[0], f"{alone:.4g}", f"{table['a3'][0]:.12f}", of_run[1], sep=",", flush=True)


if __name__ == "__main__":
    main()
