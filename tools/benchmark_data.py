"""What the pictures and the tables of the benchmarks read: files of docs/benchmarks/data, and the fronts in them."""

import csv
import json
import math
import statistics
from collections import defaultdict

import package  # noqa: F401
from pseudorigid.errors import WrongInput


def read_rows(folder, name):
    """[row by column names], numbers as texts; [] where the part was not measured."""
    path = folder / name
    if not path.is_file():
        return []
    # Google Benchmark and the programs write lines about the machine and the run before the table.
    lines = path.read_text().splitlines()
    first = next((i for i, line in enumerate(lines) if "," in line and not line.startswith("#")), len(lines))
    return list(csv.DictReader(line for line in lines[first:] if not line.startswith("#")))


def read_notes(folder, name):
    """The lines with # of a file, without it."""
    path = folder / name
    lines = path.read_text().splitlines() if path.is_file() else []
    return [line[1:].strip() for line in lines if line.startswith("#")]


def read_runs(folder):
    path = folder / "runs.json"
    if not path.is_file():
        raise WrongInput(f"{path} does not exist; scripts/benchmark.sh writes it")
    return json.loads(path.read_text())


def work_precision(folder, run=None):
    """problem -> method -> [(seconds, error)], times of one run or medians over the runs. SciPy's runs belong to the part
    `peers`."""
    times, errors = defaultdict(list), {}
    for row in read_rows(folder, "work_precision.csv") + read_rows(folder, "scipy_small_systems.csv"):
        if run is None or row.get("run", run) == run:
            job = row["problem"], row["method"], row["parameter_name"], row["parameter"]
            times[job].append(float(row["seconds"]))
            errors[job] = float(row["error"])
    problems = defaultdict(lambda: defaultdict(list))
    for (problem, method, *job), seconds in times.items():
        problems[problem][method].append((statistics.median(seconds), errors[problem, method, *job]))
    return problems


def runs_of_work_precision(folder):
    """The names of the runs."""
    return sorted({row["run"] for row in read_rows(folder, "work_precision.csv") if "run" in row}) or [None]


def errors_of(folder, name):
    """[(seconds, error)] of a file of runs."""
    return [(float(row["seconds"]), float(row["error"])) for row in read_rows(folder, name)]


def release_times(data, level, column="motion_seconds"):
    """Our time of the release and that of FEniCSx at an error, both interpolated on the fronts: the cheapest run below a
    threshold would compare errors that differ by up to 3."""
    own = [(float(r[column]), float(r["error"])) for r in read_rows(data, "ball_release.csv")]
    return time_for(own, level), time_for(errors_of(data, "fenicsx_release.csv"), level)


def release_uncertainty(folder):
    """Of the reference that the errors were measured against: the first line of benchmarks/references/ball_release.csv,
    which benchmarks/ball_release.py hands on to its results. None without data."""
    notes = [note for note in read_notes(folder, "ball_release.csv") if "uncertainty" in note]
    return float(notes[0].rsplit(" ", 1)[-1]) if notes else None


def space_rate(errors):
    """p of error ~ N⁻ᵖ, N = k·1.6^r, from {(k, r): error}, by least squares in logarithms."""
    log_n = [math.log(degree * 1.6**refinements) for degree, refinements in errors]
    return -statistics.linear_regression(log_n, [math.log(error) for error in errors.values()]).slope


def runs_of_skipping(folder):
    """The rows with numbers: not those of parts that the program does not offer for the scene."""
    return [row for row in read_rows(folder, "skipping.csv") if not row["refused"]]


def front(points):
    """The points (seconds, error, …) that no other one beats in time and in error."""
    best = []
    for point in sorted(points):
        if not best or point[1] < best[-1][1]:
            best.append(point)
    return best


def time_for(points, level):
    """Time for an error of `level`, on the straight lines through the front in logarithms; None where the front ends
    before it."""
    line = front(points)
    if not line or line[-1][1] > level:
        return None
    for (t0, e0, *_), (t1, e1, *_) in zip(line, line[1:]):
        if e0 > level >= e1:
            share = math.log(e0 / level) / math.log(e0 / e1)
            return t0 * (t1 / t0) ** share
    return line[0][0]


def cheapest(rows, level):
    """The row of least time whose error is at most `level`, or None."""
    good = [row for row in rows if float(row["error"]) <= level]
    return min(good, key=lambda row: float(row["seconds"]), default=None)


def discretization(row, prefix=""):
    """By the columns degree and refinements, their names with the prefix."""
    degree, refinements = row[f"{prefix}degree"], int(row[f"{prefix}refinements"])
    return f"k = {degree}" + (f", refined {('once', 'twice', 'three times', 'four times')[refinements - 1]}" if refinements else "")
