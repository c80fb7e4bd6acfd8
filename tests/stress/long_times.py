"""Long runs: 10^7 steps of the reduced model, 10^5 of the continuum, and releases over 100 periods of the ball. The energy
must stay bounded: its departure from the start over the second half of a run is not larger than over the first half by
more than chance makes it."""
import math

from program import DONE, faults
from random_scenes import diagonal, scaled, text

PERIOD = 2 * math.pi / 2.665622189236  # of the ball's lowest spheroidal mode
RELEASE = diagonal(1, 1, -2)
TUMBLING = {"Initial state/Deformation": text(diagonal(1.3, 1, 1 / 1.3)),
            "Initial state/Velocity": "0.26, -1.04, 0.13; 0.6, -0.3, 0.2; 0, -0.076923076923076927, 0.076923076923076927"}
LONGEST = 1500
# The largest departure of a random walk in its second half is less than this times that in its first half, in 999 of 1000
# walks (40,000 walks drawn).
GROWTH_OF_WALKS = 5.3


def departures(run, model):
    """Largest |E − E₀| over the largest kinetic energy, of the first half and of the second; and the drift, the mean of the
    last quarter less that of the first."""
    table = run.table(model)
    energy, kinetic = table.column("energy"), table.column("kinetic")
    apart = [(x - energy[0]) / max(kinetic) for x in energy]
    half, quarter = len(apart) // 2, len(apart) // 4
    mean = lambda values: sum(values) / len(values)
    return max(map(abs, apart[:half])), max(map(abs, apart[half:])), mean(apart[-quarter:]) - mean(apart[:quarter])


def measured(program, kind, name, entries, most, chance=1e-12, growth=2):
    """A record; `most`: the largest departure of the energy that passes; `growth`: the largest ratio of the departures in the
    two halves; `chance`: the growth from half to half that round-off alone may make."""
    run = program.run(entries, limit=LONGEST)
    record = {"kind": kind, "name": name, "code": run.code, "seconds": round(run.seconds, 1), "too_long": bool(run.too_long)}
    found = faults(run)
    if run.code == DONE and not found:
        for model, values in run.manifest()["models"].items():
            first, second, drift = departures(run, model)
            counters = values["counters"]
            record.update({f"{model} steps": int(counters["steps"]), f"{model} first half": first,
                           f"{model} second half": second, f"{model} drift": drift})
            if "least_surface_stretch_ratio" in counters:
                record["least surface ratio"] = counters["least_surface_stretch_ratio"]
            if not max(first, second) < most:
                found.append(f"{model}: the energy departs by {max(first, second):.1e}")
            if second > growth * first + chance:
                found.append(f"{model}: the energy departs by {first:.1e} in the first half, by {second:.1e} in the second")
    elif not found:
        found.append(f"it ended: {run.stderr.strip()[-200:]}")
    record["faults"] = "; ".join(found)
    return record


def reduced(program, quick):
    n_steps = 10**6 if quick else 10**7
    # Steps of the error that the energy then has: what is tested is that it does not grow.
    steps = {"rattle": 0.01, "rattle-4": 0.05, "rattle-8": 0.2, "symmetric-8": 0.02, "symmetric-12": 0.02, "energy-momentum": 0.02,
             "gauss-16": 0.25}
    # A random walk of round-off, measured: 1.3e-12 with AVX-512; with AVX2 2.4e-13 in the first half, 1.5e-12 in the second.
    most, chance = {"gauss-16": 5e-12}, {"gauss-16": 2.5e-12}
    growth = {"symmetric-12": GROWTH_OF_WALKS}  # its round-off makes a random walk (mechanics/methods/symmetric_multistep.h)
    for method in ("rattle", "symmetric-8", "gauss-16") if quick else steps:
        entries = {"Models": "reduced", **TUMBLING, "Time/Method": method, "Time/Step": repr(steps[method]),
                   "Time/End": repr(n_steps * steps[method]), "Output/Samples": 1000}
        yield measured(program, "reduced, tumbling", f"{method}, {n_steps:.0e} steps", entries, most.get(method, 1e-2),
                       chance.get(method, 1e-12), growth.get(method, 2))


def continuum(program, quick):
    n_steps = 2000 if quick else 10**5
    for degree, step in ((2, 0.05),) if quick else ((2, 0.05), (3, 0.025)):
        entries = {"Models": "continuum", "Continuum/Degree": degree, "Time/Method": "rattle", "Time/Step": repr(step),
                   "Initial state/Velocity": text(scaled(0.1, RELEASE)), "Time/End": repr(n_steps * step),
                   "Output/Samples": 1000 if not quick else 100}
        yield measured(program, "continuum, release of 0.1 c/r", f"degree {degree}, {n_steps} steps", entries, 1e-2)


def releases(program, quick):
    periods = 5 if quick else 100
    for degree in (3,) if quick else (3, 4):
        for a in (0.3,) if quick else (0.1, 0.2, 0.3):
            entries = {"Models": "reduced, continuum", "Continuum/Degree": degree, "Continuum/Error estimate": "none",
                       "Initial state/Velocity": text(scaled(a, RELEASE)), "Time/Tolerance": 1e-2 if quick else 1e-3,
                       "Time/Method": "rattle", "Time/Step": repr(0.02 if degree == 3 else 0.0125),
                       "Time/End": repr(periods * PERIOD), "Output/Samples": 20 * periods}
            yield measured(program, f"release, {periods} periods", f"a = {a} c/r, degree {degree}", entries, 5e-2)


def run(program, quick, with_continuum=True, **_):
    records = [*reduced(program, quick)]
    return [*records, *continuum(program, quick), *releases(program, quick)] if with_continuum else records
