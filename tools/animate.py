#!/usr/bin/python3
"""A moving picture of the bodies of a run: each frame drawn as by tools/render.py, all on one scale, as an animated GIF.

The run must have been made with Output/Graphics = vtu. Needs Debian's python3-vtk9 and python3-pil; the
first draws through an X server. Without a screen:

    apt-get install python3-vtk9 python3-pil xvfb xauth libgl1-mesa-dri
    xvfb-run -a tools/animate.py output/quickstart --output balls.gif
"""

import argparse
import pathlib
import tempfile

import render
from run_directory import Run, fail, missing

try:
    import numpy as np
    import PIL.Image
except ImportError as error:
    missing(error, "python3-pil")

N_COLOURS, N_REFINEMENTS = 48, 2  # more colours are hardly seen and make the file larger
ALMOST_WHITE = 245
PALETTE_FRAMES = 8  # the palette is made from so many frames, spread over the motion


def images(directory, cut, width):
    """All frames of a run, drawn and shrunk to this width."""
    run = Run(directory)
    n_frames = min(len(run.frames(model)) for model in run.models if run.has_frames(model) or model == run.models[-1])
    pictures = [render.read_bodies(run, frame, cut) for frame in range(n_frames)]
    limits = render.common_limits(pictures)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "frame.png"
        for picture in pictures:
            render.draw(picture, limits, path)
            image = PIL.Image.open(path).convert("RGB")
            yield image.resize((width, image.height * width // image.width), PIL.Image.Resampling.LANCZOS)


def common_palette(frames):
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


def write_gif(frames, milliseconds, output):
    palette = common_palette(frames)
    # Without dithering: its noise differs from frame to frame, and would be most of the file.
    first, *others = (frame.quantize(palette=palette, dither=PIL.Image.Dither.NONE) for frame in frames)
    try:
        first.save(output, save_all=True, append_images=others, duration=milliseconds, loop=0, optimize=False)
    except OSError as error:
        fail(f"--output: {output} cannot be written: {error}")
    print(f"{output}: {len(frames)} frames")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--output", type=pathlib.Path, metavar="GIF", help="default: RUN_DIRECTORY/bodies.gif")
    parser.add_argument("--width", type=int, default=480, metavar="PIXELS", help="default: 480")
    parser.add_argument("--milliseconds", type=int, default=120, metavar="N", help="of each frame; default: 120")
    parser.add_argument("--whole", action="store_true", help="do not take a quarter out of the balls")
    arguments = parser.parse_args()
    render.check_screen()
    frames = list(images(arguments.directory, not arguments.whole, arguments.width))
    write_gif(frames, arguments.milliseconds, arguments.output or arguments.directory / "bodies.gif")


if __name__ == "__main__":
    main()
