"""The pictures of a run, as .vtu files and as .pvtu files of several ranks."""

import contextlib
import dataclasses
import pathlib
import xml.etree.ElementTree
from collections.abc import Iterator
from typing import Any

from pseudorigid.errors import WrongInput, needs

with needs("python3-numpy"):
    import numpy as np


def parsed(path: pathlib.Path) -> xml.etree.ElementTree.Element:
    try:
        return xml.etree.ElementTree.parse(path).getroot()
    except (OSError, xml.etree.ElementTree.ParseError) as error:
        raise WrongInput(f"{path} is missing or damaged; run the scene again") from error


def read_pvd(path: pathlib.Path) -> list[tuple[float, pathlib.Path]]:
    """(time, path of the .vtu, or of the .pvtu of several ranks) in the order of time."""
    sets = parsed(path).iter("DataSet")
    return [(float(s.get("timestep", 0)), path.parent / s.get("file", "")) for s in sets]


def pieces(path: pathlib.Path) -> list[pathlib.Path]:
    """The .vtu files of a picture: itself, or those that the .pvtu of several ranks lists."""
    if path.suffix != ".pvtu":
        return [path]
    listed = parsed(path).iter("Piece")
    return [path.parent / piece.get("Source", "") for piece in listed]


def existing(path: pathlib.Path) -> pathlib.Path:
    if not pathlib.Path(path).is_file():
        raise WrongInput(f"{path} does not exist")
    return path


@contextlib.contextmanager
def without_words_of_vtk() -> Iterator[None]:
    """VTK prints several lines about a file that it cannot read or write; the caller says it in one sentence."""
    from vtkmodules.vtkCommonCore import vtkObject

    before = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()
    try:
        yield
    finally:
        vtkObject.SetGlobalWarningDisplay(before)


def read_grid(path: pathlib.Path) -> Any:
    """VTK's grid of a .vtu or .pvtu. Needs Debian's python3-vtk9."""
    with needs("python3-vtk9"):
        from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

    parallel = pathlib.Path(path).suffix == ".pvtu"
    reader = vtkXMLPUnstructuredGridReader() if parallel else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(existing(path)))
    with without_words_of_vtk():
        reader.Update()
    return reader.GetOutput()


def as_matrices(values: np.ndarray) -> np.ndarray:
    return values.reshape(-1, 3, 3) if values.ndim == 2 and values.shape[1] == 9 else values


@dataclasses.dataclass
class Picture:
    """A .vtu file, or all pieces of a .pvtu."""

    points: np.ndarray  #: (n, 3), at their current positions
    cells: list[Any]  #: as meshio has them
    fields: dict[str, np.ndarray]  #: by name n values, vectors or matrices
    constants: dict[str, np.ndarray]  #: of the whole body: TimeValue, center_of_mass, rotation


@dataclasses.dataclass
class Frame:
    """One time of a .pvd file; of modes the frequency is the time."""

    time: float
    path: pathlib.Path

    def read(self) -> Picture:
        """Its points, cells and fields. Needs meshio."""
        with needs("python3-meshio"):
            import meshio

        meshes = [meshio.read(existing(path)) for path in pieces(self.path)]
        fields = {name: as_matrices(np.concatenate([mesh.point_data[name] for mesh in meshes])) for name in meshes[0].point_data}
        constants = {name: as_matrices(values)[0] for name, values in meshes[0].field_data.items()}
        starts = np.cumsum([0] + [len(mesh.points) for mesh in meshes])
        cells = [meshio.CellBlock(block.type, block.data + start)
                 for mesh, start in zip(meshes, starts) for block in mesh.cells]
        return Picture(np.concatenate([mesh.points for mesh in meshes]), cells, fields, constants)
