"""Whether Time/Tolerance is met: short scenes with few samples against the same scenes, integrated much more accurately.
Few samples leave the step to accuracy and stability, and a short run gives errors little to average over. Every scene
follows from the seed of the part and its number. A record has the largest error of Q over the samples as a part of the
tolerance, and of the estimate that the run prints."""
import math
import random
import shutil

from program import DONE, WRONG_INPUT, faults_of_end, methods, words
from random_scenes import determinant, diagonal, irregular, product, rotation, scaled, text

LONGEST = 60  # seconds of a run
# What the program says of runs whose tolerance it does not promise to meet.
TAKEN_BACK = ("cannot be fitted to the tolerance", "below the accuracy of double precision", "the motion is unstable")
CONFIGURATION = [f"Q{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]


def start(rng, incompressible, diagonal_only, spread):
    """Deformation and velocity of a release, a stretching, a spin, or all of them."""
    logs = [rng.gauss(0, spread) for _ in range(3)]
    if rng.random() < 0.3:
        logs[1] = logs[0]  # two equal axes
    if incompressible:
        logs = [x - sum(logs) / 3 for x in logs]
    Q = diagonal(*map(math.exp, logs))
    if not diagonal_only:
        Q = product(product(rotation(rng), Q), rotation(rng))
    if incompressible:
        Q = scaled(determinant(Q) ** (-1 / 3), Q)
    kind = rng.choice(("release", "release", "stretching", "spin", "all"))
    L = irregular(rng, rng.choice((0.05, 0.3, 0.6))) if kind in ("stretching", "all") else diagonal(0, 0, 0)
    if diagonal_only:
        L = diagonal(*(L[i][i] for i in range(3)))
    if kind in ("spin", "all"):
        spin = rng.choice((0.02, 0.3, 1.0))
        L[0][1] -= spin
        L[1][0] += spin
    if incompressible:
        mean = sum(L[i][i] for i in range(3)) / 3
        for i in range(3):
            L[i][i] -= mean
    return Q, product(L, Q)


def scene(rng, with_continuum):
    model = rng.choices(("reduced", "polynomial", "continuum"), (7, 12, 1 if with_continuum else 0))[0]
    incompressible = rng.random() < 0.7
    spread = rng.choice((0.01, 0.05, 0.05, 0.15, 0.3 if model == "reduced" else 0.1))
    Q, Qdot = start(rng, incompressible, rng.random() < 0.5, spread)
    entries = {"Models": model, "Body/Incompressible": str(incompressible).lower(),
               "Material/Law": rng.choice([law for law in words("Material/Law") if law != "none"]),
               "Material/Lame lambda": repr(10 ** rng.uniform(-1, 1)), "Material/Mooney fraction": repr(rng.random()),
               "Initial state/Deformation": text(Q), "Initial state/Velocity": text(Qdot),
               "Time/End": repr(rng.uniform(1, 3 if model == "continuum" else 10)),
               "Time/Tolerance": repr(10 ** rng.uniform(-6, -2)), "Output/Samples": rng.randint(2, 8)}
    if model == "polynomial":
        entries["Polynomial/Degree"] = rng.randint(1, 3)
    if model == "continuum":
        entries["Continuum/Degree"] = 2
    if rng.random() < 0.4:
        entries["Time/Method"] = rng.choice(methods())
    if model != "reduced" and incompressible and not entries["Material/Law"].startswith("saint-venant") and rng.random() < 0.1:
        project(rng, entries)
    if rng.random() < 0.1:
        entries["Material/Viscosity"] = repr(10 ** rng.uniform(-3, -0.5))
    if rng.random() < 0.1:
        entries["Material/Drag"] = repr(10 ** rng.uniform(-2, 0))
    if rng.random() < 0.15:
        entries["Loads/Tidal matrix"] = text(irregular(rng, 0.5, symmetric=True))
    if rng.random() < 0.1:
        entries["Loads/Tidal amplitude"] = text(irregular(rng, 0.5, symmetric=True))
        entries["Loads/Tidal frequency"] = repr(rng.uniform(0.1, 5))
    if rng.random() < 0.1:
        entries["Loads/Nominal traction"] = text(irregular(rng, 0.2))
    if rng.random() < 0.1 and incompressible and "Material/Bulk" not in entries:
        entries["Gravity/Constant"] = repr(10 ** rng.uniform(-1, 0.5))
    return entries


def project(rng, entries):
    """A nearly incompressible body in place of an incompressible one, so that the start keeps the volume. The reference by RATTLE, of
    order 2, takes a tolerance that is not too small."""
    entries.update({"Body/Incompressible": "false", "Material/Bulk": "projected", "Material/Lame lambda": repr(10 ** rng.uniform(2, 5)),
                    "Time/Tolerance": repr(10 ** rng.uniform(-4, -2))})
    entries.pop("Time/Method", None)


def reference_of(entries, counters):
    """Finite elements do not have explicit-8. With dissipation, and with a projected bulk term, RATTLE is the only method. A polynomial body keeps its rule of
    quadrature, which would follow the tolerance."""
    if entries["Models"] == "polynomial":
        entries = {**entries, "Polynomial/Quadrature points": round(counters["quadrature_points"])}
    if entries["Models"] != "continuum" and "Material/Bulk" not in entries:
        return {**entries, "Time/Method": "explicit-8", "Time/Tolerance": 1e-10}
    if {"Material/Viscosity", "Material/Drag", "Material/Bulk"} & entries.keys():
        return {**entries, "Time/Method": "rattle", "Time/Tolerance": float(entries["Time/Tolerance"]) / 50}
    return {**entries, "Time/Method": "rattle-8", "Time/Tolerance": 1e-9}


def record_of(run, number, kind, entries, complete):
    """The record of the run of a scene. `complete` adds to the record of a run that is done. The folder of a run with a fault
    stays."""
    record = {"number": number, "kind": kind, "code": run.code, "method": entries.get("Time/Method", "auto"),
              "tolerance": entries["Time/Tolerance"], "estimate": "", "of_tolerance": "", "of_estimate": "", "said": "",
              "faults": run.stderr.strip() if run.code == WRONG_INPUT else "; ".join(faults_of_end(run))}
    if run.code == DONE:
        complete(record)
    if not record["faults"]:
        shutil.rmtree(run.folder, ignore_errors=True)
    return record


def error_of_Q(run, reference, model):
    """The largest difference of an entry of Q over the samples."""
    a, b = run.table(model), reference.table(model)
    return max(abs(x - y) for column in CONFIGURATION for x, y in zip(a.column(column), b.column(column)))


def one(program, seed, number, with_continuum):
    """Runs scene `number` and its reference; a record. A scene that refuses its method is run with another."""
    rng = random.Random(f"tolerances/{seed}/{number}")
    entries = scene(rng, with_continuum)
    name, model = f"scene{number}", entries["Models"]
    run = program.run(entries, name, limit=LONGEST)
    if run.code == WRONG_INPUT:
        entries.pop("Time/Method", None)
        run = program.run(entries, name, limit=LONGEST)
    kind = f"{model} {entries.get('Polynomial/Degree', '')}".strip() + (", projected" if "Material/Bulk" in entries else "")
    return record_of(run, number, kind, entries, lambda record: judge(program, entries, run, record))


def judge(program, entries, run, record):
    model, tolerance = entries["Models"], float(entries["Time/Tolerance"])
    counters = run.manifest()["models"][model]["counters"]
    record["said"] = next((words for words in TAKEN_BACK if words in run.stderr), "")
    record.update(estimate=counters.get("estimated_time_error", "") if not record["said"] else "", order=counters["order"],
                  step=counters["step"], forces=counters["forces"], pilot_forces=counters.get("pilot_forces", 0))
    reference = program.run(reference_of(entries, counters), "reference", limit=LONGEST)
    known_to = reference.manifest()["models"][model]["counters"].get("estimated_time_error", math.inf)  # violent ones have none
    if reference.code != DONE or known_to > 0.05 * tolerance:
        record["said"] = record["said"] or "no reference"
        return
    error = error_of_Q(run, reference, model)
    record["of_tolerance"] = error / tolerance
    if record["said"]:
        return
    if record["estimate"] != "":  # pilot runs give none if intervals were integrated again
        record["of_estimate"] = error / record["estimate"]
    if error > tolerance:
        record["faults"] = f"the error of Q is {error:.2e}, {error / tolerance:.2g} of the tolerance"


def run(program, number, seed, with_continuum=True, **_):
    records = [one(program, seed, i, with_continuum) for i in range(number)]
    held = [record for record in records if record["of_tolerance"] != "" and not record["said"]]
    print(f"tolerances: {len(held)} of {len(records)} scenes are held against a reference; the error of Q is at most "
          f"{max((r['of_tolerance'] for r in held), default=0):.2g} of the tolerance and "
          f"{max((r['of_estimate'] for r in held if r['of_estimate'] != ''), default=0):.2g} of the estimate")
    return records
