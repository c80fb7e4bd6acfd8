"""The spin of a family of figures of equilibrium over its angular momentum, and its Campbell diagram: frequencies of small motions,
seen from the turning figure, over the spin. Needs Debian's python3-matplotlib.

    python3 -m pseudorigid campbell output/spinning_figures --output campbell.svg
"""
import argparse
import pathlib
from typing import Any

from pseudorigid.errors import WrongInput, needs
from pseudorigid.figures import plt, save, styles
from pseudorigid.results import Run

with needs("python3-numpy"):
    import numpy as np

TABLES = {"equilibria": "reduced", "equilibria-polynomial": "polynomial", "equilibria-continuum": "continuum"}
N_RATES = 10  # rates in a row of a table
Family = dict[str, np.ndarray]


def families(run: Run) -> dict[str, Family]:
    """The members of each family of the run by its model, of polynomial bodies with the degree: "polynomial-3"."""
    found: dict[str, Family] = {}
    for name, model in TABLES.items():
        if not (run.directory / f"{name}.csv").is_file():
            continue
        columns = run.columns(name)
        if "kind" not in columns or "omega3" not in columns:
            raise WrongInput(f"{run.directory}/{name}.csv has no family of figures that turn; use an Equilibrium/Family other than static")
        degrees = columns.get("degree", np.zeros(len(columns["kind"])))
        for degree in np.unique(degrees):
            rows = (degrees == degree) & (columns["kind"] == 0)
            if "growth_rate" not in columns:
                raise WrongInput(f"{run.directory}/{name}.csv has no small motions; use Equilibrium/Small motions = true")
            found[f"{model}-{degree:.0f}" if model == "polynomial" else model] = {key: values[rows] for key, values in columns.items()}
    if not found:
        raise WrongInput(f"{run.directory} has no table of a family; run a scene with Analysis = equilibrium and without a sweep")
    return found


def frequencies(family: Family) -> tuple[np.ndarray, np.ndarray]:
    """Spin and frequency of each oscillation in a row of the table. Rates come in conjugate pairs, of which the one with the positive
    frequency counts."""
    spins, found = [], []
    for k in range(1, N_RATES + 1):
        frequency = family[f"rate_{k}_im"]
        oscillates = frequency > 1e-6 * np.abs(frequency).max()
        spins.append(family["omega3"][oscillates])
        found.append(frequency[oscillates])
    return np.concatenate(spins), np.concatenate(found)


def name_of(model: str) -> str:
    return {"reduced": "pseudo-rigid", "continuum": "finite elements"}.get(model, model.replace("polynomial-", "N = "))


def draw(axes: Any, found: dict[str, Family]) -> None:
    marks = dict(zip(found, "osx+^v"))
    for model, style in styles(list(found)).items():
        family, colour = found[model], style["color"]
        order = np.argsort(family["J3"])
        axes[0].plot(family["J3"][order], family["omega3"][order], label=name_of(model), **style)
        unstable = family["growth_rate"] > 0
        axes[0].plot(family["J3"][unstable], family["omega3"][unstable], "o", color=colour, fillstyle="none")
        axes[1].plot(*frequencies(family), marks.get(model, "."), color=colour, markersize=4, fillstyle="none", label=name_of(model))


def write(run: Run, output: pathlib.Path) -> None:
    figure, axes = plt.subplots(1, 2, figsize=(9.6, 4.2))
    figure.subplots_adjust(left=0.075, right=0.985, top=0.95, bottom=0.13, wspace=0.2)
    found = families(run)
    draw(axes, found)
    table = next(name for name in TABLES if (run.directory / f"{name}.csv").is_file())
    units = run.units(table)

    def labelled(words: str, column: str) -> str:
        unit = units.get(column, "")
        return f"{words} ({unit})" if unit else words

    axes[0].set(xlabel=labelled("angular momentum", "J3"), ylabel=labelled("spin", "omega3"))
    axes[1].set(xlabel=labelled("spin", "omega3"), ylabel=labelled("frequency in the turning frame", "omega3"), ylim=(0, None))
    for one in axes:
        one.legend(fontsize=8, frameon=False)
    save(figure, output)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("run", type=pathlib.Path, help="directory of a run with Analysis = equilibrium")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("campbell.svg"), help="the picture (default: campbell.svg)")


def main(options: argparse.Namespace) -> None:
    write(Run(options.run), options.output)
