#!/usr/bin/python3
"""The impact of an elastic ball on a rigid plane by GetFEM (python3-getfem 5.4, python3-scipy): error against run time.

    OMP_NUM_THREADS=1 benchmarks/peers/getfem_impact.py [--quick] [--program build/release/bin/pseudorigid] > getfem_impact.csv

A compressible ball with r = rho = mu = lambda = 1 and the uniform velocity -0.1 e_z touches the plane z = -1 at t = 0:

  rho u'' = Div P,   F = Id + Grad u,   W = (mu/2)(|F|^2 - 3 - 2 ln J) + (lambda/4)(J^2 - 1 - 2 ln J),
  P = mu F + ((lambda/2)(J^2 - 1) - mu) F^-T,   P N = k d e_z on the surface, d = max(0, -1 - z), k = 1000,

without friction, until t = 6. The quarter x, y > 0 has the hexahedra of src/continuum/mesh/ball_mesh.h, geometry and
displacements of degree 1 or 2, diagonal mass and elastic forces by Gauss-Lobatto points, and 2 (degree + 1) Gauss points of
contact per direction of a face. All forces and tangents are written in GWFL.
  central differences: v += h a/2, u += h v, a = f(u)/m, v += h a/2; h is a part of 2/w, w that of rest and full contact
  midpoint: (4/h^2) m (U - u - h v/2) = f(U), U = (u + u')/2, u' = 2 U - u, v' = 4 (U - u)/h - v
The midpoint rule keeps factors (SuperLU) until it converges slowly, extrapolates guesses and searches along lines. GetFEM's
interface to MUMPS forgets its factors. The job "midpoint, MUMPS", Newton's method, takes at least three times as long, and is
not in JOBS.
Degree 3 is left out, since GetFEM 5.4 tabulates its polynomials again in every assembly, which then takes 0.2 s on any mesh.
With --program, runs of pseudorigid alternate with these. Columns: method (with the part of 2/w, the step or Time/Tolerance),
seconds (processor time, median of three rounds or of as many as begin within 10 seconds: of GetFEM from the first assembly to
the last step, without imports and mesh; of pseudorigid the process less an empty start, with mesh, search for the step and
output), e (momentum at the end over that at the start), force (largest at ends of steps, of the midpoint rule at middles),
error_e and error_force (relative) from REFERENCE, drift (relative, of the energy at the end), assemblies (of forces).
"""
import argparse
import pathlib
import statistics
import sys
import tempfile
import time

import getfem as gf
import numpy as np
import scipy.sparse as sp
from scipy.optimize import brentq
from scipy.sparse.linalg import eigsh, splu

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import program  # noqa: E402

SPEED, END, STIFFNESS = 0.1, 6.0, 1000
REFERENCE = {"e": 0.9907, "force": 0.3249}  # by pseudorigid on 203103 to 347691 unknowns, within 1e-4 and 1e-3
BLOCK = (0, 0.528, 0.4533, 0.3752)  # distances of the block's corners from the centre: axes, face and space diagonals
ELASTIC = "((Id(3)+Grad_u) + (0.5*sqr(Det(Id(3)+Grad_u))-1.5)*Inv(Id(3)+Grad_u)') : Grad_Test_u"
CONTACT = f"-{STIFFNESS}*pos_part(-1-X(3)-u(3))*Test_u(3)"
ENERGY = "0.5*(Norm_sqr(Id(3)+Grad_u)-3) + 0.25*(sqr(Det(Id(3)+Grad_u))-1) - 1.5*log(Det(Id(3)+Grad_u))"
CONTACT_ENERGY = f"{STIFFNESS / 2}*sqr(pos_part(-1-X(3)-u(3)))"
SURFACE = 1  # the region that the plane may touch
TOLERANCE = 1e-7  # of the largest change of U in an iteration
SLOW = 0.3  # an iteration that reduces the change by less is with factors that are too old
SCENE = {"Models": "continuum", "Body/Incompressible": "false", "Material/Law": "ciarlet-geymonat", "Material/Lame lambda": 1,
         "Loads/Plane normals": "0, 0, 1", "Loads/Plane points": "0, 0, -1", "Loads/Plane stiffness": STIFFNESS,
         "Initial state/Center velocity": f"0, 0, {-SPEED}", "Time/End": END, "Continuum/Error estimate": "none",
         "Output/Samples": 60}
# (program, method, degree, refinements, grading, part of 2/w, step or Time/Tolerance)
MESHES = ((1, 2, 1), (2, 1, 1), (2, 1, 0.5), (2, 2, 1), (2, 2, 0.5), (2, 2, 0.3), (3, 1, 0.5), (4, 1, 0.5), (4, 1, 0.3))
JOBS = [job for mesh in MESHES for job in (("GetFEM", "central differences", *mesh, 0.8), ("pseudorigid", "auto", *mesh, 1e-3))
        if job[0] != "GetFEM" or mesh[0] < 3]
JOBS.append(("GetFEM", "midpoint", 2, 1, 1, 0.02))


def coarse_cells():
    """[(vertices, first local direction fastest; which of them are on the sphere; small end of each direction or -1)]"""
    bits = [(v & 1, v >> 1 & 1, v >> 2 & 1) for v in range(8)]
    cells = [(np.array([BLOCK[sum(b)] * np.array(b) for b in bits]), np.zeros(8, bool), (0, 0, -1))]
    for axis in range(3):
        vertices = np.zeros((8, 3))
        for vertex, b in zip(vertices, bits):
            vertex[[axis, (axis + 1) % 3, (axis + 2) % 3]] = 1, b[1], b[2]
            vertex *= vertex.sum() ** -0.5 if b[0] else BLOCK[1 + b[1] + b[2]]
        ends = (1, *(-1 if (axis + i) % 3 == 2 else 0 for i in (1, 2)))
        cells.append((vertices, np.array([b[0] == 1 for b in bits]), ends))
    return cells


def position(vertices, on_sphere, xi):
    shape = np.array([np.prod([x if v >> d & 1 else 1 - x for d, x in enumerate(xi.T)], axis=0) for v in range(8)]).T
    X = shape[:, ~on_sphere] @ vertices[~on_sphere]
    s = shape[:, on_sphere].sum(1)
    if (outer := s > 0).any():
        directions = vertices[on_sphere] / np.abs(vertices[on_sphere]).max(1, keepdims=True)
        Y = np.tan(np.pi / 4 * (shape[np.ix_(outer, on_sphere)] @ directions) / s[outer, None])
        X[outer] += s[outer, None] * Y / np.linalg.norm(Y, axis=1, keepdims=True)
    return X


def graded(x, end, grading):
    if end < 0 or grading == 1:
        return x
    b = brentq(lambda b: b / np.expm1(b) - grading, 1e-9, 100)
    return np.expm1(b * x) / np.expm1(b) if end == 0 else 1 - np.expm1(b * (1 - x)) / np.expm1(b)


def quarter(degree, refinements, grading):
    n, nodes = 2**refinements, np.linspace(0, 1, degree + 1)
    mesh, cell = gf.Mesh("empty", 3), gf.GeoTrans(f"GT_QK(3,{degree})")
    for vertices, on_sphere, ends in coarse_cells():
        for place in np.ndindex(n, n, n):
            local = [graded((i + nodes) / n, end, grading) for i, end in zip(place, ends)]
            xi = np.stack(np.meshgrid(*local, indexing="ij"), -1).reshape(-1, 3)
            X = position(vertices, on_sphere, xi).reshape([degree + 1] * 3 + [3])
            X[np.abs(X) < 1e-12] = 0
            mesh.add_convex(cell, X.transpose(2, 1, 0, 3).reshape(-1, 3).T)
            mesh.add_convex(cell, (X * (1, 1, -1)).transpose(2, 0, 1, 3).reshape(-1, 3).T)
    lower = []
    for convex, face in mesh.outer_faces().T:
        X = mesh.pts()[:, mesh.pid_in_faces(np.array([[convex], [face]]))]
        if np.allclose(np.linalg.norm(X, axis=0), 1) and X[2].max() < 1e-9 and X[2].min() < -0.6:  # near the plane
            lower.append((convex, face))
    mesh.set_region(SURFACE, np.array(lower).T)
    return mesh


def scipy_matrix(matrix):
    return sp.csc_matrix((matrix.csc_val(), *matrix.csc_ind()[::-1]), shape=matrix.size())


class Ball:
    """One impact, from the first assembly to the last step."""

    def __init__(self, mesh, degree):
        self.space = gf.MeshFem(mesh, 3)
        self.space.set_fem(gf.Fem(f"FEM_QK(3,{degree})"))
        lobatto = f"IM_GAUSSLOBATTO1D({2 * degree - 1})"
        self.inner = gf.MeshIm(mesh, gf.Integ(f"IM_PRODUCT(IM_PRODUCT({lobatto},{lobatto}),{lobatto})"))
        self.outer = gf.MeshIm(mesh, gf.Integ(f"IM_GAUSS_PARALLELEPIPED(3,{4 * degree + 3})"))
        self.mass = scipy_matrix(gf.asm_mass_matrix(self.inner, self.space)).diagonal()
        X, component = self.space.basic_dof_nodes(), np.arange(len(self.mass)) % 3
        self.free = ~((np.abs(X[0]) < 1e-9) & (component == 0) | (np.abs(X[1]) < 1e-9) & (component == 1))
        self.is_z = component == 2
        self.model = gf.Model("real")
        self.model.add_fem_variable("u", self.space)
        self.model.add_nonlinear_term(self.inner, ELASTIC)
        self.model.add_nonlinear_term(self.outer, CONTACT, SURFACE)
        self.u, self.v = np.zeros(len(self.mass)), np.where(self.is_z, -SPEED, 0.0)
        self.forces, self.past, self.n_assemblies, self.n_factorizations = [], [], 0, 0

    def assembled(self, u, what="build_rhs"):
        self.n_assemblies += what == "build_rhs"
        self.model.set_variable("u", u)
        self.model.assembly(what)
        return np.where(self.free, self.model.rhs(), 0) if what == "build_rhs" else self.model.tangent_matrix()

    def momentum_and_energy(self):
        terms = (self.inner, 0, ENERGY, -1), (self.outer, 0, CONTACT_ENERGY, SURFACE)
        stored = sum(gf.asm_generic(*term, "u", 1, self.space, self.u) for term in terms)
        return self.mass[self.is_z] @ self.v[self.is_z], 0.5 * self.mass @ self.v**2 + stored

    def central_differences(self, part):
        scale = sp.diags(np.where(self.free, self.mass**-0.5, 0))
        K = scale @ scipy_matrix(self.assembled(np.where(self.is_z, -1.0, 0), "build_matrix")) @ scale
        stable = 2 * eigsh(K, 1, which="LA", tol=1e-2, return_eigenvectors=False)[0] ** -0.5
        h = END / (n := int(np.ceil(END / (part * stable))))
        a = self.assembled(self.u) / self.mass
        for _ in range(n):
            middle = self.v + h / 2 * a
            self.u += h * middle
            a = self.assembled(self.u) / self.mass
            self.forces.append(4 * (self.mass * a)[self.is_z].sum())
            self.v = middle + h / 2 * a
        return h

    def factors(self, U, h, by_mumps):
        self.n_factorizations += 1
        inertia = gf.Spmat("diag", 4 / h**2 * self.mass + np.where(self.free, 0, 1e12))
        A = gf.Spmat("add", self.assembled(U, "build_matrix"), inertia)
        if by_mumps:
            return lambda residual: gf.linsolve_mumps(A, residual).ravel()
        return splu(scipy_matrix(A), "MMD_AT_PLUS_A", diag_pivot_thresh=0, options={"SymmetricMode": True}).solve

    def midpoint(self, h, by_mumps=False):
        solve = None
        for _ in range(round(END / h)):
            start = self.u + h / 2 * self.v
            U = start + sum(w * y for w, y in zip(([], [1], [-1, 2], [1, -3, 3])[len(self.past)], self.past))
            before, change, slope = np.inf, np.zeros_like(U), 0
            for _ in range(60):
                f = self.assembled(U)
                residual = np.where(self.free, f - 4 / h**2 * self.mass * (U - start), 0)
                if (now := residual @ change) < -0.5 * slope:  # beyond the least energy along this change
                    part, solve = slope / (slope - now), None
                    U -= (1 - part) * change
                    change, slope = part * change, part * slope
                    continue
                if solve is None or by_mumps:
                    solve, before = self.factors(U, h, by_mumps), np.inf
                change = solve(residual)
                slope, size = residual @ change, np.abs(change).max()
                U += change
                if size < TOLERANCE:
                    break
                solve, before = solve if size < SLOW * before else None, size
            else:
                raise SystemExit(f"error: no convergence with step {h}")
            self.forces.append(4 * f[self.is_z].sum())
            self.past = [*self.past[-2:], U - start]
            self.u, self.v = 2 * U - self.u, 4 / h * (U - self.u) - self.v
        return h


def by_getfem(mesh, degree, method, number):
    start = time.process_time()
    ball = Ball(mesh, degree)
    momentum, energy = ball.momentum_and_energy()
    h = ball.central_differences(number) if method == "central differences" else ball.midpoint(number, "MUMPS" in method)
    last_momentum, last_energy = ball.momentum_and_energy()
    seconds = time.process_time() - start
    touching = np.flatnonzero(np.array(ball.forces) > 1e-6)
    return (len(ball.u), h, seconds, -last_momentum / momentum, max(ball.forces), (touching[-1] - touching[0] + 1) * h,
            last_energy / energy - 1, ball.n_assemblies, ball.n_factorizations)


def by_pseudorigid(executable, degree, refinements, grading, tolerance):
    entries = {"Continuum/Degree": degree, "Continuum/Refinements": refinements, "Continuum/Grading": grading,
               "Time/Tolerance": tolerance, **SCENE}
    with tempfile.TemporaryDirectory() as folder:
        (scene := pathlib.Path(folder) / "scene.prm").touch()
        runs = [(program.run(executable, scene, pathlib.Path(folder) / "out", entries), program.start_up(executable))
                for _ in range(5)]
        table, counters = runs[0][0].table("continuum.csv"), runs[0][0].manifest["models"]["continuum"]["counters"]
    seconds = statistics.median(run.cpu for run, _ in runs) - statistics.median(start_up for _, start_up in runs)
    return (counters["unknowns"], counters["step"], seconds, table["restitution"][-1], table["largest_force"][-1],
            table["last_contact"][-1] - table["first_contact"][-1], table["energy"][-1] / table["energy"][0] - 1,
            counters["forces"] + counters["pilot_forces"], 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--program")
    options = parser.parse_args()
    gf.util_trace_level(0)
    runs = {job: [] for job in (JOBS[:4] if options.quick else JOBS) if job[0] == "GetFEM" or options.program}
    meshes = {job[2:5]: quarter(*job[2:5]) for job in runs if job[0] == "GetFEM"}
    for _ in range(1 if options.quick else 3):
        for (who, method, *mesh, number), done in runs.items():
            if sum(run[2] for run in done) < 10:
                done.append(by_getfem(meshes[tuple(mesh)], mesh[0], method, number) if who == "GetFEM" else
                            by_pseudorigid(options.program, *mesh, number))
    print("program,method,degree,refinements,grading,unknowns,step,seconds,e,error_e,force,error_force,contact_time,drift,"
          "assemblies,factorizations")
    for (who, method, *mesh, number), done in runs.items():
        unknowns, h, _, e, force, contact_time, drift, *counters = done[-1]
        print(who, f'"{method} {number:g}"', *mesh, unknowns, f"{h:.3g}", f"{statistics.median(run[2] for run in done):.3g}",
              f"{e:.5f}", f"{abs(e - REFERENCE['e']):.1e}", f"{force:.4f}", f"{abs(force / REFERENCE['force'] - 1):.1e}",
              f"{contact_time:.3f}", f"{drift:.1e}", *counters, sep=",")


if __name__ == "__main__":
    main()
