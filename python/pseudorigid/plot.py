"""Curves of a run: one component of the deformation over time, and below it

- of two models their difference, and the part of the elastic ball's kinetic energy that is in non-affine motion;
- of one model its semi-axes, and the kinetic and the elastic energy.

The component is the one that comparison.json names (C33, say, of C = Q^T Q, on which rotations do not count), of one model
the component of C that varies most, or an entry of Q or C of your choice. Needs Debian's python3-matplotlib.

    python3 -m pseudorigid plot output/quickstart
    python3 -m pseudorigid plot output/quickstart --quantity Q33 --output curves.svg
"""

import argparse
import pathlib
import re
from typing import Any

from pseudorigid.errors import WrongInput, needs
from pseudorigid.figures import BLUE, GREEN, YELLOW, plt, save, styles
from pseudorigid.results import Run

with needs("python3-numpy"):
    import numpy as np

FONT_SIZE = 13
AXES = [BLUE, YELLOW, GREEN]


def component(run: Run, model: str, quantity: str) -> np.ndarray:
    """The samples of an entry of Q or of C = Q^T Q."""
    letter, i, j = quantity[0], int(quantity[1]) - 1, int(quantity[2]) - 1
    Q = run.matrices(model, "Q")
    return (Q if letter == "Q" else np.einsum("nki,nkj->nij", Q, Q))[:, i, j]


def named_quantity(run: Run) -> str:
    """What comparison.json names, or the component of C with the largest variance."""
    if run.comparison and run.comparison.get("frequency"):
        return run.comparison["frequency"]["signal"]
    Q = run.matrices(run.models[-1], "Q")
    i, j = np.unravel_index(np.argmax(np.einsum("nki,nkj->nij", Q, Q).var(axis=0)), (3, 3))
    return f"C{min(i, j) + 1}{max(i, j) + 1}"


def draw_difference(run: Run, quantity: str, n: int, axes: Any) -> None:
    """The richest model beside the others, and below what the comparison says."""
    reference, *others = reversed(run.models)
    for model in others:
        difference = component(run, model, quantity)[:n] - component(run, reference, quantity)[:n]
        axes[1].plot(run.columns(model)["time"][:n], difference, color="#333333", linewidth=1.8)
    axes[1].axhline(0, color="#999999", linewidth=0.8)
    axes[1].set_ylabel("difference")
    table = run.columns(reference)
    if "nonaffine_kinetic_fraction" in table:
        axes[2].plot(table["time"][:n], table["nonaffine_kinetic_fraction"][:n], color=styles([reference])[reference]["color"], linewidth=1.8)
        axes[2].set_ylim(0, 1.05)
        axes[2].set_ylabel("non-affine /\nall kinetic\nenergy")


def draw_alone(table: dict[str, np.ndarray], axes: Any) -> None:
    """Semi-axes and energies, as far as the table has them."""
    for names, ax, label in (("a1 a2 a3".split(), axes[1], "semi-axes"), ("kinetic elastic".split(), axes[2], "energies")):
        for name, colour in zip(names, AXES):
            if name in table:
                ax.plot(table["time"], table[name], color=colour, linewidth=1.8, label=name)
        ax.set_ylabel(label)
        if ax.lines:
            ax.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)


def n_common_samples(run: Run) -> int:
    """A model that stopped early has fewer samples."""
    return min(len(run.columns(model)["time"]) for model in run.models)


def curves(run: Run, quantity: str | None = None) -> Any:
    """The figure of matplotlib."""
    if (run.directory / "sweep.csv").is_file():
        raise WrongInput(f"{run.directory} holds a sweep and no single motion; Run({str(run.directory)!r}).sweep() reads it")
    if run.manifest.get("system") or not any((run.directory / f"{model}.csv").is_file() for model in run.models):
        raise WrongInput(f"{run.directory} holds no motion of the ball")
    quantity = quantity or named_quantity(run)
    if not re.fullmatch("[QC][123][123]", quantity):
        raise WrongInput(f"--quantity: expected Q11 to Q33 or C11 to C33, got {quantity}")
    with plt.rc_context({"font.size": FONT_SIZE, "font.family": "DejaVu Sans"}):
        return drawn(run, quantity, n_common_samples(run))


def drawn(run: Run, quantity: str, n: int) -> Any:
    models = list(reversed(run.models))
    heights = [3, 1.6, 1.6]
    figure, axes = plt.subplots(3, 1, sharex=True, figsize=(7, 1.1 * sum(heights)), height_ratios=heights, layout="constrained")
    for model, style in styles(models).items():
        axes[0].plot(run.columns(model)["time"][:n], component(run, model, quantity)[:n], linewidth=2, label=run.title(model), **style)
    axes[0].set_ylabel(f"{quantity[0]}$_{{{quantity[1:]}}}$ (ratio of lengths{', squared' * (quantity[0] == 'C')})")
    axes[0].legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=len(models), frameon=False)
    if len(models) > 1:
        draw_difference(run, quantity, n, axes)
    else:
        draw_alone(run.columns(models[0]), axes)
    for ax in axes[1:]:
        if not ax.lines:
            ax.set_visible(False)
    for ax in axes:
        ax.grid(color="#dddddd", linewidth=0.6)
        ax.spines[["top", "right"]].set_visible(False)
        ax.tick_params(labelsize=FONT_SIZE)  # ticks are made later, when the figure is drawn
    shown = [ax for ax in axes if ax.get_visible()][-1]
    shown.set_xlabel("time (the scene's unit)")
    shown.tick_params(labelbottom=True)
    shown.set_xlim(0, run.columns(models[0])["time"][n - 1])
    figure.align_ylabels()
    return figure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--quantity", metavar="Qij|Cij", help="default: the one that comparison.json names, or that varies most")
    parser.add_argument("--output", type=pathlib.Path, metavar="SVG/PNG", help="default: RUN_DIRECTORY/comparison.svg")


def main(arguments: argparse.Namespace) -> None:
    run = Run(arguments.directory)
    output = arguments.output or arguments.directory / "comparison.svg"
    save(curves(run, arguments.quantity), output, dpi=120)
    print(f"{output}: {arguments.quantity or named_quantity(run)} of {n_common_samples(run)} samples")
