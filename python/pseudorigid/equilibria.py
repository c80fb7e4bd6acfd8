"""Figures of equilibrium of fluid and elastic bodies, computed by the program: the page docs/data/equilibria.md on
standard output, or with --output the picture of docs/equilibria.md. The picture shows the squared spin of fluid bodies over
their angular momentum, and the spin of elastic spheroids between a ball of rubber and a ball of water.

    python3 -m pseudorigid equilibria > docs/data/equilibria.md
    python3 -m pseudorigid equilibria --output docs/images/equilibria.svg

The picture needs Debian's python3-matplotlib.
"""

import argparse
import pathlib
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from pseudorigid.errors import Stopped
from pseudorigid.program import run

Row = dict[str, float]  # of equilibria.csv

KINDS = {1: "fold", 3: "index", 4: "instability"}
FLUID = {"Material/Law": "none", "Gravity/Constant": "$(1/pi)"}  # πGρ = 1


def family(entries: Mapping[str, Any], program: pathlib.Path | None = None) -> list[Row]:
    """The rows of equilibria.csv; none if there is no such figure."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            found = run({"Models": "reduced", "Analysis": "equilibrium"}, entries, output=folder + "/out", program=program)
        except Stopped:
            return []
        columns = found.columns("equilibria")
        return [dict(zip(columns, row)) for row in zip(*(values.tolist() for values in columns.values()))]


def members(program: pathlib.Path | None, name: str, values: Iterable[float], extra: Mapping[str, Any] | None = None,
            **more: Any) -> list[Row]:
    """One row for each value of the family's parameter."""
    rows = []
    for value in values:
        rows += family({**(FLUID if extra is None else extra), "Equilibrium/Family": name, "Equilibrium/First": value,
                        "Equilibrium/Last": value, "Equilibrium/Number": 1,
                        **{f"Equilibrium/{key.replace('_', ' ')}": v for key, v in more.items()}}, program)
    return rows


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def stability(row: Row) -> str:
    return "stable" if row["stable"] and not row["n_negative"] else "stable without friction" if row["stable"] \
        else f"grows at {row['growth_rate']:.6f}"


def maclaurin(program: pathlib.Path | None) -> str:
    eccentricities = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.812670011, 0.85, 0.9, 0.929955685, 0.95, 0.952886702, 0.97, 0.99]
    rows = [[f"{r['parameter']:.9g}", f"{r['a3'] / r['a1']:.6f}", f"{r['omega3'] ** 2:.9f}", f"{r['J3']:.6f}", f"{r['energy']:.6f}",
             stability(r)] for r in members(program, "maclaurin", eccentricities)]
    special = [r for r in family({**FLUID, "Equilibrium/First": 0.02, "Equilibrium/Last": 0.99, "Equilibrium/Number": 98}, program)
               if r["kind"]]
    found = [[KINDS[int(r["kind"])], f"{r['parameter']:.9f}", f"{r['omega3'] ** 2:.9f}"] for r in special]
    return ("## Maclaurin\n\nSpheroids that turn rigidly, by the eccentricity e of their meridian.\n\n"
            + table(["e", "a₃/a₁", "Ω²/πGρ", "J", "energy", "stability"], rows)
            + "\nSpecial points, located along the family (e = 0.02 … 0.99):\n\n" + table(["kind", "e", "Ω²/πGρ"], found))


def jacobi(program: pathlib.Path | None) -> str:
    rows = [[f"{r['parameter']:.2f}", f"{r['a3'] / r['a1']:.6f}", f"{r['omega3'] ** 2:.6f}", f"{r['J3']:.6f}", f"{r['energy']:.6f}",
             stability(r)] for r in members(program, "jacobi", [0.99, 0.96, 0.92, 0.88, 0.84, 0.8, 0.72, 0.64, 0.56, 0.48, 0.44, 0.4,
                                                                0.32, 0.24, 0.16])]
    return ("## Jacobi\n\nEllipsoids that turn rigidly, by a₂/a₁. Dedekind's ellipsoids are their duals: the same axes, Ω and Λ, J and Z "
            "exchanged.\n\n" + table(["a₂/a₁", "a₃/a₁", "Ω²/πGρ", "J", "energy", "stability"], rows))


def riemann(program: pathlib.Path | None) -> str:
    text = "## Riemann S\n\nSpin Ω and circulation Λ about the axis 3, by the axis ratios; f = ζ/Ω.\n"
    for ratio in (0.8, 0.5, 0.3):
        rows = [[f"{r['parameter']:.2f}", f"{r['omega3']:.6f}", f"{r['Lambda3']:.6f}", f"{r['f']:.6f}", f"{r['J3']:.6f}", f"{r['Z3']:.6f}",
                 stability(r)] for r in members(program, "riemann-s", [0.95, 0.85, 0.75, 0.65, 0.55], Axis_ratio=ratio)]
        text += f"\n### a₃/a₁ = {ratio}\n\n" + table(["a₂/a₁", "Ω", "Λ", "f", "J", "Z", "stability"], rows)
    return text


def elastic(program: pathlib.Path | None) -> str:
    rows = []
    for gravity, name in ((0, "no gravity"), (0.2, "G = 0.2"), (1, "G = 1")):
        for r in members(program, "spheroids", [0.95, 0.9, 0.8, 0.7, 0.5, 0.3], extra={"Gravity/Constant": gravity}):
            rows.append([name, f"{r['parameter']:.2f}", f"{r['omega3']:.9f}", f"{r['J3']:.6f}", f"{r['energy']:.6f}", stability(r)])
    return ("## Elastic spheroids\n\nNeo-Hookean bodies with r = ρ = μ = 1, κ = 5, by the polar axis a₃; without gravity Ω² = κ(1 − a₃³).\n\n"
            + table(["gravity", "a₃", "Ω", "J", "energy", "stability"], rows))


def page(program: pathlib.Path | None) -> str:
    return ("# Tables of relative equilibria\n\nPrinted by `python3 -m pseudorigid equilibria` from the program's own `equilibria.csv`; "
            "[equilibria.md](../equilibria.md) says what the families are. Fluid bodies: units in which r = ρ = πGρ = 1. Stability is that of "
            "affine disturbances: *stable* means even with dissipation, *stable without friction* that the energy at fixed J and Z has "
            "falling directions but no small motion grows.\n\n"
            + "\n".join(part(program) for part in (maclaurin, jacobi, riemann, elastic)))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--program", type=pathlib.Path, metavar="PATH", help="of the program; default: the one that is installed or built")
    parser.add_argument("--output", type=pathlib.Path, metavar="SVG/PNG", help="draws the picture, and prints no tables")


def main(arguments: argparse.Namespace) -> None:
    if arguments.output:
        from pseudorigid import equilibria_picture

        equilibria_picture.write(arguments.program, arguments.output)
    else:
        print(page(arguments.program), end="")
