"""Figures of equilibrium of finite elements and polynomial bodies. In random families and figures at
rest, the difference from elements of a higher degree is below omega3_error, axes_error, surface_error, rates_error and parameter_error.
Families that are ended at random moments and resumed have the table of an undisturbed run, byte by byte. Every scene follows from the seed of the part and
its number; a moment follows from the clock. A record of a figure has the largest difference over its bar."""
import math
import random
import signal
import subprocess
import time

from program import DONE, STOPPED, faults, words
from program_test import matrix

LAWS = [law for law in words("Material/Law") if law != "none"]
BARS = {"omega3": "omega3_error", **{f"a{i}": "axes_error" for i in (1, 2, 3)}, **{f"surface{i}": "surface_error" for i in (1, 2, 3)},
        **{f"rate_{k}_im": "rates_error" for k in range(1, 11)}}
ROUND_OFF = 1e-13
LIMIT = 300


def ends(rng, low, high, width):
    first = rng.uniform(low, high)
    return {"Equilibrium/First": repr(first), "Equilibrium/Last": repr(first + rng.uniform(*width))}


def loads(rng, gamma):
    strength = 10 ** rng.uniform(-2, 0.5) * (1 + 0.2 * gamma)
    T = [strength * rng.uniform(-1, 1) for _ in range(3)]
    if rng.random() < 0.3:
        T[1] = T[0]
    entries = {"Loads/Tidal matrix": matrix(*T)}
    if rng.random() < 0.4:
        entries["Loads/Nominal traction"] = matrix(*(10 ** rng.uniform(-1.5, 0.3) * rng.uniform(-0.4, 1) for _ in range(3)))
    return entries


def scene(rng, quick):
    family = rng.choice(("spinning", "maclaurin", "spheroids", "jacobi", "static", "static"))
    incompressible = family == "jacobi" or rng.random() < 0.6
    gamma = 10 ** rng.uniform(0.7 if family == "jacobi" else -1, 2) if incompressible and (family == "jacobi" or rng.random() < 0.6) else 0
    entries = {"Models": "continuum", "Analysis": "equilibrium", "Equilibrium/Family": family,
               "Body/Incompressible": str(incompressible).lower(), "Material/Law": rng.choice(LAWS),
               "Material/Lame lambda": repr(10 ** rng.uniform(-0.5, 1.5)), "Material/Mooney fraction": repr(rng.random()),
               "Continuum/Degree": 3 if quick else rng.choice((3, 4))}
    if gamma:
        entries["Gravity/Gamma"] = repr(gamma)
    if family == "static":
        return {**entries, **loads(rng, gamma)}
    spin = math.sqrt(3 + 0.3 * gamma)
    ranges = {"spinning": (0.1 * spin, 0.7 * spin, (0.01, 0.1)), "maclaurin": (0.15, 0.85, (0.02, 0.1)),
              "spheroids": (0.5, 0.9, (0.02, 0.09)), "jacobi": (0.4, 0.85, (0.02, 0.1))}
    return {**entries, **ends(rng, *ranges[family]), "Equilibrium/Number": 2}


def pairs_of_rows(mine, finer):
    """Members with the same parameter, and special points of the same kind and class, each with the nearest one."""
    names = ("kind", "odd_in_z", "m", "parameter")
    keys = [list(zip(*map(table.column, names))) for table in (mine, finer)]
    for i, (kind, *motions, parameter) in enumerate(keys[0]):
        alike = [k for k, key in enumerate(keys[1]) if key[0] == kind and (kind == 0 or list(key[1:3]) == motions)]
        if not alike:
            continue
        k = min(alike, key=lambda k: abs(keys[1][k][3] - parameter))
        if kind != 0 or keys[1][k][3] == parameter:
            yield i, k, kind


def excess(mine, finer):
    """(largest difference over its bar, its column)"""
    worst = (0, "")
    for i, k, kind in pairs_of_rows(mine, finer):
        for column, error in {**BARS, **({"parameter": "parameter_error"} if kind else {})}.items():
            value, bar = mine.column(column)[i], mine.column(error)[i]
            difference = abs(value - finer.column(column)[k])
            if difference > ROUND_OFF * max(1, abs(value)):
                worst = max(worst, (difference / bar, column))
    return worst


def one(program, seed, number, quick):
    entries = scene(random.Random(f"figures/{seed}/{number}"), quick)
    run = program.run(entries, f"figure{number}", limit=LIMIT)
    record = {"kind": f"figures, {entries['Equilibrium/Family']}", "number": number, "code": run.code, "faults": "; ".join(faults(run))}
    if run.code != DONE or record["faults"]:
        return record
    reference = program.run(entries, "reference", changes={"Continuum/Degree": 5 if quick else 7, "Continuum/Error estimate": "none"}, limit=LIMIT)
    if reference.code == DONE:
        ratio, column = excess(run.table("equilibria-continuum"), reference.table("equilibria-continuum"))
        record.update(excess=ratio, column=column)
        if ratio > 1:
            record["faults"] = f"{column} differs by {ratio:.3g} times its error: {entries}"
    return record


def interrupted(program, rng, model, number):
    """A family that is ended at two moments, by two signals, and resumed."""
    entries = {"Models": model, "Analysis": "equilibrium", "Polynomial/Degree": "1, 3", "Continuum/Degree": 3, "Gravity/Gamma": 20,
               "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.7, "Equilibrium/Last": 0.93, "Equilibrium/Number": number}
    whole = program.run(entries, "whole", limit=LIMIT)
    folder, found, code = program.scratch / "parts", faults(whole), whole.code
    resume = []
    for _ in range(2):
        process = subprocess.Popen(program.command("run", "whole.prm", "--output", folder, *resume), cwd=program.scratch,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(rng.uniform(0.2, 1) * whole.seconds)
        process.send_signal(rng.choice((signal.SIGINT, signal.SIGTERM, signal.SIGKILL)))
        if process.wait() not in (DONE, STOPPED, -signal.SIGKILL, -signal.SIGINT, -signal.SIGTERM):
            found.append(f"exit code {process.returncode} after a signal")
        resume = ["--resume"] if list(folder.glob("checkpoint-*.bin")) else []
    run = program.call("run", "whole.prm", "--output", folder, *resume, folder=folder, limit=LIMIT)
    name = f"equilibria-{model}.csv"
    if run.code != DONE or (folder / name).read_bytes() != (whole.folder / name).read_bytes():
        found.append(f"resumed with exit code {run.code}, the table is another one: {run.stderr.strip()[-300:]}")
    return {"kind": f"an ended family, {model}", "code": code, "faults": "; ".join(found), "runs": 4}


def run(program, seed, quick, with_continuum=True, **_):
    rng = random.Random(seed)
    models = ("polynomial", "continuum") if with_continuum and not quick else ("polynomial",)
    records = [interrupted(program, rng, model, 4 if quick else 12) for model in models for _ in range(1 if quick else 10)]
    numbers = range(2 if quick else 100) if with_continuum else ()
    return records + [one(program, seed, number, quick) for number in numbers]
