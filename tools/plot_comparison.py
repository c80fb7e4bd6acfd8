#!/usr/bin/python3
"""Curves of a run of both models: one component of the deformation over time, the difference of the models, and the
part of the elastic ball's kinetic energy that is in non-affine motion.

The component is the one that comparison.json names (C33, say, of C = Q^T Q, on which rotations do not count), or an
entry of Q or C of your choice. Needs Debian's python3-matplotlib.

    tools/plot_comparison.py output/quickstart
    tools/plot_comparison.py output/quickstart --quantity Q33 --output curves.svg
"""

import argparse
import json
import pathlib
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from run_directory import existing, fail, read_csv  # noqa: E402

# Okabe and Ito's colours: distinct with every kind of colour vision.
REDUCED = {"color": "#D55E00", "linestyle": "--", "label": "pseudo-rigid ball"}
CONTINUUM = {"color": "#0072B2", "linestyle": "-", "label": "elastic ball"}
REMEDY = "run the scene with Models = reduced, continuum"


def component(table, quantity, source):
    """Q33 is a column; C33 = sum over k of Qk3 Qk3."""
    letter, i, j = quantity
    try:
        if letter == "Q":
            return table[quantity]
        pairs = [zip(table[f"Q{k}{i}"], table[f"Q{k}{j}"]) for k in (1, 2, 3)]
    except KeyError as missing:
        fail(f"{source} has no column {missing}; run the scene with Output/Quantities = all")
    return [sum(a * b for a, b in row) for row in zip(*pairs)]


def named_quantity(directory):
    frequency = json.loads(existing(directory, "comparison.json", REMEDY).read_text())["frequency"]
    if frequency is None:
        fail("comparison.json names no component; run the scene with Output/Quantities = all")
    return frequency["signal"]


def draw(directory, quantity, output):
    tables = {m: read_csv(existing(directory, f"{m}.csv", REMEDY)) for m in ("reduced", "continuum", "comparison")}
    n_common = len(tables["comparison"]["time"])  # a model that stopped early has fewer samples
    time = tables["comparison"]["time"]
    reduced, continuum = (component(tables[m], quantity, f"{m}.csv")[:n_common] for m in ("reduced", "continuum"))
    nonaffine = tables["comparison"].get("nonaffine_kinetic_fraction")

    plt.rcParams.update({"font.size": 13, "font.family": "DejaVu Sans", "svg.hashsalt": "pseudorigid"})
    heights = [3, 1.6] + [1.6] * (nonaffine is not None)
    figure, axes = plt.subplots(
        len(heights), 1, sharex=True, figsize=(7, 1.1 * sum(heights)), height_ratios=heights, layout="constrained"
    )
    name = f"{quantity[0]}$_{{{quantity[1:]}}}$"
    axes[0].plot(time, continuum, linewidth=2, **CONTINUUM)
    axes[0].plot(time, reduced, linewidth=2, **REDUCED)
    axes[0].set_ylabel(f"{name} (ratio of lengths{', squared' * (quantity[0] == 'C')})")
    axes[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=2, frameon=False)
    axes[1].plot(time, [r - c for r, c in zip(reduced, continuum)], color="#333333", linewidth=1.8)
    axes[1].axhline(0, color="#999999", linewidth=0.8)
    axes[1].set_ylabel("pseudo-rigid\n$-$ elastic")
    if nonaffine is not None:
        axes[2].plot(time, nonaffine, color=CONTINUUM["color"], linewidth=1.8)
        axes[2].set_ylim(0, 1.05)
        axes[2].set_ylabel("non-affine /\nall kinetic\nenergy")
    for ax in axes:
        ax.grid(color="#dddddd", linewidth=0.6)
        ax.spines[["top", "right"]].set_visible(False)
    axes[-1].set_xlabel("time (the scene's unit)")
    axes[-1].set_xlim(time[0], time[-1])
    figure.align_ylabels()
    try:
        figure.savefig(output, dpi=120, metadata={"Date": None} if output.suffix == ".svg" else None)
    except (OSError, ValueError) as error:
        fail(f"--output: {error}")
    print(f"{output}: {quantity} of {n_common} samples")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--quantity", metavar="Qij|Cij", help="default: the one that comparison.json names")
    parser.add_argument("--output", type=pathlib.Path, metavar="SVG/PNG", help="default: RUN_DIRECTORY/comparison.svg")
    arguments = parser.parse_args()
    quantity = arguments.quantity or named_quantity(arguments.directory)
    if not re.fullmatch("[QC][123][123]", quantity):
        fail(f"--quantity: expected Q11 to Q33 or C11 to C33, got {quantity}")
    draw(arguments.directory, quantity, arguments.output or arguments.directory / "comparison.svg")


if __name__ == "__main__":
    main()
