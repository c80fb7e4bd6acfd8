"""The directory of a run: tables with their units, the comparison, pictures."""

import csv
import json
import math
import os
import pathlib
from typing import TYPE_CHECKING, Any

from pseudorigid.errors import WrongInput, needs
from pseudorigid.frames import Frame, read_pvd

with needs("python3-numpy"):
    import numpy as np

if TYPE_CHECKING:
    import pandas

# Columns that number the rows of a table; of other tables it is the time.
INDICES = {"sweep": ["run"], "connections": ["curve"], "trajectories": ["run", "time"], "manifolds": ["curve", "time"]}
OF_ALL_TABLES = {"time": "time", "frequency": "1/time"}  # units that the manifest need not say
# The same of the end of a column, in a sweep of several models.
OF_COMPARED = {"_time": "time", "_frequency": "1/time", "_frequency_error": "1/time", "_tenth_of_period_after": "time"}
# Ends of columns in which a sweep of several models has 0 or -1 for a value that does not exist.
MISSING_AS_ZERO = ("_frequency_ratio", "_frequency")
MISSING_AS_MINUS_ONE = ("_error", "_tenth_of_period_after", "_phase_after_1_period", "_phase_after_10_periods", "_phase_difference_max",
                        "_energy_drift", "surface_limit_time")
# Ends of columns of a model that exist only if its run is compared.
OF_A_COMPARED_RUN = ("_second_line", "_amplitude")
# What the columns of a sweep add to the name of a column.
OF_A_RUN = ("_end", "_min", "_max", "_drift")


def printed_error(error: float) -> str:
    """An error to one digit, rounded up as the program does it, so that the printed number is a bound as well."""
    if not error > 0:
        return "0"
    place = 10 ** math.floor(math.log10(error))
    round_off = 1e-9
    return f"{math.ceil(error / place * (1 - round_off)) * place:.1g}"


def existing(directory: str | os.PathLike[str], name: str, remedy: str) -> pathlib.Path:
    path = pathlib.Path(directory) / name
    if not path.is_file():
        raise WrongInput(f"{path} does not exist; {remedy}")
    return path


def read_csv(path: pathlib.Path) -> dict[str, np.ndarray]:
    """Columns by name."""
    with open(path, newline="") as file:
        rows = csv.reader(file)
        names = next(rows, [])
        try:
            values = np.array([[float(text) for text in row] for row in rows])
        except ValueError as error:
            raise WrongInput(f"{path} has a damaged row; run the scene again") from error
    if not len(values):
        raise WrongInput(f"{path} holds no samples")
    return dict(zip(names, values.T))


def read_json(path: pathlib.Path) -> dict[str, Any]:
    try:
        return json.loads(path.read_text()) if path.is_file() else {}
    except ValueError as error:
        raise WrongInput(f"{path} is damaged; run the scene again") from error


class Run:
    """The directory of a run. What is missing is a WrongInput."""

    def __init__(self, directory: str | os.PathLike[str]):
        self.directory = pathlib.Path(directory)
        self.manifest: dict[str, Any] = read_json(existing(directory, "manifest.json", "is this the directory of a run?"))

    def __repr__(self) -> str:
        return f"Run({str(self.directory)!r})"

    @property
    def models(self) -> list[str]:
        """The models of the ball that have run, or the one system, by the names of their files."""
        names = [model["name"] for model in self.manifest.get("ball", [])] or [self.manifest.get("system", "")]
        if (self.directory / "sweep.csv").is_file():
            return names
        last = ["modes.csv"] if names else []  # of the last model of modes

        def files(name: str) -> list[str]:
            own = [f"{stem}{name}.csv" for stem in ("", "modes-", "love-", "equilibria-")]
            figures = ["equilibria.csv"] if name == "reduced" or "ball" not in self.manifest else []
            return own + figures + (last if name == names[-1] else [])
        return [name for name in names if any((self.directory / file).is_file() for file in files(name))]

    def title(self, model: str) -> str:
        """As the ball of a model is called: 'Elastic ball'."""
        adjectives = {ball["name"]: ball["adjective"] for ball in self.manifest.get("ball", [])}
        return f"{adjectives[model].capitalize()} ball" if model in adjectives else model.replace("_", " ").capitalize()

    def has_elements(self, model: str) -> bool:
        return any(ball["name"] == model and ball["discretized"] for ball in self.manifest.get("ball", []))

    def entry(self, path: str) -> str:
        """The text of an entry as the run had it: entry("Body/Radius")."""
        values = self.manifest.get("entries", {})
        if path not in values:
            same_name = [known for known in values if known.split("/")[-1] == path.split("/")[-1]]
            advice = f"did you mean {' or '.join(same_name)}?" if same_name else "run the scene again"
            raise WrongInput(f"{self.directory}/manifest.json has no value of {path}; {advice}")
        return values[path]

    def counter(self, model: str, name: str) -> float:
        """A counter of a model: counter("continuum", "steps")."""
        counters = self.manifest.get("models", {}).get(model, {}).get("counters", {})
        if name not in counters:
            raise WrongInput(f"{self.directory}/manifest.json has no counter {name} of {model}; it has {', '.join(counters) or 'none'}")
        return counters[name]

    @property
    def comparison(self) -> dict[str, Any] | None:
        """comparison.json; None if one model has run."""
        return read_json(self.directory / "comparison.json") or None

    def comparison_of(self, model: str) -> dict[str, Any]:
        """Of a model with the richest one, if more than two have run."""
        return read_json(existing(self.directory, f"comparison-{model}.json", "it is written if more than two models run"))

    def columns(self, name: str) -> dict[str, np.ndarray]:
        """The columns of <name>.csv by name."""
        tables = ", ".join(sorted(path.stem for path in self.directory.glob("*.csv")))
        return read_csv(existing(self.directory, f"{name}.csv", f"the tables of this run are {tables}" if tables else "this run has no tables"))

    def records(self, name: str) -> np.ndarray:
        """<name>.csv as a structured array, a record a row: the table without pandas."""
        columns = self.columns(name)
        return np.rec.fromarrays(list(columns.values()), names=list(columns))

    def table(self, name: str) -> "pandas.DataFrame":
        """<name>.csv as a pandas table. Its index is the time, of a sweep the number of the run; attrs["units"] has the units."""
        with needs("python3-pandas"):
            import pandas

        table = pandas.DataFrame(self.columns(name))
        table.attrs["units"] = self.units(name, table.columns)
        index = [column for column in INDICES.get(name, ["time"]) if column in table]
        for column in set(index) - {"time"}:
            table[column] = table[column].astype(int)
        return table.set_index(index[0] if len(index) == 1 else index) if index else table

    def sweep(self) -> "pandas.DataFrame | np.ndarray":
        """The runs of a sweep, as table("sweep") or, without pandas, as records("sweep").

        A sweep of several models writes 0 for a ratio or a frequency that does not exist, -1 for an error, a phase or a time
        that is not known, and 0 for all results of a comparison in a run that is not compared. Here they are nan.
        """
        try:
            table = self.table("sweep")
        except WrongInput as error:
            if not isinstance(error.__cause__, ImportError):
                raise
            table = self.records("sweep")
        names = list(table) if hasattr(table, "columns") else list(table.dtype.names)
        if "compared" in names:
            not_compared = table["compared"] == 0
            first = next(i for i, name in enumerate(names) if name.endswith("_frequency_ratio"))
            for i, name in enumerate(names):
                if i >= first or name.endswith(OF_A_COMPARED_RUN):
                    table[name] = np.where(not_compared, np.nan, table[name])
                if name.endswith(MISSING_AS_ZERO):
                    table[name] = np.where(table[name] == 0, np.nan, table[name])
                elif name.endswith(MISSING_AS_MINUS_ONE):
                    table[name] = np.where(table[name] == -1, np.nan, table[name])
        return table

    def matrices(self, model: str, letter: str) -> np.ndarray:
        """A matrix column, such as Q, Qdot or F, of shape (samples, 3, 3)."""
        columns = self.columns(model)
        names = [f"{letter}{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
        absent = [name for name in names if name not in columns]
        if absent:
            raise WrongInput(f"{model}.csv has no column {absent[0]}; run the scene with Output/Quantities = all")
        return np.stack([columns[name] for name in names], axis=1).reshape(-1, 3, 3)

    def described(self, name: str) -> dict[str, dict[str, Any]]:
        """{column: {'unit', 'meaning', of the ball 'factor'}} of <name>.csv, as the manifest has it."""
        return {column["name"]: column for column in self.manifest.get("columns", {}).get(f"{name}.csv", [])}

    def units(self, name: str, columns: Any = None) -> dict[str, str]:
        """The dimension of each column of <name>.csv, in words; '' of a pure number and of what the manifest does not describe."""
        described = self.described(name)
        if name in ("sweep", "trajectories"):  # columns of the system, or of the model that varies
            described = {column: about for file in self.manifest.get("columns", {}) for column, about in
                         self.described(file.removesuffix(".csv")).items()}

        def unit(column: str) -> str:
            for end, dimension in OF_COMPARED.items():
                if name == "sweep" and column.endswith(end):
                    return dimension
            of_motion = next((column.removesuffix(end) for end in OF_A_RUN if column.endswith(end)), column)
            return OF_ALL_TABLES.get(column) or described.get(column, described.get(of_motion, {})).get("unit", "")

        return {column: unit(column) for column in (self.columns(name) if columns is None else columns)}

    def unit(self, name: str, column: str) -> str:
        return self.units(name, [column])[column]

    def dimensionless(self, name: str) -> "pandas.DataFrame":
        """The table divided by the scene's own units: lengths r, masses rho r^3, times r/c (with self-gravity another)."""
        table = self.table(name)
        factors = {column: what["factor"] for column, what in self.described(name).items() if "factor" in what}
        if not factors:
            raise WrongInput(f"{self.directory}/manifest.json does not say the units of {name}.csv; run the scene again")
        table = table.div([factors.get(column, 1) for column in table.columns], axis=1)
        if table.index.name == "time":
            table.index = table.index / self.manifest["unit_of_time"]
        table.attrs["units"] = dict.fromkeys(table.columns, "")
        return table

    def has_frames(self, model: str) -> bool:
        return (self.directory / f"{model}.pvd").is_file()

    def frames(self, model: str) -> list[Frame]:
        """The pictures of a model in the order of time; frames("modes") those of modes."""
        path = existing(self.directory, f"{model}.pvd", 'run the scene with --set "Output/Graphics=vtu"')
        return [Frame(time, file) for time, file in read_pvd(path)]
