"""A ball at rest in a trap by Newton's iteration, shared by the scripts of other programs.

The incompressible neo-Hookean ball, μ = ρ = r = 1, with the force −ρ T x, T = diag(0.6, 0.6, 0). The iteration starts from the
undeformed ball under the full force, and ends when no displacement changes by more than 1e-10.

A program gives a ball for a degree and refinements. It has: velocity (of the size of the unknowns), is_displacement (of each unknown),
moment (Q33 = 1 + moment · z), change(z) (of an iteration, with new factors of the tangent).
"""
import statistics
import sys
import time

import numpy as np
from petsc4py import PETSc

STIFFNESS = (0.6, 0.6, 0)
TOLERANCE = 1e-10


def solve(ball):
    """(iterations, Q33)"""
    z = np.zeros_like(ball.velocity)
    for iteration in range(1, 31):
        dz = ball.change(z)
        z = z + dz
        if np.abs(dz[ball.is_displacement]).max() < TOLERANCE:
            return iteration, 1 + ball.moment @ z
    raise SystemExit("error: no convergence")


def main(make_ball, meshes, quick_meshes, documentation):
    if sys.argv[1:] not in ([], ["--quick"]):
        raise SystemExit(documentation)
    print("degree,refinements,unknowns,iterations,seconds,Q33", flush=True)
    for degree, refinements in quick_meshes if sys.argv[1:] else meshes:
        ball = make_ball(degree, refinements)
        solve(ball)  # whatever is done once
        seconds = []
        for _ in range(3):
            PETSc.garbage_cleanup(PETSc.COMM_SELF)
            start = time.process_time()
            iterations, Q33 = solve(ball)
            seconds.append(time.process_time() - start)
        print(degree, refinements, len(ball.velocity), iterations, f"{statistics.median(seconds):.4g}", f"{Q33:.12f}", sep=",", flush=True)
