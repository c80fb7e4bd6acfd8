"""A window of VTK that is drawn off-screen: its parts, their cameras, words, the bar of colours, the file of its picture.

VTK draws through an X server; without a screen, xvfb-run is one.
"""

import os
import pathlib
from typing import Any

from pseudorigid.errors import WrongInput, needs
from pseudorigid.frames import without_words_of_vtk

with needs("python3-vtk9"):
    import numpy as np
    import vtkmodules.vtkInteractionStyle  # noqa: F401  (registers what the render window asks for)
    import vtkmodules.vtkRenderingFreeType  # noqa: F401
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.vtkCommonCore import vtkLookupTable
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter

VIEW_FROM = (0.6, -1.0, 0.4)  # direction from the bodies to the camera; z is up

# Nodes of matplotlib's "viridis": legible with every kind of colour vision, and monotone in grey.
VIRIDIS = [
    (0.267, 0.005, 0.329), (0.283, 0.141, 0.458), (0.254, 0.265, 0.530), (0.207, 0.372, 0.553), (0.164, 0.471, 0.558),
    (0.128, 0.567, 0.551), (0.135, 0.659, 0.518), (0.267, 0.749, 0.441), (0.478, 0.821, 0.318), (0.741, 0.873, 0.150),
    (0.993, 0.906, 0.144),
]  # fmt: skip


def check_screen() -> None:
    if not os.environ.get("DISPLAY"):
        raise WrongInput("there is no screen; put xvfb-run -a before the command (packages xvfb, xauth and libgl1-mesa-dri)")


def new_window(width: int, height: int) -> Any:
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(width, height)
    return window


def write_png(window: Any, output: str | os.PathLike[str]) -> None:
    """Draws the window into a file, and makes its folder."""
    try:
        pathlib.Path(output).parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise WrongInput(f"--output: {error}") from error
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(os.fspath(output))
    writer.SetCompressionLevel(9)
    writer.SetInputConnection(image.GetOutputPort())
    with without_words_of_vtk():
        writer.Write()
    if writer.GetErrorCode():
        raise WrongInput(f"--output: {output} cannot be written")


def renderer(window: Any, x0: float, y0: float, x1: float, y1: float) -> Any:
    view = vtkRenderer()
    view.SetViewport(x0, y0, x1, y1)
    view.SetBackground(1, 1, 1)
    window.AddRenderer(view)
    return view


def look(view: Any, half_height: float, distance: float, focus: Any = (0, 0, 0), view_from: Any = VIEW_FROM) -> None:
    """Places the camera of a part of the window at this distance from the focus; the view has twice `half_height`."""
    camera = view.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(np.asarray(focus) + distance * normalized(view_from))
    camera.SetViewUp(0, 0, 1)
    camera.SetParallelScale(half_height)
    view.ResetCameraClippingRange()


def normalized(a: Any) -> np.ndarray:
    return a / np.linalg.norm(a)


def text(content: str, size: int, x: float, y: float, bold: bool = False) -> Any:
    actor = vtkTextActor()
    actor.SetInput(content)
    style(actor.GetTextProperty(), size, bold)
    actor.GetTextProperty().SetJustificationToCentered()
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(x, y)
    return actor


def style(properties: Any, size: int, bold: bool = False) -> None:
    properties.SetFontFamilyToArial()
    properties.SetFontSize(size)
    properties.SetColor(0.1, 0.1, 0.1)
    properties.SetBold(bold)
    properties.SetItalic(False)
    properties.SetShadow(False)


def colours(largest: float) -> Any:
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetRange(0, largest)
    for i in range(256):
        at = i / 255 * (len(VIRIDIS) - 1)
        k = min(int(at), len(VIRIDIS) - 2)
        rgb = [a + (at - k) * (b - a) for a, b in zip(VIRIDIS[k], VIRIDIS[k + 1])]
        table.SetTableValue(i, *rgb, 1)
    return table


def colour_bar(table: Any) -> Any:
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetOrientationToHorizontal()
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.2g")
    bar.UnconstrainedFontSizeOn()
    style(bar.GetLabelTextProperty(), 28)
    bar.SetTextPositionToPrecedeScalarBar()
    bar.SetPosition(0.2, 0.46)
    bar.SetWidth(0.6)
    bar.SetHeight(0.5)
    bar.SetBarRatio(0.45)
    bar.SetTextPad(6)
    return bar
