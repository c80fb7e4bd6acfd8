#!/usr/bin/python3
"""A ball at rest in a trap by FEniCSx (Debian's python3-dolfinx-real): error against run time.

    benchmarks/peers/fenicsx_static.py [--quick] > fenicsx_static.csv

The incompressible neo-Hookean ball, μ = ρ = r = 1, with the force −ρ T x, T = diag(0.6, 0.6, 0), on the octant and elements of
fenicsx_release.py. Newton's iteration starts from the undeformed ball under the full force, with factors of each tangent by MUMPS, and
ends when no displacement changes by more than 1e-10.

Columns: degree, refinements, unknowns, iterations, seconds (processor time from the first assembly to the last solution, median of
three), Q33 (mass moment).
"""
import logging
import statistics
import sys
import time

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc
from petsc4py import PETSc

import fenicsx_release

STIFFNESS = (0.6, 0.6, 0)
MESHES = ((2, 0), (3, 0), (4, 0), (2, 1), (3, 1), (5, 0), (4, 1), (6, 0), (5, 1))
QUICK = ((3, 0), (4, 0))
TOLERANCE = 1e-10


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

    def solve(self):
        """(iterations, Q33)"""
        z = np.zeros_like(self.velocity)
        for iteration in range(1, 31):
            residual = self.residual(z)
            dz = self.factors(z)(residual)
            z = z - dz
            if np.abs(dz[self.is_displacement]).max() < TOLERANCE:
                return iteration, 1 + self.moment @ z
        raise SystemExit("error: no convergence")


def main():
    if sys.argv[1:] not in ([], ["--quick"]):
        raise SystemExit(__doc__)
    print("degree,refinements,unknowns,iterations,seconds,Q33", flush=True)
    for degree, refinements in QUICK if sys.argv[1:] else MESHES:
        ball = Ball(degree, refinements)
        ball.solve()  # whatever is done once
        seconds = []
        for _ in range(3):
            PETSc.garbage_cleanup(PETSc.COMM_SELF)
            start = time.process_time()
            iterations, Q33 = ball.solve()
            seconds.append(time.process_time() - start)
        print(degree, refinements, len(ball.velocity), iterations, f"{statistics.median(seconds):.4g}", f"{Q33:.12f}", sep=",", flush=True)


if __name__ == "__main__":
    logging.disable(logging.WARNING)
    main()
