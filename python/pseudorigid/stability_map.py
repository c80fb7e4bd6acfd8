"""The map of stability (docs/testing.md) from its CSV file. Needs Debian's python3-matplotlib.

    python3 -m pseudorigid map docs/data/stability_map.csv docs/images/stability_map.svg
"""
import argparse
import csv
import pathlib
from typing import Any

from pseudorigid.errors import WrongInput
from pseudorigid.figures import ORANGE, SKY, YELLOW, plt, save

COLUMNS = ("kind", "degree", "amplitude", "step", "part_of_limit", "outcome", "time", "biot_time")
# With a hatching for each, the colours are distinct in print as well.
OUTCOMES = {"bounded": (SKY, "", "energy within 10 % until t = 25 r/c"),
            "lost": (YELLOW, "....", "energy off by more than 10 %"),
            "ended": (ORANGE, "////", "ended with a reason at the time in the square, in r/c")}


def edges(values: list[float]) -> list[float]:
    """Between neighbours half-way, and as far beyond the ends: cells whose middles are the values."""
    middle = [(a + b) / 2 for a, b in zip(values, values[1:])]
    return [2 * values[0] - middle[0], *middle, 2 * values[-1] - middle[-1]]


def draw(axes: Any, runs: list[dict[str, Any]], degree: int, biot: float) -> None:
    mine = [run for run in runs if run["degree"] == degree]
    amplitudes = sorted({run["amplitude"] for run in mine})
    parts = sorted({run["part_of_limit"] for run in mine})
    across, up = edges(list(range(len(amplitudes)))), edges(list(range(len(parts))))
    for run in mine:
        x, y = amplitudes.index(run["amplitude"]), parts.index(run["part_of_limit"])
        colour, hatch, _ = OUTCOMES[run["outcome"]]
        axes.add_patch(plt.Rectangle((across[x], up[y]), 1, 1, facecolor=colour, edgecolor="white", linewidth=0.6,
                                     hatch=hatch))
        if run["outcome"] == "ended":
            axes.text(x, y, f"{float(run['time']):.2g}", ha="center", va="center", fontsize=7,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.2})
        if run["biot_time"]:
            axes.plot(x + 0.34, y + 0.32, marker="o", markersize=5, color="black", markeredgecolor="white")
    place = sum(a < biot for a in amplitudes) - 1
    fraction = (biot - amplitudes[place]) / (amplitudes[place + 1] - amplitudes[place])
    axes.axvline(place + fraction, color="black", linewidth=1.6)
    axes.axhline(sum(p < 1 for p in parts) - 0.5, color="black", linewidth=1, linestyle="--")
    axes.set_xlim(across[0], across[-1])
    axes.set_ylim(up[0], up[-1])
    axes.set_xticks(range(len(amplitudes)), [f"{a:g}" for a in amplitudes], rotation=90, fontsize=8)
    axes.set_yticks(range(len(parts)), [f"{p:g}" for p in parts], fontsize=8)
    limit = mine[0]["step"] / mine[0]["part_of_limit"]
    axes.set_title(f"degree {degree}, stability limit {limit:.4f} r/c", fontsize=10)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("picture", type=pathlib.Path)


def main(options: argparse.Namespace) -> None:
    write(options.data, options.picture)


def write(data: pathlib.Path, picture: pathlib.Path) -> None:
    if not data.is_file():
        raise WrongInput(f"{data} does not exist; scripts/stress.sh map makes it")
    with open(data, newline="") as file:
        table = csv.DictReader(file)
        lines = list(table)
    absent = [name for name in COLUMNS if name not in (table.fieldnames or ())]
    if absent or not lines:
        raise WrongInput(f"{data} is not a map of stability: it has no {absent[0] if absent else 'row'}")
    biot = next(float(line["amplitude"]) for line in lines if line["kind"].startswith("Biot"))
    runs = [{**line, "degree": int(line["degree"]), "amplitude": float(line["amplitude"]), "step": float(line["step"]),
             "part_of_limit": float(line["part_of_limit"])} for line in lines if line["degree"] and line["outcome"]]
    degrees = sorted({run["degree"] for run in runs})
    figure, grid = plt.subplots(2, 2, figsize=(9, 7.6), sharex=True, sharey=True)
    figure.subplots_adjust(left=0.08, right=0.98, top=0.96, bottom=0.21, wspace=0.06, hspace=0.13)
    for axes, degree in zip(grid.flat, degrees):
        draw(axes, runs, degree, biot)
    for axes in grid[1]:
        axes.set_xlabel("amplitude a of the release, in c/r")
    for axes in grid[:, 0]:
        axes.set_ylabel("step / stability limit at rest")
    counts = {name: sum(run["outcome"] == name for run in runs) for name in OUTCOMES}
    handles = [plt.Rectangle((0, 0), 1, 1, facecolor=colour, hatch=hatch, edgecolor="white", label=f"{label} ({counts[name]} runs)")
               for name, (colour, hatch, label) in OUTCOMES.items() if counts[name]]
    handles.append(plt.Line2D([], [], marker="o", markersize=5, color="black", markeredgecolor="white", linestyle="",
                              label="the continuum's surface reached Biot's limit"))
    handles.append(plt.Line2D([], [], color="black", linewidth=1.6,
                              label=f"reduced model: a₃/a₁ reaches 0.2956 at a = {biot:.3f} c/r"))
    handles.append(plt.Line2D([], [], color="black", linewidth=1, linestyle="--",
                              label="stability limit of small motions at rest"))
    figure.legend(handles=handles, loc="lower center", ncol=2, fontsize=9, frameon=False)
    save(figure, picture)
