"""Error against run time of the nonlinear release of the ball: velocity 0.3 (x, y, -2z), μ = ρ = r = 1, until t = 5.

    PSEUDORIGID=build/release/bin/pseudorigid python3 benchmarks/ball_release.py [OUTPUT.csv]

Every combination of degree, refinements and order runs with steps for several tolerances. Columns: degree, refinements,
method, tolerance, step, unknowns, seconds (of the run, from the manifest: start-up is left out; the search for the step
is contained), error (the largest difference of Q33 from the reference over the 50 samples), Q33 (at t = 5).

The reference is degree 6 refined once with Time/Tolerance 1e-7 by order 6; its difference from degree 5 refined once is
printed as a bound of its error.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

SCENE = """set Models = continuum
subsection Initial state
  set Velocity = 0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6
end
subsection Time
  set End = 5
end
subsection Output
  set Samples = 50
  set Quantities = state
end
"""
COMBINATIONS = [(2, 1), (3, 0), (4, 0), (3, 1), (5, 0), (6, 0), (4, 1), (7, 0), (2, 2), (8, 0), (5, 1)]
METHODS = ["rattle", "rattle-4"]
TOLERANCES = [1e-3, 1e-4, 1e-5]


def run(folder, degree, refinements, method, tolerance):
    """(rows of Q33, manifest's part of the continuum)"""
    scene = pathlib.Path(folder) / "release.prm"
    scene.write_text(SCENE)
    entries = {"Continuum/Degree": degree, "Continuum/Refinements": refinements, "Time/Method": method,
               "Time/Tolerance": tolerance}
    subprocess.run([os.environ["PSEUDORIGID"], "run", str(scene), "--quiet", "--output", f"{folder}/out",
                    *(f"--set={path}={value}" for path, value in entries.items())], check=True)
    with open(f"{folder}/out/continuum.csv", newline="") as file:
        Q33 = [float(row["Q33"]) for row in csv.DictReader(file)]
    manifest = json.loads(pathlib.Path(f"{folder}/out/manifest.json").read_text())
    return Q33, manifest["models"]["continuum"]


def main():
    output = sys.argv[1] if len(sys.argv) > 1 else "ball_release.csv"
    with tempfile.TemporaryDirectory() as folder, open(output, "w", newline="") as file:
        reference, _ = run(folder, 6, 1, "rattle-6", 1e-7)
        check, _ = run(folder, 5, 1, "rattle-6", 1e-7)
        print(f"reference: Q33(5) = {reference[-1]:.9f}, differs by at most "
              f"{max(abs(a - b) for a, b in zip(reference, check)):.1e} from degree 5")
        writer = csv.writer(file)
        writer.writerow("degree,refinements,method,tolerance,step,unknowns,seconds,error,Q33".split(","))
        for degree, refinements in COMBINATIONS:
            for method in METHODS:
                for tolerance in TOLERANCES:
                    Q33, model = run(folder, degree, refinements, method, tolerance)
                    error = max(abs(a - b) for a, b in zip(Q33, reference))
                    row = [degree, refinements, method, tolerance, model["counters"]["step"],
                           int(model["counters"]["unknowns"]), model["timers"]["run"], error, Q33[-1]]
                    writer.writerow(row)
                    file.flush()
                    print("k = {} refined {} {:9} {:.0e}: {:8.3f} s, error {:.2e}".format(*row[:4], row[6], error))


if __name__ == "__main__":
    main()
