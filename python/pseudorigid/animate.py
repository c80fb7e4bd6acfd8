"""A moving picture of the bodies of a run: each frame drawn as by `render`, all on one scale, as an animated GIF.

The run must have been made with Output/Graphics = vtu. Needs Debian's python3-vtk9 and python3-pil; the
first draws through an X server. Without a screen:

    apt-get install python3-vtk9 python3-pil xvfb xauth libgl1-mesa-dri
    xvfb-run -a python3 -m pseudorigid animate output/quickstart --output balls.gif
"""

import argparse
import pathlib
import tempfile
from collections.abc import Iterator, Sequence
from typing import Any

from pseudorigid import render
from pseudorigid.errors import WrongInput, needs
from pseudorigid.results import Run

with needs("python3-pil"):
    import numpy as np
    import PIL.Image

N_COLOURS, N_REFINEMENTS = 48, 2  # more colours are hardly seen and make the file larger
ALMOST_WHITE = 245
PALETTE_FRAMES = 8  # the palette is made from so many frames, spread over the motion


def images(run: Run, cut: bool, width: int) -> Iterator[Any]:
    """All frames of a run, drawn and shrunk to this width."""
    render.check_screen()
    n_frames = min(len(run.frames(model)) for model in run.models if run.has_frames(model) or model == run.models[-1])
    pictures = [render.read_bodies(run, frame, cut) for frame in range(n_frames)]
    limits = render.common_limits(pictures)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "frame.png"
        for picture in pictures:
            render.draw(picture, limits, path)
            image = PIL.Image.open(path).convert("RGB")
            yield image.resize((width, image.height * width // image.width), PIL.Image.Resampling.LANCZOS)


def common_palette(frames: Sequence[Any]) -> Any:
    chosen = frames[:: max(1, len(frames) // PALETTE_FRAMES)]
    mosaic = PIL.Image.new("RGB", (chosen[0].width, chosen[0].height * len(chosen)))
    for row, frame in enumerate(chosen):
        mosaic.paste(frame, (0, row * frame.height))
    palette = mosaic.quantize(N_COLOURS, PIL.Image.Quantize.MEDIANCUT, kmeans=N_REFINEMENTS)
    # The paper is white but for the choice of a palette.
    colours = np.array(palette.getpalette()).reshape(-1, 3)
    colours[colours.min(axis=1) > ALMOST_WHITE] = 255
    palette.putpalette(colours.ravel().tolist())
    palette.load()
    return palette


def write_gif(frames: Sequence[Any], milliseconds: int, output: pathlib.Path) -> None:
    palette = common_palette(frames)
    # Without dithering: its noise differs from frame to frame, and would be most of the file.
    first, *others = (frame.quantize(palette=palette, dither=PIL.Image.Dither.NONE) for frame in frames)
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        first.save(output, save_all=True, append_images=others, duration=milliseconds, loop=0, optimize=False)
    except (OSError, ValueError) as error:
        raise WrongInput(f"--output: {output} cannot be written: {error}") from error
    print(f"{output}: {len(frames)} frames")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--output", type=pathlib.Path, metavar="GIF", help="default: RUN_DIRECTORY/bodies.gif")
    parser.add_argument("--width", type=int, default=480, metavar="PIXELS", help="default: 480")
    parser.add_argument("--milliseconds", type=int, default=120, metavar="N", help="of each frame; default: 120")
    parser.add_argument("--whole", action="store_true", help="do not take a quarter out of the balls")


def main(arguments: argparse.Namespace) -> None:
    frames = list(images(Run(arguments.directory), not arguments.whole, arguments.width))
    write_gif(frames, arguments.milliseconds, arguments.output or arguments.directory / "bodies.gif")
