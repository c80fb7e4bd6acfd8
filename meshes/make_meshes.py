#!/usr/bin/env python3
"""Writes ellipsoid.msh and rough_ball.msh (Gmsh 2.2, ASCII, 8-node hexahedra) beside this file, or into a folder.

The topology is that of the program's own ball: an octant is a block at the centre and three cells around it, reflected
at the coordinate planes; every cell is divided into n³. Vertices are placed on the unit ball first (rays from the block
to the sphere, equal angles on the sphere) and then moved to the body by a smooth map that sends the sphere to its surface.
"""
import math
import pathlib
import sys

# Distances of the block's corners from the centre along the axes, the face diagonals and the space diagonal.
BLOCK = (0, 0.528, 0.4533, 0.3752)
# Corners of a cell in the order of Gmsh, by their bits (first direction: 1, second: 2, third: 4).
GMSH_ORDER = (0, 1, 3, 2, 4, 5, 7, 6)

SEMI_AXES = (1.3, 1.0, 0.8)


def ellipsoid(X):
    return tuple(a * x for a, x in zip(SEMI_AXES, X))


def bumps(x, y, z):
    """Sum of solid harmonics of degrees 2, 3, 4, at most about 1.3 on the unit sphere, with no symmetry."""
    r2 = x * x + y * y + z * z
    return (0.8 * x * y + 0.5 * (y * y - z * z) / 2 + 1.5 * x * y * z + 0.3 * z * (5 * z * z - 3 * r2) / 2
            + 0.7 * (x**4 - 6 * x * x * y * y + y**4) + 0.6 * x * z * (7 * z * z - 3 * r2) / 2)


def rough_ball(X):
    scale = 1 + 0.05 * bumps(*X)
    return tuple(scale * x for x in X)


def block_corner(bits, on_sphere):
    n = sum(bits)
    length = 1 / math.sqrt(n) if on_sphere else BLOCK[n]
    return tuple(length * b for b in bits)


def octant():
    """Four cells as pairs (corners, which of them are on the sphere)."""
    bits = [(v & 1, v >> 1 & 1, v >> 2 & 1) for v in range(8)]
    cells = [([block_corner(b, False) for b in bits], [False] * 8)]
    for axis in range(3):
        corners = []
        for outer, second, third in bits:
            b = [0, 0, 0]
            b[axis], b[(axis + 1) % 3], b[(axis + 2) % 3] = 1, second, third
            corners.append(block_corner(b, outer))
        cells.append((corners, [b[0] == 1 for b in bits]))
    return cells


def position(cell, xi):
    """The point ξ of a coarse cell of the unit ball, as src/continuum/mesh/ball_mesh.h has it."""
    inside, cube, s = [0, 0, 0], [0, 0, 0], 0
    for v, (corner, on_sphere) in enumerate(zip(*cell)):
        weight = math.prod(xi[d] if v >> d & 1 else 1 - xi[d] for d in range(3))
        if on_sphere:
            s += weight
        for d in range(3):
            if on_sphere:
                cube[d] += weight * corner[d] / max(corner)
            else:
                inside[d] += weight * corner[d]
    if s == 0:
        return inside
    direction = [math.tan(math.pi / 4 * y / s) for y in cube]
    length = math.hypot(*direction)
    return [a + s * b / length for a, b in zip(inside, direction)]


def hexahedra(body, n):
    """Vertices and cells (indices in the order of Gmsh) of the body, every coarse cell divided into n³."""
    numbers, vertices, cells = {}, [], []

    def number(X):
        key = tuple(round(x, 9) + 0.0 for x in X)
        if key not in numbers:
            numbers[key] = len(vertices)
            vertices.append(body(X))
        return numbers[key]

    for mirrored in range(8):
        signs = [-1 if mirrored >> d & 1 else 1 for d in range(3)]
        flip = math.prod(signs) < 0
        for cell in octant():
            grid = {}
            for i in range(n + 1):
                for j in range(n + 1):
                    for k in range(n + 1):
                        X = position(cell, (i / n, j / n, k / n))
                        grid[i, j, k] = number([s * x for s, x in zip(signs, X)])
            for i in range(n):
                for j in range(n):
                    for k in range(n):
                        corners = [grid[i + ((v & 1) ^ flip), j + (v >> 1 & 1), k + (v >> 2 & 1)] for v in GMSH_ORDER]
                        cells.append(corners)
    return vertices, cells


def write(path, vertices, cells):
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(vertices))]
    lines += [f"{i} {x:.12g} {y:.12g} {z:.12g}" for i, (x, y, z) in enumerate(vertices, 1)]
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    lines += [f"{i} 5 2 0 1 " + " ".join(str(v + 1) for v in cell) for i, cell in enumerate(cells, 1)]
    path.write_text("\n".join(lines + ["$EndElements", ""]))


def moments(vertices, cells):
    """Volume, centre of mass and E0 about it for density 1; 3 Gauss points a direction are exact for trilinear cells."""
    gauss = [(0.5 - math.sqrt(0.15), 5 / 18), (0.5, 4 / 9), (0.5 + math.sqrt(0.15), 5 / 18)]
    volume, first, second = 0, [0] * 3, [[0] * 3 for _ in range(3)]
    for cell in cells:
        corners = [vertices[cell[GMSH_ORDER.index(v)]] for v in range(8)]
        for points in ((a, b, c) for a in gauss for b in gauss for c in gauss):
            X, J = [0] * 3, [[0] * 3 for _ in range(3)]
            for v, corner in enumerate(corners):
                N = [p if v >> d & 1 else 1 - p for d, (p, _) in enumerate(points)]
                for r in range(3):
                    X[r] += math.prod(N) * corner[r]
                    for d in range(3):
                        others = math.prod(N[e] for e in range(3) if e != d)
                        J[r][d] += (1 if v >> d & 1 else -1) * others * corner[r]
            dV = math.prod(w for _, w in points) * sum(
                J[0][d] * (J[1][(d + 1) % 3] * J[2][(d + 2) % 3] - J[1][(d + 2) % 3] * J[2][(d + 1) % 3]) for d in range(3))
            volume += dV
            for r in range(3):
                first[r] += dV * X[r]
                for c in range(3):
                    second[r][c] += dV * X[r] * X[c]
    center = [x / volume for x in first]
    return volume, center, [[second[r][c] - volume * center[r] * center[c] for c in range(3)] for r in range(3)]


BODIES = {"ellipsoid": ellipsoid, "rough_ball": rough_ball}


def main(folder):
    for name, body in BODIES.items():
        vertices, cells = hexahedra(body, 2)
        write(folder / f"{name}.msh", vertices, cells)
        volume, center, E0 = moments(vertices, cells)
        print(f"{name}: {len(cells)} cells, volume {volume:.12g}, centre {', '.join(f'{x:.6g}' for x in center)}, E0 "
              + "; ".join(", ".join(f"{x:.12g}" for x in row) for row in E0))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
