#!/usr/bin/env python3
"""Writes docs/equilibria_tables.md: figures of equilibrium of fluid and elastic bodies, computed by the program.

    tools/equilibria_tables.py build/release/bin/pseudorigid > docs/equilibria_tables.md
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

KINDS = {1: "fold", 3: "index", 4: "instability"}
FLUID = {"Material/Law": "none", "Gravity/Constant": "$(1/pi)"}  # πGρ = 1


def family(program, entries):
    """The rows of equilibria.csv, as dictionaries of numbers; none where there is no such figure."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, "scene.prm")
        scene.write_text("set Models = reduced\nset Analysis = equilibrium\n")
        options = [word for path, value in entries.items() for word in ("--set", f"{path}={value}")]
        result = subprocess.run([program, "run", scene, "--quiet", "--output", folder + "/out", *options], stderr=subprocess.PIPE)
        if result.returncode == 3:
            return []
        result.check_returncode()
        with open(folder + "/out/equilibria.csv", newline="") as file:
            return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def members(program, name, values, extra=None, **more):
    """One row for each value of the family's parameter."""
    rows = []
    for value in values:
        rows += family(program, {**(FLUID if extra is None else extra), "Equilibrium/Family": name, "Equilibrium/First": value,
                                 "Equilibrium/Last": value, "Equilibrium/Number": 1,
                                 **{f"Equilibrium/{key.replace('_', ' ')}": v for key, v in more.items()}})
    return rows


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def stability(row):
    return "stable" if row["stable"] and not row["n_negative"] else "stable without friction" if row["stable"] \
        else f"grows at {row['growth_rate']:.6f}"


def maclaurin(program):
    eccentricities = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.812670011, 0.85, 0.9, 0.929955685, 0.95, 0.952886702, 0.97, 0.99]
    rows = [[f"{r['parameter']:.9g}", f"{r['a3'] / r['a1']:.6f}", f"{r['omega3'] ** 2:.9f}", f"{r['J3']:.6f}", f"{r['energy']:.6f}",
             stability(r)] for r in members(program, "maclaurin", eccentricities)]
    special = [r for r in family(program, {**FLUID, "Equilibrium/First": 0.02, "Equilibrium/Last": 0.99, "Equilibrium/Number": 98})
               if r["kind"]]
    found = [[KINDS[int(r["kind"])], f"{r['parameter']:.9f}", f"{r['omega3'] ** 2:.9f}"] for r in special]
    return ("## Maclaurin\n\nSpheroids that turn rigidly, by the eccentricity e of their meridian.\n\n"
            + table(["e", "a₃/a₁", "Ω²/πGρ", "J", "energy", "stability"], rows)
            + "\nSpecial points, located along the family (e = 0.02 … 0.99):\n\n" + table(["kind", "e", "Ω²/πGρ"], found))


def jacobi(program):
    rows = [[f"{r['parameter']:.2f}", f"{r['a3'] / r['a1']:.6f}", f"{r['omega3'] ** 2:.6f}", f"{r['J3']:.6f}", f"{r['energy']:.6f}",
             stability(r)] for r in members(program, "jacobi", [0.99, 0.96, 0.92, 0.88, 0.84, 0.8, 0.72, 0.64, 0.56, 0.48, 0.44, 0.4,
                                                                0.32, 0.24, 0.16])]
    return ("## Jacobi\n\nEllipsoids that turn rigidly, by a₂/a₁. Dedekind's ellipsoids are their duals: the same axes, Ω and Λ, J and Z "
            "exchanged.\n\n" + table(["a₂/a₁", "a₃/a₁", "Ω²/πGρ", "J", "energy", "stability"], rows))


def riemann(program):
    text = "## Riemann S\n\nSpin Ω and circulation Λ about the axis 3, by the axis ratios; f = ζ/Ω.\n"
    for ratio in (0.8, 0.5, 0.3):
        rows = [[f"{r['parameter']:.2f}", f"{r['omega3']:.6f}", f"{r['Lambda3']:.6f}", f"{r['f']:.6f}", f"{r['J3']:.6f}", f"{r['Z3']:.6f}",
                 stability(r)] for r in members(program, "riemann-s", [0.95, 0.85, 0.75, 0.65, 0.55], Axis_ratio=ratio)]
        text += f"\n### a₃/a₁ = {ratio}\n\n" + table(["a₂/a₁", "Ω", "Λ", "f", "J", "Z", "stability"], rows)
    return text


def elastic(program):
    rows = []
    for gravity, name in ((0, "no gravity"), (0.2, "G = 0.2"), (1, "G = 1")):
        for r in members(program, "spheroids", [0.95, 0.9, 0.8, 0.7, 0.5, 0.3], extra={"Gravity/Constant": gravity}):
            rows.append([name, f"{r['parameter']:.2f}", f"{r['omega3']:.9f}", f"{r['J3']:.6f}", f"{r['energy']:.6f}", stability(r)])
    return ("## Elastic spheroids\n\nNeo-Hookean bodies with r = ρ = μ = 1, κ = 5, by the polar axis a₃; without gravity Ω² = κ(1 − a₃³).\n\n"
            + table(["gravity", "a₃", "Ω", "J", "energy", "stability"], rows))


def page(program):
    return ("# Tables of relative equilibria\n\nPrinted by `tools/equilibria_tables.py` from the program's own `equilibria.csv`; "
            "[equilibria.md](equilibria.md) says what the families are. Fluid bodies: units in which r = ρ = πGρ = 1. Stability is that of "
            "affine disturbances: *stable* means even with dissipation, *stable without friction* that the energy at fixed J and Z has "
            "falling directions but no small motion grows.\n\n"
            + "\n".join(part(program) for part in (maclaurin, jacobi, riemann, elastic)))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print(page(sys.argv[1]), end="")
