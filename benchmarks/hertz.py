"""Contact of an incompressible elastic sphere with rigid planes: Hertz's theory and its first correction for a finite sphere.

Units are the radius r, the density and the shear modulus mu. d is the depth of a plane below the undeformed surface, measured
from the centre of mass. Hertz's theory of a half-space has, for a force F,

    d = a^2,   a^3 = 3F/16,   p0 = 3F/(2 pi a^2)

with the radius a and the largest pressure p0 of the contact. It takes d from points at infinity. The surface of a sphere under
a normal traction P_n(cos theta) moves by U_n P_n with

    U_n = n(2n + 1)/(2(n - 1)(2n^2 + 4n + 3)),   (2n + 1)U_n = 1 + e_n,   e_n = (3n + 6)/(2(n - 1)(2n^2 + 4n + 3))

(as h_n of a tide without gravity). A point force F is the traction F/(4 pi) sum (2n + 1)P_n. The sum of P_n is the
displacement of a half-space, so near the force, and measured from the centre of mass, the difference to it is the constant

    d = a^2 - K F,   K = (2 - sum e_n)/(4 pi) = 0.105661             one plane: n = 2, 3, ...; the force accelerates the body,
                     K = (3/4 - sum e_n)/(2 pi) = 0.046834           two opposite planes: n = 2, 4, ...

For an incompressible body there is no logarithm of a in this place.

Finite strains add a term of the same order. The displacement u of Hertz's problem has div u = 0 and the pressure p. For a
neo-Hookean body, with det(1 + grad u) = 1, the terms of third order in the energy are

    E3 = integral of (p/2) tr(grad u)^2 - det(grad u) = -(S/2) F^2,   S = 0.0081345

in the half-space below the contact, by quadrature (`finite_strains`). A change of the energy at a given depth is the opposite
change of the complementary energy at a given force, so that

    d = a^2 - (K - S) F.

The next terms are smaller by the factor a/r. A plane that gives way with the stiffness k (pressure over depth) adds p0/(2k):
the derivative with respect to F of the elastic energy (1/2k) times the integral of p^2, with Hertz's pressure p. Such a plane
also changes the pressure and the radius. `soft_plane` computes them from the integral equation of the half-space: at the
distance s < b from the axis, and with p = 0 for s > b,

    p(s)/k + u(s) = d - s^2/2,   u(s) = (1/4 pi) integral of p dA/R.
"""
import functools
import math

import numpy as np

N_TERMS = 100_000


def excess(n):
    return (3 * n + 6) / (2 * (n - 1) * (2 * n * n + 4 * n + 3))


ONE_PLANE = (2 - sum(map(excess, range(2, N_TERMS))) - 0.75 / N_TERMS) / (4 * math.pi)
TWO_PLANES = (0.75 - sum(map(excess, range(2, N_TERMS, 2))) - 0.375 / N_TERMS) / (2 * math.pi)


@functools.cache
def finite_strains(n=100):
    """S. With a = 1, p0 = 1 and mu = 1, the fields at the depth z and the distance s from the axis are integrals over a disc of
    complex sources, with R = sqrt(s^2 + (z - it)^2) and weights t:

        p = Im int t/R,   C = Im int t(1 - (z - it)/R)/s,   D = -dp/dz,   E = -dp/ds,   t from 0 to 1,
        grad u:  zz = -zD/2,  zs = -(C + zE)/2,  sz = (C - zE)/2,  ss = z(D - C/s)/2,  and zC/(2s) about the axis.

    The integrals over t are elementary. The volume is integrated in oblate spheroidal coordinates by Gauss's rule."""
    nodes, weights = np.polynomial.legendre.leggauss(n)
    nodes, weights = (nodes + 1) / 2, weights / 2
    x, y = np.meshgrid(nodes / (1 - nodes), nodes, indexing="ij")
    volume = np.outer(weights / (1 - nodes) ** 2, weights) * 2 * math.pi * (x**2 + y**2)
    s, z = np.sqrt((1 + x**2) * (1 - y**2)), x * y

    def integrated(primitive):  # t = i(w - z) and dt = i dw, with w = z - it
        def at(w):
            root = np.sqrt(s**2 + w**2)
            return primitive(w, root, np.log(w + root))
        return (at(z + 0j) - at(z - 1j)).imag
    p = integrated(lambda w, root, log: root - z * log)
    C = integrated(lambda w, root, log: (w**2 - w * root + s**2 * log) / (2 * s) - z * (w - root) / s)
    D = integrated(lambda w, root, log: log - (w - z) / root)
    E = integrated(lambda w, root, log: -s / root - z * w / (s * root))
    zz, zs, sz, ss, around = -z * D / 2, -(C + z * E) / 2, (C - z * E) / 2, z * (D - C / s) / 2, z * C / (2 * s)
    energy = np.sum(volume * (p / 2 * (zz**2 + ss**2 + around**2 + 2 * zs * sz) - around * (zz * ss - zs * sz)))
    return -2 * energy * 8 / math.pi / (2 * math.pi / 3) ** 2  # p0 = 8 a/pi


def radius(force):
    return (3 * force / 16) ** (1 / 3)


def powers(correction, k):
    """(c, p) of the terms c F^p of the depth: Hertz, minus the correction, and the depth p0/(2k) of the plane."""
    hertz = (3 / 16) ** (2 / 3)
    return (hertz, 2 / 3), (-correction, 1), (3 / (4 * math.pi * k * hertz), 1 / 3)


def depth(force, correction=0.0, k=math.inf):
    """Depth for a force: Hertz, minus `correction` (such as ONE_PLANE - S) times the force, plus that of the plane."""
    return sum(c * force**p for c, p in powers(correction, k))


def elliptic(m):
    """The complete elliptic integrals (K, E) of the parameter m, by the arithmetic-geometric mean."""
    a, b, c, total = np.ones_like(m), np.sqrt(1 - m), np.sqrt(m), m / 2
    for power in range(12):
        a, b, c = (a + b) / 2, np.sqrt(a * b), (a - b) / 2
        total = total + 2**power * c * c
    return math.pi / (2 * a), math.pi / (2 * a) * (1 - total)


def displacement(s, radius):
    """u at the distance s from the axis of a disc with this radius and the pressure 1 (Johnson, Contact Mechanics, 3.4)."""
    inside = s <= radius
    m = np.minimum(np.where(inside, s / radius, radius / s) ** 2, 1 - 1e-15)
    K, E = elliptic(m)
    return np.where(inside, radius * E, s * (E - (1 - m) * K)) / math.pi


def contact_of_radius(b, k, n=200):
    """(force, largest pressure, radius by the pressure) of the half-space for the radius b, with n rings of constant pressure.
    The radius by the pressure is the root of 5/2 times the mean of s^2; for Hertz's pressure it is a."""
    edges = b * np.sin(np.linspace(0, math.pi / 2, n + 1))
    middle = (edges[1:] + edges[:-1]) / 2
    places = np.append(middle, b)[:, None]
    discs = displacement(places, edges[None, 1:])
    rings = np.diff(discs, prepend=0)
    matrix = rings[:-1] + np.eye(n) / k
    by_depth, by_shape = np.linalg.solve(matrix, np.stack([np.ones(n), middle**2 / 2], axis=1)).T
    depth = (b * b / 2 - rings[-1] @ by_shape) / (1 - rings[-1] @ by_depth)  # the gap at b is 0
    pressure = depth * by_depth - by_shape
    force = pressure @ np.diff(math.pi * edges**2)
    return force, pressure[0], math.sqrt(2.5 * (pressure @ np.diff(math.pi / 2 * edges**4)) / force)


def soft_plane(force, k):
    """(largest pressure, radius by the pressure) of a half-space on a plane of stiffness k, over those of Hertz."""
    a = radius(force)
    low, high = 0.5 * a, 3 * a
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if contact_of_radius(middle, k)[0] < force else (low, middle)
    _, pressure, by_pressure = contact_of_radius(low, k)
    return pressure / (3 * force / (2 * math.pi * a * a)), by_pressure / a


def impact(v, k=math.inf, n=2000):
    """(F_max, duration) of a ball that hits a plane with the speed v, for the force F(d) of `depth` without vibrations."""
    terms, mass = powers(ONE_PLANE - finite_strains(), k), 4 * math.pi / 3

    def work(force):
        return sum(c * p / (1 + p) * force ** (1 + p) for c, p in terms)
    low, high = 0.0, 100 * v
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if work(middle) < mass * v * v / 2 else (low, middle)
    half_duration = 0
    for i in range(n):  # F = F_max sin^3: the integrand dd/speed has no singularity
        s = math.pi / 2 * (i + 0.5) / n
        force = high * math.sin(s) ** 3
        rate = sum(c * p * force ** (p - 1) for c, p in terms) * 3 * high * math.sin(s) ** 2 * math.cos(s)
        half_duration += rate / math.sqrt(v * v - 2 * work(force) / mass) * math.pi / 2 / n
    return high, 2 * half_duration
