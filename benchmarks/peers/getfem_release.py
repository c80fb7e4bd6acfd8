#!/usr/bin/python3
"""The nonlinear release of the ball by GetFEM (Debian's python3-getfem++ 5.4, python3-scipy): error against run time.

    OMP_NUM_THREADS=1 benchmarks/peers/getfem_release.py [--quick] > getfem_release.csv
    OMP_NUM_THREADS=1 benchmarks/peers/getfem_release.py --sizes > getfem_sizes.csv

The same problem, reference and schemes as in fenicsx_release.py (release.py), on the same hexahedra of the octant.
Displacements are in Q_k with geometry of degree k, k = 2 or 3. GetFEM 5.4 has no discontinuous P_{k−1} on hexahedra, so the
Kirchhoff pressure is continuous in Q_{k−1} (Taylor–Hood). All forces and tangents are written in GWFL, with k + 1
Gauss points in each direction. Factors are by SuperLU, because GetFEM's interface to MUMPS forgets its factors. Errors are measured
for degree 2 only, since GetFEM 5.4 tabulates the polynomials of higher degrees again in every assembly: on an Intel Xeon, a run
with degree 3 on the unrefined mesh took 256 s and had an error of 4e-3.

Columns: degree, refinements, scheme, step, unknowns, seconds (processor time from the first assembly to the last sample;
median of three runs, or of as many as 10 seconds hold), error (largest difference of Q33 over the 50 samples),
iterations_per_step (Newton iterations of a midpoint step), factorizations, tolerance (of these iterations); with --sizes solver,
seconds_factors and seconds_step (release.py). The largest meshes of --sizes have the iterations of saddle_point.py in place of factors.
"""
import getfem as gf
import numpy as np
import scipy.sparse as sp
from petsc4py import PETSc
from scipy.sparse.linalg import splu

import saddle_point
from getfem_impact import coarse_cells, position, scipy_matrix
from release import main

# (degree, refinements): {scheme: steps between two samples}
JOBS = {
    (2, 0): {"midpoint": (2, 4)},
    (2, 1): {"midpoint": (4, 8), "midpoint, order 4": (1, 2)},
    (2, 2): {"midpoint": (8,), "midpoint, order 4": (1, 2)},
}
QUICK = {(2, 0): {"midpoint": (2,)}}
SIZES = {"SuperLU": ((2, 0), (2, 1), (3, 1), (2, 2)), "iterations": ((2, 2), (2, 3), (2, 4))}
PLACED = "(Id(3)+0.5*Grad_u+0.5*Grad_start)"
RESIDUAL = (f"h2*(u-moved).Test_u + ({PLACED}+(p-1)*Inv({PLACED})'):Grad_Test_u + log(Det(Id(3)+Grad_u))*Test_p")


def octant(degree, refinements):
    """The interpolant of the map at Gauss-Lobatto points, as in fenicsx_octant.py, by its values at equidistant ones."""
    n, inner = 2**refinements, np.polynomial.Legendre.basis(degree).deriv().roots()
    nodes, equidistant = np.array([0, *(1 + inner) / 2, 1]), np.linspace(0, 1, degree + 1)
    interpolate = np.vander(equidistant) @ np.linalg.inv(np.vander(nodes))
    mesh, cell = gf.Mesh("empty", 3), gf.GeoTrans(f"GT_QK(3,{degree})")
    for vertices, on_sphere, _ in coarse_cells():
        for place in np.ndindex(n, n, n):
            local = [(i + nodes) / n for i in place]
            xi = np.stack(np.meshgrid(*local, indexing="ij"), -1).reshape(-1, 3)
            X = position(vertices, on_sphere, xi).reshape([degree + 1] * 3 + [3])
            for direction in range(3):
                X = np.moveaxis(np.tensordot(interpolate, X, (1, direction)), 0, direction)
            X[np.abs(X) < 1e-12] = 0
            mesh.add_convex(cell, X.transpose(2, 1, 0, 3).reshape(-1, 3).T)
    return mesh


class Ball:
    def __init__(self, degree, refinements, solver="SuperLU"):
        self.solver = solver
        mesh = octant(degree, refinements)
        displacements, pressures = gf.MeshFem(mesh, 3), gf.MeshFem(mesh, 1)
        displacements.set_fem(gf.Fem(f"FEM_QK(3,{degree})"))
        pressures.set_fem(gf.Fem(f"FEM_QK(3,{degree - 1})"))
        points = gf.MeshIm(mesh, gf.Integ(f"IM_GAUSS_PARALLELEPIPED(3,{2 * degree + 1})"))
        self.kept = mesh, displacements, pressures, points  # the model refers to them, but does not own them
        self.model = gf.Model("real")
        self.model.add_fem_variable("u", displacements)
        self.model.add_fem_variable("p", pressures)
        self.model.add_initialized_data("h2", 1.0)
        for name in ("start", "moved"):
            self.model.add_fem_data(name, displacements)
        self.model.add_nonlinear_term(points, RESIDUAL)
        n_u, n = displacements.nbdof(), displacements.nbdof() + pressures.nbdof()
        self.of_u, self.of_p = (self.model.interval_of_variable(name) for name in "up")
        X, component = displacements.basic_dof_nodes(), np.arange(n_u) % 3
        own = X[component, np.arange(n_u)]
        self.is_displacement = np.zeros(n, bool)
        self.is_displacement[self.of_u[0]:self.of_u[0] + n_u] = True
        self.free = ~self.is_displacement
        self.free[self.is_displacement] = np.abs(own) > 1e-9
        weights = gf.asm_mass_matrix(points, displacements).mult(np.where(component == 2, own, 0)).ravel()
        self.moment, self.velocity = np.zeros(n), np.zeros(n)
        self.moment[self.is_displacement] = weights / (weights @ own)
        self.velocity[self.is_displacement] = 0.3 * np.where(component == 2, -2, 1) * own

    def begin(self, u, moved, h):
        self.model.set_variable("start", u[self.is_displacement])
        self.model.set_variable("moved", moved[self.is_displacement])
        self.model.set_variable("h2", 2 / h**2)

    def assemble(self, z, what):
        for name, (first, size) in zip("up", (self.of_u, self.of_p)):
            self.model.set_variable(name, z[first:first + size])
        self.model.assembly(what)

    def residual(self, z):
        self.assemble(z, "build_rhs")
        return np.where(self.free, -self.model.rhs(), 0)

    def factors(self, z):
        self.assemble(z, "build_matrix")
        free, held = (sp.diags(chosen.astype(float)) for chosen in (self.free, ~self.free))
        tangent = (free @ scipy_matrix(self.model.tangent_matrix()) @ free + held).tocsr()
        if self.solver == "iterations":
            return saddle_point.solver(PETSc.Mat().createAIJ(tangent.shape, csr=(tangent.indptr, tangent.indices, tangent.data)),
                                       self.is_displacement)
        return splu(tangent.tocsc()).solve


if __name__ == "__main__":
    gf.util_trace_level(0)
    main(Ball, JOBS, QUICK, SIZES, __doc__)
