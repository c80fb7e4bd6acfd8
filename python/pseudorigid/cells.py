"""The same picture of a body with linear cells and with Lagrange cells (Output/Cells), side by side, as VTK draws them.

Above is the body, below a part of its outline; white lines are edges of cells, colours the von Mises stress. Lagrange cells
are drawn with Nonlinear Subdivision Level 4. Needs Debian's python3-vtk9 and an X server:

    apt-get install python3-vtk9 xvfb xauth libgl1-mesa-dri
    xvfb-run -a python3 -m pseudorigid cells LINEAR.vtu LAGRANGE.vtu --output cells.png
"""

import argparse
import pathlib
from typing import Any

from pseudorigid.errors import WrongInput
from pseudorigid.frames import read_grid
from pseudorigid.render import FIELD, VIEW_FROM, check_screen, colours
from vtkmodules.vtkCommonCore import reference, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

SIZE = (1100, 960)
SUBDIVISION = 4  # of curved cells: 2^4 straight pieces along an edge
LARGEST = 0.5  # stress at the end of the colours, in the scene's unit
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


def edges(grid: Any) -> Any:
    """Edges of the outer faces of cells, each as a curve."""
    counts, faces = {}, []
    for k in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(k)
        for n in range(cell.GetNumberOfFaces()):
            face = cell.GetFace(n)
            centre = tuple(round(sum(face.GetPoints().GetPoint(i)[d] for i in range(4)) / 4, 7) for d in range(3))
            counts[centre] = counts.get(centre, 0) + 1
            faces.append((k, n, centre))
    points, lines = vtkPoints(), vtkCellArray()
    for k, n, centre in faces:
        if counts[centre] > 1:
            continue
        face = grid.GetCell(k).GetFace(n)
        for e in range(face.GetNumberOfEdges()):
            edge = face.GetEdge(e)
            n_pieces = 2**SUBDIVISION if edge.GetNumberOfPoints() > 2 else 1
            lines.InsertNextCell(n_pieces + 1)
            for i in range(n_pieces + 1):
                x, weights = [0.0] * 3, [0.0] * edge.GetNumberOfPoints()
                edge.EvaluateLocation(reference(0), [i / n_pieces, 0, 0], x, weights)
                lines.InsertCellPoint(points.InsertNextPoint(x))
    curves = vtkPolyData()
    curves.SetPoints(points)
    curves.SetLines(lines)
    return curves


def actors(grid: Any) -> tuple[Any, Any]:
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface(grid))
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(FIELD)
    mapper.SetLookupTable(colours(LARGEST))
    mapper.SetScalarRange(0, LARGEST)
    body = vtkActor()
    body.SetMapper(mapper)
    body.GetProperty().SetAmbient(0.75)
    body.GetProperty().SetDiffuse(0.25)
    lines = vtkPolyDataMapper()
    lines.SetInputData(edges(grid))
    lines.SetRelativeCoincidentTopologyLineOffsetParameters(-2, -40)
    lines.SetResolveCoincidentTopologyToPolygonOffset()
    drawn = vtkActor()
    drawn.SetMapper(lines)
    drawn.GetProperty().SetColor(1, 1, 1)
    drawn.GetProperty().SetLineWidth(1.5)
    drawn.GetProperty().LightingOff()
    return body, drawn


def view(window: Any, grid: Any, title: str, column: int) -> None:
    """Above the whole body, below its upper right outline."""
    extent = max(abs(x) for x in grid.GetBounds())
    for row, (scale, focus) in enumerate((((1.15 * extent), (0, 0, 0)), (CLOSE * extent, None))):
        renderer = vtkRenderer()
        renderer.SetViewport(0.5 * column, 0.45 * (1 - row), 0.5 * (column + 1), 0.45 + 0.55 * (1 - row))
        renderer.SetBackground(1, 1, 1)
        for actor in actors(grid):
            renderer.AddActor(actor)
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        size = sum(x * x for x in VIEW_FROM) ** 0.5
        right = (-VIEW_FROM[1], VIEW_FROM[0], 0)
        length = sum(x * x for x in right) ** 0.5
        focus = focus or tuple(0.66 * extent * r / length + (0.6 * extent if d == 2 else 0) for d, r in enumerate(right))
        camera.SetFocalPoint(*focus)
        camera.SetPosition(*(f + 10 * extent * x / size for f, x in zip(focus, VIEW_FROM)))
        camera.SetViewUp(0, 0, 1)
        camera.SetParallelScale(scale)
        renderer.ResetCameraClippingRange()
        if row == 0:
            text = vtkTextActor()
            text.SetInput(title)
            text.GetTextProperty().SetColor(0.1, 0.1, 0.1)
            text.GetTextProperty().SetFontSize(20)
            text.GetTextProperty().SetJustificationToCentered()
            text.SetPosition(SIZE[0] / 4, 0.55 * SIZE[1] - 30)
            renderer.AddViewProp(text)
        window.AddRenderer(renderer)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("linear", type=pathlib.Path)
    parser.add_argument("lagrange", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("cells.png"))


def main(arguments: argparse.Namespace) -> None:
    check_screen()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    for column, (path, title) in enumerate(((arguments.linear, "Cells = linear"), (arguments.lagrange, "Cells = lagrange"))):
        view(window, grid_of(path), title, column)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetFileName(str(arguments.output))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    print(arguments.output)
