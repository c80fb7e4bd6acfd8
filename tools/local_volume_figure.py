"""docs/images/local_volume.svg from docs/data/local_volume.csv: error of the local volume and error of Q over the degree of
the unrefined mesh, a curve for each volumetric stiffness."""
import csv

import package  # noqa: F401
from pseudorigid.figures import BLACK, BLUE, GREEN, ORANGE, SKY, plt, save

COLOURS = {0: BLUE, 1: SKY, 3: GREEN, 10: ORANGE, 30: BLACK}


def write(data, picture):
    with open(data, newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["refinements"] == "0" and row["volume_error"]]
    stretches = sorted({float(row["stretch"]) for row in rows})
    figure, axes = plt.subplots(2, len(stretches), figsize=(4.2 * len(stretches), 6.4), sharey="row", squeeze=False)
    for column, stretch in enumerate(stretches):
        for row_of_axes, (name, label) in enumerate((("volume_error", "largest rms of ln J"), ("q_error_5", "error of Q until t = 5 r/c"))):
            ax = axes[row_of_axes][column]
            for kappa, colour in COLOURS.items():
                curve = sorted((int(r["degree"]), float(r[name])) for r in rows if float(r["stretch"]) == stretch and float(r["kappa"]) == kappa)
                ax.semilogy(*zip(*curve), marker="o", markersize=4, color=colour, label=f"κ = {kappa} μ")
            ax.set_xticks([degree for degree, _ in curve])
            ax.set_xlabel("degree of the elements")
            if column == 0:
                ax.set_ylabel(label)
        axes[0][column].set_title(f"release from the stretch {stretch:g}", fontsize=10)
    axes[0][0].legend(fontsize=8)
    figure.tight_layout()
    save(figure, picture)
