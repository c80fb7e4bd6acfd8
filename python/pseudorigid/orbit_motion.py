"""The motion of a body and its companions, projected on the plane of the first companion's orbit at the start."""

import dataclasses
import math
from functools import cached_property

from pseudorigid.errors import WrongInput, needs
from pseudorigid.results import Run

with needs("python3-numpy"):
    import numpy as np

COMPANIONS = ("companion", "second_companion")
POINTS_BETWEEN_SAMPLES = 12  # of a path: an orbit with a few samples is a smooth curve as well
ROUND = 1e-9  # a body whose semi-axes differ by less, in radii, is taken to be round


def vectors(columns: dict[str, np.ndarray], name: str) -> np.ndarray:
    return np.stack([columns[f"{name}{i}"] for i in (1, 2, 3)], axis=1)


def orbit_plane(position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """Two orthonormal rows, along which the orbit is anticlockwise. The first one is the x axis if the orbit is in z = 0."""

    def unit_least_along(direction: np.ndarray) -> np.ndarray:
        return np.eye(3)[np.argmin(np.abs(direction))]

    normal = np.cross(position, velocity)
    if not normal.any():  # a companion that falls straight has no orbital plane
        normal = np.cross(position, unit_least_along(position))
    normal /= np.linalg.norm(normal)
    first = unit_least_along(normal)
    first -= first @ normal * normal
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(normal, first)])


def turned_per_time(position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """The angular velocity of points of the plane about its origin."""
    return (position[:, 0] * velocity[:, 1] - position[:, 1] * velocity[:, 0]) / (position**2).sum(axis=1)


@dataclasses.dataclass
class Motion:
    """The samples of a run. Lengths are in radii of the body, points have two coordinates."""

    times: np.ndarray
    masses: np.ndarray  #: of the body and its companions
    positions: np.ndarray  #: (bodies, samples, 2), relative to their common centre of mass
    velocities: np.ndarray
    spin: np.ndarray  #: of the body about the normal of the plane
    projected: np.ndarray  #: (samples, 2, 3): the projection of the body is the image of the unit ball
    marked: np.ndarray  #: the point of the unit ball that faces the first companion at the start

    @cached_property
    def axes(self) -> tuple[np.ndarray, np.ndarray]:
        """The semi-axes of the projected body, in ascending order, and their directions in columns."""
        squares, directions = np.linalg.eigh(self.projected @ self.projected.transpose(0, 2, 1))
        return np.sqrt(squares), directions

    @cached_property
    def mean_radius(self) -> float:
        return float(np.sqrt(self.axes[0][0].prod()))

    def deformation(self, samples: np.ndarray) -> float:
        """The largest difference of a semi-axis to the mean radius at the start, relative to it."""
        return float(np.abs(self.axes[0][samples] / self.mean_radius - 1).max())

    def compression(self, samples: np.ndarray) -> float:
        """The largest amount by which a semi-axis is smaller than the mean radius at the start, relative to it, or 0."""
        return float(np.maximum(1 - self.axes[0][samples] / self.mean_radius, 0).max())

    def magnified(self, sample: int, factor: float) -> np.ndarray:
        """The matrix that maps points of the projected body to those with a magnified deformation."""
        lengths, directions = self.axes[0][sample], self.axes[1][sample]
        return directions @ np.diag((self.mean_radius + factor * (lengths - self.mean_radius)) / lengths) @ directions.T

    def outline(self, sample: int, factor: float) -> np.ndarray:
        """Points of the outline, of shape (points, 2)."""
        angles = np.linspace(0, 2 * math.pi, 121)
        lengths, directions = self.axes[0][sample], self.axes[1][sample]
        circle = np.stack([np.cos(angles), np.sin(angles)])
        return (self.magnified(sample, factor) @ directions @ np.diag(lengths) @ circle).T

    def mark(self, sample: int, factor: float) -> np.ndarray:
        """The marked point of the material."""
        return self.magnified(sample, factor) @ self.projected[sample] @ self.marked

    def long_axis(self, sample: int) -> np.ndarray | None:
        """A unit vector along the bulge."""
        lengths, directions = self.axes[0][sample], self.axes[1][sample]
        return directions[:, 1] if lengths[1] - lengths[0] > ROUND * lengths[1] else None

    def towards(self, companion: int, sample: int) -> np.ndarray:
        difference = self.positions[companion, sample] - self.positions[0, sample]
        return difference / np.linalg.norm(difference)

    def lag(self, sample: int) -> float | None:
        """The angle from the first companion to the long axis, between -pi/2 and pi/2."""
        axis, towards = self.long_axis(sample), self.towards(1, sample)
        if axis is None:
            return None
        return math.remainder(math.atan2(towards[0] * axis[1] - towards[1] * axis[0], towards @ axis), math.pi)

    @cached_property
    def orbital_rate(self) -> np.ndarray:
        return turned_per_time(self.positions[1] - self.positions[0], self.velocities[1] - self.velocities[0])

    @cached_property
    def orbits(self) -> np.ndarray:
        """The number of orbits of the first companion since the start, by the trapezoidal rule."""
        rate = self.orbital_rate
        return np.concatenate([[0], np.cumsum(np.diff(self.times) * (rate[1:] + rate[:-1]) / 2)]) / (2 * math.pi)

    def path(self, body: int, first: int, last: int) -> np.ndarray:
        """A smooth curve through samples: the cubic of Hermite between two of them has their velocities."""
        if last == first:
            return self.positions[body, first : first + 1]
        x, v = self.positions[body, first : last + 1], self.velocities[body, first : last + 1]
        steps = np.diff(self.times[first : last + 1])[:, None, None]
        s = np.linspace(0, 1, POINTS_BETWEEN_SAMPLES, endpoint=False)[None, :, None]
        between = ((1 + 2 * s) * (1 - s) ** 2 * x[:-1, None] + s * s * (3 - 2 * s) * x[1:, None]
                   + steps * s * (1 - s) * ((1 - s) * v[:-1, None] - s * v[1:, None]))
        return np.concatenate([between.reshape(-1, 2), x[-1:]])


def numbers(run: Run, entry: str) -> np.ndarray:
    """An entry with numbers in rows or in a row."""
    return np.array([float(word) for word in run.entry(entry).replace(";", ",").split(",")])


def read_motion(run: Run, model: str) -> Motion:
    columns = run.columns(model)
    if "companion1" not in columns:
        raise WrongInput(f"{model}.csv has no column companion1; the scene needs a companion, and Output/Quantities = all")
    radius, semi_axes = numbers(run, "Body/Radius")[0], numbers(run, "Body/Semi-axes")
    names = [name for name in COMPANIONS if f"{name}1" in columns]
    body_mass = numbers(run, "Body/Density")[0] * 4 / 3 * math.pi * radius**3 * semi_axes.prod()
    masses = np.array([body_mass, *numbers(run, "Companions/Masses")])
    positions = np.stack([vectors(columns, name) for name in names]) / radius
    velocities = np.stack([vectors(columns, f"{name}_velocity") for name in names]) / radius
    plane = orbit_plane(positions[0, 0], velocities[0, 0])

    def about_centre_of_mass(relative_to_body: np.ndarray) -> np.ndarray:
        all_bodies = np.concatenate([np.zeros_like(relative_to_body[:1]), relative_to_body]) @ plane.T
        return all_bodies - np.average(all_bodies, axis=0, weights=masses)

    shape = run.matrices(model, "Q") * semi_axes
    marked = np.linalg.solve(shape[0], positions[0, 0])
    return Motion(columns["time"], masses, about_centre_of_mass(positions), about_centre_of_mass(velocities),
                  vectors(columns, "spin") @ np.cross(*plane), plane @ shape, marked / np.linalg.norm(marked))
