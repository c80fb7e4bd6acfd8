"""A moving picture of the bodies of a run, as an animated GIF.

Each frame has the bodies as `render` draws them, a bar of colours, and a column of the tables over time with a dot at the
time of the frame. All frames have one scale of stress, which ends at the largest stress. Colours follow its square root,
because stresses peak for a moment where waves meet.

The run must have been made with Output/Graphics = vtu. Needs Debian's python3-vtk9, python3-pil and python3-matplotlib;
the first draws through an X server. Without a screen:

    apt-get install python3-vtk9 python3-pil python3-matplotlib xvfb xauth libgl1-mesa-dri
    xvfb-run -a python3 -m pseudorigid animate output/quickstart --output balls.gif
"""

import argparse
import io
import math
import pathlib
import tempfile
from collections.abc import Iterator
from typing import Any

from pseudorigid import render
from pseudorigid.errors import WrongInput, needs
from pseudorigid.figures import plt, styles
from pseudorigid.gif import write_gif
from pseudorigid.results import Run
from pseudorigid.window import VIRIDIS

with needs("python3-pil"):
    import numpy as np
    import PIL.Image


def images(run: Run, cut: bool, width: int, quantity: str) -> Iterator[Any]:
    """All frames of a run, drawn and shrunk to this width, each above its strip with the bar of colours and the curves."""
    render.check_screen()
    n_frames = min(len(run.frames(model)) for model in run.models if run.has_frames(model) or model == run.models[-1])
    pictures = [render.read_bodies(run, frame, cut) for frame in range(n_frames)]
    _, largest, extent = render.common_limits(pictures)
    limits = math.sqrt(render.rounded_up(largest)), math.sqrt(largest), extent
    strip = Strip(run, quantity, width, render.rounded_up(largest))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "frame.png"
        for time, radius, bodies in pictures:
            roots = {title: (x, np.sqrt(np.maximum(stress, 0))) for title, (x, stress) in bodies.items()}
            render.draw((time, radius, roots), limits, path, with_bar=False)
            above = PIL.Image.open(path).convert("RGB")
            above = above.resize((width, above.height * width // above.width), PIL.Image.Resampling.LANCZOS)
            below = strip.at(time)
            image = PIL.Image.new("RGB", (width, above.height + below.height), "white")
            image.paste(above, (0, 0))
            image.paste(below, (0, above.height))
            yield image


class Strip:
    """The part of a frame below the bodies."""

    HEIGHT = 190  # for a width of 480
    DPI = 200

    def __init__(self, run: Run, quantity: str, width: int, end_of_bar: float) -> None:
        self.size = width, self.HEIGHT * width // 480
        self.figure, (bar, self.axes) = plt.subplots(2, 1, figsize=(4.8, self.HEIGHT / 100), dpi=self.DPI, height_ratios=(1, 9))
        self.figure.subplots_adjust(left=0.12, right=0.97, top=0.97, bottom=0.22, hspace=0.95)
        self._draw_bar(bar, end_of_bar)
        self.curves = []
        for model, style in styles(run.models).items():
            table = run.columns(model)
            if quantity not in table:
                raise WrongInput(f"--quantity: {model}.csv has no column {quantity}")
            (line,) = self.axes.plot(table["time"], table[quantity], **style, linewidth=1.2, label=run.title(model))
            self.curves.append((table["time"], table[quantity], self.axes.plot([], [], "o", color=line.get_color(), markersize=4)[0]))
        self.axes.set_xlabel("time", fontsize=7, labelpad=1)
        self.axes.set_ylabel(quantity, fontsize=7, labelpad=1)
        self.axes.tick_params(labelsize=6.5)
        self.axes.margins(x=0)
        self.axes.legend(fontsize=6, loc="upper right", ncols=2, frameon=False, borderaxespad=0.1)
        low, high = self.axes.get_ylim()
        self.axes.set_ylim(low, high + 0.22 * (high - low))  # room for the legend

    @staticmethod
    def _draw_bar(bar: Any, end: float) -> None:
        steps = np.linspace(0, 1, 256)
        colours = np.array([np.interp(steps, np.linspace(0, 1, len(VIRIDIS)), channel) for channel in zip(*VIRIDIS)]).T
        bar.imshow(colours[None], aspect="auto", extent=(0, 1, 0, 1))
        marks = [part * end for part in (0, 0.04, 0.16, 0.36, 0.64, 1)]
        bar.set_xticks([math.sqrt(mark / end) for mark in marks], [f"{mark:.2g}" for mark in marks], fontsize=6.5)
        bar.set_yticks([])
        bar.set_xlabel("von Mises stress", fontsize=7, labelpad=1)

    def at(self, time: float) -> Any:
        for times, values, dot in self.curves:
            dot.set_data([time], [np.interp(time, times, values)])
        file = io.BytesIO()
        self.figure.savefig(file, format="png", dpi=self.DPI)
        return PIL.Image.open(file).convert("RGB").resize(self.size, PIL.Image.Resampling.LANCZOS)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--output", type=pathlib.Path, metavar="GIF", help="default: RUN_DIRECTORY/bodies.gif")
    parser.add_argument("--width", type=int, default=480, metavar="PIXELS", help="default: 480")
    parser.add_argument("--milliseconds", type=int, default=120, metavar="N", help="of each frame; default: 120")
    parser.add_argument("--quantity", default="Q33", metavar="COLUMN", help="below the bodies; default: Q33")
    parser.add_argument("--whole", action="store_true", help="do not take a quarter out of the balls")


def main(arguments: argparse.Namespace) -> None:
    frames = list(images(Run(arguments.directory), not arguments.whole, arguments.width, arguments.quantity))
    write_gif(frames, arguments.milliseconds, arguments.output or arguments.directory / "bodies.gif")
