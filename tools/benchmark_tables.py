"""Tables of the benchmarks as (header, rows of texts), from the files of docs/benchmarks/data; None without data."""

import math
import re
import statistics


from benchmark_data import (
    cheapest, discretization, front, read_rows, read_runs, release_times, runs_of_skipping, runs_of_work_precision, time_for,
    work_precision)

LEVELS = (1e-6, 1e-8, 1e-10, 1e-12)
LIBRARIES = ("GSL", "odeint", "CVODE", "ARKODE", "SciPy")
PROBLEMS = {"sl3": "pseudo-rigid ball", "rigid_body": "rigid body", "double_pendulum": "double pendulum",
            "gravitating": "fluid ellipsoid"}
NONE = "–"
AUTO_SCENES = {"release": "release from a stretch", "velocity": "release by a velocity, a = 0.3",
               "compressible": "compressible, in a tidal field"}
# Counted work says nothing of these: eigenvalue problems and searches are not counted as forces, and forces of the
# continuum have another unit than those of the reduced model.
PARTS_WITHOUT_WORK = ("modes", "critical points", "continuum")


def number(x, digits=3):
    """Plain digits where they are short."""
    if 10**digits <= abs(x) < 1e5:
        return f"{x:.0f}"
    return f"{x:.{digits}g}" if 1e-3 <= abs(x) < 1e5 or x == 0 else f"{x:.1e}"


def methods(data, problem):
    points = work_precision(data).get(problem)
    if not points:
        return None
    rows = []
    for method, p in points.items():
        times = [time_for(p, level) for level in LEVELS]
        rows.append([method, *(f"{1e3 * t:.2f}" if t else NONE for t in times), f"{min(e for _, e in p):.0e}"])
    header = ["method", *(f"{level:.0e}" for level in LEVELS), "least error"]
    return header, rows


def methods_together(data, level="1e-10"):
    """The times in ms of every method for one error, a column for each problem."""
    times = {}
    for problem in PROBLEMS:
        header, rows = methods(data, problem) or (["method", level], [])
        for row in rows:
            times.setdefault(row[0].removesuffix(" (constrained)"), {})[problem] = row[header.index(level)]
    if not times:
        return None
    measured = [problem for problem in PROBLEMS if any(problem in found for found in times.values())]
    return (["method", *(PROBLEMS[problem] for problem in measured)],
            [[method, *(found.get(problem, "") for problem in measured)]
             for method, found in times.items() if set(found.values()) != {NONE}])


def two_digits(x):
    return f"{float(f'{x:.2g}'):.0f}" if x >= 9.95 else f"{x:#.2g}"


def fastest(points, level, of_libraries):
    """(seconds, method) of the fastest of our methods or of the libraries; None if none has the error."""
    times = [(t, method) for method, p in points.items()
             if method.startswith(LIBRARIES) == of_libraries and (t := time_for(p, level))]
    return min(times, default=None)


def least_error(points):
    """What the libraries reach, where they do not reach a level."""
    seconds, error, method = min(((*front(p)[-1], method) for method, p in points.items() if method.startswith(LIBRARIES)),
                                 key=lambda found: found[1])
    return f"{NONE} ({method} has {error:.1e} in {two_digits(1e3 * seconds)})"


def times_as_fast(data, problem, level):
    """Of our fastest method, against the fastest library: the ratios of all runs, two digits, and a range if they
    differ."""
    ratios = []
    for run in runs_of_work_precision(data):
        points = work_precision(data, run)[problem]
        own, library = fastest(points, level, False), fastest(points, level, True)
        if not own or not library:
            return NONE
        ratios.append(library[0] / own[0])
    low, high = two_digits(min(ratios)), two_digits(max(ratios))
    return low if low == high else f"{low} to {high}"


def small_systems(data):
    """For each problem and error the fastest of our methods and of the libraries."""
    rows = []
    for problem, points in work_precision(data).items():
        for level in LEVELS:
            own, library = fastest(points, level, False), fastest(points, level, True)
            rows.append([PROBLEMS[problem], f"{level:.0e}",
                         f"{two_digits(1e3 * own[0])} ({own[1]})" if own else NONE,
                         f"{two_digits(1e3 * library[0])} ({library[1]})" if library else least_error(points),
                         times_as_fast(data, problem, level)])
    header = ["problem", "error", "ms, pseudorigid", "ms, fastest library", "library / pseudorigid"]
    return (header, rows) if rows else None


def small_systems_short(data):
    """A line for each problem: how many times as fast as the fastest library, for each error."""
    rows = [[PROBLEMS[problem], *(times_as_fast(data, problem, level) for level in LEVELS)]
            for problem in work_precision(data)]
    return (["times as fast as the fastest library, at an error of", *(f"{level:.0e}" for level in LEVELS)], rows) if rows else None


def calls(data, name):
    """Medians of Google Benchmark."""
    rows = [row for row in read_rows(data, name) if row["name"].endswith("_median")]
    return (["call", "ns"], [[row["name"].removesuffix("_median"), number(float(row["cpu_time"]))] for row in rows]) \
        if rows else None


def gravitating_release(data):
    rows = read_rows(data, "gravitating_release.csv")
    result = []
    for level in (1e-3, 3e-4, 1e-4, 3e-5, 1e-5):
        best = cheapest(rows, level)
        if best:
            result.append([f"{level:.0e}", discretization(best), best["method"], best["unknowns"],
                           f"{float(best['error']):.1e}", number(float(best["seconds"]))])
    return (["error at most", "cheapest", "method", "unknowns", "its error", "s"], result) if result else None


def gravity_cost(data):
    rows = read_rows(data, "ball_gravity.csv")
    return (["k, refined", "unknowns", "points", "targets × sources", "ms, gravity", "ms, step", "share", "ns a pair",
             "Gflop/s"],
            [[f"{r['degree']}, {r['refinements']}", r["unknowns"], r["points"], f"{r['targets']} × {r['sources']}",
              number(1e3 * float(r["gravity_s"])), number(1e3 * float(r["step_s"])), f"{100 * float(r['share']):.0f} %",
              number(1e9 * float(r["pairs_s"]) / (int(r["targets"]) * int(r["sources"]))),
              number(1e-9 * float(r["flops_per_s"]))]
             for r in rows]) if rows else None


def lamb(data):
    rows = read_rows(data, "lamb_response.csv")
    result = []
    for level in (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 5e-6):
        best = cheapest(rows, level)
        if best:
            result.append([f"{level:.0e}", discretization(best), best["unknowns"], best["steps"],
                           f"{float(best['error']):.1e}", number(float(best["seconds"]))])
    return (["error at most", "cheapest", "unknowns", "steps", "its error", "s"], result) if result else None


def frequency(data):
    rows = read_rows(data, "ball_frequency.csv")
    return (["way", "discretisation", "unknowns", "relative error", "s"],
            [[r["way"], discretization(r), r["unknowns"], f"{float(r['error']):.1e}", number(float(r["seconds"]))]
             for r in rows]) if rows else None


def auto_discretization(data):
    rows = read_rows(data, "auto_discretization.csv")
    return (["scene", "tolerance", "found", "estimate", "error", "by hand", "its error", "s", "s / by hand",
             "work / by hand"],
            [[AUTO_SCENES[r["scene"]], f"{float(r['tolerance']):.0e}", discretization(r), f"{float(r['estimate']):.1e}",
              f"{float(r['error']):.1e}", discretization(r, "hand_"), f"{float(r['hand_error']):.1e}",
              number(float(r["seconds"])), f"{float(r['seconds']) / float(r['hand_seconds']):.1f}",
              f"{float(r['work']) / float(r['hand_work']):.1f}"] for r in rows]) if rows else None


def steps(data):
    rows = read_rows(data, "ball_steps.csv")
    return (["k, refined", "ranks", "unknowns", "multipliers", "ms a step", "step/force", "Gram iterations a step",
             "a solve", "at most", "bytes an unknown", "of which preconditioner"],
            [[f"{r['degree']}, {r['refinements']}", r["ranks"], r["unknowns"], r["multipliers"],
              number(1e3 * float(r["step_s"])), r["step_per_force"], r["gram_iterations"], r["iterations_per_solve"],
              r["iterations_at_most"],
              f"{float(r['allocated_MB']) * 1e6 * int(r['ranks']) / int(r['unknowns']):.0f}",
              f"{float(r['gram_MB']) * 1e6 * int(r['ranks']) / int(r['unknowns']):.0f}"]
             for r in rows]) if rows else None


def ranks(data):
    """Time of a step on one rank over that on more, where both were measured."""
    rows = read_rows(data, "ball_steps.csv")
    one = {(r["degree"], r["refinements"]): float(r["step_s"]) for r in rows if r["ranks"] == "1"}
    result = [[f"{r['degree']}, {r['refinements']}", r["unknowns"], r["ranks"],
               number(one[r["degree"], r["refinements"]] / float(r["step_s"]))]
              for r in rows if r["ranks"] != "1" and (r["degree"], r["refinements"]) in one]
    return (["k, refined", "unknowns", "ranks", "times as fast as one"], result) if result else None


def scaling(data):
    """Counts of a rank in a step."""
    rows = [row for row in read_rows(data, "scaling.csv") if int(row["ranks"]) > 1]
    return (["ranks", "unknowns", "messages", "kB", "reductions", "Gram iterations"],
            [[row["ranks"], row["unknowns"], number(float(row["messages"])), number(float(row["bytes"]) / 1e3),
              number(float(row["reductions"])), number(float(row["gram_iterations"]))] for row in rows]) if rows else None


def figure_ranks(data):
    """Times of figures on one and on two ranks."""
    rows = read_rows(data, "figure_ranks.csv")
    return (["figure", "k, refined", "unknowns", "s, 1 rank", "2 ranks", "1 rank / 2 ranks"],
            [[r["figure"], f"{r['degree']}, {r['refinements']}", r["unknowns"], number(float(r["seconds_1"])), number(float(r["seconds_2"])),
              two_digits(float(r["ratio"]))] for r in rows]) if rows else None


def gram_iterations(data):
    """A line for each degree, a column for each refinement and deformation."""
    rows = read_rows(data, "gram_iterations.csv")
    if not rows:
        return None
    columns = list(dict.fromkeys((r["shear"], r["refinements"]) for r in rows))
    columns.sort(key=lambda c: float(c[0]))
    of = {(r["degree"], r["shear"], r["refinements"]): r["iterations"] for r in rows}
    header = ["k", *(f"{'at rest' if float(shear) == 0 else 'deformed'}, refined {n}" for shear, n in columns)]
    degrees = dict.fromkeys(r["degree"] for r in rows)
    return header, [[k, *(of.get((k, *column), NONE) for column in columns)] for k in degrees]


def work_ratio(row):
    """Counted work with the part over that without; None where it was not counted."""
    without, having = float(row["work"]), float(row["work_with"])
    return having / without if without and row["part"] not in PARTS_WITHOUT_WORK else None


def skipping(data):
    """A line for each scene, a column for each part: seconds more, the ratio, and that of the counted work if it is
    not 1."""
    rows = read_rows(data, "skipping.csv")
    if not rows:
        return None
    parts = list(dict.fromkeys(r["part"] for r in rows))
    of = {(r["scene"], r["part"]): r for r in rows}

    def cell(row):
        if row is None:
            return ""
        if row["refused"]:
            return "not offered"
        without, having = float(row["seconds"]), float(row["seconds_with"])
        ratio = work_ratio(row)
        work = f", work ×{ratio:.2g}" if ratio and ratio != 1 else ""
        return f"{having - without:+.2g} s (×{having / without:.2g}{work})"

    scenes = dict.fromkeys(r["scene"] for r in rows)
    return ["scene", *parts], [[scene, *(cell(of.get((scene, part))) for part in parts)] for scene in scenes]


def skipped_parts(data):
    """A line for each part, over the scenes."""
    rows = runs_of_skipping(data)
    result = []
    for part in dict.fromkeys(r["part"] for r in rows):
        own = [r for r in rows if r["part"] == part]
        ratios = [float(r["seconds_with"]) / float(r["seconds"]) for r in own]
        more = [float(r["seconds_with"]) - float(r["seconds"]) for r in own]
        memory = [float(r["megabytes_with"]) - float(r["megabytes"]) for r in own]
        work = [ratio for r in own if (ratio := work_ratio(r))]
        result.append([part, str(len(own)), number(statistics.median(more), 2), number(statistics.median(ratios), 2),
                       f"{number(min(ratios), 2)} to {number(max(ratios), 2)}",
                       number(statistics.median(work), 2) if work else NONE, f"{statistics.median(memory):.0f}"])
    header = ["part", "scenes that skip it", "s more", "time with / without", "from, to", "work with / without",
              "MB more"]
    return (header, result) if result else None


def with_error(value, error):
    """Both with the power of ten of the larger one: -1.6e-13 ± 0.8e-13."""
    exponent = math.floor(math.log10(max(abs(value), error)))
    return f"{value / 10**exponent:.1f}e{exponent} ± {error / 10**exponent:.1f}e{exponent}"


def long_run(data):
    rows = read_rows(data, "long_run_summary.csv")
    header = ["method, step", "energy", "its drift", "its exponent", "J", "Z", "constraint", "coordinates",
              "their exponent", "s"]

    def line(r):
        chaotic = not float(r["error"]) <= 0.1
        return [f"{r['method']}, 1/{r['steps_per_unit']}{' (rigid body)' if r['problem'] == 'rigid_body' else ''}",
                f"{float(r['energy_error']):.1e}", with_error(float(r["energy_drift"]), float(r["drift_error"])),
                r["energy_growth"], *(f"{float(r[name]):.1e}" if float(r[name]) else NONE
                                      for name in ("J_error", "Z_error", "constraint_error")),
                *([NONE, NONE] if chaotic else [f"{float(r['error']):.1e}", r["error_growth"]]),
                number(float(r["seconds"]))]
    return (header, [line(r) for r in rows]) if rows and "problem" in rows[0] else None  # not of an earlier form


def long_run_growth(data):
    """Largest errors over the long run, and the powers of the time with which they grow."""
    rows = read_rows(data, "long_run_summary.csv")
    if not rows or "problem" not in rows[0]:
        return None

    def line(r):
        chaotic = not float(r["error"]) <= 0.1
        return [PROBLEMS[r["problem"]], f"{r['method']}, 1/{r['steps_per_unit']}", f"{float(r['energy_error']):.0e}",
                r["energy_growth"], f"{float(r['J_error']):.0e}",
                *([NONE, NONE] if chaotic else [f"{float(r['error']):.0e}", r["error_growth"]])]
    return ["problem", "method, step", "energy", "its exponent", "J", "coordinates", "their exponent"], [line(r) for r in rows]


def machine(data):
    """A column for each machine that parts were measured on, that of the most parts first."""
    keys = ("processor", "cores", "vector instructions", "caches", "memory", "system", "compiler", "flags", "packages")
    parts = {}
    for name, run in read_runs(data).items():
        parts.setdefault(tuple(run[key] for key in keys), []).append(name)
    machines = sorted(parts, key=lambda machine: -len(parts[machine]))
    header = ["", *("" if len(parts) == 1 else ", ".join(sorted(parts[machine])) for machine in machines)]
    return header, [[key, *(machine[i] for machine in machines)] for i, key in enumerate(keys)]


def parts(data):
    return ["part", "date", "load at start", "s", "commit", "form"], [
        [name, run["date"], f"{run['load at start']:.1f}", str(run["seconds"]), run["commit"][:9],
         "quick" if run["quick"] else "full"] for name, run in read_runs(data).items()]


def rung_name(row):
    """Of a row of ladder.csv."""
    if row["model"] == "continuum":
        return f"finite elements, {discretization(row)}"
    return "pseudo-rigid body" if row["degree"] == "1" else f"polynomial body, N = {row['degree']}"


def ladder(data):
    """The models from the poorest in motions to the richest: how many unknowns and seconds buy which accuracy."""
    rungs = {}
    for row in read_rows(data, "ladder.csv"):  # the last tolerance of each: the errors are those of the space
        rungs[rung_name(row)] = row
    of_elements = {discretization(row): row["error"] for row in read_rows(data, "ball_frequency.csv") if row["way"] == "octant"}
    lines = []
    for name, row in rungs.items():
        error = row["frequency_error"] or of_elements.get(discretization(row))
        lines.append([name, row["unknowns"], digits_of_error(error) if error else NONE,
                      number(float(row["error"]), 2), number(float(row["seconds"]), 2), number(float(row["megabytes"]), 2)])
    header = ["model", "unknowns", "relative error of the frequency of S2", "error of Q33 in the release", "s", "MB"]
    return (header, lines) if lines else None


def digits_of_error(error):
    """Frequencies are known to about 1e-12."""
    known = 1e-12
    return number(float(error), 2) if float(error) > known else f"below {known:.0e}"


PACKAGES = {"GSL": "libgsl-dev", "odeint": "libboost-dev", "CVODE": "libsundials-dev", "ARKODE": "libsundials-dev",
            "SciPy": "python3-scipy", "FEniCSx": "python3-dolfinx-real"}


def library_version(data, part, library):
    """The version of a library that a part was measured with, by that of its package."""
    packages = read_runs(data)[part]["packages"]
    return re.search(re.escape(PACKAGES[library]) + r" (?:\d+:)?([\d.]*\d)", packages)[1]


def summary(data):
    """A line for each problem that has its data."""
    lines = []
    for problem, title in PROBLEMS.items():
        if not (measured := methods(data, problem)):
            continue
        header, rows = measured
        best = min((r for r in rows if r[3] != NONE and not r[0].startswith(LIBRARIES)), key=lambda r: float(r[3]))
        rival = min((r for r in rows if r[3] != NONE and r[0].startswith(LIBRARIES)), key=lambda r: float(r[3]))
        library, _, method = rival[0].partition(" ")
        lines.append([f"{title}, error 1e-10", f"{best[3]} ms ({best[0]})",
                      f"{rival[3]} ms ({library} {library_version(data, 'small-systems', library)}, {method})"])
    for level in (3e-4, 1e-4, 1e-5):
        own, peer = release_times(data, level)
        if own and peer:
            version = library_version(data, "peers", "FEniCSx")
            lines.append([f"elastic ball, release, error of Q33 {level:.0e}, interpolated",
                          f"{number(own, 2)} s; with set-up and output {number(release_times(data, level, 'seconds')[0], 2)} s",
                          f"{number(peer, 2)} s (FEniCSx {version})"])
    best = cheapest([r for r in read_rows(data, "ball_frequency.csv") if r["way"] == "octant"], 1e-9)
    if best:
        lines.append(["elastic ball, frequency of S2, relative error 1e-9", f"{number(float(best['seconds']))} s", NONE])
    return (["problem", "pseudorigid", "fastest other program measured"], lines) if lines else None
