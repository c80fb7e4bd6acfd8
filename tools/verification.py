#!/usr/bin/python3
"""Makes docs/images/verification.svg and the table of docs/verification.md again: errors against exact values, with the
rates at which they fall, fitted by least squares in logarithms.

    tools/verification.py build/release/bin/pseudorigid [--runs DIR]

The runs take about a minute; those that are there are used again. Needs Debian's python3-matplotlib.
"""

import argparse
import dataclasses
import hashlib
import math
import pathlib
import re
import sys

import package  # noqa: F401
import numpy as np
from pseudorigid.errors import WrongInput, exit_code_of
from pseudorigid.figures import BLACK, BLUE, GREEN, GREY, ORANGE, SKY, YELLOW, plt, save
from pseudorigid.program import run as run_scene
from pseudorigid.results import Run

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE, PICTURE = ROOT / "docs/verification.md", ROOT / "docs/images/verification.svg"
BEGIN, END = "<!-- begin: rates -->\n", "<!-- end: rates -->"
ROUND_OFF, DIGITS_OF_PERIOD = 2e-13, 3e-12  # errors below are not fitted
PERIOD = 2.0256220163011  # of the pseudo-rigid neo-Hookean ball from the stretch 1.5 (docs/physics.md)


@dataclasses.dataclass
class Series:
    """Errors over a resolution. `falls`: "power" of 1/x, or "exponential" in x."""

    name: str
    x: list
    error: list
    falls: str
    style: dict
    floor: float = ROUND_OFF
    n_fitted: int = 99  # of the finest that are above the floor

    def rate(self):
        """The power p of x⁻ᵖ, or the factor that one more degree brings."""
        kept = [(x, e) for x, e in zip(self.x, self.error) if e > self.floor][-self.n_fitted:]
        x, e = np.array(kept).T
        slope, _ = np.polyfit(np.log(x) if self.falls == "power" else x, np.log(e), 1)
        return -slope if self.falls == "power" else math.exp(-slope)


class Runs:
    """Runs of scenes; one that is complete in the directory of runs is not made again."""

    def __init__(self, program, directory):
        self.program, self.directory = program, directory

    def __call__(self, entries):
        self.directory.mkdir(parents=True, exist_ok=True)
        scene = self.directory / "empty.prm"
        scene.write_text("")
        output = self.directory / hashlib.sha256(repr(sorted(entries.items())).encode()).hexdigest()[:16]
        if (output / "manifest.json").is_file() and Run(output).manifest.get("state") == "done":
            return Run(output)
        return run_scene(scene, entries, output=output, program=self.program)


def bessel(x):
    """j₂(x) and its derivative."""
    s, c = math.sin(x), math.cos(x)
    j1, j2 = s / x**2 - c / x, (3 / x**3 - 1 / x) * s - 3 / x**2 * c
    return j2, j1 - 3 / x * j2


def frequency_with_gravity(gamma):
    """The root of the determinant of docs/physics.md, section 3, for n = 2, near 2.8 at gamma = 1."""
    k, n, N = 0.4, 2, 6

    def determinant(x):
        j, dj = bessel(x)
        return (-x * x + 2 * n * (n - 1) + gamma * k * n) * ((2 * N - 2 - x * x) * j - 2 * x * dj) - N * (2 * (x * dj - j) + gamma * k * j) * 2 * (n - 1)

    low, high = 2.7, 2.9
    while high - low > 1e-15:
        middle = (low + high) / 2
        low, high = (middle, high) if determinant(low) * determinant(middle) > 0 else (low, middle)
        if middle in (low, high) and high - low < 1e-14:
            break
    return (low + high) / 2


def frequency_error(run, model, exact, entries):
    """Of S2, relative to the exact frequency."""
    table = run({"Models": model, "Analysis": "modes", "Modes/Number": 2, "Output/Graphics": "none", **entries}).columns("modes")
    chosen = (table["kind"] == 1) & (table["degree"] == 2)
    return abs(table["omega"][chosen][0] / exact - 1)


def frequencies(run):
    lamb, gravity = 2.665622189236, {"Gravity/Constant": 3 / (4 * math.pi)}
    exact = frequency_with_gravity(1)
    degrees, odd = [2, 3, 4, 5], [1, 3, 5, 7, 9]
    element = lambda k, r=0: {"Continuum/Degree": k, "Continuum/Refinements": r}  # noqa: E731
    in_h = lambda k, refinements: [frequency_error(run, "continuum", lamb, element(k, r)) for r in refinements]  # noqa: E731
    return [
        Series("S2 (Lamb), finite elements", degrees, [frequency_error(run, "continuum", lamb, element(k)) for k in degrees], "exponential", dict(color=BLUE, marker="o")),
        Series("S2 (Lamb), polynomial bodies", odd, [frequency_error(run, "polynomial", lamb, {"Polynomial/Degree": N}) for N in odd], "exponential", dict(color=GREEN, marker="s", linestyle="-.")),
        Series("S2 with gravity, γ = 1 (Bromwich), finite elements", degrees[:3], [frequency_error(run, "continuum", exact, {**gravity, **element(k)}) for k in degrees[:3]], "exponential", dict(color=SKY, marker="^")),
        Series("S2 with gravity, γ = 1 (Bromwich), polynomial bodies", odd, [frequency_error(run, "polynomial", exact, {**gravity, "Polynomial/Degree": N}) for N in odd], "exponential", dict(color=BLACK, marker="v", linestyle=":")),
    ], [
        Series("S2 (Lamb), k = 2", [1, 2, 4], in_h(2, (0, 1, 2)), "power", dict(color=SKY, marker="o"), n_fitted=2),
        Series("S2 (Lamb), k = 3", [1, 2], in_h(3, (0, 1)), "power", dict(color=BLUE, marker="s")),
    ]


def love_error(run, n, k):
    """Of h_n at gamma = 1, relative to the exact number."""
    table = run({"Models": "continuum", "Analysis": "love numbers", "Gravity/Constant": 3 / (4 * math.pi), "Continuum/Degree": k}).columns("love-continuum")
    chosen = table["degree"] == n
    return abs(table["h"][chosen][0] / table["h_exact"][chosen][0] - 1)


def love_numbers(run):
    of_elements = lambda n, ks: [love_error(run, n, k) for k in ks]  # noqa: E731
    degrees = [2, 3, 4, 5, 6]
    return [
        Series("Love number h₂ (Kelvin), finite elements", degrees, of_elements(2, degrees), "exponential", dict(color=BLUE, marker="o")),
        Series("Love number h₄ (Kelvin), finite elements", degrees[2:], of_elements(4, degrees[2:]), "exponential", dict(color=SKY, marker="^")),
    ]


def motions(run):
    """Dirichlet's fluid and the step of the methods."""
    fluid = []
    for k in (2, 3, 4):
        result = run({"Models": "reduced, continuum", "Material/Law": "none", "Gravity/Constant": 1, "Continuum/Degree": k, "Time/End": 2,
                      "Initial state/Deformation": "$(1/sqrt(1.3)), 0, 0; 0, $(1/sqrt(1.3)), 0; 0, 0, 1.3", "Time/Tolerance": 1e-7, "Continuum/Error estimate": "none"})
        fluid.append(result.comparison["differences"]["q_difference"]["max"])
    dirichlet = Series("fluid ellipsoid (Dirichlet), finite elements", [2, 3, 4], fluid, "exponential", dict(color=ORANGE, marker="D"))
    steps = []
    for (method, numbers), style in zip(STEPS.items(), LINES):
        steps.append(Series(method, list(numbers), [closing_error(run, method, n) for n in numbers], "power", style, DIGITS_OF_PERIOD))
    return dirichlet, steps


LINES = [dict(color=c, marker=m) for c, m in zip((BLACK, ORANGE, BLUE, GREEN, SKY, YELLOW, GREY), "osD^vP*")]
N_PERIODS = 5
STEPS = {"rattle": (160, 320, 640, 1280, 2560), "rattle-4": (160, 320, 640, 1280, 2560), "symmetric-4": (320, 640, 1280, 2560, 5120),
         "rattle-6": (80, 113, 160, 226, 320, 640), "symmetric-8": (500, 600, 720, 860, 1040), "rattle-8": (48, 64, 80, 96, 113), "gauss-16": (14, 16, 18, 21, 24)}


def closing_error(run, method, n_steps):
    """The rate of Q33 after whole periods of a release from rest, where it vanishes, over its size."""
    result = run({"Models": "reduced", "Initial state/Deformation": "$(1/sqrt(1.5)), 0, 0; 0, $(1/sqrt(1.5)), 0; 0, 0, 1.5", "Time/End": N_PERIODS * PERIOD,
                  "Time/Method": method, "Time/Step": N_PERIODS * PERIOD / n_steps, "Output/Samples": 1})
    return abs(result.columns("reduced")["Qdot33"][-1])


def draw(panels):
    figure, axes = plt.subplots(2, 2, figsize=(9, 7.4), layout="constrained")
    for axis, (title, label, series) in zip(axes.flat, panels):
        for s in series:
            axis.plot(s.x, np.maximum(s.error, 1e-15), **s.style, markersize=4, linewidth=1.2, label=s.name)
        axis.set(title=title, xlabel=label, yscale="log", xscale="log" if series[0].falls == "power" else "linear")
        if label.startswith("degree"):
            axis.xaxis.get_major_locator().set_params(integer=True)
        if max(map(max, (s.x for s in series))) == 4:
            axis.set_xticks([1, 2, 4], ["1", "2", "4"])
            axis.minorticks_off()
        axis.grid(alpha=0.3)
        axis.legend(fontsize=6.5)
    for axis in axes[:, 0]:
        axis.set_ylabel("relative error")
    save(figure, PICTURE)


def rows(panels):
    for _, _, series in panels:
        for s in series:
            rate = f"order {s.rate():.2f}" if s.falls == "power" else f"a factor of {s.rate():.2g} for each degree"
            yield f"| {s.name} | {s.x[0]} … {s.x[-1]} | {s.error[0]:.1e} … {s.error[-1]:.1e} | {rate} |\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--runs", type=pathlib.Path, default=pathlib.Path("output/verification"))
    arguments = parser.parse_args()
    if not arguments.program.is_file():
        raise WrongInput(f"{arguments.program} does not exist; scripts/run.sh builds it")
    run = Runs(arguments.program, arguments.runs)
    in_degree, in_h = frequencies(run)
    dirichlet, steps = motions(run)
    panels = [("Modes and motions", "degree k or N", [*in_degree, dirichlet]), ("Love numbers", "degree k or N", love_numbers(run)),
              ("Refinement of the mesh", "cells along an edge, 1/h", in_h),
              (f"Time step, {N_PERIODS} periods", "steps", steps)]
    draw(panels)
    text = PAGE.read_text()
    head = "| Error | Resolutions | Errors | Rate |\n|---|---|---|---|\n"
    PAGE.write_text(re.sub(f"{re.escape(BEGIN)}.*?{re.escape(END)}", lambda _: BEGIN + head + "".join(rows(panels)) + END, text, flags=re.DOTALL))


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
