#!/usr/bin/python3
"""Impact of an incompressible ball on a rigid plane from v = 0.01 c to 2 c: the curves of docs/contact.md.

    benchmarks/impact_curve.py build/release/bin/pseudorigid [--speeds 0.1 0.2] > docs/data/impacts.csv

Rows have the model, degree, refinements and grading, the stiffness k, v/c, and a word: done or failed. For an impact that is
done, they have e, the time of contact T c/r, F/(rho v^2 r^2) with the largest force F, the largest depth and pressure radius
over r, and the energy of vibration after the impact and its parts of degree 2 ... 8, over the energy of the ball. The columns
*_hertz are Hertz's theory, and the columns *_sphere its law for a finite sphere on a plane of the stiffness k (hertz.py). The
radius of this law is the pressure radius of a half-space on such a plane. The first row of a speed is in the picture.

The depth is that of the plane below the undeformed surface, measured from the centre of mass. A slow impact needs a mesh that
resolves a small contact. A fast one needs large cells and a
volumetric stiffness, because small cells at the pole are turned inside out.
"""
import argparse
import pathlib
import tempfile

import hertz
import program

SPEEDS = 0.01, 0.02, 0.03, 0.05, 0.1, 0.2, 0.5, 1, 1.5, 2
PARTS = range(2, 9)
NAMES = ("model", "degree", "refinements", "grading", "stiffness", "volumetric", "v", "outcome", "e", "duration", "force", "depth", "radius", "vibration",
         *(f"vibration_{n}" for n in PARTS), "duration_hertz", "force_hertz", "depth_hertz", "radius_hertz", "duration_sphere",
         "force_sphere", "depth_sphere", "radius_sphere")


def meshes(v):
    """(degree, refinements, grading, stiffness, volumetric stiffness) of the finite elements."""
    if v <= 0.01:
        return (5, 1, 0.1, 1000, 0), (5, 1, 0.1, 300, 0), (5, 1, 0.07, 1000, 0)
    if v <= 0.1:
        return ((4, 1, 0.15, 300, 0),)
    if v <= 0.2:
        return (4, 1, 0.3, 100, 0), (3, 1, 0.5, 100, 0)
    if v <= 0.5:
        return (3, 1, 0.5, 30, 0), (3, 0, 1, 30, 0)
    if v <= 1.5:
        return (3, 0, 1, 30, 10), (3, 1, 1, 30, 10)
    return (3, 0, 1, 30, 10), (3, 1, 1, 30, 10), (3, 0, 1, 30, 30), (4, 0, 1, 30, 30)


def cases(v):
    for mesh in meshes(v):
        degree, refinements, grading, k, kappa = mesh
        yield "continuum", mesh, {"Continuum/Degree": degree, "Continuum/Refinements": refinements, "Continuum/Grading": grading,
                                  "Continuum/Volumetric stiffness": kappa, "Continuum/Error estimate": "none", "Loads/Plane stiffness": k}
    k = meshes(v)[0][3]
    for degree in 3, 5, 7:
        yield "polynomial", (degree, 0, 1, k, ""), {"Polynomial/Degree": degree, "Loads/Plane stiffness": k}
    yield "reduced", (1, 0, 1, k, ""), {"Loads/Plane stiffness": k}


def theory(v, k):
    of_half_space = 2.922 * v**-0.2, 5.2747 * v**-0.8, 0.9927 * v**0.8, 0.9963 * v**0.4
    if v > 0.2:  # the first correction is for small contacts
        return *of_half_space, *[""] * 4
    force, duration = hertz.impact(v, k)
    depth = hertz.depth(force, hertz.ONE_PLANE - hertz.finite_strains(), k)
    return *of_half_space, duration, force / v**2, depth, hertz.soft_plane(force, k)[1] * hertz.radius(force)


def impact(run, model, v, entries):
    gap, end = 0.001, 2.922 * v**-0.2
    try:
        table = run({**entries, "Models": model, "Loads/Plane normals": "0, 0, 1", "Loads/Plane points": f"0, 0, {-1 - gap}",
                     "Initial state/Center velocity": f"0, 0, {-v!r}", "Time/End": gap / v + end + (1 if v < 0.3 else 4),
                     "Time/Tolerance": 1e-2 * min(v, 0.3) ** 1.5, "Output/Samples": 400,
                     "Output/Quantities": "state, energies, vibration"}).table(f"{model}.csv")
    except SystemExit:
        return ("failed",) + ("",) * (6 + len(PARTS))
    last = {name: column[-1] for name, column in table.items()}
    parts = [last[name] / table["energy"][0] for name in ("vibration", *(f"vibration_{n}" for n in PARTS))]
    return ("done", last["restitution"], last["last_contact"] - last["first_contact"], last["largest_force"] / v**2,
            -min(table["x3"]) - gap, max(table["pressure_radius"]), *parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--speeds", type=float, nargs="+", default=SPEEDS)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.prm"
        scene.write_text("")
        print(*NAMES, sep=",", flush=True)
        for v in options.speeds:
            for model, mesh, entries in cases(v):
                def run(changes):
                    return program.run(options.program, scene, pathlib.Path(folder) / "out", changes)
                row = model, *mesh, v, *impact(run, model, v, entries), *theory(v, mesh[3])
                print(*(value if isinstance(value, str) else f"{value:.6g}" for value in row), sep=",", flush=True)


if __name__ == "__main__":
    main()
