"""docs/images/violent_motions.svg from docs/data/violent_motions.csv: the map of stability of violent releases. Each panel has
the stretch and the self-gravity; panels differ by degree, spin and law."""
import csv

import package  # noqa: F401
from pseudorigid.figures import ORANGE, SKY, YELLOW, plt, save

OUTCOMES = {"finished": (SKY, "", "reached t = 60 r/c"), "ended": (ORANGE, "////", "ended at the upper time, in r/c"),
            "long": (YELLOW, "....", "interrupted by the time limit")}
N_COLUMNS = 4


def number(text):
    value = float(text)
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}"


def title(degree, spin, law):
    parts = [f"degree {degree}"]
    if float(spin):
        parts.append(f"spin {float(spin):g} c/r")
    if law != "neo-hookean":
        parts.append(law)
    return ", ".join(parts)


def draw(axes, rows, stretches, gravities):
    for row in rows:
        x, y = stretches.index(float(row["stretch"])), gravities.index(float(row["gamma"]))
        colour, hatch, _ = OUTCOMES[row["outcome"]]
        axes.add_patch(plt.Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=colour, edgecolor="white", linewidth=0.6, hatch=hatch))
        lines = [number(row["time"])] if row["outcome"] != "finished" else []
        lines += [f"({number(row['biot_time'])})"] if row["biot_time"] else []
        if lines:
            axes.text(x, y, "\n".join(lines), ha="center", va="center", fontsize=6, linespacing=1.0,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6} if hatch else None)
    axes.set_xlim(-0.5, len(stretches) - 0.5)
    axes.set_ylim(-0.5, len(gravities) - 0.5)
    axes.set_xticks(range(len(stretches)), [f"{stretch:g}" for stretch in stretches], fontsize=8)
    axes.set_yticks(range(len(gravities)), [f"{gamma:g}" for gamma in gravities], fontsize=8)


def write(data, picture):
    with open(data, newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["outcome"]]
    stretches, gravities = (sorted({float(row[name]) for row in rows}) for name in ("stretch", "gamma"))
    keys = sorted({(row["law"] != "neo-hookean", float(row["spin"]), int(row["degree"]), row["law"]) for row in rows})
    n_rows = -(-len(keys) // N_COLUMNS)
    figure, grid = plt.subplots(n_rows, N_COLUMNS, figsize=(11, 2.5 * n_rows + 0.7), sharex=True, sharey=True, squeeze=False)
    for axes in grid.flat[len(keys):]:
        axes.set_visible(False)
    for i, (axes, (_, spin, degree, law)) in enumerate(zip(grid.flat, keys)):
        draw(axes, [row for row in rows if (float(row["spin"]), int(row["degree"]), row["law"]) == (spin, degree, law)], stretches, gravities)
        axes.set_title(title(degree, spin, law), fontsize=9)
        if i % N_COLUMNS == 0:
            axes.set_ylabel("γ")
        if i + N_COLUMNS >= len(keys):
            axes.set_xlabel("stretch")
            axes.tick_params(labelbottom=True)
    handles = [plt.Rectangle((0, 0), 1, 1, facecolor=colour, hatch=hatch, edgecolor="white", label=label)
               for name, (colour, hatch, label) in OUTCOMES.items() if any(row["outcome"] == name for row in rows)]
    handles.append(plt.Line2D([], [], linestyle="", label="(in brackets: time of Biot's limit)"))
    figure.tight_layout(rect=(0, 0.5 / (2.5 * n_rows + 0.7), 1, 1))
    figure.legend(handles=handles, loc="lower center", ncol=4, fontsize=8, frameon=False)
    save(figure, picture)
