#!/usr/bin/python3
"""docs/images/impacts.svg from docs/data/impacts.csv (benchmarks/impact_curve.py): restitution and largest force of a ball on a
rigid plane over its speed, with the laws of Hertz and of Jana et al. (2026)."""
import csv
import pathlib

import package  # noqa: F401
from pseudorigid.figures import BLACK, BLUE, GREEN, ORANGE, SKY, plt, save

ROOT = pathlib.Path(__file__).resolve().parents[1]
CURVES = (("continuum", None, BLACK, "finite elements"), ("polynomial", "7", BLUE, "polynomials, N = 7"),
          ("polynomial", "5", SKY, "N = 5"), ("polynomial", "3", GREEN, "N = 3"), ("reduced", None, ORANGE, "pseudo-rigid"))


def first_of_each_speed(rows):
    found = {}
    for row in rows:
        found.setdefault(float(row["v"]), row)
    return [found[v] for v in sorted(found)]


def write(data, picture):
    with open(data, newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["outcome"] == "done"]
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4))
    for model, degree, colour, label in CURVES:
        curve = first_of_each_speed(r for r in rows if r["model"] == model and degree in (None, r["degree"]))
        speeds = [float(r["v"]) for r in curve]
        for axes, name in ((left, "e"), (right, "force")):
            axes.plot(speeds, [float(r[name]) for r in curve], marker="o", markersize=4, color=colour, label=label)
    slow = [v for v in sorted({float(r["v"]) for r in rows}) if v <= 1]
    right.plot(slow, [5.2747 * v**-0.8 for v in slow], color=BLACK, linestyle=":", label="Hertz, v → 0")
    right.plot((1, 2), (3.24, 3.24), color=BLACK, linestyle="--", label="Jana et al., v > c")
    left.set_ylabel("coefficient of restitution")
    right.set_ylabel("largest force / (ρ v² r²)")
    right.set_yscale("log")
    for axes in left, right:
        axes.set_xscale("log")
        axes.set_xlabel("v/c")
    right.legend(fontsize=8)
    figure.tight_layout()
    save(figure, picture)


if __name__ == "__main__":
    write(ROOT / "docs/data/impacts.csv", ROOT / "docs/images/impacts.svg")
