"""The base of the end-to-end tests of the systems beside the ball: runs, documented columns, units."""
import itertools
import json
import re
import tempfile

from program_test import ProgramTest, SOURCE, largest_difference, overrides

# The scenes of params/ and the file of each.
SCENES = {
    "three_bodies": "mass_points", "double_pendulum": "double_pendulum", "heavy_top": "rigid_body",
    "free_body": "rigid_body", "foucault": "moving_frame", "torus": "torus", "geodesic": "geodesic",
    "jacobi_kepler": "jacobi_geodesic", "spherical_pendulum": "spherical_pendulum", "rotor": "fixed_axis",
    "t_handle": "rigid_body",
}

# Scenes in which every force acts.
PENDULUM = {
    "System": "double pendulum", "Double pendulum/First mass": 1.5, "Double pendulum/Second mass": 0.7,
    "Double pendulum/First length": 1.2, "Double pendulum/Second length": 0.9, "Double pendulum/Gravity": 9.81,
    "Double pendulum/Angles": "0.5, 0.3", "Double pendulum/Rates": "0.1, -0.2", "Time/End": 10, "Output/Samples": 50,
}
POINTS = {
    "System": "mass points", "Mass points/Masses": "1, 2, 0.5",
    "Mass points/Positions": "1, 0, 0; -0.7, 0.3, 0.1; 0.2, 1.3, -0.4",
    "Mass points/Velocities": "0, 0.9, 0.3; 0, -0.6, 0.5; -0.9, 0, -0.3", "Mass points/Gravitational constant": 0.2,
    "Mass points/Springs": "1, 2, 3, 1.6; 2, 3, 1, 0; 1, 3, 1, 1.5", "Mass points/Field": "0, 0.1, -0.3",
    "Mass points/Center": "0.1, 0, 0.2", "Mass points/Confinement": 0.5, "Mass points/Central attraction": 0.1,
    "Time/End": 5, "Output/Samples": 50,
}
DAMPED_POINTS = {**POINTS, "Mass points/Dashpots": "1, 3, 0.1", "Mass points/Drag": 0.02}
TOP = {
    "System": "rigid body", "Rigid body/Mass": 2, "Rigid body/Center": "0.1, 0, 0.2",
    "Rigid body/Inertia": "1, 0.1, 0; 0.1, 1.2, 0.05; 0, 0.05, 0.9", "Rigid body/Gravity": "0, 0.5, -2",
    "Rigid body/Springs": "0.3, 0, 0.1, 1, 0.2, 0, 0.8, 0.2", "Rigid body/Rotation": "0.8, -0.6, 0; 0.6, 0.8, 0; 0, 0, 1",
    "Rigid body/Angular velocity": "0.3, 1, 2", "Time/End": 5, "Output/Samples": 50,
}
BODY = {
    **TOP, "Rigid body/Fixed point": "false", "Rigid body/Center": "0, 0, 0", "Rigid body/Springs": "",
    "Rigid body/Position": "1, 2, -1", "Rigid body/Velocity": "0.3, -0.2, 0.5",
}
BODY_OF_POINTS = {
    **{path: value for path, value in BODY.items() if path not in ("Rigid body/Mass", "Rigid body/Inertia", "Rigid body/Center")},
    "Rigid body/Points": "0.5, 0.1, 0, 0.7; -0.3, 0.8, 0.2, 0.4; 0, -0.6, 0.3, 0.5; 0.1, 0, 0.9, 0.4",
    "Rigid body/Springs": "0.3, 0, 0.1, 1, 0.2, 0, 0.8, 0.2",
}
SPHERICAL_PENDULUM = {
    "System": "spherical pendulum", "Spherical pendulum/Mass": 1.5, "Spherical pendulum/Length": 1.2,
    "Spherical pendulum/Gravity": 9.81, "Spherical pendulum/Drag": 0.1, "Spherical pendulum/Angles": "1, 0.4",
    "Spherical pendulum/Rates": "0.3, 1", "Time/End": 5, "Output/Samples": 50,
}
ROTOR = {
    "System": "fixed axis", "Fixed axis/Mass": 2, "Fixed axis/Center": "0.1, 0, 0.2",
    "Fixed axis/Inertia": "1, 0.1, 0; 0.1, 1.2, 0.05; 0, 0.05, 0.9", "Fixed axis/Weights": "0.3, 0.2, 0.1, 0.4; 0, -0.5, 0.6, 0.1",
    "Fixed axis/Axis": "0.3, -0.2, 1", "Fixed axis/Bearings": "-0.4, 0.7", "Fixed axis/Gravity": "0, 0.5, -2",
    "Fixed axis/Friction": 0.05, "Fixed axis/Angle": 0.3, "Fixed axis/Rate": 3, "Time/End": 5, "Output/Samples": 50,
}
FRAME = {
    "System": "moving frame", "Moving frame/Position": "1, 0.2, -0.3", "Moving frame/Velocity": "0.1, 0.4, 0",
    "Moving frame/Orientation": "0.3, -0.4, 0.5", "Moving frame/Spin axis": "0.2, 0.3, 1", "Moving frame/Spin rate": 0.7,
    "Moving frame/Spin acceleration": 0.1, "Moving frame/Precession": "0.1, 0.2, -0.3", "Moving frame/Origin": "0.3, 0, 0",
    "Moving frame/Origin velocity": "0, 0.1, 0", "Moving frame/Origin acceleration": "0.01, 0, -0.02",
    "Moving frame/Shaking": "0, 0.1, 0.1", "Moving frame/Shaking frequency": 2, "Moving frame/Field": "0, 0, -0.1",
    "Moving frame/Stiffness": 0.5, "Moving frame/Attraction": 0.3, "Moving frame/Centre": "-1, -1, 0.5",
    "Moving frame/Frame field": "0.05, 0, 0", "Moving frame/Frame stiffness": "1, 2, 1.5",
    "Moving frame/Frame centre": "0.1, 0, 0.1", "Time/End": 5, "Output/Samples": 50,
}
TORUS = {
    "System": "torus", "Torus/Radius": 2.5, "Torus/Tube radius": 0.8, "Torus/Gravity": 1.3, "Torus/Damping": 0.2,
    "Torus/Damping variation": "0.05, -0.08", "Torus/Grain": 0.3, "Torus/Grain angle": 0.6, "Torus/Tilt": 0.1,
    "Torus/Angles": "0.5, 0.7", "Torus/Rates": "0.4, -0.3", "Time/End": 10, "Output/Samples": 50,
}
ELLIPSOID = {
    "System": "geodesic", "Geodesic/Surface": "ellipsoid", "Geodesic/Semi-axes": "1.2, 1, 0.7", "Geodesic/Point": "1.1, 0.3",
    "Geodesic/Velocity": "0.3, 0.8", "Time/End": 10, "Output/Samples": 50,
}
PARABOLOID = {
    **ELLIPSOID, "Geodesic/Surface": "paraboloid", "Geodesic/Curvature": 1.5, "Geodesic/Point": "0.6, -0.2",
}
JACOBI = {
    "System": "jacobi geodesic", "Jacobi geodesic/Potential": "harmonic", "Jacobi geodesic/Stiffness": 1.7,
    "Jacobi geodesic/Energy": 2, "Jacobi geodesic/Position": "0.8, 0.1", "Jacobi geodesic/Direction": "0.3, 1",
    "Time/End": 10, "Output/Samples": 50,
}
JACOBI_TORUS = {
    **JACOBI, "Jacobi geodesic/Potential": "torus", "Jacobi geodesic/Radius": 3, "Jacobi geodesic/Tube radius": 0.8,
    "Jacobi geodesic/Gravity": 1.2, "Jacobi geodesic/Energy": 6, "Jacobi geodesic/Position": "0.5, 0.2",
}
JACOBI_PENDULUM = {
    **JACOBI, "Jacobi geodesic/Potential": "double pendulum", "Jacobi geodesic/Radius": 1.1, "Jacobi geodesic/Second mass": 0.7,
    "Jacobi geodesic/Second length": 0.9, "Jacobi geodesic/Gravity": 9.81, "Jacobi geodesic/Energy": 60,
    "Jacobi geodesic/Position": "0.5, 0.3",
}

# The second form of each.
LAGRANGE = {"Double pendulum/Form": "lagrange"}
EULER = {"Rigid body/Form": "euler"}
ANGLES = {"Rigid body/Form": "lagrange", "Rigid body/Rotation": "0.8, -0.36, 0.48; 0.6, 0.48, -0.64; 0, 0.8, 0.6"}
INERTIAL = {"Moving frame/Form": "inertial"}

ROTATION = [f"R{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]

# Entries and columns whose unit is not in the column of units: rows of several quantities, coordinates that are lengths on
# one surface, and the arc that takes the place of time.
UNITS_OF_ROWS = {
    "Mass points/Springs": ("", "", "mass/time^2", "length"), "Mass points/Dashpots": ("", "", "mass/time"),
    "Rigid body/Springs": 6 * ("length",) + ("mass/time^2", "length"),
    "Rigid body/Points": ("length", "length", "length", "mass"), "Fixed axis/Weights": ("length", "length", "length", "mass"),
}
UNITS_ON_THE_PARABOLOID = {
    "Geodesic/Point": "length", "Geodesic/Velocity": "length/time", "q1": "length", "q2": "length",
    "q1_dot": "length/time", "q2_dot": "length/time",
}
ARC_FOR_TIME = {"Time/End": "length^2/time", "time": "length^2/time"}


def unit(dimension, scales):
    """Of a quantity: unit("mass*length/time^2", {"length": 2, "mass": 3, "time": 1}) → 6."""
    value = 1.0
    dimension = re.sub(r"/\(([^)]*)\)", lambda group: "/" + group[1].replace("*", "/"), dimension)  # a/(b*c) is a/b/c
    for before, word, power in re.findall(r"(^|[*/])(\w+)(?:\^(\d))?", dimension):
        value *= scales.get(word, 1) ** ((-1 if before == "/" else 1) * int(power or 1))
    return value


def scaled_entries(entries, scales, documented, units={}):
    """The same scene where the units of length, mass and time are 1/scales; `documented`: the unit of every entry, `units`:
    those that depend on the scene."""
    scaled = {}
    for path, value in entries.items():
        value = str(value)
        of_columns = UNITS_OF_ROWS.get(path, (units.get(path, documented[path]),))
        factors = [unit(dimension, scales) for dimension in of_columns]
        if value not in ("", "auto") and any(of_columns):
            rows = [zip(row.split(","), itertools.cycle(factors)) for row in value.split(";")]
            value = "; ".join(", ".join(repr(float(x) * factor) for x, factor in row) for row in rows)
        scaled[path] = value
    return scaled


def drift(table, *columns):
    """Largest distance of a column from its first value."""
    return max(abs(x - table.column(name)[0]) for name in columns for x in table.column(name))


def distance(a, b, columns=None):
    """Largest difference of two tables in these columns, or in all."""
    return max(abs(x - y) for name in columns or a.header for x, y in zip(a.column(name), b.column(name), strict=True))


class SystemTest(ProgramTest):
    def motion(self, scene, changes={}):
        """The table that a run writes: of the scene of params/ with this name, or of entries. Its folder: table.folder."""
        path = SOURCE / "params" / f"{scene}.prm" if isinstance(scene, str) else self.scene(scene)
        folder = tempfile.mkdtemp(dir=self.scratch)
        self.run_done("run", path, "--quiet", "--output", folder, *overrides(changes))
        (file,) = [name for name in self.files(folder) if name.endswith(".csv")]
        table = self.table(folder, file)
        table.folder, table.file = folder, file.removesuffix(".csv")
        return table

    def documented_columns(self, file, n_points=2, of=""):
        """[(column, unit)] by the page of parameters, with its rule for n points."""
        page = self.run_done("parameters").stdout
        section = re.search(rf"^## Columns of {file}\.csv{of}\n(.*?)(?=^## |\Z)", page, re.M | re.S)[1]
        columns = [("time", "time")] + re.findall(r"^\| `(\w+)` \| (\S*) +\|", section, re.M)
        if file != "mass_points":
            return columns
        points = [(f"{letter}{i}", quantity) for prefix, quantity in (("", "length"), ("v", "length/time"))
                  for i in range(1, n_points + 1) for letter in (prefix + "x", prefix + "y", prefix + "z")]
        return columns[:1] + points + columns[1 + 2 * 2 * 3:]

    # Units.

    def used_entries(self, folder):
        """{path: value} of all entries of a run, those with their default value too."""
        return self.json(folder, "manifest.json")["entries"]

    def scaled_entries(self, entries, scales, units):
        page = json.loads(self.run_done("parameters", "--format", "json").stdout)
        return scaled_entries(entries, scales, {entry["entry"]: entry["unit"] for entry in page}, units)

    def in_units_of(self, scales, table, units, n_points):
        """The table divided by its units."""
        factors = [unit(units.get(name, dimension), scales)
                   for name, dimension in self.documented_columns(table.file, n_points) if name in table.header]
        table.rows = [[x / factor for x, factor in zip(row, factors, strict=True)] for row in table.rows]
        return table

    def differences_in_units(self, scene, all_factors, units, n_points, tolerance):
        """For each (length, mass, time) of factors: how far the scene in these units is from the scene itself."""
        reference = self.motion(scene, {"Time/Tolerance": tolerance})
        entries = self.used_entries(reference.folder)
        del entries["Output/Directory"]
        for factors in all_factors:
            scales = dict(zip(("length", "mass", "time"), factors))
            scaled = self.motion(self.scaled_entries(entries, scales, units))
            yield factors, largest_difference(reference, self.in_units_of(scales, scaled, units, n_points))
