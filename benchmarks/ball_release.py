#!/usr/bin/python3
"""Error against run time of the nonlinear release of the ball: velocity 0.3 (x, y, −2z), μ = ρ = r = 1, until t = 5.

    benchmarks/ball_release.py build/release/bin/pseudorigid [--quick] > ball_release.csv
    benchmarks/ball_release.py build/release/bin/pseudorigid --make-reference > benchmarks/references/ball_release.csv

With --gravity the ball has its own gravity, γ = ρgr/μ = 5, another reference (gravitating_release.csv), and the
discretisations of QUICK and one refined more.

Every discretisation runs with the methods and tolerances of STEPS, those of LARGE with the last two only, those
of QUICK also with HIGHER; in turn, for nine rounds (the last six, the third and the second are left out once a run has
taken 1, 10 and 20 seconds in all). Columns: degree, refinements, method, tolerance (Time/Tolerance), step, unknowns,
seconds (processor time of the process less that of a start after it, median; the search for the step is contained),
motion_seconds (wall time from the search for the step to the last sample, median: what benchmarks/peers is timed for),
error (the largest difference of Q33 from the reference over the 50 samples).

The reference is in benchmarks/references with a bar of its own: see make_reference.
"""
import argparse
import math
import pathlib
import statistics
import sys
import tempfile

import program

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
GRAVITY = """subsection Gravity
  set Constant = $(15/(4*pi))
end
"""
REFERENCES = pathlib.Path(__file__).parent / "references"
DISCRETIZATIONS = [(2, 0), (2, 1), (3, 0), (4, 0), (3, 1), (5, 0), (6, 0), (4, 1), (2, 2), (7, 0), (5, 1), (8, 0)]
REFERENCE_DEGREES = (4, 5, 6)
LARGE = [(7, 0), (5, 1), (8, 0)]  # where only the smallest errors are worth their time
QUICK = [(2, 1), (3, 0), (4, 0), (3, 1), (5, 0)]
# The higher orders are at the limit of stability with every tolerance that makes sense here.
STEPS = [("rattle", 3e-4), ("rattle", 1e-4), ("rattle-4", 1e-5), ("symmetric-4", 1e-3), ("symmetric-4", 1e-4),
         ("symmetric-4", 1e-5)]
HIGHER = [("rattle-6", 1e-5), ("rattle-8", 1e-5)]  # on small discretisations, which are enough to see their place


def read_reference(gravity):
    """(uncertainty, Q33 at the samples)"""
    first, _, *rows = (REFERENCES / ("gravitating_release.csv" if gravity else "ball_release.csv")).read_text().splitlines()
    return float(first.split()[-1]), [float(row.split(",")[1]) for row in rows]


class Release:
    def __init__(self, executable, folder, gravity):
        self.executable, self.folder = executable, pathlib.Path(folder)
        self.scene = self.folder / "release.prm"
        self.scene.write_text(SCENE + GRAVITY * gravity)

    def run_with(self, entries):
        return program.run(self.executable, self.scene, self.folder / "out", entries)

    def run(self, degree, refinements, method, tolerance):
        """(Q33 at the samples, counters of the continuum, (seconds, motion_seconds))"""
        entries = {"Continuum/Degree": degree, "Continuum/Refinements": refinements, "Time/Method": method,
                   "Time/Tolerance": tolerance}
        result = self.run_with(entries)
        # Beside each run: in the course of minutes it changes by more than a small run takes.
        start_up = program.start_up(self.executable)
        model = result.manifest["models"]["continuum"]
        times = result.cpu - start_up, model["timers"]["run"]
        return result.table("continuum.csv")["Q33"], model["counters"], times


def largest_difference(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def measure(release, quick, gravity):
    uncertainty, reference = read_reference(gravity)
    print(f"# uncertainty of the reference: {uncertainty:.1e}")
    print("degree,refinements,method,tolerance,step,unknowns,seconds,motion_seconds,error")
    if gravity:
        jobs = [(*d, *s) for d in (QUICK if quick else QUICK + [(4, 1)]) for s in STEPS]
    else:
        jobs = [(*d, *s) for d in (QUICK if quick else DISCRETIZATIONS)
                for s in (STEPS[4:] if d in LARGE else STEPS) + (HIGHER if d in QUICK and not quick else [])]
    times, last = {job: [] for job in jobs}, {}
    for limit in (math.inf, 20, 10, 1, 1, 1, 1, 1, 1)[:1 if quick else 9]:
        for job in jobs:
            if sum(seconds for seconds, _ in times[job]) < limit:
                Q33, counters, spent = release.run(*job)
                last[job] = Q33, counters
                times[job].append(spent)
                print(f"k = {job[0]} refined {job[1]} {job[2]:8} {job[3]:.0e}: {spent[0]:8.3f} s, error "
                      f"{largest_difference(Q33, reference):.2e}", file=sys.stderr)
    for job in jobs:
        Q33, counters = last[job]
        print(*job, counters["step"], int(counters["unknowns"]),
              *(f"{statistics.median(column):.4g}" for column in zip(*times[job])),
              f"{largest_difference(Q33, reference):.4g}", sep=",")


def make_reference(release):
    """Richardson's extrapolation over the degree: of degrees 4, 5, 6, refined once, the differences of Q33 (root mean
    squares over the samples) fall by a factor ρ, so that Q33 of the last plus (last − last but one)/(ρ − 1) is left.
    The uncertainty is the largest of this correction. A check by other means: of the small release, whose exact motion
    is known (lamb_response.cpp), degree 6 refined once has an error that is 2e-7 at this amplitude. Order 4 at the
    limit of stability differs from order 6 by 4e-9.
    """
    Q = [release.run(degree, 1, "rattle-4", 1e-7)[0] for degree in REFERENCE_DEGREES]
    reference = extrapolate(*Q)
    print(f"# degrees {', '.join(map(str, REFERENCE_DEGREES))}, refined once, extrapolated; uncertainty "
          f"{largest_difference(reference, Q[-1]):.1e}")
    print("time,Q33")
    for i, value in enumerate(reference):
        print(f"{i * 5 / 50:g},{value:.12f}")


def extrapolate(a, b, c):
    factor = math.sqrt(sum((y - x) ** 2 for x, y in zip(a, b)) / sum((z - y) ** 2 for y, z in zip(b, c)))
    return [z + (z - y) / (factor - 1) for y, z in zip(b, c)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--gravity", action="store_true")
    parser.add_argument("--make-reference", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        release = Release(arguments.program.resolve(), folder, arguments.gravity)
        if arguments.make_reference:
            make_reference(release)
        else:
            measure(release, arguments.quick, arguments.gravity)


if __name__ == "__main__":
    main()
