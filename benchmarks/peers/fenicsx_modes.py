#!/usr/bin/python3
"""The small free vibrations of the elastic ball by FEniCSx (Debian's python3-dolfinx-real) and SLEPc: error against run time.

    OMP_NUM_THREADS=1 benchmarks/peers/fenicsx_modes.py [--quick] > fenicsx_modes.csv

The ball is incompressible, with radius, density and shear modulus 1. The unit of frequencies is the shear speed over the radius. The
octant is that of fenicsx_octant.py. The displacements u are in Q_k, and the discontinuous pressures p are in P_{k-1}:

    K u - Gᵀ p = ω² M u,   G u = 0,   K = ∫ 2 ε(u):ε(v),   G u = ∫ q div u

Rows with 1 sector have the 12 lowest modes for which the three coordinate planes are planes of symmetry. In this sector, the modes are
the spheroidal ones of even degree and the toroidal ones of odd degree. S2 then has 2 of its 5 modes. Rows with 4 sectors have all
modes up to the 12th frequency of the ball. The other 4 of the 8 parity sectors have the same frequencies (src/continuum/modes/modes.h).
benchmarks/mode_cost.py measures pseudorigid, which computes the same modes as the rows with 4 sectors.

The mass M is consistent, or lumped by the quadrature at the Gauss–Lobatto nodes. The pressures are polynomials in the coordinates xi of
the reference cell, as is usual in FEniCSx, or in the position X, as in pseudorigid. With the lumped mass and pressures in X, the
equations are those of pseudorigid, and its frequencies are the same.

The following was tried out for FEniCSx, on some of the meshes:

  - The forms are compiled with -O3 -march=native -ffast-math. With five other sets of options, the assembly took 0.9 to 1.1 times as long.
  - Only one component of the mass is assembled. Its zeros are not stored.
  - The matrices of a sector have fixed patterns, and only their entries are copied.
  - MUMPS factorises K - σ M as a symmetric matrix. With unsymmetric factors (LU), a run takes up to 1.4 times as long.
  - MUMPS has the ordering METIS and does not scale the matrix. Neither another ordering nor the scaling makes a run clearly shorter.
  - The Krylov–Schur iteration does not use the inner product of M (GNHEP). With this product (GHEP), a run takes up to 1.2 times as long.
  - The shift σ = 20 lies between the wanted ω². With σ = 1, a run takes up to 1.1 times as long.
  - The search space has three vectors for each mode. With two, four or five vectors, no run is clearly shorter.
  - Pressures in X are more accurate than those in xi for k > 4. The runs take 1.0 to 1.3 times as long.

Imports, the mesh, the patterns of the matrices and the compilation of forms are not timed. The number of modes of each sector comes from
the exact frequencies. FEniCSx does not sort the modes by kind and degree, and does not check that none is missing. pseudorigid does both.

Columns: degree, refinements, mass, unknowns (displacements and pressures of the sectors), seconds (processor time from the first
assembly to the eigenvalues; median of three runs, or of as many as 10 seconds hold), n_modes (of all 8 sectors if `sectors` is 4),
error_S2 (relative error of the mean frequency of S2), error_largest (largest relative error of a mode, with the modes and the exact
ones in ascending order), factor_seconds (part of `seconds` for K - σ M and its factors), sectors, pressure (polynomials in xi or X),
omega_S2.
"""
import itertools
import logging
import pathlib
import statistics
import sys
import time

import numpy as np
import scipy.sparse
import ufl
from dolfinx import fem
from dolfinx.fem import petsc
from petsc4py import PETSc
from scipy.optimize import brentq
from scipy.special import spherical_jn
from slepc4py import SLEPc

from fenicsx_octant import octant
from fenicsx_release import JIT

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import sphere_modes  # noqa: E402

MESHES = ((3, 0), (4, 0), (5, 0), (3, 1), (6, 0), (4, 1), (7, 0), (5, 1))
QUICK = ((3, 0), (4, 0))
PAIRS = (("consistent", "xi"), ("consistent", "X"), ("lumped", "X"))  # mass and pressure; the last is that of pseudorigid
N_WANTED = 12  # modes in the sector of the octant, frequencies of the ball
LARGEST = 9.0  # exact frequencies are computed up to here
SHIFT, TOLERANCE = 20.0, 1e-10  # of the eigenvalues ω²
# The signs of the parity under the three reflections: {sector: number of sectors with the same frequencies}.
OCTANT = {(1, 1, 1): 1}
ALL = {(1, 1, 1): 1, (-1, 1, 1): 3, (-1, -1, 1): 3, (-1, -1, -1): 1}
VECTORS_PER_MODE = 3  # of the search space
MUMPS = {"icntl_7": 5, "icntl_8": 0}  # ordering by METIS, no scaling


def n_harmonics(n, n_odd):
    """Number of surface harmonics of degree n that are odd in n_odd given coordinates and even in the others."""
    if n % 2 != n_odd % 2:
        return 0
    return (n + (2, 1, 0, -1)[n_odd]) // 2


def exact_modes():
    """[(frequency, number of modes in a sector with 0, 1, 2, 3 negative signs)] of the sphere, in ascending order."""
    def toroidal(n, w):  # a free surface: (j/r)' = 0
        return w * spherical_jn(n, w, True) - spherical_jn(n, w)

    modes, step = [], 0.05
    for n in range(1, 12):
        for condition, is_spheroidal in ((sphere_modes.determinant, True), (toroidal, False)):
            # The rotation in a toroidal motion reverses the parity of its harmonic.
            in_sector = [n_harmonics(n, negative if is_spheroidal else 3 - negative) for negative in range(4)]
            for i in range(10, round(LARGEST / step)):
                if condition(n, i * step) * condition(n, (i + 1) * step) < 0:
                    modes.append((brentq(lambda w: condition(n, w), i * step, (i + 1) * step, xtol=1e-13), in_sector))
    return sorted(modes)


def polynomials_of_position(mesh, degree):
    """The monomials of X in each cell, about the middle of the cell."""
    middle = fem.Function(fem.VectorFunctionSpace(mesh, ("DG", 0)))
    middle.interpolate(lambda x: x)
    X = 2 * (ufl.SpatialCoordinate(mesh) - middle)
    return ufl.as_vector([X[0]**a * X[1]**b * X[2]**c for a, b, c in itertools.product(range(degree + 1), repeat=3)
                          if a + b + c <= degree])


class Sector:
    """The matrices of one parity. Their entries are some of the entries of the matrices of all unknowns."""
    def __init__(self, stiffness, mass, components, on_plane, pressures, signs):
        held = [[(i == j) == (signs[j] > 0) for j in range(3)] for i in range(3)]
        free = [~on_plane[held[i]].any(axis=0) for i in range(3)]
        order = np.concatenate([*(components[i][free[i]] for i in range(3)), pressures])
        no_mass = scipy.sparse.csr_matrix(2 * (len(pressures),), dtype=int)
        self.n_unknowns, self.n_negative = len(order), signs.count(-1)
        self.parts = [self.part(stiffness[order][:, order]),
                      self.part(scipy.sparse.block_diag([*(mass[f][:, f] for f in free), no_mass], "csr"))]

    @staticmethod
    def part(numbers):
        """(matrix, array of its entries, their numbers)"""
        numbers.sort_indices()
        values = np.zeros(numbers.nnz)
        csr = (numbers.indptr.astype(np.int32), numbers.indices.astype(np.int32), values)
        matrix = PETSc.Mat().createAIJWithArrays(numbers.shape, csr, comm=PETSc.COMM_SELF)
        matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        return matrix, values, numbers.data

    def operators(self, entries):
        for (matrix, values, numbers), of_whole in zip(self.parts, entries):
            np.take(of_whole, numbers, out=values, mode="clip")
            matrix.assemble()
        return [matrix for matrix, _, _ in self.parts]


class Ball:
    def __init__(self, degree, refinements, is_lumped, of_position, sectors):
        mesh = octant(degree, refinements)
        cell = mesh.ufl_cell()
        displacement = ufl.VectorElement("Lagrange", cell, degree)
        if of_position:
            basis = polynomials_of_position(mesh, degree - 1)
            pressure = ufl.VectorElement("DG", cell, 0, dim=len(basis))
        else:
            pressure = ufl.FiniteElement("DPC", cell, degree - 1)
        space = fem.FunctionSpace(mesh, ufl.MixedElement([displacement, pressure]))
        (u, p), (w, q) = ufl.TrialFunctions(space), ufl.TestFunctions(space)
        if of_position:
            p, q = ufl.dot(p, basis), ufl.dot(q, basis)
        dx = ufl.Measure("dx", domain=mesh, metadata={"quadrature_degree": 2 * degree})
        strains = ufl.inner(ufl.sym(ufl.grad(u)), ufl.sym(ufl.grad(w)))
        self.stiffness_form = fem.form((2 * strains - p * ufl.div(w) - q * ufl.div(u)) * dx, jit_params=JIT)
        collapsed, components = zip(*(space.sub(0).sub(i).collapse() for i in range(3)))
        places = collapsed[0].tabulate_dof_coordinates()
        assert all(np.allclose(other.tabulate_dof_coordinates(), places) for other in collapsed)
        u, w = ufl.TrialFunction(collapsed[0]), ufl.TestFunction(collapsed[0])
        nodes = {"quadrature_rule": "GLL", "quadrature_degree": 2 * degree - 1}
        self.mass_form = fem.form(u * w * (dx(metadata=nodes) if is_lumped else dx), jit_params=JIT)
        self.K, self.M = petsc.create_matrix(self.stiffness_form), petsc.create_matrix(self.mass_form)
        self.assemble()
        on_plane = np.abs(places.T) < 1e-10
        pressures = np.array(space.sub(1).collapse()[1])
        whole = [self.numbers(matrix, is_sparse) for matrix, is_sparse in ((self.K, False), (self.M, True))]
        self.sectors = [Sector(*whole, [np.array(c) for c in components], on_plane, pressures, signs) for signs in sectors]

    @staticmethod
    def numbers(matrix, is_sparse):
        """The pattern of a matrix, with the numbers of its entries. If is_sparse is true, it is without entries that are zero."""
        starts, columns, values = matrix.getValuesCSR()
        rows = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
        kept = np.flatnonzero(np.abs(values) > 1e-14 * np.abs(values).max()) if is_sparse else np.arange(len(values))
        pattern = scipy.sparse.csr_matrix((kept, (rows[kept], columns[kept])), matrix.size)
        assert pattern.nnz == len(kept)
        return pattern

    def assemble(self):
        for matrix, form in ((self.K, self.stiffness_form), (self.M, self.mass_form)):
            matrix.zeroEntries()
            petsc.assemble_matrix(matrix, form)
            matrix.assemble()

    def frequencies(self, n_wanted):
        """(frequencies of each sector in ascending order, processor time for factors)"""
        self.assemble()
        entries = [matrix.getValuesCSR()[2] for matrix in (self.K, self.M)]
        found, factor_seconds = [], 0
        for sector, n in zip(self.sectors, n_wanted):
            n_rigid = sector.n_negative in (1, 2)
            solver = self.solver(sector.operators(entries), n + n_rigid)
            start = time.process_time()
            solver.setUp()
            factor_seconds += time.process_time() - start
            solver.solve()
            squares = np.sort([solver.getEigenvalue(i).real for i in range(solver.getConverged())])[n_rigid:]
            if len(squares) < n:
                raise SystemExit(f"error: {len(squares)} of {n} modes")
            found.append(np.sqrt(squares[:n]))
        return found, factor_seconds

    def solver(self, operators, n_wanted):
        solver = SLEPc.EPS().create(PETSc.COMM_SELF)
        solver.setOperators(*operators)
        solver.setProblemType(SLEPc.EPS.ProblemType.GNHEP)
        solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
        solver.setTarget(SHIFT)
        solver.setDimensions(n_wanted, VECTORS_PER_MODE * n_wanted)
        solver.setTolerances(TOLERANCE)
        transformation = solver.getST()
        transformation.setType("sinvert")
        transformation.setMatStructure(PETSc.Mat.Structure.SUBSET_NONZERO_PATTERN)
        direct = transformation.getKSP()
        direct.setType("preonly")
        direct.getPC().setType("cholesky")
        direct.getPC().setFactorSolverType("mumps")
        options = PETSc.Options()
        for name, value in MUMPS.items():
            options[f"st_mat_mumps_{name}"] = value
        solver.setFromOptions()
        return solver


def errors(frequencies, sectors, exact):
    """(number of modes, mean frequency of S2, largest relative error)"""
    S2 = next(w for w, in_sector in exact if in_sector == [2, 0, 1, 0])
    n_modes, largest, of_S2 = 0, 0, []
    for signs, found in zip(sectors, frequencies):
        known = np.repeat([w for w, _ in exact], [in_sector[signs.count(-1)] for _, in_sector in exact])[:len(found)]
        n_modes += sectors[signs] * len(found)
        largest = max(largest, np.abs(found / known - 1).max())
        of_S2 += sectors[signs] * list(found[known == S2])
    return n_modes, np.mean(of_S2), np.mean(of_S2) / S2 - 1, largest


def measure(degree, refinements, mass, pressure, sectors, exact):
    last = exact[N_WANTED - 1][0]
    n_wanted = [N_WANTED] if len(sectors) == 1 else [
        sum(in_sector[signs.count(-1)] for w, in_sector in exact if w <= last) for signs in sectors]
    ball = Ball(degree, refinements, mass == "lumped", pressure == "X", sectors)
    seconds, factor_seconds = [], []
    while len(seconds) < 3 and sum(seconds) < 10:
        PETSc.garbage_cleanup(PETSc.COMM_SELF)
        start = time.process_time()
        frequencies, of_factors = ball.frequencies(n_wanted)
        seconds.append(time.process_time() - start)
        factor_seconds.append(of_factors)
    n_modes, S2, error, largest = errors(frequencies, sectors, exact)
    print(degree, refinements, mass, sum(sector.n_unknowns for sector in ball.sectors), f"{statistics.median(seconds):.4g}",
          n_modes, f"{abs(error):.3g}", f"{largest:.3g}", f"{statistics.median(factor_seconds):.4g}", len(sectors),
          pressure, f"{S2:.13f}", sep=",", flush=True)


def main():
    if sys.argv[1:] not in ([], ["--quick"]):
        raise SystemExit(__doc__)
    exact = exact_modes()
    print("degree,refinements,mass,unknowns,seconds,n_modes,error_S2,error_largest,factor_seconds,sectors,pressure,omega_S2", flush=True)
    for degree, refinements in QUICK if sys.argv[1:] else MESHES:
        for mass, pressure in PAIRS:
            for sectors in (OCTANT, ALL):
                measure(degree, refinements, mass, pressure, sectors, exact)


if __name__ == "__main__":
    logging.disable(logging.WARNING)  # FFCx tells of each of its files
    main()
