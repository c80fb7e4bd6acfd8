"""The same picture of a body with linear cells and with Lagrange cells (Output/Cells), side by side, as VTK draws them.

Above is the body, below a part of its outline, enlarged; white lines are edges of cells, and a bar at the bottom has the
colours of the von Mises stress. Lagrange cells are drawn with Nonlinear Subdivision Level 4. Needs Debian's python3-vtk9 and an X server:

    apt-get install python3-vtk9 xvfb xauth libgl1-mesa-dri
    xvfb-run -a python3 -m pseudorigid cells LINEAR.vtu LAGRANGE.vtu --output cells.png
"""

import argparse
import pathlib
from collections.abc import Iterator
from typing import Any

from pseudorigid.errors import WrongInput
from pseudorigid.frames import read_grid
from pseudorigid.render import FIELD, body, lines, polylines
from pseudorigid.window import (VIEW_FROM, check_screen, colour_bar, colours, look, new_window, normalized, renderer, text,
                                write_png)
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

SIZE = (1100, 1060)
SUBDIVISION = 4  # of curved cells: 2^4 straight pieces along an edge
LARGEST = 0.6  # stress at the end of the colours, in the scene's unit
# Parts of the height: the bar of colours, the lower views, the upper views.
BAR, LOWER, UPPER = 0.1, 0.4, 0.5
CLOSE = 0.22  # height of the lower views, in that of the upper ones


def grid_of(path: pathlib.Path) -> Any:
    grid = read_grid(path)
    if not grid.GetNumberOfCells() or not grid.GetPointData().HasArray(FIELD):
        raise WrongInput(f"{path} holds no cells with {FIELD}")
    return grid


def surface(grid: Any) -> Any:
    """The outer faces, curved ones in straight pieces."""
    faces = vtkDataSetSurfaceFilter()
    faces.SetInputData(grid)
    faces.SetNonlinearSubdivisionLevel(SUBDIVISION)
    faces.Update()
    return faces.GetOutput()


def edges(grid: Any) -> Iterator[list[list[float]]]:
    """Edges of the outer faces of cells, each as the points of a curve."""
    counts: dict[tuple[float, ...], int] = {}
    faces = []
    for k in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(k)
        for n in range(cell.GetNumberOfFaces()):
            face = cell.GetFace(n)
            centre = tuple(round(sum(face.GetPoints().GetPoint(i)[d] for i in range(4)) / 4, 7) for d in range(3))
            counts[centre] = counts.get(centre, 0) + 1
            faces.append((k, n, centre))
    for k, n, centre in faces:
        if counts[centre] > 1:
            continue
        face = grid.GetCell(k).GetFace(n)
        for e in range(face.GetNumberOfEdges()):
            edge = face.GetEdge(e)
            n_pieces = 2**SUBDIVISION if edge.GetNumberOfPoints() > 2 else 1
            yield [point_on(edge, i / n_pieces) for i in range(n_pieces + 1)]


def point_on(edge: Any, part: float) -> list[float]:
    """The point of an edge at this part of its parameter, from 0 to 1."""
    x, weights = [0.0] * 3, [0.0] * edge.GetNumberOfPoints()
    edge.EvaluateLocation(reference(0), [part, 0, 0], x, weights)
    return x


def show(window: Any, grid: Any, title: str, column: int) -> None:
    """Above the whole body, below its upper right outline."""
    extent = max(abs(x) for x in grid.GetBounds())
    right = normalized((-VIEW_FROM[1], VIEW_FROM[0], 0))
    outline = extent * (0.66 * right + (0, 0, 0.6))
    for bottom, height, half_height, focus, name in ((BAR + LOWER, UPPER, 1.15 * extent, (0, 0, 0), title),
                                                     (BAR, LOWER, CLOSE * extent, outline, "enlarged")):
        view = renderer(window, 0.5 * column, bottom, 0.5 * (column + 1), bottom + height)
        view.AddActor(body(surface(grid), colours(LARGEST), ambient=0.75, smooth=False))
        view.AddActor(lines(polylines(edges(grid)), (1, 1, 1), 1.5, offset=(-2, -40)))
        look(view, half_height, 10 * extent, focus)
        view.AddActor2D(text(name, 20, 0.5 if name == title else 0.85, 1 - 30 / (height * SIZE[1])))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("linear", type=pathlib.Path)
    parser.add_argument("lagrange", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("cells.png"))


def main(arguments: argparse.Namespace) -> None:
    check_screen()
    window = new_window(*SIZE)
    for column, (path, title) in enumerate(((arguments.linear, "Cells = linear"), (arguments.lagrange, "Cells = lagrange"))):
        show(window, grid_of(path), title, column)
    strip = renderer(window, 0, 0, 1, BAR)
    strip.AddActor2D(colour_bar(colours(LARGEST)))
    strip.AddActor2D(text("von Mises stress (the scene's unit of pressure)", 20, 0.5, 0.08))
    write_png(window, arguments.output)
    print(arguments.output)
