#!/usr/bin/python3
"""Pictures of the benchmarks (docs/benchmarks.md): work-precision diagrams, the long run, and a table of ratios.
Needs Debian's python3-matplotlib.

    tools/plot_benchmarks.py work_precision.csv --long-run long_run.csv --output docs/images
    tools/plot_benchmarks.py work_precision.csv --table
"""

import argparse
import csv
import math
import pathlib
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from run_directory import fail  # noqa: E402

# Okabe and Ito's colours: distinct with every kind of colour vision; own methods full lines, rivals broken ones.
STYLES = {
    "symmetric-8": ("#0072B2", "o", "-"),
    "symmetric-12": ("#56B4E9", "s", "-"),
    "explicit-8": ("#009E73", "D", "-"),
    "rattle-8": ("#000000", "^", "-"),
    "rattle-6": ("#777777", "v", "-"),
    "GSL rk8pd": ("#D55E00", "o", "--"),
    "odeint rkf78": ("#E69F00", "s", "--"),
    "odeint Bulirsch-Stoer": ("#CC79A7", "D", "--"),
    "CVODE Adams": ("#8B4513", "^", ":"),
    "ARKODE order 8": ("#999933", "v", ":"),
}
TITLES = {
    "sl3": "(i) neo-Hookean pseudo-rigid ball on SL(3)",
    "rigid_body": "(ii) free rigid body",
    "double_pendulum": "(iii) double pendulum",
}
LEVELS = (1e-6, 1e-8, 1e-10, 1e-11, 1e-12)


def read(path):
    """problem -> method -> [(seconds, error, evaluations, constraint error)]"""
    problems = defaultdict(lambda: defaultdict(list))
    try:
        lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    except OSError as error:
        fail(f"{path}: {error.strerror}; benchmarks/work_precision writes it")
    for row in csv.DictReader(lines):
        problems[row["problem"]][row["method"]].append(
            (float(row["seconds"]), float(row["error"]), int(row["evaluations"]), float(row["constraint_error"]))
        )
    return problems


def bare(method):
    return method.removesuffix(" (constrained)").removesuffix(" (angles)")


def front(points):
    """The points that no other one of the method beats in time and in error."""
    best = []
    for point in sorted(points):
        if not best or point[1] < best[-1][1]:
            best.append(point)
    return best


def time_for(points, level):
    """Time for an error of `level`, on the straight lines through the front in logarithms; None if it is not reached."""
    line = front(points)
    if not line or line[-1][1] > level:
        return None
    for (t0, e0, *_), (t1, e1, *_) in zip(line, line[1:]):
        if e0 > level >= e1:
            share = math.log(e0 / level) / math.log(e0 / e1)
            return t0 * (t1 / t0) ** share
    return line[0][0]


def prepare():
    plt.rcParams.update({"font.size": 12, "font.family": "DejaVu Sans", "svg.hashsalt": "pseudorigid"})


def finish(axes):
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)


def draw_work_precision(problem, methods, output, image_format):
    figure, axes = plt.subplots(figsize=(9, 5.6), layout="constrained")
    for method in sorted(methods, key=lambda m: list(STYLES).index(bare(m)) if bare(m) in STYLES else 99):
        if bare(method) not in STYLES:
            continue
        color, marker, line = STYLES[bare(method)]
        in_angles = method.endswith("(angles)")
        points = front(methods[method])
        axes.loglog(
            [1e3 * p[0] for p in points],
            [p[1] for p in points],
            color=color,
            marker=marker,
            linestyle=line,
            linewidth=1.6,
            markersize=5,
            markerfacecolor="white" if in_angles else color,
            label=method,
        )
    axes.set_xlabel("processor time of the run (ms)")
    axes.set_ylabel("greatest error of positions and velocities")
    axes.set_title(TITLES.get(problem, problem) + ", T = 100", loc="left", fontsize=13)
    axes.set_ylim(1e-14, 1e-2)
    finish(axes)
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False, fontsize=10)
    save(figure, output / f"benchmark_{problem}.{image_format}")


def draw_long_run(path, output):
    with path.open() as file:
        rows = list(csv.DictReader(file))
    methods = list(dict.fromkeys(row["method"] for row in rows))
    quantities = [("energy_error", "energy"), ("J_error", "angular\nmomentum"), ("Z_error", "circulation"),
                  ("det_error", "det Q")]
    figure, all_axes = plt.subplots(len(quantities), 1, sharex=True, figsize=(7.5, 9), layout="constrained")
    colors = {"rattle-8": "#000000", "symmetric-8": "#0072B2", "symmetric-12": "#56B4E9", "energy-momentum": "#D55E00"}
    for axes, (column, label) in zip(all_axes, quantities):
        for method in methods:
            own = [r for r in rows if r["method"] == method and float(r["time"]) > 0]
            values = [max(abs(float(r[column])), 1e-17) for r in own]
            axes.semilogy([float(r["time"]) / 2 for r in own], values, ".", markersize=2.2, label=method,
                          color=colors.get(method, "#777777"), rasterized=True)
        axes.set_ylabel(f"|error| of\n{label}\n" + ("(absolute)" if column == "det_error" else "(relative)"))
        finish(axes)
    all_axes[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=4, frameon=False, markerscale=5,
                       fontsize=10, columnspacing=1, handletextpad=0.2)
    all_axes[-1].set_xlabel("time (periods of pulsation, 2 units of time)")
    save(figure, output / "benchmark_long_run.png")


def save(figure, path):
    try:
        figure.savefig(path, dpi=120, metadata={"Date": None} if path.suffix == ".svg" else None)
    except OSError as error:
        fail(f"{path}: {error.strerror}")
    print(path)
    plt.close(figure)


def print_table(problems):
    for problem, methods in problems.items():
        print(f"\n{TITLES.get(problem, problem)}: time in ms for an error of\n")
        print("| method | " + " | ".join(f"{level:.0e}" for level in LEVELS) + " | least error |")
        print("|---" * (len(LEVELS) + 2) + "|")
        for method, points in methods.items():
            times = [time_for(points, level) for level in LEVELS]
            cells = [f"{1e3 * t:.2f}" if t else "–" for t in times]
            print(f"| {method} | " + " | ".join(cells) + f" | {min(p[1] for p in points):.0e} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work_precision", type=pathlib.Path)
    parser.add_argument("--long-run", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--format", choices=("svg", "png"), default="svg", help="of the work-precision diagrams")
    parser.add_argument("--table", action="store_true", help="print the table instead of drawing")
    arguments = parser.parse_args()
    problems = read(arguments.work_precision)
    if arguments.table:
        print_table(problems)
        return
    prepare()
    for problem, methods in problems.items():
        draw_work_precision(problem, methods, arguments.output, arguments.format)
    if arguments.long_run:
        draw_long_run(arguments.long_run, arguments.output)


if __name__ == "__main__":
    main()
