#!/usr/bin/python3
"""A ball at rest in a trap by GetFEM (Debian's python3-getfem++ 5.4, python3-petsc4py): error against run time.

    OMP_NUM_THREADS=1 benchmarks/peers/getfem_static.py [--quick] > getfem_static.csv

The problem and the iteration are those of static.py, on the octant and Taylor–Hood elements of getfem_release.py. Pressures in
Q_{k−2}, discontinuous, had at least twenty times the error on the same mesh. With discontinuous P_{k−1}, made of Q_{k−1} by a
reduction of its unknowns, Q33 was that of fenicsx_static.py to 1e-11, with 1.1 to 40 times the error in about the same time.

From degree 3, assembly takes most of the time. GetFEM 5.4 tabulates the polynomials again in every assembly, on any mesh for 0.2 s with
degree 3 and for 2 s with degree 4. On unrefined meshes this is nearly all, and on those refined once a third of the time. So one assembly
gives both parts of an iteration: the residual is the derivative of the potential, a row of the tangent. Factors are by the MUMPS of
PETSc. With it, a run of degree 2 refined twice took 2.8 s, with GetFEM's interface to MUMPS 3.4 s, and with SuperLU
3.4 s or 7 s by its ordering.

Columns: degree, refinements, unknowns, iterations, seconds (processor time from the first assembly to the last solution, median of
three), Q33 (mass moment).
"""
import getfem as gf
import numpy as np
from petsc4py import PETSc

import getfem_release
from static import STIFFNESS, main

MESHES = ((2, 0), (2, 1), (3, 0), (2, 2), (3, 1), (4, 0), (4, 1))
QUICK = ((2, 0), (2, 1))
F = "(Id(3)+Grad_u)"
TRAP = f"[{','.join(map(str, STIFFNESS))}].*(X+u)"
RESIDUAL = f"({F}+(p-1)*Inv({F})'):Grad_Test_u + ({TRAP}).Test_u + log(Det({F}))*Test_p"
POTENTIAL = f"0.5*Norm_sqr({F}) + (p-1)*log(Det({F})) + 0.5*({TRAP}).(X+u)"


def solution(A, b):
    A = A.tocsr()
    solver = PETSc.KSP().create(PETSc.COMM_SELF)
    solver.setOperators(PETSc.Mat().createAIJ(A.shape, csr=(A.indptr, A.indices, A.data), comm=PETSc.COMM_SELF))
    solver.setType("preonly")
    solver.getPC().setType("lu")
    solver.getPC().setFactorSolverType("mumps")
    x = np.zeros_like(b)
    solver.solve(*(PETSc.Vec().createWithArray(values, comm=PETSc.COMM_SELF) for values in (b, x)))
    solver.destroy()
    return x


class Ball(getfem_release.Ball):
    def __init__(self, degree, refinements):
        super().__init__(degree, refinements)
        _, displacements, pressures, points = self.kept
        self.model = gf.Model("real")
        self.model.add_fem_variable("u", displacements)
        self.model.add_fem_variable("p", pressures)
        self.model.add_variable("z", 1)  # in alphabetical order the last one
        self.model.add_nonlinear_term(points, f"{RESIDUAL} + ({POTENTIAL})*Test_z")

    def change(self, z):
        self.assemble(z, "build_matrix")
        tangent, free = getfem_release.scipy_matrix(self.model.tangent_matrix()), np.flatnonzero(self.free)
        residual, dz = tangent[-1].toarray().ravel(), np.zeros_like(z)
        dz[free] = solution(tangent[:, free][free], -residual[free])
        return dz


if __name__ == "__main__":
    gf.util_trace_level(0)
    gf.util_warning_level(0)
    main(Ball, MESHES, QUICK, __doc__)
