#!/usr/bin/python3
"""docs/images/rheology.svg from docs/data/rheology.csv (benchmarks/rheology.py): size and loss 1/Q of the complex Love number k2
over the frequency, for gamma = 1, with the theory of the elastic sphere and of the pseudo-rigid ball."""
import csv
import math
import pathlib
import sys

import package  # noqa: F401
import numpy as np
from pseudorigid.figures import BLACK, BLUE, GREEN, ORANGE, SKY, plt, save

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "benchmarks"))
from rheology import FREQUENCY, MODELS, RHEOLOGIES, modulus  # noqa: E402

COLOURS = dict(zip(RHEOLOGIES, (BLUE, ORANGE, GREEN, SKY)))
MARKERS = {"reduced": ("o", "pseudo-rigid"), "polynomial": ("s", "polynomials, N = 3"), "continuum": ("x", "finite elements")}
GAMMA = 1


def love_number(factor, rheology, omega_tau):
    return 1.5 / (1 + factor * modulus(rheology, 1j * FREQUENCY, omega_tau / FREQUENCY) / GAMMA)


def write(data, picture):
    with open(data, newline="") as file:
        rows = [row for row in csv.DictReader(file) if float(row["gamma"]) == GAMMA]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4))
    grid = np.logspace(-2.3, 2.3, 200)
    for rheology, colour in COLOURS.items():
        for factor, style in ((9.5, "-"), (12.5, "--")):
            k2 = np.array([love_number(factor, rheology, x) for x in grid])
            left.plot(grid, np.abs(k2), style, color=colour, linewidth=1, label=rheology if factor == 9.5 else None)
            right.plot(grid, np.abs(np.imag(k2)) / np.abs(k2), style, color=colour, linewidth=1)
        for model in MODELS:
            found = [row for row in rows if row["model"] == model and row["rheology"] == rheology]
            x = [float(row["omega_tau"]) for row in found]
            style = dict(linestyle="none", marker=MARKERS[model][0], markersize=4, color=colour, fillstyle="none")
            left.plot(x, [float(row["size"]) for row in found], **style)
            right.plot(x, [abs(math.sin(float(row["phase"]))) for row in found], **style)
    for marker, label in MARKERS.values():
        right.plot([], [], linestyle="none", marker=marker, markersize=4, color=BLACK, fillstyle="none", label=label)
    for style, label in (("-", "theory, factor 19/2"), ("--", "theory, factor 25/2")):
        right.plot([], [], style, color=BLACK, linewidth=1, label=label)
    left.set_ylabel("|k₂|")
    right.set_ylabel("1/Q = |Im k₂|/|k₂|")
    left.set_yscale("log")
    right.set_yscale("log")
    for axes in left, right:
        axes.set_xscale("log")
        axes.set_xlabel("ω τ")
        axes.legend(fontsize=7)
    figure.tight_layout()
    save(figure, picture)


if __name__ == "__main__":
    write(ROOT / "docs/data/rheology.csv", ROOT / "docs/images/rheology.svg")
