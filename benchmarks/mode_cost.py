#!/usr/bin/python3
"""The small free vibrations of the elastic ball: error against run time.

    OMP_NUM_THREADS=1 benchmarks/mode_cost.py [--quick] > mode_cost.csv

The problem and the meshes are those of benchmarks/peers/fenicsx_modes.py: an incompressible ball with radius, density and shear
modulus 1. Analysis = modes computes the 12 lowest frequencies with all their modes. The unit of frequencies is the shear speed over
the radius. On these meshes, the program solves 4 of the 8 parity sectors. The other 4 sectors have the same frequencies. No entry of a
scene selects fewer sectors. The rows of fenicsx_modes.py with 4 sectors, the lumped mass and pressures in X solve the same equations.

The path of the program is in the environment variable PSEUDORIGID. If it is not set, the program is build/release/bin/pseudorigid.
One thread computes.

Columns: degree, refinements, unknowns (coordinates of the octant, with those that a sector sets to 0), seconds (processor time of the
process less that of a start of the finite elements before it, median of five), n_modes, error_S2 (relative error of the mean frequency
of S2), sectors, omega_S2.
"""
import os
import pathlib
import statistics
import sys
import tempfile

import program

ENTRIES = {"Analysis": "modes", "Models": "continuum", "Modes/Number": 12, "Output/Graphics": "none"}
MESHES = ((3, 0), (4, 0), (5, 0), (3, 1), (6, 0), (4, 1), (7, 0), (5, 1))
QUICK = ((3, 0), (4, 0))
N_RUNS = 5
N_SECTORS = 4  # meshes with a threefold axis (src/continuum/modes/modes.h)
SPHEROIDAL = 1


def measure(executable, entries):
    """(seconds, manifest of the model, columns of modes.csv)"""
    seconds = []
    for _ in range(N_RUNS):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "modes.prm"
            scene.write_text("")
            empty = program.start_up(executable)
            run = program.run(executable, scene, pathlib.Path(folder) / "out", entries)
            model, table = run.manifest["models"]["continuum"], run.table("modes.csv")
        seconds.append(run.cpu - empty)
    return statistics.median(seconds), model, table


def main():
    if sys.argv[1:] not in ([], ["--quick"]):
        raise SystemExit(__doc__)
    built = pathlib.Path(__file__).resolve().parents[1] / "build/release/bin/pseudorigid"
    executable = pathlib.Path(os.environ.get("PSEUDORIGID", built)).resolve()
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    print("degree,refinements,unknowns,seconds,n_modes,error_S2,sectors,omega_S2", flush=True)
    for degree, refinements in QUICK if sys.argv[1:] else MESHES:
        entries = {**ENTRIES, "Continuum/Degree": degree, "Continuum/Refinements": refinements}
        seconds, model, table = measure(executable, entries)
        S2 = next(i for i, row in enumerate(zip(table["kind"], table["degree"], table["overtone"])) if row == (SPHEROIDAL, 2, 0))
        omega, exact = table["omega"][S2], table["exact"][S2]
        print(degree, refinements, int(model["counters"]["unknowns"]), f"{seconds:.4g}", int(sum(table["multiplicity"])),
              f"{abs(omega / exact - 1):.3g}", N_SECTORS, f"{omega:.13f}", sep=",", flush=True)


if __name__ == "__main__":
    main()
