"""The results of a run of pseudorigid, for Python: tables with their units, the comparison, pictures.

    from run_directory import Run
    run = Run("output/quickstart")
    run.models                        ['reduced', 'continuum']
    run.table("reduced")              a pandas table, a row a sample, the time as index
    run.columns("reduced")            the same as arrays by name, without pandas
    run.matrices("reduced", "Q")      Q at every sample, of shape (samples, 3, 3)
    run.unit("reduced", "J1")         'mass*length^2/time'
    run.dimensionless("reduced")      the table in the scene's own units r, rho r^3 and t
    run.comparison                    comparison.json, None of one model
    run.entry("Body/Radius")          what an entry was
    run.frames("continuum")           the pictures: [Frame(time, path)]
    run.frames("continuum")[-1].read().fields["cauchy_stress"]      of shape (points, 3, 3)

Needs numpy; tables need pandas (Debian: python3-pandas), pictures meshio (python3-meshio). docs/python.md shows it at work.
"""

import csv
import dataclasses
import json
import pathlib
import sys
import xml.etree.ElementTree


def fail(message):
    """The user can mend it: one sentence, exit code 2, as pseudorigid does."""
    print(f"error: {message}", file=sys.stderr)
    raise SystemExit(2)


def missing(error, packages):
    """Likewise where `import` has failed, as with another Python than Debian's."""
    fail(f"{error}; this tool needs Debian's {packages}, and to run with /usr/bin/python3")


try:
    import numpy as np
except ImportError as failure:
    missing(failure, "python3-numpy")


def existing(directory, name, remedy):
    path = pathlib.Path(directory) / name
    if not path.is_file():
        fail(f"{path} does not exist; {remedy}")
    return path


def read_csv(path):
    """Columns by name, as arrays."""
    with open(path, newline="") as file:
        rows = csv.reader(file)
        names = next(rows, [])
        values = [[float(text) for text in row] for row in rows]
    if not values:
        fail(f"{path} holds no samples")
    return dict(zip(names, np.array(values).T))


def read_pvd(path):
    """[(time, path of the .vtu, or of the .pvtu of several ranks)] in the order of time."""
    sets = xml.etree.ElementTree.parse(path).getroot().iter("DataSet")
    return [(float(s.get("timestep")), path.parent / s.get("file")) for s in sets]


def pieces(path):
    """The .vtu files of a picture: itself, or those that the .pvtu of several ranks lists."""
    if path.suffix != ".pvtu":
        return [path]
    listed = xml.etree.ElementTree.parse(path).getroot().iter("Piece")
    return [path.parent / piece.get("Source") for piece in listed]


def read_grid(path):
    """VTK's grid of a .vtu or .pvtu. Needs Debian's python3-vtk9."""
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

    parallel = pathlib.Path(path).suffix == ".pvtu"
    reader = vtkXMLPUnstructuredGridReader() if parallel else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


@dataclasses.dataclass
class Picture:
    """A .vtu file, or all pieces of a .pvtu: `points` (n, 3) at their current positions, `cells` as meshio has them, and by name `fields`, with n values,
    vectors or matrices, and `constants` of the whole body (TimeValue, center_of_mass, rotation)."""

    points: np.ndarray
    cells: list
    fields: dict
    constants: dict


@dataclasses.dataclass
class Frame:
    time: float
    path: pathlib.Path

    def read(self):
        """The Picture. Needs meshio."""
        import meshio

        meshes = [meshio.read(path) for path in pieces(self.path)]
        as_matrices = lambda values: values.reshape(-1, 3, 3) if values.ndim == 2 and values.shape[1] == 9 else values
        joined = lambda name: np.concatenate([mesh.point_data[name] for mesh in meshes])
        fields = {name: as_matrices(joined(name)) for name in meshes[0].point_data}
        constants = {name: as_matrices(values)[0] for name, values in meshes[0].field_data.items()}
        starts = np.cumsum([0] + [len(mesh.points) for mesh in meshes])
        cells = [meshio.CellBlock(block.type, block.data + start)
                 for mesh, start in zip(meshes, starts) for block in mesh.cells]
        return Picture(np.concatenate([mesh.points for mesh in meshes]), cells, fields, constants)


class Run:
    """The directory of a run. What is missing ends the program with one sentence, as in pseudorigid itself."""

    def __init__(self, directory):
        self.directory = pathlib.Path(directory)
        self.manifest = json.loads(existing(directory, "manifest.json", "is this the directory of a run?").read_text())

    @property
    def models(self):
        """The models of the ball that have run, or the one system, by the names of their files."""
        names = [model["name"] for model in self.manifest.get("ball", [])] or [self.manifest.get("system", "")]
        return [name for name in names if (self.directory / f"{name}.csv").is_file()]

    def title(self, model):
        """As the ball of a model is called: 'Elastic ball'."""
        adjectives = {ball["name"]: ball["adjective"] for ball in self.manifest.get("ball", [])}
        return f"{adjectives[model].capitalize()} ball" if model in adjectives else model.replace("_", " ").capitalize()

    def has_elements(self, model):
        return any(ball["name"] == model and ball["discretized"] for ball in self.manifest.get("ball", []))

    def entry(self, path):
        """The text of an entry as the run had it: entry("Body/Radius")."""
        values = self.manifest.get("entries", {})
        if path not in values:
            fail(f"{self.directory}/manifest.json has no value of {path}; run the scene again")
        return values[path]

    def counter(self, model, name):
        """What a model has counted: counter("continuum", "steps")."""
        return self.manifest["models"][model]["counters"][name]

    @property
    def comparison(self):
        path = self.directory / "comparison.json"
        return json.loads(path.read_text()) if path.is_file() else None

    def columns(self, name):
        """The columns of <name>.csv as arrays."""
        return read_csv(existing(self.directory, f"{name}.csv", "run the scene with another list of Models?"))

    def table(self, name):
        """<name>.csv as a pandas table, the time as index where it has one."""
        import pandas

        table = pandas.DataFrame(self.columns(name))
        return table.set_index("time") if "time" in table else table

    def matrices(self, model, letter):
        """A matrix column, such as Q, Qdot or F, of shape (samples, 3, 3)."""
        columns = self.columns(model)
        names = [f"{letter}{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
        missing = [name for name in names if name not in columns]
        if missing:
            fail(f"{model}.csv has no column {missing[0]}; run the scene with Output/Quantities = all")
        return np.stack([columns[name] for name in names], axis=1).reshape(-1, 3, 3)

    def described(self, name):
        """{column: {'unit', 'meaning', of the ball 'factor'}} of <name>.csv, as the manifest has it."""
        return {column["name"]: column for column in self.manifest.get("columns", {}).get(f"{name}.csv", [])}

    def unit(self, name, column):
        """The dimension of a column, in words; '' of a pure number."""
        return "time" if column == "time" else self.described(name).get(column, {}).get("unit", "")

    def dimensionless(self, name):
        """The table divided by the scene's own units: lengths r, masses rho r^3, times r/c (with self-gravity another)."""
        table = self.table(name)
        factors = {column: what["factor"] for column, what in self.described(name).items() if "factor" in what}
        if not factors:
            fail(f"{self.directory}/manifest.json does not say the units of {name}.csv; run the scene again")
        table = table.div([factors.get(column, 1) for column in table.columns], axis=1)
        table.index = table.index / self.manifest["unit_of_time"]
        return table

    def has_frames(self, model):
        return (self.directory / f"{model}.pvd").is_file()

    def frames(self, model):
        path = existing(self.directory, f"{model}.pvd", 'run the scene with --set "Output/Graphics=vtu"')
        return [Frame(time, file) for time, file in read_pvd(path)]
