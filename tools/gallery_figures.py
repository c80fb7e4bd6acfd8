"""What the curves of docs/gallery.md share: colours, tables of runs, axes (tools/gallery.py)."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import package  # noqa: E402, F401
from pseudorigid.figures import BLACK, BLUE, GREEN, GREY, ORANGE, SKY, STYLES, save  # noqa: E402, F401
from pseudorigid.results import read_csv  # noqa: E402

REDUCED = {**STYLES["reduced"], "label": "pseudo-rigid ball"}
CONTINUUM = {**STYLES["continuum"], "label": "elastic ball"}
TIME = "time (r/c)"


def table(directory, name):
    return read_csv(directory / f"{name}.csv")


def both(directory):
    return table(directory, "continuum"), table(directory, "reduced")


def figure(n_rows=1, n_columns=1, height=3.2, **options):
    plt.rcParams.update({"font.size": 10.5, "font.family": "DejaVu Sans", "lines.linewidth": 1.7})
    drawn, axes = plt.subplots(n_rows, n_columns, figsize=(8, height), layout="constrained", squeeze=False, **options)
    for ax in axes.flat:
        ax.grid(color="#dddddd", linewidth=0.6)
        ax.spines[["top", "right"]].set_visible(False)
    return drawn, list(axes.flat)


def legend_above(ax, n_columns):
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=n_columns, frameon=False)


def label_axes(ax, x, y):
    ax.set_xlabel(x)
    ax.set_ylabel(y)


def two_models(ax, directory, column, y):
    for models_table, style in zip(both(directory), (CONTINUUM, REDUCED)):
        ax.plot(models_table["time"], column(models_table), **style)
    label_axes(ax, TIME, y)


def stretch_along_z(t):
    return np.sqrt(t["Q13"] ** 2 + t["Q23"] ** 2 + t["Q33"] ** 2)


def picture_of(pictures):
    """A decorator that puts a drawing, a function of run and of the picture's path, among `pictures` by its name."""
    def add(draw):
        pictures[draw.__name__] = draw
        return draw
    return add
