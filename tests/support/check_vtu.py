#!/usr/bin/python3
"""Reads VTU files with meshio and with VTK, prints what they hold as JSON, and fails where the two disagree.

Sample runs:
    check_vtu.py output/stretch/graphics/*.vtu
    check_vtu.py --expect-fields displacement,pressure file.vtu
"""
import argparse
import json
import sys

import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

MESHIO_NAMES = {"triangle": 5, "quad": 9, "hexahedron": 12, "VTK_LAGRANGE_HEXAHEDRON": 72}
LAGRANGE = 72


class Disagreement(Exception):
    pass


def require(condition, complaint):
    if not condition:
        raise Disagreement(complaint)


def read_vtk(path):
    errors = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("VTK's reader reports an error"))
    reader.SetFileName(path)
    reader.Update()
    require(not errors, "; ".join(errors))
    return reader.GetOutput()


def cells_of_vtk(grid):
    """[(type, node numbers)] in the order of the file."""
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    return [(grid.GetCellType(i), connectivity[offsets[i]:offsets[i + 1]]) for i in range(grid.GetNumberOfCells())]


def cells_of_meshio(mesh):
    return [(MESHIO_NAMES[block.type], nodes) for block in mesh.cells for nodes in block.data]


def turned_round(nodes):
    """Of a Lagrange hexahedron VTK numbers two edges the other way round than files of version 1.0 do, and meshio does
    not."""
    n = round(len(nodes) ** (1 / 3)) - 2  # points inside an edge
    edge = 8 + 10 * n
    return np.concatenate((nodes[:edge], nodes[edge + n:edge + 2 * n], nodes[edge:edge + n], nodes[edge + 2 * n:]))


def compare_cells(of_meshio, of_vtk):
    require(len(of_meshio) == len(of_vtk), f"{len(of_meshio)} cells in meshio, {len(of_vtk)} in VTK")
    for i, ((type_a, nodes_a), (type_b, nodes_b)) in enumerate(zip(of_meshio, of_vtk)):
        require(type_a == type_b, f"cell {i} has type {type_a} in meshio, {type_b} in VTK")
        require(np.array_equal(turned_round(nodes_a) if type_a == LAGRANGE else nodes_a, nodes_b), f"cell {i} has other nodes in meshio and in VTK")


def compare_fields(mesh, grid):
    data = grid.GetPointData()
    of_vtk = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    require(set(of_vtk) == set(mesh.point_data), f"fields {sorted(mesh.point_data)} in meshio, {sorted(of_vtk)} in VTK")
    for name, values in mesh.point_data.items():
        require(values.dtype == np.float64, f"{name} is not Float64")
        require(np.array_equal(values, of_vtk[name]), f"{name} differs between meshio and VTK")
        require(np.isfinite(values).all(), f"{name} is not finite")


def compare_constants(mesh, grid):
    data = grid.GetFieldData()
    of_vtk = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    require(set(of_vtk) == set(mesh.field_data),
            f"constants {sorted(mesh.field_data)} in meshio, {sorted(of_vtk)} in VTK")
    for name, values in mesh.field_data.items():
        require(np.array_equal(values, of_vtk[name]), f"{name} differs between meshio and VTK")


def check_places_in_cells(grid):
    """If a file says where in its cell each node belongs, VTK's shape functions must think so too."""
    field = grid.GetPointData().GetArray("place_in_cell")
    if field is None:
        return
    reference = vtk_to_numpy(field)
    for i in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(i)
        nodes = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
        of_vtk = np.array(vtk_parametric(cell))
        require(np.allclose(of_vtk, reference[nodes], atol=1e-12), f"the nodes of cell {i} stand in another order in VTK")


def vtk_parametric(cell):
    """Where VTK's own inverse map finds each node of the cell."""
    coordinates, sub_id, distance, weights = [0.0] * 3, vtk.reference(0), vtk.reference(0.0), [0.0] * cell.GetNumberOfPoints()
    closest, result = [0.0] * 3, []
    for k in range(cell.GetNumberOfPoints()):
        cell.EvaluatePosition(cell.GetPoints().GetPoint(k), closest, sub_id, coordinates, distance, weights)
        result.append(tuple(coordinates))
    return result


def check(path, expected_fields):
    mesh, grid = meshio.read(path), read_vtk(path)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    require(points.dtype == np.float64, "points are not Float64")
    require(np.array_equal(mesh.points, points), "points differ between meshio and VTK")
    cells = cells_of_meshio(mesh)
    compare_cells(cells, cells_of_vtk(grid))
    compare_fields(mesh, grid)
    compare_constants(mesh, grid)
    check_places_in_cells(grid)
    missing = set(expected_fields) - set(mesh.point_data)
    require(not missing, f"fields {sorted(missing)} are missing")
    return {
        "file": path,
        "points": len(points),
        "cells": len(cells),
        "cell_types": sorted({type_ for type_, _ in cells}),
        "fields": {name: list(values.shape[1:]) or [1] for name, values in sorted(mesh.point_data.items())},
        "constants": {name: np.ravel(values).tolist() for name, values in sorted(mesh.field_data.items())},
        "bounds": [points.min(axis=0).tolist(), points.max(axis=0).tolist()],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+")
    parser.add_argument("--expect-fields", default="", help="names separated by commas")
    arguments = parser.parse_args()
    expected_fields = [name for name in arguments.expect_fields.split(",") if name]
    n_bad = 0
    for path in arguments.files:
        try:
            print(json.dumps(check(path, expected_fields)))
        except (Disagreement, meshio.ReadError, SystemExit) as error:
            print(f"{path}: {error}", file=sys.stderr)
            n_bad += 1
    return 1 if n_bad else 0


if __name__ == "__main__":
    sys.exit(main())
