"""Spheroidal modes of the homogeneous incompressible elastic sphere (Lamb 1882), in units of its radius, density and shear
modulus. With the angular frequency w, spherical Bessel functions j, surface harmonics Y of degree n and constants A, B, a mode is

    u = (U Y, V r grad Y),   U = A n(n+1) j(wr)/(wr) + B n r^(n-1),   V = A (r j(wr))'/(wr) + B r^(n-1),   p = B w^2 r^n Y.

The surface is free: V' - V + U = 0 and 2U' - B w^2 = 0 at r = 1.
"""
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import spherical_jn


def parts(n, w, r):
    """(U, V, U', V') of the part with A = 1, and of the part with B = 1."""
    x = w * r
    j, d = spherical_jn(n, x), spherical_jn(n, x, True)
    second = (n * (n + 1) / x**2 - 1) * j - 2 * d / x
    of_A = (n * (n + 1) * j / x, (j + x * d) / x, n * (n + 1) * w * (d / x - j / x**2),
            w * ((2 * d + x * second) / x - (j + x * d) / x**2))
    return of_A, (n * r**(n - 1), r**(n - 1), n * (n - 1) * r**(n - 2), (n - 1) * r**(n - 2))


def conditions(n, w):
    """The matrix of the two conditions at the surface, in rows."""
    a, b = parts(n, w, 1.0)
    return (a[3] - a[1] + a[0], b[3] - b[1] + b[0]), (2 * a[2], 2 * b[2] - w * w)


def determinant(n, w):
    (a, b), (c, d) = conditions(n, w)
    return a * d - b * c


def pole(n, w):
    """Squared radial displacement of the pole in the axisymmetric mode, with the integral of |u|^2 equal to the volume."""
    (A, B), _ = conditions(n, w)
    A, B = B, -A

    def U_and_V(r):
        a, b = parts(n, w, r)
        return A * a[0] + B * b[0], A * a[1] + B * b[1]

    def density(r):
        U, V = U_and_V(r)
        return (U * U + n * (n + 1) * V * V) * r * r
    return U_and_V(1.0)[0]**2 * (2 * n + 1) / (3 * quad(density, 1e-6, 1, epsrel=1e-11)[0])


def spheroidal_modes(largest_degree, largest_frequency):
    """(n, w, pole(n, w)) of the degrees 2 to `largest_degree`. The pole of modes of degree 1 does not move."""
    modes, step = [], 0.05
    for n in range(2, largest_degree + 1):
        for i in range(10, round(largest_frequency / step)):
            if determinant(n, i * step) * determinant(n, (i + 1) * step) < 0:
                w = brentq(lambda w: determinant(n, w), i * step, (i + 1) * step, xtol=1e-13)
                modes.append((n, w, pole(n, w)))
    return modes
