"""Impact of an incompressible elastic sphere on a rigid plane, by Hertz's law and the spheroidal modes together.

Units are the radius, the density and the shear modulus mu. With the mass M, the force F, the depth d of the plane (hertz.py), and
for each mode of degree n the displacement q of the pole, the frequency w and the squared displacement p of the pole
(sphere_modes.py),

    M d'' = -F,     q'' + w^2 q = (p/M) P_n(F),
    d = D(F) + sum over the modes of P_n'(F) (q - p P_n(F)/(M w^2)),                                     n = 2, ..., N.

D(F) is the static depth: Hertz, the correction for a finite sphere with finite strains, and the depth of a soft plane. It contains
the static displacement of every mode, so that the sum has only the difference of a mode to it. P_n is the part of Hertz's
pressure with the degree n, and P_n' that of a flat punch, by which the contact grows:

    P_n = 3F (sin x - x cos x)/x^3,   P_n' = sin x/x,   x = (n + 1/2)a,   a^3 = 3F/16.

The equations are those of a Lagrangian, and conserve the energy. As v tends to 0, q does not act on F, and the loss 1 - e^2 tends to
the sum over modes of contact.py. Modes of degree n > N answer F as if they were static. Modes with (N + 1/2)a > 2 are refused:
with all modes taken from it, nothing of D would be left.
"""
import dataclasses
import math

import numpy as np

import hertz
from sphere_modes import spheroidal_modes

MASS = 4 * math.pi / 3


@dataclasses.dataclass
class Impact:
    loss: float  # 1 - e^2
    duration: float
    force: float  # the largest


class Contact:
    """The force for a depth and displacements of the modes of degree 2 to `largest_degree`, on a plane of stiffness k."""

    def __init__(self, largest_degree, k):
        n, self.w, self.p = np.array(spheroidal_modes(largest_degree, 30)).T
        self.order = n + 0.5
        self.compliance = self.p / (MASS * self.w**2)
        self.terms = hertz.powers(hertz.ONE_PLANE - hertz.finite_strains(), k)

    def parts(self, force):
        """P_n, P_n' and P_n'' for each mode."""
        x = self.order * hertz.radius(force)
        sine, cosine = np.sin(x), np.cos(x)
        return 3 * force * (sine - x * cosine) / x**3, sine / x, (cosine - sine / x) / (3 * force)

    def force(self, depth, q, guess):
        """The root F by Newton's method, or 0 if there is no contact."""
        force = guess or (max(depth, 1e-12) / self.terms[0][0]) ** 1.5
        for _ in range(100):
            P, first, second = self.parts(force)
            rest = sum(c * force**power for c, power in self.terms) + first @ (q - self.compliance * P) - depth
            slope = sum(c * power * force ** (power - 1) for c, power in self.terms)
            slope += second @ (q - self.compliance * P) - self.compliance @ first**2
            if slope <= 0:
                raise ValueError("too many modes for this depth")
            new = max(force - rest / slope, force / 5)
            if new < 1e-13:
                return 0.0
            if abs(new - force) < 1e-13 * force or abs(rest) < 1e-15 * (abs(depth) + np.abs(q).sum()):
                return new
            force = new
        raise ValueError("no force for this depth")


def resolves(v, largest_degree):
    return (largest_degree + 0.5) * 0.9963 * v**0.4 <= 2


def impact(v, k, largest_degree, n_steps=3000):
    """The impact with the speed v, by the Strang splitting of forces and free motions. If the modes are too many, the values
    are not numbers."""
    if not resolves(v, largest_degree):
        return Impact(math.nan, math.nan, math.nan)
    contact = Contact(largest_degree, k)
    w, p = contact.w, contact.p
    h = 2.922 * v**-0.2 / n_steps  # Hertz's duration has n_steps
    cosine, sine = np.cos(w * h), np.sin(w * h)
    t, depth, speed, force, largest = 0.0, 0.0, v, 0.0, 0.0
    q, rate, P = np.zeros_like(w), np.zeros_like(w), np.zeros_like(w)
    while t == 0 or force > 1e-7 * largest:  # a vibrating pole may touch at d < 0
        speed, rate = speed - force / MASS * h / 2, rate + p / MASS * P * h / 2
        t, depth = t + h, depth + speed * h
        q, rate = cosine * q + sine / w * rate, cosine * rate - w * sine * q
        force = contact.force(depth, q, force)
        largest = max(largest, force)
        P = contact.parts(force)[0] if force > 0 else 0 * P
        speed, rate = speed - force / MASS * h / 2, rate + p / MASS * P * h / 2
    return Impact(1 - (speed / v) ** 2, t, largest)
