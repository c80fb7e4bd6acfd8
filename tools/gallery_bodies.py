"""The pictures of docs/gallery.md that are bodies and surfaces, drawn off-screen with VTK (tools/gallery.py)."""

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

import package  # noqa: F401
from pseudorigid import render
from pseudorigid.frames import read_grid, read_pvd
from pseudorigid.results import Run, read_csv
from pseudorigid.window import colour_bar, colours, look, new_window, renderer, text, write_png

BLUE, ORANGE, GREEN, BLACK = (0, 0.447, 0.698), (0.835, 0.369, 0), (0, 0.62, 0.451), (0, 0, 0)  # Okabe and Ito's
GREY = (0.8, 0.8, 0.8)
AMBIENT = 0.5
KINDS = {1: "S", 2: "T"}  # spheroidal, toroidal


class Surface:
    """The surface of the hexahedra of a .vtu, whose cells have points of their own: those at one place are joined, and
    a face that one hexahedron alone has is on the surface."""

    FACES = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (0, 3, 2, 1), (4, 5, 6, 7))

    def __init__(self, path, fields):
        grid = read_grid(path)
        x = vtk_to_numpy(grid.GetPoints().GetData())
        _, first, joined = np.unique(np.round(x, 9), axis=0, return_index=True, return_inverse=True)
        self.points = x[first]
        self.fields = {name: vtk_to_numpy(grid.GetPointData().GetArray(name))[first] for name in fields}
        cells = joined.reshape(-1)[vtk_to_numpy(grid.GetCells().GetConnectivityArray())].reshape(-1, 8)
        faces = np.concatenate([cells[:, face] for face in self.FACES])
        _, index, number = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
        self.faces = faces[index[number == 1]]


def add_colour_bar(window, height, table, caption):
    """In a strip at the bottom of the window, of this part of its height."""
    strip = renderer(window, 0, 0, 1, height)
    strip.AddActor2D(colour_bar(table))
    strip.AddActor2D(text(caption, 26, 0.5, 0.1))


def release(run, path):
    """Both balls with their stress, as `python3 -m pseudorigid render` draws them."""
    print(render.picture(Run(run("spin_and_stretch")), path, frame=3))


def rough_ball(run, path):
    """The body of the mesh file at rest and at the end, with its stress."""
    frames = read_pvd(run("rough_ball", "Output/Graphics=vtu", "Output/Frames=3") / "continuum.pvd")
    window = new_window(860, 520)
    surfaces = [Surface(file, ("displacement", "von_mises")) for _, file in frames]
    shown = np.concatenate([s.fields["von_mises"][np.unique(s.faces)] for s in surfaces])
    table = colours(render.rounded_up(np.quantile(shown, render.SATURATED)))
    for k, ((time, _), surface) in enumerate(zip(frames, surfaces)):
        view = renderer(window, k / 3, render.STRIP, (k + 1) / 3, 1)
        view.AddActor(render.body(render.quadrilaterals(surface.points, surface.faces, surface.fields["von_mises"]), table, AMBIENT))
        sides = surface.points[surface.faces[:, [0, 1, 2, 3, 0]]]
        view.AddActor(render.lines(render.polylines(sides), (1, 1, 1), 1, 0.35, offset=(-2, -40)))
        view.AddActor2D(text(f"t = {time:g} r/c", 26, 0.5, 0.9, bold=True))
        render.aim(view, 1.25)
    add_colour_bar(window, render.STRIP, table, "von Mises stress (μ)")
    write_png(window, path)


def modes(run, path):
    """One mode of each of the eight lowest frequencies, with a largest displacement of 0.3 r."""
    directory = run("modes", "Modes/Number=8")
    rows = read_csv(directory / "modes.csv")
    frames = read_pvd(directory / "modes.pvd")
    window = new_window(900, 630)
    strip = 110 / 630  # of the height
    height = (1 - strip) / 2
    table = colours(1)
    for k, (_, file) in enumerate(frames[:8]):
        surface = Surface(file, ("displacement",))
        u = surface.fields["displacement"]
        column, bottom = k % 4, 1 - (1 + k // 4) * height
        view = renderer(window, column / 4, bottom, (column + 1) / 4, bottom + height)
        size = np.linalg.norm(u, axis=1)
        view.AddActor(render.body(render.quadrilaterals(surface.points + 0.3 * u, surface.faces, size), table, AMBIENT))
        name = KINDS[int(rows["kind"][k])] + f"{int(rows['degree'][k])}" + "*" * int(rows["overtone"][k])
        view.AddActor2D(text(f"{name}   {rows['omega'][k]:.4f} c/r", 21, 0.5, 0.89))
        render.aim(view, 1.2)
    add_colour_bar(window, strip, table, "displacement / largest displacement of the mode")
    write_png(window, path)


def torus_surface(n=96, R=3.0, r=1.0):
    """Oliva 5.8.8: (r sin w, (R + r cos w) sin u, (R + r cos w) cos u)."""
    w, u = np.meshgrid(np.arange(n // 2) * 4 * np.pi / n, np.arange(n) * 2 * np.pi / n, indexing="ij")
    points = np.stack([r * np.sin(w), (R + r * np.cos(w)) * np.sin(u), (R + r * np.cos(w)) * np.cos(u)], -1)
    index = np.arange(w.size).reshape(w.shape)
    next_w, next_u = np.roll(index, -1, 0), np.roll(index, -1, 1)
    return points.reshape(-1, 3), np.stack([index, next_w, np.roll(next_w, -1, 1), next_u], -1).reshape(-1, 4)


def tube(curve, colour, radius):
    filter_ = vtkTubeFilter()
    filter_.SetInputData(render.polylines([curve]))
    filter_.SetRadius(radius)
    filter_.SetNumberOfSides(12)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(filter_.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    actor.GetProperty().SetAmbient(0.6)
    actor.GetProperty().SetDiffuse(0.4)
    return actor


def ball(center, radius, colour):
    source = vtkSphereSource()
    source.SetCenter(*center)
    source.SetRadius(radius)
    source.SetThetaResolution(24)
    source.SetPhiResolution(24)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    return actor


def torus_view(window, x0, x1, title, view_from):
    view = renderer(window, x0, 0, x1, 1)
    surface = render.body(render.quadrilaterals(*torus_surface()), None, AMBIENT)
    surface.GetProperty().SetColor(GREY)
    surface.GetProperty().SetOpacity(0.55)
    view.AddActor(surface)
    view.AddActor2D(text(title, 22, 0.5, 0.94))
    look(view, 4.7, 40, view_from=view_from)
    return view


def way(directory, file):
    t = read_csv(directory / f"{file}.csv")
    return np.stack([t["x"], t["y"], t["z"]], -1)


def torus(run, path):
    window = new_window(860, 480)
    for k, (tilt, title) in enumerate((("0", "upright: to the lower saddle"), ("0.05", "tilted by 0.05: to the sink"))):
        curve = way(run("torus", f"Torus/Tilt={tilt}", "Output/Samples=2000"), "torus")
        view = torus_view(window, k / 2, (k + 1) / 2, title, (1, -0.45, 0.2))
        view.AddActor(tube(curve, (BLUE, ORANGE)[k], 0.06))
        view.AddActor(ball(curve[0], 0.16, BLACK))
        view.AddActor(ball(curve[-1], 0.2, (BLUE, ORANGE)[k]))
    write_png(window, path)


def geodesic(run, path):
    window = new_window(860, 480)
    cases = (((), "Clairaut's integral 2.001: turns back"),
             (("Geodesic/Velocity=0.8661697, 0.124938",), "1.999: passes through the hole"))
    for k, (entries, title) in enumerate(cases):
        curve = way(run("geodesic", *entries, "Output/Samples=4000"), "geodesic")
        view = torus_view(window, k / 2, (k + 1) / 2, title, (1, -0.45, 0.2))
        view.AddActor(tube(curve, (BLUE, ORANGE)[k], 0.045))
        view.AddActor(ball(curve[0], 0.16, BLACK))
    write_png(window, path)


PICTURES = {
    "spin_and_stretch": release,
    "rough_ball": rough_ball,
    "modes": modes,
    "torus": torus,
    "geodesic": geodesic,
}
