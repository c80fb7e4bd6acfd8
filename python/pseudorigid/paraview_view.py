"""Opens the motion of a run in ParaView: the elastic ball (continuum) and the pseudo-rigid ball (reduced) side by side,
coloured by von Mises stress on one scale for all times, seen by one camera with z upwards. With --picture or
--animation it draws off-screen instead. The colour bar ends where 98 % of the points of all frames are within it.

The run must have been made with Output/Graphics = vtu. Needs Debian's paraview and python3-paraview (they replace
python3-vtk9, whose modules they bring), and an X server, real or virtual:

    apt-get install paraview python3-paraview xvfb xauth
    python3 -m pseudorigid paraview output/quickstart
    xvfb-run -a python3 -m pseudorigid paraview output/quickstart --picture balls.png --frame 14
    xvfb-run -a python3 -m pseudorigid paraview output/quickstart --animation balls.avi
"""

import argparse
import os
import pathlib
from typing import Any

from pseudorigid.errors import WrongInput, needs
from pseudorigid.frames import read_pvd

TITLES = {"continuum": "Elastic ball", "reduced": "Pseudo-rigid ball"}
SIZE = (1280, 720)
FRAMES_PER_SECOND = 8
SUBDIVISION = 3  # of curved cells (Output/Cells = lagrange): 8 straight pieces along an edge
RUN = "PSEUDORIGID_RUN"  # the run directory, for this file as a script of ParaView's own


def collections(directory: pathlib.Path) -> dict[str, list[tuple[float, pathlib.Path]]]:
    """{model: [(time, path of the .vtu)]} of the models that have pictures."""
    paths = {model: directory / f"{model}.pvd" for model in TITLES}
    found = {model: read_pvd(path) for model, path in paths.items() if path.is_file()}
    if not any(found.values()):
        raise WrongInput(f'{directory} holds no pictures; run the scene with --set "Output/Graphics=vtu"')
    return found


def time_of(directory: pathlib.Path, frame: int) -> float:
    frames = min(collections(directory).values(), key=len)
    if not -len(frames) <= frame < len(frames):
        raise WrongInput(f"--frame: expected a number from 0 to {len(frames) - 1}, got {frame}")
    return frames[frame][0]


def scale_of(frames: Any) -> tuple[float, float]:
    """The end of the colour bar, from all points of all frames, and the size of what is shown."""
    import numpy as np
    from pseudorigid.render import SATURATED, read_points, rounded_up

    points, _, stresses = zip(*(read_points(path) for model in frames.values() for _, path in model))
    extent = max(float(np.linalg.norm(x - x.mean(axis=0), axis=1).max()) for x in points)
    return rounded_up(float(np.quantile(np.concatenate(stresses), SATURATED))), extent


def colour(simple: Any, largest: float) -> Any:
    """The one table of colours of both views."""
    from pseudorigid.render import FIELD
    from pseudorigid.window import VIRIDIS

    table = simple.GetColorTransferFunction(FIELD)
    n = len(VIRIDIS) - 1
    table.RGBPoints = [number for i, rgb in enumerate(VIRIDIS) for number in (largest * i / n, *rgb)]
    table.ColorSpace = "RGB"
    table.AutomaticRescaleRangeMode = "Never"
    return table


def label(simple: Any, source: Any, view: Any, place: str, size: int, **properties: Any) -> None:
    display = simple.Show(source, view)
    settings = {"WindowLocation": place, "FontSize": size, "Color": [0.1, 0.1, 0.1], **properties}
    for name, value in settings.items():
        setattr(display, name, value)


def show_model(simple: Any, directory: pathlib.Path, model: str, view: Any) -> Any:
    from pseudorigid.render import FIELD

    reader = simple.PVDReader(registrationName=TITLES[model], FileName=str(directory / f"{model}.pvd"))
    display = simple.Show(reader, view)
    display.SetRepresentationType("Surface")
    display.NonlinearSubdivisionLevel = SUBDIVISION
    simple.ColorBy(display, ("POINTS", FIELD))
    display.Ambient, display.Diffuse, display.Specular = 0.65, 0.35, 0.0
    label(simple, simple.Text(Text=TITLES[model]), view, "Upper Center", 22, Bold=1)
    label(simple, simple.AnnotateTimeFilter(reader, Format="t = {time:g}"), view, "Lower Left Corner", 20)
    return display


def show_bar(simple: Any, table: Any, view: Any) -> None:
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = "von Mises stress", "(the scene's unit of pressure)"
    bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Right Corner"
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    bar.TitleFontSize = bar.LabelFontSize = 15
    bar.ScalarBarLength = 0.45
    bar.LabelFormat = bar.RangeLabelFormat = "%.3g"
    bar.Visibility = 1


def aim(view: Any, extent: float) -> None:
    from pseudorigid.window import VIEW_FROM

    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = [10 * extent * x for x in VIEW_FROM]
    view.CameraViewUp = [0, 0, 1]
    view.CameraParallelScale = 1.35 * extent
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesLabelColor = [0.1, 0.1, 0.1]


def build(directory: pathlib.Path, simple: Any) -> Any:
    """All views of the run; their layout."""
    frames = collections(directory)
    largest, extent = scale_of(frames)
    simple._DisableFirstRenderCameraReset()
    simple.RemoveViewsAndLayouts()  # those of the window
    layout = simple.CreateLayout("pseudorigid")
    views = []
    for model in frames:
        view = simple.CreateView("RenderView")
        simple.AssignViewToLayout(view=view, layout=layout, hint=len(views))
        if not views and len(frames) > 1:
            layout.SplitHorizontal(0, 0.5)
        show_model(simple, directory, model, view)
        aim(view, extent)
        views.append(view)
    show_bar(simple, colour(simple, largest), views[-1])  # ParaView has rescaled the colours as it showed the models
    views[-1].OrientationAxesVisibility = len(views) == 1  # the bar is there; one camera needs the axes once
    if len(views) > 1:
        simple.AddCameraLink(*views, "one camera")
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    return layout


def draw(directory: pathlib.Path, arguments: argparse.Namespace) -> None:
    with needs("paraview and python3-paraview"):
        from paraview import simple
    layout = build(directory, simple)
    layout.SetSize(*SIZE)  # that of the window is its own
    scene = simple.GetAnimationScene()
    if arguments.picture:
        scene.AnimationTime = time_of(directory, arguments.frame)
        written = simple.SaveScreenshot(str(arguments.picture), layout, ImageResolution=SIZE)
    else:
        written = simple.SaveAnimation(str(arguments.animation), layout, ImageResolution=SIZE, FrameRate=FRAMES_PER_SECOND)
    output = arguments.picture or arguments.animation
    if not written:
        raise WrongInput(f"{output} cannot be written")
    print(output)


def open_window(directory: pathlib.Path) -> None:
    """Becomes ParaView, which runs this file as a script. With ParaView's own settings: with the user's it may greet at
    its start, in the middle of the script, which then waits for the greeting to be closed."""
    packages = str(pathlib.Path(__file__).resolve().parents[1])
    environment = {**os.environ, RUN: str(directory.resolve()), "PYTHONPATH": packages}
    try:
        script = f"--script={pathlib.Path(__file__).resolve()}"
        os.execvpe("paraview", ["paraview", "--disable-registry", script], environment)
    except OSError as error:
        raise WrongInput(f"paraview cannot be started ({error.strerror}): apt-get install paraview python3-paraview")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--picture", type=pathlib.Path, metavar="PNG", help="draw one frame into this file")
    parser.add_argument("--frame", type=int, default=-1, metavar="N", help="from 0; -1, the default, is the last")
    parser.add_argument("--animation", type=pathlib.Path, metavar="AVI/OGV/PNG", help="draw all frames; .png: a numbered series")


def main(arguments: argparse.Namespace) -> None:
    if arguments.picture and arguments.animation:
        raise WrongInput("--picture and --animation exclude one another")
    time_of(arguments.directory, arguments.frame)
    if not (arguments.picture or arguments.animation):
        open_window(arguments.directory)
    if not os.environ.get("DISPLAY"):
        raise WrongInput("no X server; put xvfb-run -a before the command")
    draw(arguments.directory, arguments)


if RUN in os.environ:  # in ParaView, which open_window has become
    from paraview import simple as of_window

    build(pathlib.Path(os.environ[RUN]), of_window)
