#!/usr/bin/python3
"""Compares the ball on rigid planes with Hertz's theory and with the loss by its modes (docs/contact.md).

    benchmarks/contact.py build/release/bin/pseudorigid [--quick] [--only hertz|impact] > contact.csv

hertz: the ball is pressed between two planes of stiffness k and brought to rest by a drag, for depths d/r, by finite
elements: columns d, degree, grading, k, F over (16/3) mu sqrt(r) d^(3/2), and over d the depths for this force by Hertz, with the
correction for the finite sphere, with finite strains in addition, and with the depth of the plane in addition (hertz.py). Then,
over Hertz's values for this force, the radius by the area, the radius by the pressure, and the largest pressure. The last two
columns are the radius by the pressure and the largest pressure of a half-space on a plane of stiffness k, also over Hertz's.

impact: the ball hits a plane with the speed v, by the pseudo-rigid ball, polynomial bodies and finite elements: columns
model, degree, refinements, grading, k, v/c, e, (1 - e^2) c/v, the same by the sum over modes, T c/r, T by Hertz,
F_max/(rho v^2 r^2), the same by Hertz, unknowns, seconds, T and F_max/(rho v^2 r^2) of the corrected law. Two more
columns have (1 - e^2) c/v of vibrating_impact.py with modes of degree up to 4, and up to 6, or nan for fast impacts. For small v, with the
frequencies w and the squared displacements p of the pole of the spheroidal modes (sphere_modes.py), the sum is

    1 - e^2 = 5.72958 (v/c) sum p (1 + sin(w T))/w^5,   T = 2.922 (v/c)^(-1/5) r/c.

A plane is too stiff for a mesh if the nodes of the surface swing on it (docs/contact.md). The force then oscillates, and the
loss depends on the mesh. So every speed has several meshes and stiffnesses. The differences between meshes are an error bar.
"""
import argparse
import math
import pathlib
import sys
import tempfile
import time

import hertz
import program
import vibrating_impact
from sphere_modes import spheroidal_modes

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "tests/support"))
from program_test import scene_text  # noqa: E402

MODES = spheroidal_modes(20, 30)
COARSE = {"Continuum/Degree": 4, "Continuum/Refinements": 1, "Continuum/Grading": 0.3, "Continuum/Error estimate": "none"}
FINE = {"Continuum/Degree": 4, "Continuum/Refinements": 1, "Continuum/Grading": 0.15, "Continuum/Error estimate": "none"}
FINEST = {**FINE, "Continuum/Degree": 5, "Continuum/Grading": 0.1}
STEEPER = {**FINEST, "Continuum/Grading": 0.07}
REFINED = {**FINE, "Continuum/Refinements": 2, "Continuum/Grading": 0.3}
# Depth, degree, grading and stiffness.
PRESSES = ((0.04, 4, 0.3, 1000), *((0.02, degree, 0.2, 1000) for degree in (3, 4, 5, 6)), (0.02, 5, 0.2, 150),
           *((0.01, degree, 0.1, 2000) for degree in (3, 4, 5, 6)), *((0.01, degree, 0.1, 300) for degree in (3, 4, 5, 6)))
# Neighbours differ in the mesh or in the stiffness.
STUDY = ((COARSE, 100), (FINE, 100), (FINE, 300), (FINEST, 300), (FINEST, 1000), (STEEPER, 1000))


def hertz_time(v):
    return 2.922 * v**-0.2


def loss_by_modes(v):
    return 5.72958 * sum(p * (1 + math.sin(w * hertz_time(v))) / w**5 for _, w, p in MODES)


def press(run, depth, degree, grading, k):
    axis = 1 - depth
    side = axis**-0.5
    table = run({**FINE, "Continuum/Degree": degree, "Continuum/Grading": grading, "Models": "continuum",
                 "Loads/Plane normals": "0, 0, 1; 0, 0, -1", "Loads/Plane points": f"0, 0, {-axis!r}; 0, 0, {axis!r}",
                 "Loads/Plane stiffness": k, "Material/Drag": 3,
                 "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, {axis!r}", "Time/End": 6,
                 "Time/Method": "rattle", "Time/Step": 0.098 * grading / degree**2,  # 0.8 of the stable step
                 "Output/Samples": 12}).table("continuum.csv")
    force = table["contact_force"][-1]
    both = hertz.TWO_PLANES - hertz.finite_strains()
    depths = hertz.depth(force), hertz.depth(force, hertz.TWO_PLANES), hertz.depth(force, both), hertz.depth(force, both, k)
    radius = hertz.radius(force)
    pressure = 3 * force / (2 * math.pi * radius**2)
    soft_pressure, soft_radius = hertz.soft_plane(force, k)
    return (depth, degree, grading, k, force / (16 / 3 * depth**1.5), *(d / depth for d in depths),
            table["contact_radius"][-1] / radius, table["pressure_radius"][-1] / radius, k * table["penetration"][-1] / pressure,
            soft_radius, soft_pressure)


def impact(run, model, v, entries):
    start = time.perf_counter()
    result = run({**entries, "Models": model, "Loads/Plane normals": "0, 0, 1", "Loads/Plane points": "0, 0, -1.001",
                  "Initial state/Center velocity": f"0, 0, {-v!r}", "Time/End": 0.001 / v + hertz_time(v) + 1,
                  "Time/Tolerance": 1e-2 * v**1.5, "Output/Samples": 400})
    seconds = time.perf_counter() - start
    table = result.table(f"{model}.csv")
    e = table["restitution"][-1]
    duration = table["last_contact"][-1] - table["first_contact"][-1]
    k = entries.get("Loads/Plane stiffness", 1000)
    corrected_force, corrected_duration = hertz.impact(v, k)
    unknowns = result.manifest["models"][model]["counters"].get("unknowns", 12)
    return (entries.get("Continuum/Degree", entries.get("Polynomial/Degree", 1)), entries.get("Continuum/Refinements", 0),
            entries.get("Continuum/Grading", 1), k, v, e, (1 - e * e) / v,
            loss_by_modes(v), duration, hertz_time(v), table["largest_force"][-1] / v**2, 5.2747 * v**-0.8, unknowns, seconds, corrected_duration,
            corrected_force / v**2, *(vibrating_impact.impact(v, k, n).loss / v for n in (4, 6)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", choices=("hertz", "impact"))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.prm"
        scene.write_text(scene_text({}))

        def run(entries):
            return program.run(options.program, scene, pathlib.Path(folder) / "out", entries)

        def show(*values):
            print(*(value if isinstance(value, str) else f"{value:.6g}" for value in values), sep=",", flush=True)

        if options.only != "impact":
            show("depth", "degree", "grading", "stiffness", "force_ratio", "depth_hertz", "depth_sphere", "depth_strains",
                 "depth_plane", "radius_ratio", "pressure_radius_ratio", "pressure_ratio", "pressure_radius_theory",
                 "pressure_theory")
            for case in PRESSES[:1] if options.quick else PRESSES:
                show(*press(run, *case))
        if options.only != "hertz":
            show("model", "degree", "refinements", "grading", "stiffness", "v", "e", "loss", "loss_by_modes", "duration",
                 "duration_hertz", "force", "force_hertz", "unknowns", "seconds", "duration_sphere", "force_sphere",
                 "loss_4", "loss_6")
            for v in (0.1,) if options.quick else (2, 1, 0.5, 0.2, 0.1, 0.05, 0.03, 0.02, 0.01, 0.007, 0.005, 0.003, 0.002):
                show("reduced", *impact(run, "reduced", v, {}))
                for degree in (3, 5, 7):
                    show("polynomial", *impact(run, "polynomial", v, {"Polynomial/Degree": degree}))
                for mesh, k in ((FINE, 300),) if options.quick else (*STUDY, *((REFINED, 1000),) * (v == 0.03)):
                    show("continuum", *impact(run, "continuum", v, {**mesh, "Loads/Plane stiffness": k}))


if __name__ == "__main__":
    main()
