"""Animated GIFs from images of PIL."""

import pathlib
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from pseudorigid.errors import WrongInput, needs

with needs("python3-pil"):
    import numpy as np
    import PIL.Image

N_COLOURS, N_REFINEMENTS = 63, 2  # more colours are hardly seen and make the file larger
TRANSPARENT = N_COLOURS  # the index after those of the colours
ALMOST_WHITE = 245
PALETTE_FRAMES = 8  # the palette is made from so many frames, spread over the motion


def common_palette(frames: Sequence[Any]) -> Any:
    chosen = frames[:: max(1, len(frames) // PALETTE_FRAMES)]
    mosaic = PIL.Image.new("RGB", (chosen[0].width, chosen[0].height * len(chosen)))
    for row, frame in enumerate(chosen):
        mosaic.paste(frame, (0, row * frame.height))
    palette = mosaic.quantize(N_COLOURS, PIL.Image.Quantize.MEDIANCUT, kmeans=N_REFINEMENTS)
    # The paper is white but for the choice of a palette.
    colours = np.array(palette.getpalette()).reshape(-1, 3)[:N_COLOURS]
    colours[colours.min(axis=1) > ALMOST_WHITE] = 255
    # PIL fills a palette with black, which would be a second index of a colour.
    filled = np.concatenate([colours, np.repeat(colours[:1], 256 - len(colours), axis=0)])
    palette.putpalette(filled.ravel().tolist())
    palette.load()
    return palette


def changes(frames: Iterable[Any]) -> Iterator[Any]:
    """Frames that show only the pixels that differ from the frame before: a file of lines has less than half of the size."""
    before: np.ndarray | None = None
    for frame in frames:
        pixels = np.array(frame)
        pixels[pixels >= N_COLOURS] = 0  # the same colour, by the palette
        changed = PIL.Image.fromarray(pixels if before is None else np.where(pixels == before, TRANSPARENT, pixels).astype(np.uint8), "P")
        changed.putpalette(frame.getpalette())
        before = pixels
        yield changed


def write_gif(frames: Sequence[Any], milliseconds: int, output: pathlib.Path) -> None:
    palette = common_palette(frames)
    # Without dithering: its noise differs from frame to frame, and would be most of the file.
    first, *others = changes(frame.quantize(palette=palette, dither=PIL.Image.Dither.NONE) for frame in frames)
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        first.save(output, save_all=True, append_images=others, duration=milliseconds, loop=0, optimize=False, transparency=TRANSPARENT, disposal=1)
    except (OSError, ValueError) as error:
        raise WrongInput(f"--output: {output} cannot be written: {error}") from error
    print(f"{output}: {len(frames)} frames")
