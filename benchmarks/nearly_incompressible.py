#!/usr/bin/python3
"""A nearly incompressible ball: error against run time of both forms of the bulk term (Material/Bulk).

    benchmarks/nearly_incompressible.py build/release/bin/pseudorigid [--quick] > nearly_incompressible.csv

The release of ball_release.py with Incompressible = false and Lamé's λ from 10² to 10⁵ shear moduli. `pointwise` is explicit in time,
with steps limited by pressure waves. `projected` has ln det F on the functions of the pressure, implicit in time. The reference of each
λ has pointwise elements of degree 8. Its uncertainty, in a line with #, is the difference from projected elements of degree 7.

Columns: lambda, bulk, degree, tolerance, method, step, unknowns, seconds (wall time of one thread from the search for the step to the
last sample; median of three, or of one if that takes more than a second), error (largest difference of Q33 over 50 samples).
"""
import argparse
import pathlib
import statistics
import tempfile

import program

ENTRIES = {"Body/Incompressible": "false", "Models": "continuum", "Continuum/Refinements": 0, "Continuum/Error estimate": "none",
           "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6", "Time/End": 5, "Output/Samples": 50, "Output/Quantities": "state"}
LAMBDAS = (1e2, 1e3, 1e4, 1e5)
DEGREES = (2, 3, 4, 5, 6)
TOLERANCES = (1e-3, 1e-4, 1e-5)
REFERENCE, ITS_CHECK = ("pointwise", 8, 1e-6), ("projected", 7, 1e-5)


def run(executable, modulus, bulk, degree, tolerance):
    """(model of the manifest, Q33 at the samples)"""
    entries = {**ENTRIES, "Material/Lame lambda": modulus, "Material/Bulk": bulk, "Continuum/Degree": degree, "Time/Tolerance": tolerance}
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "release.prm"
        scene.write_text("")
        done = program.run(executable, scene, pathlib.Path(folder) / "out", entries)
        return done.manifest["models"]["continuum"], done.table("continuum.csv")["Q33"]


def largest_difference(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("--quick", action="store_true", help="one λ and two degrees, once")
    arguments = parser.parse_args()
    print("lambda,bulk,degree,tolerance,method,step,unknowns,seconds,error", flush=True)
    for modulus in (1e4,) if arguments.quick else LAMBDAS:
        _, exact = run(arguments.program, modulus, *((REFERENCE[0], 6, REFERENCE[2]) if arguments.quick else REFERENCE))
        if not arguments.quick:
            print(f"# lambda {modulus:g}: uncertainty {largest_difference(exact, run(arguments.program, modulus, *ITS_CHECK)[1]):.1e}")
        for bulk in ("pointwise", "projected"):
            for degree in (2, 4) if arguments.quick else DEGREES:
                for tolerance in (1e-4,) if arguments.quick else TOLERANCES:
                    seconds = []
                    while not seconds or (len(seconds) < 3 and seconds[0] < 1 and not arguments.quick):
                        model, Q33 = run(arguments.program, modulus, bulk, degree, tolerance)
                        seconds.append(model["timers"]["run"])
                    print(f"{modulus:g}", bulk, degree, tolerance, model["method"], f"{model['counters']['step']:.4g}",
                          int(model["counters"]["unknowns"]), f"{statistics.median(seconds):.4g}",
                          f"{largest_difference(Q33, exact):.3g}", sep=",", flush=True)


if __name__ == "__main__":
    main()
