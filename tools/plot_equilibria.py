#!/usr/bin/python3
"""The picture of docs/equilibria.md: squared spin of fluid figures of equilibrium over their angular momentum, and the
spin of elastic spheroids between a ball of rubber and a ball of water. Needs Debian's python3-matplotlib.

    tools/plot_equilibria.py build/release/bin/pseudorigid --output docs/images/equilibria.svg
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from equilibria_tables import FLUID, family  # noqa: E402

BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "#777777"  # Okabe and Ito's


def curve(program, entries, first, last, number):
    return family(program, {**entries, "Equilibrium/First": first, "Equilibrium/Last": last,
                            "Equilibrium/Number": number})


def split_by_stability(rows):
    """Runs of one kind of stability, each beginning where the one before ends."""
    def kind(row):
        return 2 if not row["stable"] else 1 if row["n_negative"] else 0
    runs = []
    for row in rows:
        if not runs or kind(runs[-1][-1]) != kind(row):
            runs.append(([runs[-1][-1]] if runs else []) + [row])
        else:
            runs[-1].append(row)
    return [(kind(run[-1]), run) for run in runs]


STYLE = {0: ("-", 2.2), 1: ("--", 1.8), 2: (":", 1.8)}


def draw(axes, rows, x, y, colour, label):
    for kind, run in split_by_stability(rows):
        line, width = STYLE[kind]
        axes.plot([x(r) for r in run], [y(r) for r in run], line, color=colour, linewidth=width)
    axes.plot([], [], "-", color=colour, linewidth=2.2, label=label)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--output", required=True)
    options = parser.parse_args()

    maclaurin = curve(options.program, {**FLUID, "Equilibrium/Family": "maclaurin"}, 0.02, 0.992, 244)
    jacobi = curve(options.program, {**FLUID, "Equilibrium/Family": "jacobi"}, 0.16, 0.999, 84)
    plt.rcParams["svg.hashsalt"] = "pseudorigid"  # the same picture is the same file
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for rows, colour, name in ((maclaurin, BLUE, "Maclaurin"), (jacobi, ORANGE, "Jacobi")):
        members = [r for r in rows if r["kind"] == 0]
        draw(left, members, lambda r: r["J3"], lambda r: r["omega3"] ** 2, colour, name)
    for row in maclaurin:
        words = {1: ("greatest spin", (-0.55, 0.014)), 3: ("Jacobi branches off", (-1.1, -0.005)),
                 4: ("unstable from here", (0.1, 0.012))}
        if row["kind"] in words:
            text, (dx, dy) = words[row["kind"]]
            left.plot(row["J3"], row["omega3"] ** 2, "o", color="black", markersize=5)
            left.annotate(f"{text}\ne = {row['parameter']:.6f}", (row["J3"], row["omega3"] ** 2),
                          (row["J3"] + dx, row["omega3"] ** 2 + dy), fontsize=8, va="bottom" if dy > 0 else "top")
    left.set_ylim(0, 0.58)
    left.set_xlabel("angular momentum J  (units r = ρ = πGρ = 1)")
    left.set_ylabel("squared spin Ω²/πGρ")
    left.set_title("Fluid bodies with gravity", fontsize=10)

    shades = ["#000000", BLUE, "#56B4E9", "#009E73", ORANGE]
    for modulus, colour in zip((0, 0.02, 0.1, 0.3, 1), shades):
        law = {"Gravity/Constant": "$(1/pi)",
               **({"Material/Law": "none"} if modulus == 0 else {"Material/Shear modulus": modulus})}
        rows = curve(options.program, {**law, "Equilibrium/Family": "maclaurin"}, 0.02, 0.98, 193)
        name = "fluid" if modulus == 0 else f"μ = {modulus} ρ²πGr²"
        members = [r for r in rows if r["kind"] == 0]
        draw(right, members, lambda r: r["parameter"], lambda r: r["omega3"], colour, name)
        right.annotate(name, (members[-1]["parameter"], members[-1]["omega3"]), (5, 0 if modulus else -5),
                       textcoords="offset points", fontsize=8, va="center")
    right.set_xlim(0, 1.3)
    right.set_xticks([0, 0.2, 0.4, 0.6, 0.8, 1])
    right.set_xlabel("eccentricity e of the meridian")
    right.set_ylabel("spin Ω/√(πGρ)")
    right.set_title("Neo-Hookean bodies with gravity: elastic Maclaurin spheroids", fontsize=10)
    for axes in (left, right):
        axes.grid(True, color="#dddddd", linewidth=0.6)
    left.plot([], [], "--", color=GREY, label="stable without friction only")
    left.plot([], [], ":", color=GREY, label="a disturbance grows")
    left.legend(fontsize=8, loc="upper left")
    figure.savefig(options.output, metadata={"Date": None} if options.output.endswith(".svg") else None)


if __name__ == "__main__":
    main()
