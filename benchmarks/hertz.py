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

For an incompressible body there is no logarithm of a in this place. The next terms are smaller by the factor a/r. A plane that
gives way with the stiffness k (pressure over depth) adds p0/(2k): the derivative with respect to F of the elastic energy
(1/2k) times the integral of p^2, with Hertz's pressure p.
"""
import math

N_TERMS = 100_000


def excess(n):
    return (3 * n + 6) / (2 * (n - 1) * (2 * n * n + 4 * n + 3))


ONE_PLANE = (2 - sum(map(excess, range(2, N_TERMS))) - 0.75 / N_TERMS) / (4 * math.pi)
TWO_PLANES = (0.75 - sum(map(excess, range(2, N_TERMS, 2))) - 0.375 / N_TERMS) / (2 * math.pi)


def radius(force):
    return (3 * force / 16) ** (1 / 3)


def powers(correction, k):
    """(c, p) of the terms c F^p of the depth: Hertz, the correction, and the depth p0/(2k) of the plane."""
    hertz = (3 / 16) ** (2 / 3)
    return (hertz, 2 / 3), (-correction, 1), (3 / (4 * math.pi * k * hertz), 1 / 3)


def depth(force, correction=0.0, k=math.inf):
    """Depth for a force: Hertz, minus `correction` (ONE_PLANE, TWO_PLANES) times the force, plus that of the plane."""
    return sum(c * force**p for c, p in powers(correction, k))


def impact(v, k=math.inf, correction=ONE_PLANE, n=2000):
    """(F_max, duration) of a ball that hits a plane with the speed v, for the force F(d) of `depth` without vibrations."""
    terms, mass = powers(correction, k), 4 * math.pi / 3

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
