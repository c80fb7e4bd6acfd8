"""A picture of the bodies of a run at one time, drawn off-screen with VTK.

Every model of the run has its body, the richest on the left, coloured by von Mises stress on one scale and seen by one
camera, with z upwards. A quarter is taken out. Thin lines are the edges of the finite elements and, on the pseudo-rigid
ball beside them, the same material lines; of a body alone those of its own blocks. A dashed circle is the outline of the
undeformed ball. The colour bar ends where 98 % of the shown surface are within it; what is beyond has its last colour.

The run must have been made with Output/Graphics = vtu. Needs Debian's python3-vtk9, which draws through
an X server; without a screen:

    apt-get install python3-vtk9 xvfb xauth libgl1-mesa-dri
    xvfb-run -a python3 -m pseudorigid render output/quickstart --frame 14 --output ball.png
"""

import argparse
import math
import os
import pathlib
from collections.abc import Sequence
from typing import Any

from pseudorigid.errors import WrongInput, needs
from pseudorigid.frames import read_grid
from pseudorigid.results import Run
from pseudorigid.window import VIEW_FROM, check_screen, colour_bar, colours, look, new_window, normalized, renderer, text, write_png

with needs("python3-vtk9"):
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

WIDTH, HEIGHT = 1020, 680
FIELD = "von_mises"
SATURATED = 0.98  # the part of the points within the colour bar: stresses peak where waves meet
FINE = 12  # intervals along the edge of an element
BLOCK_OF_ANALYTIC_MODELS = 4  # degree of the blocks that a model without elements is drawn with
STRIP = 0.21  # part of the height below the bodies, with the colour bar


def read_points(path: pathlib.Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions x, displacements x - X and stresses at the points of a .vtu."""
    grid = read_grid(path)
    data = grid.GetPointData()
    if data.GetArray(FIELD) is None or data.GetArray("displacement") is None:
        raise WrongInput(f"{path} cannot be read, or lacks the fields displacement and {FIELD}")
    x = vtk_to_numpy(grid.GetPoints().GetData())
    return x, vtk_to_numpy(data.GetArray("displacement")), vtk_to_numpy(data.GetArray(FIELD))


Scene = tuple[float, float, dict[str, tuple[np.ndarray, np.ndarray]]]  # time, radius, and by the title of a model position and stress


class Faces:
    """The faces of the blocks that are to be seen, on a grid finer than their nodes: the polynomials through the nodes are
    evaluated, so that curved faces look curved. A block is (degree + 1)^3 points, by their numbers."""

    def __init__(self, blocks: np.ndarray, reference: np.ndarray, nodes: np.ndarray, radius: float, cut: bool) -> None:
        self.to_fine = interpolation(nodes)
        lattices = reference[blocks]
        self.chosen = [
            np.take(blocks[block], side, axis)
            for block, lattice in enumerate(lattices)
            for axis in (range(3) if lattice.shape[0] > 1 else (0,))
            for side in ((0, -1) if lattice.shape[0] > 1 else (0,))
            if is_seen(np.take(lattice, side, axis), lattice.mean(axis=(0, 1, 2)), radius, cut)
        ]

    def of(self, values: np.ndarray) -> np.ndarray:
        """Values at the points -> values on the faces, (face, i, j, component)."""
        nodes = values.reshape(len(values), -1)[np.array(self.chosen)]
        return np.einsum("ai,bj,fijc->fabc", self.to_fine, self.to_fine, nodes)


def is_seen(face: np.ndarray, centre: np.ndarray, radius: float, cut: bool) -> bool:
    """On the surface of the ball or, where the quarter x > 0 > y is taken out, on the cut."""
    near = 1e-6 * radius
    if cut and centre[0] > 0 > centre[1]:
        return False
    if np.all(np.abs(np.linalg.norm(face, axis=-1) - radius) < near):
        return True
    on_x, on_y = (np.all(np.abs(face[..., k]) < near) for k in (0, 1))
    return cut and bool((on_x and centre[1] < 0) or (on_y and centre[0] > 0))


def interpolation(nodes: np.ndarray) -> np.ndarray:
    """Lagrange's polynomials on these nodes in [-1, 1] at equidistant points."""
    degree, vandermonde = len(nodes) - 1, np.polynomial.legendre.legvander
    return vandermonde(np.linspace(-1, 1, FINE + 1), degree) @ np.linalg.inv(vandermonde(nodes, degree))


def gauss_lobatto(degree: int) -> np.ndarray:
    inner = np.polynomial.legendre.Legendre.basis(degree).deriv().roots().real
    return np.concatenate(([-1], np.sort(inner), [1]))


def blocks_of(hexahedra: np.ndarray, degree: int) -> np.ndarray:
    """The points of each block, from its degree^3 hexahedra with straight edges, the first direction fastest:
    (block, k, j, i)."""
    cells = hexahedra.reshape(-1, degree, degree, degree, 8)
    blocks = np.empty((len(cells), degree + 1, degree + 1, degree + 1), dtype=hexahedra.dtype)
    for corner, (i, j, k) in enumerate([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]):
        blocks[:, k:k + degree, j:j + degree, i:i + degree] = cells[..., corner]
    return blocks


def quadrilaterals(points: np.ndarray, corners: np.ndarray, values: np.ndarray | None = None) -> Any:
    """VTK's surface of quadrilaterals, each the numbers of its four points; values at the points give colours."""
    data, positions, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    positions.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    for four in corners.tolist():
        cells.InsertNextCell(4, four)
    data.SetPoints(positions)
    data.SetPolys(cells)
    if values is not None:
        scalars = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        scalars.SetName(FIELD)
        data.GetPointData().SetScalars(scalars)
    return data


def surface(positions: np.ndarray, stress: np.ndarray) -> Any:
    """Quadrilaterals of all faces; positions and stress as from Faces.of."""
    m = FINE + 1
    of_face = (np.arange(FINE)[:, None] * m + np.arange(FINE)).ravel()
    first = (np.arange(len(positions))[:, None] * m * m + of_face).ravel()
    return quadrilaterals(positions.reshape(-1, 3), np.stack([first, first + 1, first + m + 1, first + m], axis=-1), stress.ravel())


def polylines(curves: Any) -> Any:
    data, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    for curve in curves:
        cells.InsertNextCell(len(curve))
        for point in curve:
            cells.InsertCellPoint(points.InsertNextPoint(point))
    data.SetPoints(points)
    data.SetLines(cells)
    return data


def edges(positions: np.ndarray) -> Any:
    return polylines([side for f in positions for side in (f[0], f[-1], f[:, 0], f[:, -1])])


def body(data: Any, table: Any, ambient: float = 0.7, smooth: bool = True) -> Any:
    """A surface, coloured by its scalars; of one colour without a table. Much ambient light lets the colour be read off, and
    the shading shows the shape alone."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(with_normals(data) if smooth else data)
    if table:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(FIELD)
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
    else:
        mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(ambient)
    actor.GetProperty().SetDiffuse(1 - ambient)
    actor.GetProperty().SetSpecular(0)
    return actor


def with_normals(data: Any) -> Any:
    normals = vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SplittingOff()
    normals.Update()
    return normals.GetOutput()


def lines(polydata: Any, colour: Any, width: float, opacity: float = 1.0, offset: tuple[float, float] = (-4, -4)) -> Any:
    """Lines on a surface; the offset moves them towards the camera, so that the surface does not hide them."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(polydata)
    mapper.ScalarVisibilityOff()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyLineOffsetParameters(*offset)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().SetOpacity(opacity)
    actor.GetProperty().LightingOff()
    return actor


def dashed_circle(radius: float, distance: float, n_dashes: int = 48) -> Any:
    """Outline of the undeformed ball, held `distance` before it so that nothing hides it."""
    to_camera = normalized(VIEW_FROM)
    right = normalized(np.cross((0, 0, 1), to_camera))
    up = np.cross(to_camera, right)
    angles = 2 * math.pi / n_dashes * (np.arange(n_dashes)[:, None] + np.linspace(0, 0.55, 5))
    in_plane = np.cos(angles)[..., None] * right + np.sin(angles)[..., None] * up
    return polylines(radius * in_plane + distance * to_camera)


def aim(view: Any, extent: float) -> None:
    """At a whole body, with room for a title above it."""
    look(view, 1.22 * extent, 10 * extent)
    view.GetActiveCamera().SetWindowCenter(0, 0.1)


def rounded_up(value: float) -> float:
    """The next 1, 1.2, 1.6, 2, 2.4, 3.2, 4, 6, 8 or 10 times a power of ten: divided by 4 it is short."""
    if value <= 0:
        return 1
    power = 10 ** math.floor(math.log10(value))
    return power * next(m for m in (1, 1.2, 1.6, 2, 2.4, 3.2, 4, 6, 8, 10) if m * power >= 0.999 * value)


def caption(largest: float, table: Any) -> str:
    beyond = f"; largest {largest:.2g}" if largest > table.GetRange()[1] else ""
    return f"von Mises stress (the scene's unit of pressure{beyond})"


def degree_of(run: Run, model: str) -> int:
    """Of the blocks of a model's pictures; of finite elements their own, as it was asked for or found."""
    if not run.has_elements(model):
        return BLOCK_OF_ANALYTIC_MODELS
    degree = run.entry("Continuum/Degree")
    return int(run.counter(model, "degree") if degree == "auto" else degree)


def cells_of(path: pathlib.Path) -> np.ndarray:
    """The points of each cell."""
    grid = read_grid(path)
    cells = grid.GetCells()
    return vtk_to_numpy(cells.GetConnectivityArray()).reshape(cells.GetNumberOfCells(), -1)


def faces_of(run: Run, model: str, path: pathlib.Path, reference: np.ndarray, radius: float, cut: bool) -> Faces:
    """Finite elements have their points one element after the other; other models are drawn with hexahedra, in blocks, or
    by their surface alone, each cell a face of its own."""
    degree = degree_of(run, model)
    if run.has_elements(model):
        blocks, nodes = np.arange(len(reference)).reshape(-1, degree + 1, degree + 1, degree + 1), gauss_lobatto(degree)
    else:
        cells = cells_of(path)
        if cells.shape[1] == 4:
            return Faces(cells[:, [0, 1, 3, 2]].reshape(-1, 1, 2, 2), reference, np.array([-1, 1]), radius, cut=False)
        if cells.shape[1] != 8:
            raise WrongInput(f"{path} has curved cells; run the scene with Output/Cells = linear, or use python3 -m pseudorigid paraview")
        blocks, nodes = blocks_of(cells, degree), np.linspace(-1, 1, degree + 1)
    return Faces(blocks, reference, nodes, radius, cut)


def read_bodies(run: Run, frame: int, cut: bool) -> Scene:
    """Time, radius, and by the title of each model position and stress on material faces; an affine body has those of the elements that are
    beside it."""
    models = [model for model in reversed(run.models) if run.has_frames(model)]
    if not models:
        raise WrongInput(f'{run.directory} holds no pictures; run the scene with --set "Output/Graphics=vtu"')
    frames = {model: run.frames(model) for model in models}
    n_frames = min(map(len, frames.values()))
    if not -n_frames <= frame < n_frames:
        raise WrongInput(f"--frame: expected a number from 0 to {n_frames - 1}, got {frame}")
    radius = float(run.entry("Body/Radius"))
    bodies, elements = {}, None
    for model in models:
        path = frames[model][:n_frames][frame].path
        x, displacement, stress = read_points(path)
        reference = x - displacement
        matrix, residual, *_ = np.linalg.lstsq(reference, x - x.mean(axis=0), rcond=None)
        if elements and np.max(np.abs(reference @ matrix + x.mean(axis=0) - x)) < 1e-9 * radius:
            faces, of_elements = elements
            bodies[run.title(model)] = faces.of(of_elements @ matrix + x.mean(axis=0)), faces.of(np.full(len(of_elements), stress[0]))
            continue
        faces = faces_of(run, model, path, reference, radius, cut)
        bodies[run.title(model)] = faces.of(x), faces.of(stress)
        if run.has_elements(model):
            elements = faces, reference
    return frames[models[0]][:n_frames][frame].time, radius, bodies


def common_limits(pictures: Sequence[Scene]) -> tuple[float, float, float]:
    """For pictures, each as read_bodies gives it, on one scale: end of the colour bar, largest stress, half of the view."""
    stress = np.concatenate([faces[1].ravel() for _, _, bodies in pictures for faces in bodies.values()])
    extent = max(max(radius, *(np.abs(x - centre_of(x)).max() for x, _ in bodies.values())) for _, radius, bodies in pictures)
    return rounded_up(np.quantile(stress, SATURATED)), stress.max(), extent


def centre_of(positions: np.ndarray) -> np.ndarray:
    points = positions.reshape(-1, 3)
    return (points.max(axis=0) + points.min(axis=0)) / 2


def draw(picture: Scene, limits: tuple[float, float, float], output: str | os.PathLike[str], with_bar: bool = True) -> None:
    time, radius, bodies = picture
    end_of_bar, largest, extent = limits
    table = colours(end_of_bar)
    n, strip_height = len(bodies), STRIP if with_bar else 0
    window = new_window(WIDTH * max(n, 2) // 2, HEIGHT if with_bar else round(HEIGHT * (1 - STRIP)))
    for i, (title, (x, stress)) in enumerate(bodies.items()):
        view = renderer(window, i / n, strip_height, (i + 1) / n, 1)
        x = x - centre_of(x)
        view.AddActor(body(surface(x, stress), table))
        view.AddActor(lines(edges(x), (1, 1, 1), 1.5, 0.5))
        view.AddActor(lines(dashed_circle(radius, 2 * extent), (0.1, 0.1, 0.1), 2.5))
        view.AddActor2D(text(f"{title}, t = {time:g}", 34, 0.5, 0.91, bold=True))
        aim(view, extent)
    if with_bar:
        strip = renderer(window, 0, 0, 1, STRIP)
        strip.AddActor2D(colour_bar(table))
        strip.AddActor2D(text(caption(largest, table), 30, 0.5, 0.13))
    write_png(window, output)


def picture(run: Run, output: str | os.PathLike[str], frame: int = -1, cut: bool = True) -> str:
    """Draws a frame, from 0, or from the last by negative numbers, into a PNG file; says what the file shows."""
    check_screen()
    bodies = read_bodies(run, frame, cut)
    draw(bodies, common_limits([bodies]), output)
    return f"{output}: {' and '.join(title.lower() for title in bodies[2])} at time {bodies[0]:g}"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--frame", type=int, default=-1, metavar="N", help="from 0; -1, the default, is the last")
    parser.add_argument("--output", type=pathlib.Path, metavar="PNG", help="default: RUN_DIRECTORY/bodies.png")
    parser.add_argument("--whole", action="store_true", help="do not take a quarter out of the balls")


def main(arguments: argparse.Namespace) -> None:
    output = arguments.output or arguments.directory / "bodies.png"
    print(picture(Run(arguments.directory), output, arguments.frame, not arguments.whole))
