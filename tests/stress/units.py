"""The same scenes in other units of length, mass and time: the results, divided by their units, must be the same to 1e-10
of each quantity's largest value. Factors of 1e±12 one at a time and mixed; 1e±60 either the same or refused."""
import json
import math

from program import WRONG_INPUT, faults, largest_difference
from random_scenes import diagonal, text
from system_test import (ANGLES, ARC_FOR_TIME, BODY, DAMPED_POINTS, ELLIPSOID, EULER, FRAME, JACOBI, LAGRANGE, PARABOLOID,
                         PENDULUM, POINTS, SystemTest, TOP, TORUS, UNITS_ON_THE_PARABOLOID, scaled_entries, unit)

SAME = 1e-10
ENERGY = "mass*length^2/time^2"
COLUMNS = {"time": "time", "Qdot": "1/time", "x": "length", "v": "length/time", "J": "mass*length^2/time",
           "Z": "mass*length^2/time", "multiplier": "1/time^2", "a": "length",
           "contact_force": "mass*length/time^2", "largest_force": "mass*length/time^2", "contact_point": "length",
           "contact_radius": "length", "pressure_radius": "length", "penetration": "length", "first_contact": "time", "last_contact": "time",
           **dict.fromkeys(("kinetic", "elastic", "gravitational", "external", "dissipated", "energy", "volumetric",
                            "contact"), ENERGY)}
START = {"Initial state/Deformation": text(diagonal(1.25, 1, 0.8)), "Initial state/Velocity": "0, 0.4, 0; -0.3, 0, 0; 0, 0, 0",
         "Time/End": 2, "Output/Samples": 10}
RELEASE = {"Initial state/Deformation": text(diagonal(1.25, 1, 0.8)),
           "Initial state/Velocity": text(diagonal(0.1, 0.1, -0.144)), "Time/End": 1, "Output/Samples": 10,
           "Continuum/Degree": 2, "Continuum/Error estimate": "none", "Time/Tolerance": 1e-4,
           "Time/Constraint tolerance": 1e-13}
# What a looser tolerance of the constraint leaves depends on round-off.
POLYNOMIAL = {"Models": "polynomial", "Polynomial/Degree": 3, "Time/Constraint tolerance": 1e-13}
LOADS = {"Loads/Tidal matrix": text(diagonal(0.2, 0.1, -0.3)), "Loads/Nominal traction": text(diagonal(0.1, 0, -0.2)),
         "Loads/Acceleration": "0.1, 0.2, -0.1", "Material/Viscosity": 0.02, "Material/Drag": 0.01}
IMPACT = {"Loads/Plane normals": "0, 0, 1", "Loads/Plane points": "0, 0, -1.2", "Loads/Plane damping": 0.5,
          "Initial state/Center velocity": "0.1, 0, -0.5"}
SHAKEN = {**IMPACT, "Loads/Plane friction": 0.3, "Loads/Plane slip speed": 0.05, "Loads/Plane speeds": 0.1,
          "Loads/Plane amplitudes": 0.05, "Loads/Plane frequency": 2, "Time/Step": 0.01, "Time/Method": "rattle"}
SCENES = {
    "reduced": {"Models": "reduced", **START},
    "reduced with gravity": {"Models": "reduced", **START, "Gravity/Constant": 1.5},
    "reduced fluid": {"Models": "reduced", **START, "Gravity/Constant": 1, "Material/Law": "none"},
    "reduced with loads and dissipation": {"Models": "reduced", **START, **LOADS},
    "reduced, compressible": {"Models": "reduced", **START, "Body/Incompressible": "false", "Material/Lame lambda": 2.5},
    "reduced on a plane": {"Models": "reduced", **START, **IMPACT},
    "reduced on a rough plane in motion": {"Models": "reduced", **START, **SHAKEN},
    "polynomial": {**POLYNOMIAL, **START},
    "polynomial with gravity": {**POLYNOMIAL, **START, "Gravity/Constant": 1.5},
    "polynomial with loads and dissipation": {**POLYNOMIAL, **RELEASE, **LOADS},
    "polynomial, compressible": {**POLYNOMIAL, **START, "Body/Incompressible": "false"},
    "both models": {"Models": "reduced, continuum", **RELEASE},
    "both models with gravity": {"Models": "reduced, continuum", **RELEASE, "Gravity/Constant": 1.5},
    "both models, a fluid": {"Models": "reduced, continuum", **RELEASE, "Gravity/Constant": 1, "Material/Law": "none"},
    "both models, loads and dissipation": {"Models": "reduced, continuum", **RELEASE, **LOADS},
    "both models on a plane": {"Models": "reduced, continuum", **RELEASE, **IMPACT},
    "both models, compressible": {"Models": "reduced, continuum", **RELEASE, "Body/Incompressible": "false"},
    "both models, nearly incompressible": {"Models": "reduced, continuum", **RELEASE, "Body/Incompressible": "false",
                                           "Material/Lame lambda": 1e4, "Material/Bulk": "projected"},
}
SYSTEMS = {
    "mass points": (POINTS, {}, 3), "mass points, damped": (DAMPED_POINTS, {}, 3), "double pendulum": (PENDULUM, {}, 2),
    "double pendulum in angles": ({**PENDULUM, **LAGRANGE}, {}, 2), "top": (TOP, {}, 2), "free body": (BODY, {}, 2),
    "free body by Euler's equation": ({**BODY, **EULER}, {}, 2), "top in Euler angles": ({**TOP, **ANGLES}, {}, 2),
    "moving frame": (FRAME, {}, 2), "torus": (TORUS, {}, 2),
    "ellipsoid": (ELLIPSOID, {}, 2), "paraboloid": (PARABOLOID, UNITS_ON_THE_PARABOLOID, 2),
    "Jacobi's metric": (JACOBI, ARC_FOR_TIME, 2),
}
BIG, SMALL = 1e12, 1e-12
SINGLE = [(BIG, 1, 1), (SMALL, 1, 1), (1, BIG, 1), (1, SMALL, 1), (1, 1, BIG), (1, 1, SMALL)]
MIXED = [(BIG, BIG, BIG), (SMALL, SMALL, SMALL), (BIG, SMALL, BIG), (SMALL, BIG, SMALL), (SMALL, BIG, BIG), (6.4e6, 6e24, 805.0)]
# The unit of time of a geodesic of Jacobi's metric has the fourth power of the speed, so that speeds of 1e±24 are refused.
LARGEST_SPEED = {"Jacobi's metric": 1e17}
EXTREME = [(1e60, 1, 1), (1e-60, 1, 1), (1, 1e60, 1), (1, 1, 1e-60)]


def scales_of(length, mass, time):
    scales = {"length": length, "mass": mass, "time": time}
    scales["pressure"] = unit("mass/length/time^2", scales)
    return scales


def tables(run, scales):
    """Of all models, divided by their units."""
    result = {}
    for path in run.files(".csv"):
        if path.stem == "comparison":
            continue
        table = run.table(path.stem)
        factors = [unit(COLUMNS.get(name.rstrip("123"), ""), scales) for name in table.header]
        table.rows = [[x / factor for x, factor in zip(row, factors)] for row in table.rows]
        result[path.stem] = table
    return result


def ball(program, documented, quick):
    for name, entries in SCENES.items():
        if quick and name not in ("reduced with loads and dissipation", "both models, loads and dissipation"):
            continue
        # Everything that has a unit is written out, those values too that the scene leaves at their defaults.
        whole = {"Body/Radius": 1, "Body/Density": 1, "Material/Shear modulus": 1, "Material/Lame lambda": 1, **entries}
        reference = program.run(whole, limit=60)
        expected = tables(reference, scales_of(1, 1, 1))
        for factors in SINGLE[:4:3] + MIXED[2:3] if quick else SINGLE + MIXED + EXTREME:
            scales = scales_of(*factors)
            run = program.run(scaled_entries(whole, scales, documented), limit=60)
            record = {"kind": name, "length": factors[0], "mass": factors[1], "time": factors[2], "code": run.code,
                      "seconds": round(run.seconds, 2), "difference": ""}
            found = faults(run)
            if run.code == 0 and not found:
                got = tables(run, scales)
                record["difference"] = max(largest_difference(expected[model], got[model]) for model in expected)
                if not record["difference"] < SAME:
                    found.append(f"the results differ by {record['difference']:.1e}")
            elif not (run.code == WRONG_INPUT and factors in EXTREME):
                found.append(f"exit code {run.code}: {run.stderr.strip()[-200:]}")
            record["faults"] = "; ".join(found)
            yield record


def systems(quick):
    test = SystemTest()
    for name, (entries, units, n_points) in SYSTEMS.items():
        if quick and name != "mass points, damped":
            continue
        test.setUp()
        try:
            all_factors = SINGLE[:4:3] if quick else SINGLE + MIXED
            largest = LARGEST_SPEED.get(name, math.inf)
            all_factors = [f for f in all_factors if 1 / largest < f[0] / f[2] < largest]
            for factors, difference in test.differences_in_units(entries, all_factors, units, n_points, 1e-11):
                record = {"kind": name, "length": factors[0], "mass": factors[1], "time": factors[2], "code": 0,
                          "difference": difference, "faults": ""}
                if not difference < SAME:
                    record["faults"] = f"the results differ by {difference:.1e}"
                yield record
        except AssertionError as error:
            yield {"kind": name, "code": "", "faults": str(error)}
        finally:
            test.doCleanups()


def run(program, quick, with_continuum=True, **_):
    page = program.call("parameters", "--format", "json", folder=program.scratch).stdout
    documented = {entry["entry"]: entry["unit"] for entry in json.loads(page)}
    if not with_continuum:
        for name in [name for name in SCENES if name.startswith("both")]:
            del SCENES[name]
    return [*ball(program, documented, quick), *systems(quick)]
