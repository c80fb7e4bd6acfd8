#!/usr/bin/python3
"""A ball at rest in a trap by FEniCSx (Debian's python3-dolfinx-real): error against run time.

    benchmarks/peers/fenicsx_static.py [--quick] > fenicsx_static.csv

The problem and the iteration are those of static.py, on the octant and elements of fenicsx_release.py. Factors of each tangent are by
MUMPS.

Columns: degree, refinements, unknowns, iterations, seconds (processor time from the first assembly to the last solution, median of
three), Q33 (mass moment).
"""
import logging

import ufl
from dolfinx import fem
from dolfinx.fem import petsc

import fenicsx_release
from static import STIFFNESS, main

MESHES = ((2, 0), (3, 0), (4, 0), (2, 1), (3, 1), (5, 0), (4, 1), (6, 0), (5, 1))
QUICK = ((3, 0), (4, 0))


class Ball(fenicsx_release.Ball):
    def __init__(self, degree, refinements):
        super().__init__(degree, refinements)
        mesh = self.space.mesh
        u, p = ufl.split(self.z)
        w, q = ufl.TestFunctions(self.space)
        dx = ufl.Measure("dx", domain=mesh, metadata={"quadrature_degree": 2 * degree})
        F = ufl.Identity(3) + ufl.grad(u)
        P = F + (p - 1) * ufl.inv(F).T
        trap = ufl.diag(ufl.as_vector(STIFFNESS))
        residual = (ufl.inner(P, ufl.grad(w)) + ufl.dot(trap * (ufl.SpatialCoordinate(mesh) + u), w) + q * ufl.ln(ufl.det(F))) * dx
        self.residual_form = fem.form(residual, jit_params=fenicsx_release.JIT)
        self.jacobian = fem.form(ufl.derivative(residual, self.z), jit_params=fenicsx_release.JIT)
        self.matrix = petsc.create_matrix(self.jacobian)

    def change(self, z):
        residual = self.residual(z)
        return -self.factors(z)(residual)


if __name__ == "__main__":
    logging.disable(logging.WARNING)
    main(Ball, MESHES, QUICK, __doc__)
