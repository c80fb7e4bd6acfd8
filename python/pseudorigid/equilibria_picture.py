"""The picture of `python3 -m pseudorigid equilibria`."""

import pathlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from pseudorigid.equilibria import FLUID, Row, family
from pseudorigid.figures import BLACK, BLUE, GREEN, GREY, ORANGE, SKY, plt, save


def curve(program: pathlib.Path | None, entries: Mapping[str, Any], first: float, last: float, number: int) -> list[Row]:
    return family({**entries, "Equilibrium/First": first, "Equilibrium/Last": last, "Equilibrium/Number": number}, program)


def split_by_stability(rows: Sequence[Row]) -> list[tuple[int, list[Row]]]:
    """Runs of one kind of stability, each beginning where the one before ends."""
    def kind(row: Row) -> int:
        return 2 if not row["stable"] else 1 if row["n_negative"] else 0
    runs: list[list[Row]] = []
    for row in rows:
        if not runs or kind(runs[-1][-1]) != kind(row):
            runs.append(([runs[-1][-1]] if runs else []) + [row])
        else:
            runs[-1].append(row)
    return [(kind(run[-1]), run) for run in runs]


STYLE = {0: ("-", 2.2), 1: ("--", 1.8), 2: (":", 1.8)}


def draw(axes: Any, rows: Sequence[Row], x: Callable[[Row], float], y: Callable[[Row], float], colour: str, label: str) -> None:
    for kind, run in split_by_stability(rows):
        line, width = STYLE[kind]
        axes.plot([x(r) for r in run], [y(r) for r in run], line, color=colour, linewidth=width)
    axes.plot([], [], "-", color=colour, linewidth=2.2, label=label)


def draw_fluid_bodies(axes: Any, program: pathlib.Path | None) -> None:
    maclaurin = curve(program, {**FLUID, "Equilibrium/Family": "maclaurin"}, 0.02, 0.992, 244)
    jacobi = curve(program, {**FLUID, "Equilibrium/Family": "jacobi"}, 0.16, 0.999, 84)
    for rows, colour, name in ((maclaurin, BLUE, "Maclaurin"), (jacobi, ORANGE, "Jacobi")):
        members = [r for r in rows if r["kind"] == 0]
        draw(axes, members, lambda r: r["J3"], lambda r: r["omega3"] ** 2, colour, name)
    words = {1: ("greatest spin", (-0.55, 0.014)), 3: ("Jacobi branches off", (-1.1, -0.005)), 4: ("unstable from here", (0.1, 0.012))}
    for row in maclaurin:
        if row["kind"] in words:
            text, (dx, dy) = words[int(row["kind"])]
            axes.plot(row["J3"], row["omega3"] ** 2, "o", color=BLACK, markersize=5)
            axes.annotate(f"{text}\ne = {row['parameter']:.6f}", (row["J3"], row["omega3"] ** 2),
                          (row["J3"] + dx, row["omega3"] ** 2 + dy), fontsize=8, va="bottom" if dy > 0 else "top")
    axes.set_ylim(0, 0.58)
    axes.set_xlabel("angular momentum J  (units r = ρ = πGρ = 1)")
    axes.set_ylabel("squared spin Ω²/πGρ")
    axes.set_title("Fluid bodies with gravity", fontsize=10)
    axes.plot([], [], "--", color=GREY, label="stable without friction only")
    axes.plot([], [], ":", color=GREY, label="a disturbance grows")
    axes.legend(fontsize=8, loc="upper left")


def draw_elastic_bodies(axes: Any, program: pathlib.Path | None) -> None:
    for modulus, colour in zip((0, 0.02, 0.1, 0.3, 1), (BLACK, BLUE, SKY, GREEN, ORANGE)):
        law = {"Gravity/Constant": "$(1/pi)", **({"Material/Law": "none"} if modulus == 0 else {"Material/Shear modulus": modulus})}
        rows = curve(program, {**law, "Equilibrium/Family": "maclaurin"}, 0.02, 0.98, 193)
        name = "fluid" if modulus == 0 else f"μ = {modulus} ρ²πGr²"
        members = [r for r in rows if r["kind"] == 0]
        draw(axes, members, lambda r: r["parameter"], lambda r: r["omega3"], colour, name)
        axes.annotate(name, (members[-1]["parameter"], members[-1]["omega3"]), (5, 0 if modulus else -5),
                      textcoords="offset points", fontsize=8, va="center")
    axes.set_xlim(0, 1.3)
    axes.set_xticks([0, 0.2, 0.4, 0.6, 0.8, 1])
    axes.set_xlabel("eccentricity e of the meridian")
    axes.set_ylabel("spin Ω/√(πGρ)")
    axes.set_title("Neo-Hookean bodies with gravity: elastic Maclaurin spheroids", fontsize=10)


def write(program: pathlib.Path | None, output: pathlib.Path) -> None:
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    draw_fluid_bodies(left, program)
    draw_elastic_bodies(right, program)
    for axes in (left, right):
        axes.grid(True, color="#dddddd", linewidth=0.6)
    save(figure, output)
