"""A movie of a body and its companions in orbit, as an animated GIF.

Left: the paths about the common centre of mass, in the plane of the first companion's orbit at the start. A small body is
drawn larger, by the factor next to its name; the size of a companion only says whether it is heavier than the body.
Right: the projection of the deformed body x = QX on this plane, with the directions of the companions, the long axis of
the bulge, and a radius that moves with the material. Both panels magnify the deformation by a factor that the title gives.

The frames are samples of the run. Without --end, the movie ends before the end of the run if body or companion would
otherwise make more than an eighth of a turn, on average, between two frames. Needs Debian's python3-matplotlib and python3-pil.

    scripts/run.sh params/tidal_locking.prm
    python3 -m pseudorigid orbit output/tidal_locking --output locking.gif
"""

import argparse
import math
import pathlib
from typing import Any

from pseudorigid.errors import WrongInput, needs
from pseudorigid.figures import BLACK, GREY, SKY, YELLOW, plt, styles
from pseudorigid.gif import write_gif
from pseudorigid.orbit_motion import ROUND, Motion, read_motion
from pseudorigid.results import Run

with needs("python3-pil"):
    import numpy as np
    import PIL.Image

INCHES = 7.6, 4.5
SMALLEST_WIDTH = 160
SMALLEST_BODY = 0.07  # of half the width of a panel: a smaller body is enlarged
VISIBLE_DEFORMATION = 0.35  # the largest one after magnification, which ends at the next smaller round factor
LARGE_DEFORMATION = 0.15  # is not magnified
TURN_BETWEEN_FRAMES = math.pi / 4
ARROW = 1.12, 1.42  # begin and end, in largest radii of the outline
COMPANION_COLOURS = [YELLOW, SKY]


def round_below(value: float) -> float:
    """The largest of …, 1, 2, 5, 10, 20, … that is not larger."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(digit * power for digit in (5, 2, 1) if digit * power <= value * (1 + 1e-9))


def chosen_model(run: Run, model: str | None) -> str:
    tables = [name for name in run.models if (run.directory / f"{name}.csv").is_file()]
    if not tables:
        raise WrongInput(f"{run.directory} holds no motion")
    if model is not None and model not in tables:
        raise WrongInput(f"--model: expected one of {', '.join(tables)}, got {model}")
    return model or tables[-1]


def chosen_samples(motion: Motion, n_frames: int, start: float | None, end: float | None) -> np.ndarray:
    """The samples that become frames, each the same number of samples after the one before."""
    first = 0 if start is None else int(np.searchsorted(motion.times, start))
    last = len(motion.times) - 1 if end is None else int(np.searchsorted(motion.times, end, side="right")) - 1
    if n_frames < 2 or first >= last:
        raise WrongInput(f"--frames, --start, --end: expected two or more frames, and two or more samples between t = {motion.times[0]:g} "
                         f"and {motion.times[-1]:g}")
    stride = math.ceil((last - first) / (n_frames - 1))
    if end is None:
        turned = max(np.abs(motion.orbital_rate).mean(), np.abs(motion.spin).mean()) * np.diff(motion.times).mean()
        stride = min(stride, max(1, int(TURN_BETWEEN_FRAMES / max(turned, 1e-300))))
    return np.arange(first, last + 1, stride)[:n_frames]


def chosen_factor(motion: Motion, samples: np.ndarray, factor: float | None) -> float:
    deformation = motion.deformation(samples)
    if factor is None:
        return round_below(VISIBLE_DEFORMATION / deformation) if ROUND < deformation < LARGE_DEFORMATION else 1
    bound = 1 / max(motion.compression(samples), 1e-300)
    if not 0 < factor < bound:
        raise WrongInput(f"--magnify: expected a factor above 0 and below {bound:.3g}, at which the outline is a line")
    return factor


def new_panel(axes: Any, title: str, centre: Any, half: float) -> None:
    axes.set_aspect("equal")
    axes.set_xlim(centre[0] - half, centre[0] + half)
    axes.set_ylim(centre[1] - half, centre[1] + half)
    axes.set_title(title, fontsize=9)
    axes.set_xlabel("radii of the body", fontsize=8, labelpad=2)
    axes.tick_params(labelsize=7.5)
    axes.grid(color="#eeeeee", linewidth=0.6)
    axes.set_axisbelow(True)


def legend(axes: Any, handles: list[Any]) -> Any:
    """Below a panel, in two columns. Its title, which changes from frame to frame, is returned."""
    made = axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(-0.03, -0.12), fontsize=7.5, ncols=2, frameon=False, title=" ",
                       title_fontsize=8, alignment="left", columnspacing=1.2, handlelength=1.8)
    return made.get_title()


class OrbitPanel:
    """The paths so far and the bodies at their ends."""

    def __init__(self, axes: Any, motion: Motion, samples: np.ndarray, title: str, colours: list[str]) -> None:
        self.motion, self.first = motion, samples[0]
        self.decimals = max(0, 2 - math.floor(math.log10(motion.times[samples[-1]] - motion.times[samples[0]])))
        every = np.concatenate([motion.path(body, samples[0], samples[-1]) for body in range(len(motion.masses))])
        low, high = every.min(axis=0), every.max(axis=0)
        half = 1.15 * (high - low).max() / 2 + 1
        self.scale = max(1, SMALLEST_BODY * half)
        new_panel(axes, "orbit", (low + high) / 2, half)
        self.paths = [axes.plot([], [], color=colour, linewidth=0.9, alpha=0.8)[0] for colour in colours]
        self.dots = [axes.plot([], [], "o", color=colour, markeredgecolor=BLACK, markeredgewidth=0.6, label=label,
                               markersize=11 if mass > motion.masses[0] else 7)[0]
                     for colour, label, mass in zip(colours[1:], companion_names(motion), motion.masses[1:])]
        (self.body,) = axes.fill([0], [0], facecolor=colours[0], edgecolor=BLACK, linewidth=0.6, zorder=3,
                                 label=title + (f" × {self.scale:.2g}" if self.scale > 1 else ""))
        (self.radius,) = axes.plot([], [], color=BLACK, linewidth=0.9, zorder=4)
        self.text = legend(axes, [self.body, *self.dots])

    def show(self, sample: int, factor: float) -> None:
        for body, line in enumerate(self.paths):
            line.set_data(*self.motion.path(body, self.first, sample).T)
        for dot, position in zip(self.dots, self.motion.positions[1:, sample]):
            dot.set_data(*position[:, None])
        centre = self.motion.positions[0, sample]
        self.body.set_xy(centre + self.scale * self.motion.outline(sample, factor))
        self.radius.set_data(*np.array([centre, centre + self.scale * self.motion.mark(sample, factor)]).T)
        self.text.set_text(f"t = {self.motion.times[sample]:.{self.decimals}f}, {self.motion.orbits[sample]:.2f} orbits")


class BodyPanel:
    """The outline of the body, magnified, and directions in it."""

    def __init__(self, axes: Any, motion: Motion, samples: np.ndarray, factor: float, colours: list[str]) -> None:
        self.motion, self.factor = motion, factor
        self.largest = max(np.abs(motion.outline(sample, factor)).max() for sample in samples)
        new_panel(axes, f"body, deformation × {factor:g}" if factor != 1 else "body, deformation to scale", (0, 0), 1.5 * self.largest)
        axes.add_patch(plt.Circle((0, 0), motion.mean_radius, fill=False, edgecolor=GREY, linestyle=":", linewidth=1))
        (self.outline,) = axes.fill([0], [0], facecolor=colours[0] + "40", edgecolor=colours[0], linewidth=1.6)
        (self.radius,) = axes.plot([], [], "-o", color=colours[0], linewidth=1.6, markersize=6, markevery=[1], label="radius in the material")
        (self.axis,) = axes.plot([], [], color=BLACK, linestyle="--", linewidth=1.2, label="long axis")
        style = {"arrowstyle": "-|>", "linewidth": 2.2, "mutation_scale": 14, "shrinkA": 0, "shrinkB": 0}
        self.arrows = [axes.annotate("", (0, 0), (0, 0), arrowprops={**style, "color": colour}) for colour in colours[1:]]
        directions = [axes.plot([], [], color=colour, linewidth=2.2, label=f"to the {name}")[0]
                      for colour, name in zip(colours[1:], companion_names(motion))]
        self.text = legend(axes, [self.radius, self.axis, *directions])

    def show(self, sample: int) -> None:
        self.outline.set_xy(self.motion.outline(sample, self.factor))
        self.radius.set_data(*np.array([(0, 0), self.motion.mark(sample, self.factor)]).T)
        axis, lag = self.motion.long_axis(sample), self.motion.lag(sample)
        ends = [] if axis is None else np.outer((-1, 1), axis) * ARROW[0] * self.largest
        self.axis.set_data(*(np.transpose(ends) if len(ends) else ([], [])))
        for companion, arrow in enumerate(self.arrows, start=1):
            begin, end = (length * self.largest * self.motion.towards(companion, sample) for length in ARROW)
            arrow.set_position(begin)
            arrow.xy = end
        if lag is None:
            self.text.set_text("round: no long axis")
        else:
            self.text.set_text(f"bulge {abs(math.degrees(lag)):.1f}° {'ahead of' if lag > 0 else 'behind'} the companion")


def companion_names(motion: Motion) -> list[str]:
    return ["companion", "second companion"][: len(motion.masses) - 1]


def images(run: Run, model: str, motion: Motion, samples: np.ndarray, factor: float, width: int) -> list[Any]:
    """A picture of each of these samples."""
    if width < SMALLEST_WIDTH:
        raise WrongInput(f"--width: expected {SMALLEST_WIDTH} or more, got {width}")
    colours = [styles(run.models)[model]["color"], *COMPANION_COLOURS[: len(motion.masses) - 1]]
    with plt.rc_context({"font.family": "DejaVu Sans"}):
        figure, (left, right) = plt.subplots(1, 2, figsize=INCHES, dpi=width / INCHES[0])
        figure.subplots_adjust(left=0.06, right=0.985, top=0.94, bottom=0.22, wspace=0.14)
        orbit = OrbitPanel(left, motion, samples, run.title(model), colours)
        body = BodyPanel(right, motion, samples, factor, colours)
        made = []
        for sample in samples:
            orbit.show(sample, factor)
            body.show(sample)
            figure.canvas.draw()
            made.append(PIL.Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB"))
        plt.close(figure)
    return made


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--output", type=pathlib.Path, metavar="GIF", help="default: RUN_DIRECTORY/orbit.gif")
    parser.add_argument("--model", metavar="NAME", help="default: the last one of the run")
    parser.add_argument("--frames", type=int, default=120, metavar="N", help="at most; default: 120")
    parser.add_argument("--start", type=float, metavar="TIME", help="default: that of the first sample")
    parser.add_argument("--end", type=float, metavar="TIME", help="default: as above")
    parser.add_argument("--magnify", type=float, metavar="FACTOR", help="of the deformation; default: a round one that shows it")
    parser.add_argument("--width", type=int, default=760, metavar="PIXELS", help="default: 760")
    parser.add_argument("--milliseconds", type=int, default=80, metavar="N", help="of each frame; default: 80")


def main(arguments: argparse.Namespace) -> None:
    run = Run(arguments.directory)
    model = chosen_model(run, arguments.model)
    motion = read_motion(run, model)
    samples = chosen_samples(motion, arguments.frames, arguments.start, arguments.end)
    factor = chosen_factor(motion, samples, arguments.magnify)
    frames = images(run, model, motion, samples, factor, arguments.width)
    write_gif(frames, arguments.milliseconds, arguments.output or arguments.directory / "orbit.gif")
    print(f"t = {motion.times[samples[0]]:g} to {motion.times[samples[-1]]:g} of {motion.times[-1]:g}; deformation magnified {factor:g} times")
