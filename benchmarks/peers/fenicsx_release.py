#!/usr/bin/python3
"""The nonlinear release of the ball by FEniCSx (Debian's python3-dolfinx-real): error against run time.

    benchmarks/peers/fenicsx_release.py [--quick] > fenicsx_release.csv
    benchmarks/peers/fenicsx_release.py --reference fenicsx_reference.csv > fenicsx_release.csv
    benchmarks/peers/fenicsx_release.py --sizes > fenicsx_sizes.csv

The same problem and reference as benchmarks/ball_release.py, on the same octant (fenicsx_octant.py), with the schemes of
release.py. Displacement u in Q_k with geometry of degree k, Kirchhoff pressure p discontinuous of degree k − 1, ∫ q ln det F = 0.
The settings are those that suit FEniCSx: factors by MUMPS, forms compiled with -O3 -march=native, quadrature of degree 2k. Imports,
mesh and compilation of forms are not timed. With --reference the runs of degree 3, 4 and 5 refined once are extrapolated to a
reference of FEniCSx alone (release.py).

Columns: degree, refinements, scheme, step, unknowns, seconds (processor time from the first assembly to the last sample;
median of three runs, or of as many as 10 seconds hold), error (largest difference of Q33 over the 50 samples),
iterations_per_step (Newton iterations of a midpoint step), factorizations, tolerance (of these iterations); with --sizes solver,
seconds_factors and seconds_step (release.py). The largest meshes of --sizes have the iterations of saddle_point.py in place of factors.
"""
import logging

import dolfinx
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem import petsc
from mpi4py import MPI
from petsc4py import PETSc

import saddle_point
from fenicsx_octant import octant
from release import main

# (degree, refinements): {scheme: steps between two samples}
JOBS = {
    (3, 0): {"midpoint": (2, 4, 8), "midpoint, order 4": (1,)},
    (4, 0): {"midpoint": (4, 8, 16, 32), "midpoint, order 4": (1, 2)},
    (3, 1): {"midpoint, order 4": (1, 2, 3)},
    (5, 0): {"midpoint": (32,), "midpoint, order 4": (1, 2, 3)},
    (4, 1): {"midpoint, order 4": (1, 2, 3)},
    (5, 1): {"midpoint, order 4": (2, 3)},
}
QUICK = {(3, 0): {"midpoint": (4,)}, (4, 0): {"midpoint": (8,), "midpoint, order 4": (1,)}}
SIZES = {"MUMPS": ((3, 0), (4, 0), (4, 1), (3, 2), (4, 2)), "iterations": ((3, 2), (4, 2), (3, 3), (4, 3))}
JIT = {"cffi_extra_compile_args": ["-O3", "-march=native", "-ffast-math"]}


class Ball:
    """Its arrays are those of the unknowns that this rank owns."""

    def __init__(self, degree, refinements, solver="MUMPS", comm=MPI.COMM_SELF):
        self.solver, self.comm = solver, comm
        mesh = octant(degree, refinements, comm)
        cell = mesh.ufl_cell()
        self.space = fem.FunctionSpace(mesh, ufl.MixedElement([
            ufl.VectorElement("Lagrange", cell, degree), ufl.FiniteElement("DPC", cell, degree - 1)]))
        self.n_own = self.space.dofmap.index_map.size_local
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
        self.residual_form = fem.form(residual, jit_params=JIT)
        self.jacobian = fem.form(ufl.derivative(residual, self.z), jit_params=JIT)
        X = ufl.SpatialCoordinate(mesh)
        self.conditions = self.planes(mesh)
        moment = petsc.assemble_vector(fem.form(X[2] * w[2] * dx, jit_params=JIT))
        self.add_shared(moment)
        self.moment = moment.array / comm.allreduce(fem.assemble_scalar(fem.form(X[2] ** 2 * dx, jit_params=JIT)))
        velocity = fem.Function(self.space)
        velocity.sub(0).interpolate(lambda x: 0.3 * np.array([x[0], x[1], -2 * x[2]]))
        self.velocity = velocity.x.array[:self.n_own].copy()
        displacement_dofs = np.array(self.space.sub(0).collapse()[1])
        self.is_displacement = np.zeros(len(self.velocity), bool)
        self.is_displacement[displacement_dofs[displacement_dofs < self.n_own]] = True
        self.matrix, self.b = petsc.create_matrix(self.jacobian), petsc.create_vector(self.residual_form)
        self.dx = self.b.duplicate()

    def planes(self, mesh):
        """u_i = 0 where X_i = 0."""
        found = []
        for i in range(3):
            component = self.space.sub(0).sub(i)
            collapsed, _ = component.collapse()
            dofs = fem.locate_dofs_geometrical((component, collapsed), lambda x, i=i: np.isclose(x[i], 0, atol=1e-10))
            found.append(fem.dirichletbc(fem.Function(collapsed), dofs, component))
        held = np.unique(np.concatenate([bc.dof_indices()[0] for bc in found]))
        self.held = held[held < self.n_own]
        return found

    def set(self, function, values):
        function.x.array[:self.n_own] = values
        function.x.scatter_forward()

    @staticmethod
    def add_shared(vector):
        vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)

    def begin(self, u, moved, h):
        self.set(self.start, u)
        self.set(self.moving, moved)
        self.h2.value = 2 / h**2

    def residual(self, z):
        self.set(self.z, z)
        with self.b.localForm() as local:
            local.set(0)
        petsc.assemble_vector(self.b, self.residual_form)
        self.add_shared(self.b)
        self.b.array[self.held] = 0
        return self.b.array

    def factors(self, z):
        self.set(self.z, z)
        self.matrix.zeroEntries()
        petsc.assemble_matrix(self.matrix, self.jacobian, bcs=self.conditions)
        self.matrix.assemble()
        PETSc.garbage_cleanup(self.comm)  # earlier factors, which petsc4py keeps until then
        if self.solver == "iterations":
            return saddle_point.solver(self.matrix, self.is_displacement, self.comm)
        solver = PETSc.KSP().create(self.comm)
        solver.setOperators(self.matrix.copy())
        solver.setType("preonly")
        solver.getPC().setType("lu")
        solver.getPC().setFactorSolverType("mumps")
        solver.setUp()

        def solve(_):  # of what residual() returned
            solver.solve(self.b, self.dx)
            return self.dx.array
        return solve


if __name__ == "__main__":
    logging.disable(logging.WARNING)  # FFCx tells of each of its files
    main(Ball, JOBS, QUICK, SIZES, __doc__, of_reference=((3, 1), (4, 1), (5, 1)))
