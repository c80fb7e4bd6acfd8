"""Motions driven to where they end: rising amplitudes of a release, a spin and a shear, in both models; starts that are
nearly turned inside out; two equal axes; steps from 0.8 to 1.3 of the stability limit."""
import math

from program import DONE, STOPPED, faults, faults_of_resume, reason_without_numbers
from random_scenes import diagonal, scaled, text

LONGEST = 60
RELEASE = diagonal(1, 1, -2)
SPIN = [[0, -1, 0], [1, 0, 0], [0, 0, 0]]
SHEAR = [[0, 1, 0], [0, 0, 0], [0, 0, 0]]
BASE = {"Models": "reduced, continuum", "Continuum/Degree": 3, "Continuum/Error estimate": "none", "Output/Samples": 40,
        "Time/End": 4, "Time/Tolerance": 1e-3}
REDUCED = {"Models": "reduced", "Output/Samples": 40, "Time/End": 10, "Time/Tolerance": 1e-8}


def ramps(quick):
    """(name, entries) of every run."""
    amplitudes = (0.3, 3) if quick else (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 8, 12, 20, 50)
    for name, velocity in (("release", RELEASE), ("spin", SPIN), ("shear", SHEAR)):
        for a in amplitudes:
            # Without planes of symmetry there are eight times the cells.
            degree = {"Continuum/Degree": 3 if name == "release" else 2}
            entries = {**BASE, **degree, "Initial state/Velocity": text(scaled(a, velocity))}
            yield f"{name} {a} c/r", entries
            if not quick:
                yield f"{name} {a} c/r, compressible", {**entries, "Body/Incompressible": "false"}


def near_inversions(quick):
    for exponent in (2, 5) if quick else (1, 2, 3, 4, 5):
        s = 10.0 ** -exponent
        flat, drawn = diagonal(s**-0.5, s**-0.5, s), diagonal(s**0.5, s**0.5, 1 / s)
        yield f"flattened to {s:g}", {**REDUCED, "Initial state/Deformation": text(flat), "Time/End": 1}
        yield f"drawn to {1 / s:g}", {**REDUCED, "Initial state/Deformation": text(drawn), "Time/End": 1}
        crushed = {"Body/Incompressible": "false", "Initial state/Deformation": text(diagonal(1, 1, s))}
        yield f"crushed to {s:g}", {**REDUCED, **crushed, "Time/End": 1}
        if exponent <= 3:
            both = {**BASE, "Time/End": 0.2, "Output/Samples": 4, "Continuum/Degree": 2}
            yield f"both models flattened to {s:g}", {**both, "Initial state/Deformation": text(flat)}
            yield f"both models crushed to {s:g}", {**both, **crushed}


def coincident_axes(quick):
    """Axes that are equal, nearly equal, or cross; with the bipolar decomposition and with self-gravity, whose formulas
    must not divide by a difference of axes."""
    gaps = (0, 1e-9) if quick else (0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3)
    bipolar = {**REDUCED, "Output/Quantities": "all, bipolar", "Output/Samples": 200}
    for gap in gaps:
        Q = diagonal(1.2, 1.2 * (1 + gap), 1 / (1.44 * (1 + gap)))
        for name, velocity in (("at rest", scaled(0, SPIN)), ("spinning", scaled(0.4, SPIN)), ("crossing", diagonal(0.3, -0.3, 0))):
            L = [[sum(Q[i][k] * velocity[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
            entries = {**bipolar, "Initial state/Deformation": text(Q), "Initial state/Velocity": text(L)}
            yield f"axes apart by {gap:g}, {name}", entries
            yield f"axes apart by {gap:g}, {name}, gravity", {**entries, "Gravity/Constant": 1}
    yield "a ball, bipolar", {**bipolar, "Initial state/Velocity": text(SPIN)}


def steps_about_the_limit(program, quick):
    """Intervals between samples are ten steps, so that the step is the one that is meant."""
    for degree in (2,) if quick else (2, 3, 4):
        limit = stability_limit(program, degree)
        for part in (0.9, 1.15) if quick else (0.8, 0.9, 0.95, 0.98, 1.0, 1.02, 1.05, 1.1, 1.2, 1.3):
            yield f"degree {degree}, step {part} of the limit", with_step(0.05, degree, part * limit, 40)


def with_step(amplitude, degree, step, n_samples):
    return {"Models": "continuum", "Continuum/Degree": degree, "Initial state/Velocity": text(scaled(amplitude, RELEASE)),
            "Time/Method": "rattle", "Time/Step": repr(step * (1 + 1e-9)), "Time/End": repr(10 * n_samples * step),
            "Output/Samples": n_samples}


def stability_limit(program, degree):
    """The step at which RATTLE loses stability at the state of rest: by the largest step with which a motion of 10⁻⁶ does
    not grow in 400 steps, found by halving intervals."""
    low, high = 0.0, 0.5
    while high - low > 2e-3 * high:
        step = (low + high) / 2
        run = program.run(with_step(1e-6, degree, step, 40), "limit", limit=LONGEST)
        grows = run.code != DONE or max(run.table("continuum").column("energy")) > 1e-9
        low, high = (low, step) if grows else (step, high)
    return low


def run(program, quick, **_):
    records = []
    groups = (("ramp", ramps(quick)), ("near inversion", near_inversions(quick)), ("coincident axes", coincident_axes(quick)),
              ("step about the limit", steps_about_the_limit(program, quick)))
    for group, scenes in groups:
        for name, entries in scenes:
            result = program.run(entries, limit=LONGEST)
            found = faults(result)
            record = {"kind": group, "name": name, "code": result.code, "seconds": round(result.seconds, 2), "resumed": "",
                      "too_long": bool(result.too_long), "reason": ""}
            if result.code == STOPPED and not found and not result.too_long:
                record["reason"] = reason_without_numbers(result.stop()[1])
                record["time"] = result.stop()[0]
                found, again = faults_of_resume(program, result, limit=LONGEST)
                record["resumed"] = {DONE: "finished", STOPPED: "stopped"}.get(again.code, "refused")
            if result.code == 2:
                record["reason"] = reason_without_numbers(result.stderr.split("error: ", 1)[-1].strip())
                found.append(f"refused: {result.stderr.strip()}")
            record["faults"] = "; ".join(found)
            records.append(record)
    return records
