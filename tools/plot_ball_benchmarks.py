#!/usr/bin/python3
"""Pictures of the ball's benchmarks (docs/benchmarks.md). Needs Debian's python3-matplotlib.

    tools/plot_ball_benchmarks.py --release ball_release.csv --kernels kernels.csv --output docs/images
"""

import argparse
import csv
import pathlib
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from run_directory import fail  # noqa: E402

# Okabe and Ito's colours, a marker for each as well: distinct with every kind of colour vision.
DEGREES = {2: ("#000000", "o"), 3: ("#E69F00", "s"), 4: ("#56B4E9", "D"), 5: ("#009E73", "^"), 6: ("#0072B2", "v"),
           7: ("#D55E00", "<"), 8: ("#CC79A7", ">")}
KERNELS = {"force": ("#0072B2", "o"), "constraint": ("#009E73", "s"), "rate": ("#E69F00", "D"),
           "reaction": ("#CC79A7", "^"), "gram": ("#000000", "v"), "FEEvaluation": ("#D55E00", "x")}
NAMES = {"gram": "action of S", "FEEvaluation": "force by dealii::FEEvaluation"}


def rows(path):
    try:
        lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    except OSError as error:
        fail(f"{path}: {error.strerror}")
    return list(csv.DictReader(lines))


def plot_release(path, output):
    """Each discretisation's runs, joined; the cheapest run for each error is what counts."""
    runs = defaultdict(list)
    for row in rows(path):
        runs[int(row["degree"]), int(row["refinements"])].append((float(row["seconds"]), float(row["error"])))
    figure, axes = plt.subplots(figsize=(7, 4.6), constrained_layout=True)
    for (degree, refinements), points in sorted(runs.items()):
        colour, marker = DEGREES[degree]
        front, best = [], float("inf")
        for seconds, error in sorted(points):
            if error < best:
                front.append((seconds, error))
                best = error
        axes.loglog(*zip(*front), color=colour, marker=marker, markersize=5, linewidth=1.2,
                    linestyle=["-", "--", ":"][refinements], markerfacecolor=colour if refinements == 0 else "white",
                    label=f"k = {degree}" + (f", refined {refinements}×" if refinements else ""))
    axes.set_xlabel("run time after start-up in s, one core")
    axes.set_ylabel("largest error of $Q_{33}$, $t$ ≤ 5")
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axes.legend(fontsize=8, ncol=2, frameon=False)
    figure.savefig(output / "benchmark_ball_release.svg")


def plot_kernels(path, output):
    throughput = defaultdict(list)
    for row in rows(path):
        throughput[row["kernel"]].append((int(row["degree"]), float(row["per_second"]) / 1e6))
    figure, axes = plt.subplots(figsize=(7, 4.2), constrained_layout=True)
    for kernel, points in throughput.items():
        colour, marker = KERNELS[kernel]
        axes.semilogy(*zip(*sorted(points)), color=colour, marker=marker, linewidth=1.2,
                      linestyle="--" if kernel == "FEEvaluation" else "-", label=NAMES.get(kernel, kernel))
    axes.set_xlabel("degree $k$")
    axes.set_ylabel("million unknowns per second, one core")
    axes.grid(True, which="both", color="#dddddd", linewidth=0.6)
    axes.legend(fontsize=8, ncol=2, frameon=False)
    figure.savefig(output / "benchmark_kernels.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--release", type=pathlib.Path)
    parser.add_argument("--kernels", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("."))
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    if arguments.release:
        plot_release(arguments.release, arguments.output)
    if arguments.kernels:
        plot_kernels(arguments.kernels, arguments.output)


if __name__ == "__main__":
    main()
