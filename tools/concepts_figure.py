#!/usr/bin/python3
"""Makes docs/images/concepts.svg again: material lines of a ball at rest and, after half a pulsation, in both models.

    tools/concepts_figure.py build/release/bin/pseudorigid

Needs Debian's python3-matplotlib and python3-vtk9.
"""

import argparse
import pathlib
import sys

import package  # noqa: F401
import numpy as np
from matplotlib.tri import CubicTriInterpolator, Triangulation
from pseudorigid.errors import WrongInput, exit_code_of
from pseudorigid.figures import BLUE, GREY, ORANGE, plt, save
from pseudorigid.frames import read_grid
from pseudorigid.program import run as run_scene
from vtkmodules.util.numpy_support import vtk_to_numpy

ROOT = pathlib.Path(__file__).resolve().parents[1]
STRETCH, TIME = 1.4, 1.1
LINES, FINE = np.linspace(-0.8, 0.8, 9), 121


def release(program, output):
    """A release from the stretch, with a picture at rest and one at the time."""
    return run_scene(ROOT / "params/quickstart.prm", {
        "Initial state/Deformation": f"$(1/sqrt({STRETCH})), 0, 0; 0, $(1/sqrt({STRETCH})), 0; 0, 0, {STRETCH}",
        "Continuum/Degree": 5, "Continuum/Refinements": 1, "Continuum/Error estimate": "none", "Time/End": TIME, "Output/Samples": 20,
        "Output/Frames": 2, "Output/Fields": "displacement"}, output=output, program=program)


def plane_motion(path):
    """(X1, X3) → (x1, x3) on the plane X2 = 0, between the points of a picture."""
    grid = read_grid(path)
    x, X = vtk_to_numpy(grid.GetPoints().GetData()), vtk_to_numpy(grid.GetPointData().GetArray("reference_coordinates"))
    _, first = np.unique(np.round(X[:, [0, 2]], 7)[np.abs(X[:, 1]) < 1e-9], axis=0, return_index=True)
    X, x = (points[np.abs(points_of_plane) < 1e-9][first] for points, points_of_plane in ((X, X[:, 1]), (x, X[:, 1])))
    triangles = Triangulation(X[:, 0], X[:, 2])
    parts = [CubicTriInterpolator(triangles, x[:, k] - X[:, k], kind="geom") for k in (0, 2)]
    return lambda a, c: (a + parts[0](a, c), c + parts[1](a, c))


def draw(ax, motion, colour, title):
    inside = 0.999  # of the radius: the triangles end a little within the sphere
    for value in LINES:
        way = np.linspace(-1, 1, FINE) * inside * np.sqrt(1 - value**2)
        for a, c in ((np.full(FINE, value), way), (way, np.full(FINE, value))):
            ax.plot(*motion(a, c), color=colour, linewidth=0.7)
    angle = np.linspace(0, 2 * np.pi, 361)
    ax.plot(*motion(0.998 * np.cos(angle), 0.998 * np.sin(angle)), color=colour, linewidth=1.8)
    ax.set_title(title, fontsize=10)
    ax.set(aspect="equal", xlim=(-1.3, 1.3), ylim=(-1.1, 1.1))
    ax.set_axis_off()


def affine(Q):
    return lambda a, c: (Q[0, 0] * a + Q[0, 2] * c, Q[2, 0] * a + Q[2, 2] * c)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--run", type=pathlib.Path, default=pathlib.Path("output/concepts"))
    arguments = parser.parse_args()
    if not arguments.program.is_file():
        raise WrongInput(f"{arguments.program} does not exist; scripts/run.sh builds it")
    run = release(arguments.program, arguments.run)
    figure, axes = plt.subplots(1, 3, figsize=(8, 2.7), layout="constrained")
    draw(axes[0], affine(np.eye(3)), GREY, "undeformed ball, X")
    draw(axes[1], plane_motion(run.frames("continuum")[-1].path), BLUE, "finite elements, x(X, t)")
    draw(axes[2], affine(run.matrices("reduced", "Q")[-1]), ORANGE, "pseudo-rigid, x = Q(t) X")
    angle, moment = np.linspace(0, 2 * np.pi, 361), run.matrices("continuum", "Q")[-1]
    axes[1].plot(*affine(moment)(np.cos(angle), np.sin(angle)), color="black", linestyle="--", linewidth=1.2, label="Q$_M$X")
    axes[1].legend(frameon=False, fontsize=8, loc="lower right")
    save(figure, ROOT / "docs/images/concepts.svg")


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
