"""Random scenes of the ball and of the other systems: laws, states, loads, units, steps, methods, degrees, sectors,
models, ranks. Every scene follows from the seed of the part and its number."""
import math
import random
import shutil

from program import (DONE, STOPPED, faults, faults_of_resume, found_nothing, methods, reason_without_numbers,
                     words)
from random_loads import put_branches, put_companions, put_planes

LONGEST = {True: 15, False: 60}  # seconds of a run, in the short form and otherwise


# Matrices as lists of rows.

def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def determinant(a):
    return sum(a[0][i] * (a[1][(i + 1) % 3] * a[2][(i + 2) % 3] - a[1][(i + 2) % 3] * a[2][(i + 1) % 3]) for i in range(3))


def scaled(factor, a):
    return [[factor * x for x in row] for row in a]


def diagonal(*entries):
    return [[x if i == j else 0 for j in range(3)] for i, x in enumerate(entries)]


def text(a):
    return "; ".join(", ".join(repr(float(x)) for x in row) for row in a)


def rotation(rng):
    w, x, y, z = (rng.gauss(0, 1) for _ in range(4))
    n = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def irregular(rng, size, symmetric=False):
    a = [[rng.uniform(-size, size) for _ in range(3)] for _ in range(3)]
    return [[(a[i][j] + a[j][i]) / 2 for j in range(3)] for i in range(3)] if symmetric else a


def initial_state(rng, rate, incompressible, diagonal_only):
    """Deformation and velocity; stretches are seldom large, since much fails there."""
    spread = rng.choice((0.02, 0.2, 0.2, 0.5, 1.0))
    logs = [rng.gauss(0, spread) for _ in range(3)]
    if rng.random() < 0.3:
        logs[1] = logs[0]  # two equal axes
    if incompressible:
        logs = [x - sum(logs) / 3 for x in logs]
    turn = (lambda: diagonal(1, 1, 1)) if diagonal_only else (lambda: rotation(rng))
    Q = product(product(turn(), diagonal(*map(math.exp, logs))), turn())
    if incompressible:
        Q = scaled(determinant(Q) ** (-1 / 3), Q)
    L = irregular(rng, rate * rng.choice((0.01, 0.3, 0.3, 1.0, 3.0)))
    if diagonal_only:
        L = diagonal(*(L[i][i] for i in range(3)))
    if incompressible:
        mean = sum(L[i][i] for i in range(3)) / 3
        for i in range(3):
            L[i][i] -= mean
    return Q, product(Q, L)


def ball(rng, with_continuum):
    """Entries of a scene of the ball, its models by chance; and the number of ranks."""
    models = rng.choices(("reduced", "continuum", "reduced, continuum"), (9, 5, 6))[0] if with_continuum else "reduced"
    reduced_only = models == "reduced"
    radius, density, modulus = (10 ** rng.uniform(-6, 6) if rng.random() < 0.3 else 1.0 for _ in range(3))
    rate = math.sqrt(modulus / density) / radius
    incompressible = rng.random() < 0.7
    symmetric = rng.random() < (0.3 if reduced_only else 0.6)
    Q, Qdot = initial_state(rng, rate, incompressible, symmetric)
    law = rng.choice([law for law in words("Material/Law") if law != "none"])
    end = rng.uniform(0.3, 30) if reduced_only else rng.uniform(0.1, 2.5)
    entries = {"Models": models, "Body/Radius": repr(radius), "Body/Density": repr(density),
               "Body/Incompressible": str(incompressible).lower(), "Material/Law": law,
               "Material/Shear modulus": repr(modulus), "Material/Lame lambda": repr(modulus * 10 ** rng.uniform(-1, 1)),
               "Material/Mooney fraction": repr(rng.random()), "Material/Gent limit": repr(10 ** rng.uniform(-1, 2)),
               "Initial state/Deformation": text(Q), "Initial state/Velocity": text(Qdot), "Time/End": repr(end / rate),
               "Output/Samples": rng.randint(2, 30)}
    if rng.random() < 0.2:
        entries["Material/Viscosity"] = repr(modulus / rate * 10 ** rng.uniform(-3, 0))
    if rng.random() < 0.2:
        put_branches(rng, entries, rate, modulus)
    if rng.random() < 0.15:
        entries["Material/Drag"] = repr(rate * 10 ** rng.uniform(-3, 0))
    if rng.random() < 0.2:
        entries["Loads/Tidal matrix"] = text(irregular(rng, rate**2, symmetric=True) if not symmetric else
                                             scaled(rate**2, diagonal(*(rng.uniform(-1, 1) for _ in range(3)))))
    if rng.random() < 0.15:
        entries["Loads/Acceleration"] = ", ".join(repr(radius * rate**2 * rng.uniform(-1, 1)) for _ in range(3))
    if rng.random() < 0.15:
        entries["Loads/Nominal traction"] = text(irregular(rng, modulus * 0.5))
    if reduced_only:
        if rng.random() < 0.3:
            entries["Gravity/Constant"] = repr(rate**2 / density * 10 ** rng.uniform(-2, 1))
            if rng.random() < 0.3:
                entries["Material/Law"] = "none"
        if rng.random() < 0.2:
            entries["Body/Semi-axes"] = ", ".join(repr(math.exp(rng.gauss(0, 0.4))) for _ in range(3))
        if rng.random() < 0.3:
            entries["Output/Quantities"] = rng.choice(("all, bipolar", "all, pressure", "state", "energies, momenta"))
    else:
        entries["Continuum/Degree"] = rng.choices((1, 2, 3, 4, 5), (1, 8, 6, 3, 1))[0]
        if entries["Continuum/Degree"] == 2 and rng.random() < 0.1:
            entries["Continuum/Refinements"] = 1
        entries["Continuum/Symmetry"] = rng.choices(("auto", "none", "octant", "z", "xy"), (10, 2, 2, 1, 1))[0]
        entries["Continuum/Error estimate"] = rng.choice(("auto", "none", "none"))
        if incompressible and rng.random() < 0.3:
            entries["Gravity/Constant"] = repr(rate**2 / density * 10 ** rng.uniform(-2, 1))
            if rng.random() < 0.2 and not {"Material/Viscosity", "Loads/Nominal traction"} & entries.keys():
                entries["Material/Law"] = "none"
        if not incompressible and not law.startswith("saint-venant") and rng.random() < 0.4:
            entries["Material/Bulk"] = rng.choice(("pointwise", "projected"))
            entries["Material/Lame lambda"] = repr(modulus * 10 ** rng.uniform(2, 5))
            entries["Continuum/Degree"] = max(2, entries["Continuum/Degree"])
        if incompressible and rng.random() < 0.15:
            entries["Continuum/Volumetric stiffness"] = repr(modulus * 10 ** rng.uniform(-2, 1))
    if rng.random() < 0.15:
        entries.update({"Output/Graphics": "vtu", "Output/Frames": 2})
    if incompressible and "Gravity/Constant" not in entries and rng.random() < 0.15:
        entries["Output/Quantities"] = "energies, momenta, vibration"
    if rng.random() < 0.2:
        entries["Output/Quantities"] = entries.get("Output/Quantities", "all") + ", stresses"
    planes = rng.random() < 0.15
    if planes:
        put_planes(rng, entries, radius, rate, modulus, Q)
    if reduced_only and not planes and rng.random() < 0.15:
        look_for_equilibria(rng, entries, rate)
    elif rng.random() < 0.3:
        bend(rng, entries)
    if incompressible and rng.random() < 0.12:
        start_from_a_figure(rng, entries, rate)
    choose_method(rng, entries, 1 / rate, reduced_only)
    if "Material/Branch moduli" in entries and "Time/Tolerance" in entries:  # RATTLE has order 2: less takes minutes
        entries["Time/Tolerance"] = repr(max(float(entries["Time/Tolerance"]), 1e-6))
    ranks = 2 if not reduced_only and rng.random() < 0.15 and shutil.which("mpirun") else 1
    if rng.random() < 0.06:
        stay_at_rest(rng, entries, rate**2 / density, with_continuum)
    if "Gravity/Constant" in entries and "Analysis" not in entries and not planes and rng.random() < 0.5:
        put_companions(rng, entries, radius, rate, density)
    return entries, ranks


def start_from_a_figure(rng, entries, rate):
    """A spinning figure of each model in place of the initial state, some with a small motion. Many have none, or loads that
    forbid one."""
    entries.update({"Initial state/Equilibrium": rng.choice(("spinning", "spinning", "maclaurin")), "Initial state/Figure": rng.choice(("own", "affine")),
                    "Initial state/Deformation": text(diagonal(1, 1, 1)), "Initial state/Velocity": text(diagonal(0, 0, 0)),
                    "Continuum/Degree": rng.randint(2, 3)})
    size = rng.uniform(0, 2.2)
    entries["Initial state/Equilibrium parameter"] = repr(size * rate if entries["Initial state/Equilibrium"] == "spinning" else min(size / 2.2, 0.97))
    for load in "Loads/Tidal matrix", "Loads/Nominal traction", "Material/Drag", "Material/Branch moduli", "Material/Branch times":
        if rng.random() < 0.9:
            entries.pop(load, None)
    if rng.random() < 0.5:
        entries.update({"Initial state/Mode": rng.choice(("1", "2", "7", "10", "auto")), "Initial state/Mode amplitude": repr(10 ** rng.uniform(-8, -1))})


def stay_at_rest(rng, entries, unit_of_gravity, with_continuum):
    """Modes or Love numbers in place of the motion. Most of these have nothing that they refuse."""
    entries.update({"Analysis": rng.choice(("modes", "love numbers")), "Polynomial/Degree": rng.choice(("1", "3", "5", "8")),
                    "Continuum/Degree": rng.randint(2, 4), "Modes/Number": rng.randint(1, 6)})
    entries["Models"] = rng.choice(("polynomial", "continuum", "reduced, polynomial, continuum") if with_continuum else
                                   ("polynomial", "reduced, polynomial"))
    if rng.random() < 0.9:
        refused = ("Loads/", "Material/Viscosity", "Material/Branch", "Material/Drag", "Body/Semi-axes", "Initial state/", "Output/Graphics",
                   "Output/Frames", "Continuum/Symmetry", "Time/Method")
        for path in [path for path in entries if path.startswith(refused)]:
            del entries[path]
    if rng.random() < (0.95 if entries["Analysis"] == "love numbers" else 0.3):
        entries.update({"Body/Incompressible": "true", "Gravity/Constant": repr(unit_of_gravity * 10 ** rng.uniform(-3, 3))})
    if rng.random() < 0.3:
        entries["Love numbers/Degrees"] = rng.choice(("2", "2, 3", "3, 4", "4", "2, 7"))
    if "Gravity/Constant" in entries and rng.random() < 0.5:
        del entries["Gravity/Constant"]
        entries["Gravity/Gamma"] = repr(10 ** rng.uniform(-3, 3))
        if rng.random() < 0.5:
            entries.update({"Gravity/Gamma": "$(g)", "Sweep/Parameters": f"g: {entries['Gravity/Gamma']}, 1, 30"})


def bend(rng, entries):
    """Polynomial bodies in place of the pseudo-rigid one, or beside the models of the scene."""
    others = entries["Models"].split(", ")
    entries["Models"] = ", ".join(name for name in ("reduced", "polynomial", "continuum")
                                  if name == "polynomial" or (name in others and rng.random() < 0.6))
    entries["Polynomial/Degree"] = rng.choices(("1", "2", "3", "4", "5", "1, 3", "auto"), (2, 2, 6, 1, 2, 2, 1))[0]
    entries["Polynomial/Tolerance"] = repr(10 ** rng.uniform(-2.5, -1))
    entries["Time/End"] = repr(0.2 * float(entries["Time/End"]))


def choose_method(rng, entries, time_unit, cheap):
    entries["Time/Tolerance"] = repr(10 ** rng.uniform(-9 if cheap else -5, -2))
    if rng.random() < 0.6:
        entries["Time/Method"] = rng.choice([m for m in methods() if cheap or m not in ("gauss-16", "explicit-8")])  # refused for elements
    if rng.random() < 0.5:
        entries["Time/Step"] = repr(min(time_unit * 10 ** rng.uniform(-2.5, -0.3), float(entries["Time/End"])))


def system(rng):
    """A system beside the ball: a scene in which every force acts, all its numbers changed by chance."""
    from system_test import (ANGLES, BODY, BODY_OF_POINTS, DAMPED_POINTS, ELLIPSOID, EULER, FRAME, INERTIAL, JACOBI,
                             JACOBI_PENDULUM, JACOBI_TORUS, LAGRANGE, PARABOLOID, PENDULUM, POINTS, ROTOR,
                             SPHERICAL_PENDULUM, TOP, TORUS)
    entries = dict(rng.choice((PENDULUM, {**PENDULUM, **LAGRANGE}, POINTS, DAMPED_POINTS, TOP, {**TOP, **ANGLES}, BODY,
                               {**BODY, **EULER}, FRAME, {**FRAME, **INERTIAL}, TORUS, ELLIPSOID, PARABOLOID, JACOBI,
                               JACOBI_TORUS, JACOBI_PENDULUM, BODY_OF_POINTS, SPHERICAL_PENDULUM, ROTOR)))
    kept = ("System", "Rigid body/Inertia", "Rigid body/Rotation", "Fixed axis/Inertia", "Mass points/Springs",
            "Mass points/Dashpots", "Output/Samples")
    for path, value in entries.items():
        if path not in kept:
            entries[path] = changed_numbers(rng, str(value))
    entries["Output/Samples"] = rng.randint(2, 30)
    choose_method(rng, entries, 1.0, True)
    choose_analysis(rng, entries)
    if "Analysis" not in entries and float(entries["Time/End"]) > 0 and rng.random() < 0.1:
        keep_trajectories(rng, entries)
    return entries, 1


def choose_analysis(rng, entries):
    """Now and then a section, the manifolds of the critical points, or a motion backwards in time."""
    columns = {"mass points": "x1", "double pendulum": "theta", "torus": "u", "geodesic": "q2", "moving frame": "relative_x"}
    system, chance = entries["System"], rng.random()
    if chance < 0.15 and system in columns:
        entries.update({"Analysis": "section", "Section/Column": columns[system], "Section/Value": repr(rng.gauss(0, 0.5)),
                        "Section/Direction": rng.choice(("up", "down", "both"))})
    elif chance < 0.2 and system in ("double pendulum", "torus"):
        entries.update({"Analysis": "manifolds", "Manifolds/Starts": rng.randint(1, 5)})
    elif chance < 0.4 and (system == "torus" or entries.get("Double pendulum/Form") == "lagrange"):
        entries["Time/End"] = repr(-float(entries["Time/End"]))
    if "Analysis" in entries:
        entries.pop("Time/Method", None)


def keep_trajectories(rng, entries):
    """A sweep over the end, with the samples of its runs."""
    end = float(entries["Time/End"])
    entries.update({"Sweep/Parameters": f"t: {0.5 * end!r} .. {end!r} in {rng.randint(2, 12)}", "Time/End": "$(t)",
                    "Sweep/Trajectories": "true", "Sweep/Threads": rng.randint(1, 3)})
    if "Time/Step" in entries:
        entries["Time/Step"] = repr(min(float(entries["Time/Step"]), 0.5 * end))


def look_for_equilibria(rng, entries, rate):
    """Those at rest in place of the motion, or a family of figures that turn, of bodies that may bend as well. Most of these
    have nothing that families refuse: loads that know a direction, dissipation, figures that bend with circulation within."""
    family = rng.choice(words("Equilibrium/Family"))
    entries.update({"Analysis": "equilibrium", "Equilibrium/Family": family})
    if family == "static":
        if rng.random() < 0.6:
            load_along_the_axes(rng, entries, rate)
        return
    scale = rate if family == "spinning" else 1
    first, last = sorted(scale * rng.uniform(0.02, 0.98) for _ in range(2))
    entries.update({"Equilibrium/First": repr(first), "Equilibrium/Last": repr(last), "Equilibrium/Number": rng.randint(2, 6),
                    "Equilibrium/Axis ratio": repr(math.exp(rng.gauss(0, 0.3)))})
    if rng.random() < (0.1 if family.startswith(("dedekind", "riemann")) else 0.6):
        entries["Models"] = rng.choice(("polynomial", "reduced, polynomial"))
        entries["Polynomial/Degree"] = rng.choice(("1", "2", "3", "1, 3", "4"))
    if rng.random() < 0.8:
        refused = ("Loads/", "Material/Viscosity", "Material/Drag", "Body/Semi-axes")
        for path in [path for path in entries if path.startswith(refused)]:
            del entries[path]


def load_along_the_axes(rng, entries, rate):
    """Figures at rest of bodies that may bend, under loads with the coordinate planes as symmetry planes. Some loads are too large."""
    for path in [path for path in entries if path.startswith(("Loads/", "Material/Viscosity", "Material/Drag", "Material/Branch"))]:
        del entries[path]
    entries.update({"Models": rng.choice(("polynomial", "reduced, polynomial", "polynomial, continuum")),
                    "Polynomial/Degree": rng.choice(("1", "2", "3", "1, 3", "4")), "Continuum/Degree": 2, "Body/Semi-axes": "1, 1, 1"})
    modulus = float(entries["Material/Shear modulus"])
    for load, unit in rng.sample((("Loads/Tidal matrix", rate**2), ("Loads/Nominal traction", modulus), ("Loads/Pressure", modulus)), rng.randint(1, 2)):
        size = unit * 10 ** rng.uniform(-3, 1)
        entries[load] = repr(size) if load == "Loads/Pressure" else text(diagonal(*(size * rng.gauss(0, 1) for _ in range(3))))
    if "reduced" not in entries["Models"] and rng.random() < 0.3:
        entries.update({"Loads/Tidal matrix": "$(k), 0, 0; 0, 0, 0; 0, 0, 0", "Sweep/Parameters": f"k: {rate**2!r}, {-rate**2!r}, {9 * rate**2!r}",
                        "Output/Graphics": "none"})


def changed_numbers(rng, value):
    def change(number):
        try:
            return repr(float(number) * math.exp(rng.gauss(0, 0.5)) * (-1 if float(number) < 0 and rng.random() < 0.2 else 1))
        except ValueError:
            return number.strip()
    return "; ".join(", ".join(change(x) for x in row.split(",")) for row in value.split(";"))


def energy_drift(run):
    """Largest change of the energy over the largest kinetic energy, of the body or of the orbits, or change of another part, by
    model; only where the energy is to stay."""
    drifts = {}
    for path in run.files(".csv"):
        if path.stem in ("comparison", "moving_frame", "manifolds") or path.stem.startswith("equilibria"):
            continue
        table = run.table(path.stem)
        if "energy" not in table.header or "kinetic" not in table.header or len(table) < 2:
            continue
        energy = table.column("energy")
        parts = [name for name in ("kinetic", "elastic", "gravitational", "external", "potential", "orbital", "interaction") if name in table.header]
        scale = max(max(abs(x - table.column(name)[0]) for x in table.column(name)) for name in parts)
        scale = max([scale] + [max(map(abs, table.column(name))) for name in ("kinetic", "orbital") if name in table.header])
        if scale > 0:
            drifts[path.stem] = max(abs(x - energy[0]) for x in energy) / scale
    return drifts


def faults_of_love_numbers(run):
    """The exact sphere is within the bounds of every discretisation."""
    found = []
    for path in run.files(".csv"):
        if not path.stem.startswith("love-") or path.stem == "love-reduced":
            continue
        table = run.table(path.stem)
        for name in "hl":
            for value, exact, error in zip(*(table.column(f"{name}{suffix}") for suffix in ("", "_exact", "_error"))):
                if abs(value - exact) > error + 1e-10 * exact:
                    found.append(f"{path.stem}: {name} = {value} +- {error}, and the sphere has {exact}")
    return found


def is_conservative(entries):
    return not any(path in entries for path in ("Material/Viscosity", "Material/Drag", "Mass points/Drag",
                                                "Mass points/Dashpots", "Torus/Damping", "Spherical pendulum/Drag", "Fixed axis/Friction"))


def faults_of_energy(entries, run):
    """Where the program chose the step for a tolerance of the configuration: to first order, with frequencies ω up to some
    ten of the unit of time, the energy errs by ω times that, relative to a motion of order 1. Small motions and stretched
    bodies, that have other scales, get the factor below. A run that said that no step meets the tolerance promises nothing."""
    if "Time/Step" in entries or not is_conservative(entries) or "cannot be fitted to the tolerance" in run.stderr:
        return []
    bound = 1000 * float(entries["Time/Tolerance"])
    return [f"{model}: the energy drifts by {drift:.2e}, the tolerance is {entries['Time/Tolerance']}"
            for model, drift in energy_drift(run).items() if drift > bound]


def one(program, seed, number, limit, with_continuum=True):
    """Runs scene `number`; a record."""
    rng = random.Random(f"{seed}/{number}")
    kind = "system" if rng.random() < 0.3 else "ball"
    entries, ranks = ball(rng, with_continuum) if kind == "ball" else system(rng)
    name = f"scene{number}"
    run = program.run(entries, name, limit=limit, ranks=ranks)
    found = faults(run)
    record = {"number": number, "kind": entries.get("System", entries.get("Models", "ball")), "ranks": ranks,
              "code": run.code, "seconds": round(run.seconds, 2), "too_long": bool(run.too_long), "resumed": "", "reason": ""}
    if run.code == DONE and not found:
        found = faults_of_energy(entries, run) + faults_of_love_numbers(run)
    elif run.code == STOPPED and entries.get("Analysis") in ("modes", "love numbers"):  # they have no time to stop at
        record["reason"] = reason_without_numbers(run.stderr.split("error: ", 1)[-1].strip())
        found = [] if "error: " in run.stderr else ["exit code 3 without a reason"]
    elif run.code == STOPPED and found_nothing(run):
        record["reason"] = "no equilibrium was found"
    elif run.code == STOPPED and not found and not run.too_long and "Analysis" not in entries:
        record["reason"] = reason_without_numbers(run.stop()[1])
        found, again = faults_of_resume(program, run, name, limit=limit, ranks=ranks)
        record["resumed"] = {DONE: "finished", STOPPED: "stopped"}.get(again.code, "refused")
    elif run.code == 2:
        record["reason"] = reason_without_numbers(run.stderr.split("error: ", 1)[-1].strip())
    record["faults"] = "; ".join(found)
    if not found:
        shutil.rmtree(run.folder, ignore_errors=True)
    return record


def run(program, number, seed, quick, with_continuum=True, **_):
    return [one(program, seed, i, LONGEST[quick], with_continuum) for i in range(number)]
