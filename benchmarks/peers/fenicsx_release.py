#!/usr/bin/python3
"""The nonlinear release of the ball by FEniCSx (Debian's python3-dolfinx-real): error against run time.

    benchmarks/peers/fenicsx_release.py [--quick] > fenicsx_release.csv

The same problem and reference as benchmarks/ball_release.py, on the same octant (fenicsx_octant.py). Displacement u in Q_k
with geometry of degree k, Kirchhoff pressure p discontinuous of degree k − 1, ∫ q ln det F = 0, W = (μ/2)(tr C − 3 − 2 ln J):

  (2ρ/h²)(u¹ − u⁰ − h v⁰) = div(P(Fᵐ) + p Fᵐ⁻ᵀ),  Fᵐ = Id + ∇(u⁰ + u¹)/2,  ln det F(u¹) = 0,  v¹ = 2(u¹ − u⁰)/h − v⁰

implicit midpoint rule with the constraint at the end of the step; or five of them, composed to order 4 (Suzuki). What helps
it: modified Newton iterations with factors by MUMPS that are kept until an iteration converges slowly, initial guesses
extrapolated from the last four steps, forms compiled with -O3 -march=native, quadrature of degree 2k, processor time
without imports, mesh, and compilation of forms.

Columns: degree, refinements, scheme, step, unknowns, seconds (processor time from the first assembly to the last sample;
median of three runs, or of as many as 10 seconds hold), error (largest difference of Q33 over the 50 samples),
iterations_per_step (Newton iterations of a midpoint step), factorizations.
"""
import logging
import pathlib
import statistics
import sys
import time

import dolfinx
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc
from petsc4py import PETSc

from fenicsx_octant import octant

REFERENCE = pathlib.Path(__file__).resolve().parents[1] / "references/ball_release.csv"
END, SAMPLES = 5.0, 50
SUZUKI = (1 / (4 - 4 ** (1 / 3)),) * 2 + (1 - 4 / (4 - 4 ** (1 / 3)),) + (1 / (4 - 4 ** (1 / 3)),) * 2
SCHEMES = {"midpoint": (1.0,), "midpoint, order 4": SUZUKI}
# (degree, refinements): {scheme: steps between two samples}
JOBS = {
    (3, 0): {"midpoint": (2, 4, 8), "midpoint, order 4": (1,)},
    (4, 0): {"midpoint": (4, 8, 16, 32), "midpoint, order 4": (1, 2)},
    (3, 1): {"midpoint, order 4": (1, 2, 3)},
    (5, 0): {"midpoint": (32,), "midpoint, order 4": (1, 2, 3)},
    (4, 1): {"midpoint, order 4": (2,)},
}
QUICK = {(3, 0): {"midpoint": (4,)}, (4, 0): {"midpoint": (8,), "midpoint, order 4": (1,)}}
JIT = {"cffi_extra_compile_args": ["-O3", "-march=native", "-ffast-math"]}
TOLERANCE = 1e-7  # of the largest change of u in an iteration; with 1e-9 errors are the same
SLOW = 0.5  # an iteration that reduces the change by less is with factors that are too old; 0.15 costs twice as much


class Ball:
    def __init__(self, degree, refinements):
        mesh = octant(degree, refinements)
        cell = mesh.ufl_cell()
        self.space = fem.FunctionSpace(mesh, ufl.MixedElement([
            ufl.VectorElement("Lagrange", cell, degree), ufl.FiniteElement("DPC", cell, degree - 1)]))
        self.h2 = fem.Constant(mesh, PETSc.ScalarType(1))  # 2/h²
        self.z, self.start, self.moving = (fem.Function(self.space) for _ in range(3))  # (u¹, p), (u⁰, ·), (u⁰ + h v⁰, ·)
        u, p = ufl.split(self.z)
        u0, moved = ufl.split(self.start)[0], ufl.split(self.moving)[0]
        w, q = ufl.TestFunctions(self.space)
        dx = ufl.Measure("dx", domain=mesh, metadata={"quadrature_degree": 2 * degree})
        identity = ufl.Identity(3)
        F = ufl.variable(identity + ufl.grad((u0 + u) / 2))
        P = F + (p - 1) * ufl.inv(F).T
        residual = (self.h2 * ufl.dot(u - moved, w) + ufl.inner(P, ufl.grad(w)) + q * ufl.ln(ufl.det(identity + ufl.grad(u)))) * dx
        self.residual = fem.form(residual, jit_params=JIT)
        self.jacobian = fem.form(ufl.derivative(residual, self.z), jit_params=JIT)
        X = ufl.SpatialCoordinate(mesh)
        self.conditions = self.planes(mesh)
        self.moment = petsc.assemble_vector(fem.form(X[2] * w[2] * dx, jit_params=JIT)).array.copy()
        self.moment /= fem.assemble_scalar(fem.form(X[2] ** 2 * dx, jit_params=JIT))
        velocity = fem.Function(self.space)
        velocity.sub(0).interpolate(lambda x: 0.3 * np.array([x[0], x[1], -2 * x[2]]))
        self.velocity = velocity.x.array.copy()
        displacement_dofs = self.space.sub(0).collapse()[1]
        self.is_displacement = np.zeros(len(self.velocity), bool)
        self.is_displacement[displacement_dofs] = True
        self.matrix, self.b = petsc.create_matrix(self.jacobian), petsc.create_vector(self.residual)
        self.dx = self.b.duplicate()

    def planes(self, mesh):
        """u_i = 0 where X_i = 0."""
        found = []
        for i in range(3):
            component = self.space.sub(0).sub(i)
            collapsed, _ = component.collapse()
            dofs = fem.locate_dofs_geometrical((component, collapsed), lambda x, i=i: np.isclose(x[i], 0, atol=1e-10))
            found.append(fem.dirichletbc(fem.Function(collapsed), dofs, component))
        self.held = np.unique(np.concatenate([bc.dof_indices()[0] for bc in found]))
        return found


class Motion:
    def __init__(self, ball):
        self.ball = ball
        self.u, self.v, self.p = np.zeros_like(ball.velocity), ball.velocity.copy(), np.zeros_like(ball.velocity)
        self.factors, self.past = {}, {}
        self.n_iterations = self.n_factorizations = self.n_steps = 0

    def factorize(self, h):
        ball = self.ball
        ball.matrix.zeroEntries()
        petsc.assemble_matrix(ball.matrix, ball.jacobian, bcs=ball.conditions)
        ball.matrix.assemble()
        solver = PETSc.KSP().create(PETSc.COMM_SELF)
        solver.setOperators(ball.matrix.copy())
        solver.setType("preonly")
        solver.getPC().setType("lu")
        solver.getPC().setFactorSolverType("mumps")
        solver.setUp()
        self.factors[h] = solver
        self.n_factorizations += 1

    def guess(self, place):
        """Accelerations-like parts (u¹ − u⁰ − h v⁰, p) of the last four steps at this place of the composition, by a cubic."""
        past = self.past.get(place, [])
        weights = {0: [], 1: [1], 2: [-1, 2], 3: [1, -3, 3], 4: [-1, 4, -6, 4]}[len(past)]
        return sum((w * y for w, y in zip(weights, past)), np.zeros_like(self.u))

    def step(self, h, place):
        ball, z = self.ball, self.ball.z.x.array
        is_u = ball.is_displacement
        moved = self.u + h * self.v
        ball.start.x.array[:] = self.u
        ball.moving.x.array[:] = moved
        ball.h2.value = 2 / h**2
        z[:] = np.where(is_u, moved, 0) + self.guess(place)
        before = np.inf
        for _ in range(30):
            if h not in self.factors:
                self.factorize(h)
                before = np.inf
            with ball.b.localForm() as local:
                local.set(0)
            petsc.assemble_vector(ball.b, ball.residual)
            ball.b.array[ball.held] = 0
            self.factors[h].solve(ball.b, ball.dx)
            z -= ball.dx.array
            self.n_iterations += 1
            change = np.abs(ball.dx.array[is_u]).max()
            if change < TOLERANCE:
                break
            if change > SLOW * before:
                del self.factors[h]
            before = change
        else:
            raise SystemExit(f"error: no convergence with step {h}")
        self.n_steps += 1
        self.past[place] = [*self.past.get(place, [])[-3:], z - np.where(is_u, moved, 0)]
        self.v = np.where(is_u, 2 * (z - self.u) / h - self.v, 0)
        self.u = np.where(is_u, z, 0)

    def run(self, weights, n_steps):
        Q33 = [1.0]
        h = END / SAMPLES / n_steps
        for _ in range(SAMPLES):
            for _ in range(n_steps):
                for place, weight in enumerate(weights):
                    self.step(weight * h, place)
            Q33.append(1 + self.ball.moment @ self.u)
        return Q33


def reference():
    return [float(line.split(",")[1]) for line in REFERENCE.read_text().splitlines()[2:]]


def main():
    logging.disable(logging.WARNING)  # FFCx tells of each of its files
    quick = sys.argv[1:] == ["--quick"]
    if sys.argv[1:] and not quick:
        raise SystemExit(__doc__)
    print("degree,refinements,scheme,step,unknowns,seconds,error,iterations_per_step,factorizations")
    exact = reference()
    for (degree, refinements), schemes in (QUICK if quick else JOBS).items():
        ball = Ball(degree, refinements)
        Motion(ball).step(1e-3, 0)  # whatever is done once
        for scheme, steps in schemes.items():
            for n_steps in steps:
                seconds = []
                while len(seconds) < (1 if quick else 3) and sum(seconds) < 10:
                    motion = Motion(ball)
                    start = time.process_time()
                    Q33 = motion.run(SCHEMES[scheme], n_steps)
                    seconds.append(time.process_time() - start)
                error = max(abs(a - b) for a, b in zip(Q33, exact))
                print(degree, refinements, f'"{scheme}"', f"{END / SAMPLES / n_steps:.4g}", len(ball.velocity),
                      f"{statistics.median(seconds):.4g}", f"{error:.3g}",
                      f"{motion.n_iterations / motion.n_steps:.1f}", motion.n_factorizations, sep=",", flush=True)


if __name__ == "__main__":
    main()
