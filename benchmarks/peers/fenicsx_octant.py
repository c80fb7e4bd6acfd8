"""The octant of the unit ball for FEniCSx: the four cells and the map of src/continuum/mesh/ball_mesh.h, with geometry of any
degree. The scripts of this folder know nothing else of pseudorigid."""
import basix
import dolfinx
import numpy as np
import ufl
from mpi4py import MPI
from scipy.spatial import cKDTree

BLOCK = (0, 0.528, 0.4533, 0.3752)  # distances of the block's corners from the centre: axes, face and space diagonals


def corner(bits, on_sphere):
    n = sum(bits)
    return np.array(bits) * (1 / np.sqrt(n) if on_sphere else BLOCK[n])


def coarse_cells():
    """[(vertices, first local direction fastest; which of them are on the sphere)]"""
    bits = [(v & 1, v >> 1 & 1, v >> 2 & 1) for v in range(8)]
    cells = [(np.array([corner(b, False) for b in bits]), np.zeros(8, bool))]
    for axis in range(3):
        outward = np.eye(3, dtype=int)[axis]
        vertices = []
        for b in bits:
            place = outward.copy()
            place[(axis + 1) % 3], place[(axis + 2) % 3] = b[1], b[2]
            vertices.append(corner(tuple(place), bool(b[0])))
        cells.append((np.array(vertices), np.array([bool(b[0]) for b in bits])))
    return cells


def position(cell, xi):
    """X(ξ) for the rows of xi: transfinite, with equiangular coordinates of the sphere."""
    vertices, on_sphere = cell
    shape = np.ones((len(xi), 8))
    for v in range(8):
        for d in range(3):
            shape[:, v] *= xi[:, d] if v >> d & 1 else 1 - xi[:, d]
    X = shape[:, ~on_sphere] @ vertices[~on_sphere]
    s = shape[:, on_sphere].sum(1)
    outer = s > 0
    if outer.any():
        directions = vertices[on_sphere] / np.abs(vertices[on_sphere]).max(1, keepdims=True)
        y = shape[np.ix_(outer, on_sphere)] @ directions / s[outer, None]
        Y = np.tan(np.pi / 4 * y)
        X[outer] += s[outer, None] * Y / np.linalg.norm(Y, axis=1, keepdims=True)
    return X


def octant(degree, n_refinements, comm=MPI.COMM_SELF):
    """The mesh of a communicator. The first rank gives all cells, and dolfinx distributes them."""
    # The interpolant of the map at Gauss–Lobatto points, by its values at equidistant ones, which FFCx takes for geometry.
    gauss_lobatto, equidistant = (basix.create_element(basix.ElementFamily.P, basix.CellType.hexahedron, degree, variant)
                                  for variant in (basix.LagrangeVariant.gll_warped, basix.LagrangeVariant.equispaced))
    interpolate = gauss_lobatto.tabulate(0, equidistant.points)[0, :, :, 0]
    n = 2**n_refinements
    points = []
    for cell in coarse_cells():
        for i in range(n**3):
            offset = np.array([i % n, i // n % n, i // n**2])
            points.append(interpolate @ position(cell, (offset + gauss_lobatto.points) / n))
    # Cells share nodes, whose positions differ by round-off. Of a node that is given twice dolfinx reads beyond its memory.
    points = np.concatenate(points)
    points[np.abs(points) < 1e-12] = 0
    first = [min(near) for near in cKDTree(points).query_ball_point(points, 1e-8)]
    nodes, cells = np.unique(first, return_inverse=True)
    m = degree * n
    assert len(nodes) == (m + 1) ** 3 + 3 * m**2 * (m + 1) + m  # the block, what lies outside of it, the diagonal
    element = ufl.VectorElement("Lagrange", "hexahedron", degree)
    given = slice(None) if comm.rank == 0 else slice(0)
    return dolfinx.mesh.create_mesh(comm, cells.reshape(4 * n**3, -1)[given], points[nodes][given], ufl.Mesh(element),
                                    dolfinx.mesh.GhostMode.none)
