"""The map of stability: the ball released with the velocity a(x, y, −2z), over the amplitude a, the step in parts of the
stability limit at rest, and the degree, on the unrefined octant until t = 25 r/c. `python3 -m pseudorigid map` draws it.

Each run is one of: bounded, the energy stays within a tenth of the start's; lost, it does not; ended, the program stopped
and said why. A run whose surface reached Biot's limit has the time of that."""
from program import STOPPED, faults, reason_without_numbers
from ramps import RELEASE, stability_limit
from random_scenes import scaled, text

AMPLITUDES = (0.1, 0.3, 0.45, 0.6, 0.8, 1.0, 1.3, 2.0)
PARTS = (0.5, 0.8, 0.95, 1.05, 1.2)
DEGREES = (2, 3, 4, 5)
END = 25
BOUNDED = 0.1
BIOT = 0.29559774252208477
LONGEST = 120


def entries(a, degree, step):
    """Intervals between samples are two steps, so that the step is the one that is meant."""
    n_samples = round(END / (2 * step))
    return {"Models": "continuum", "Continuum/Degree": degree, "Initial state/Velocity": text(scaled(a, RELEASE)),
            "Time/End": repr(n_samples * 2 * step), "Output/Samples": n_samples, "Time/Method": "rattle",
            "Time/Step": repr(step * (1 + 1e-9))}


def outcome(run):
    record = {"outcome": "bounded", "time": "", "energy_departure": "", "biot_time": "", "least_surface_ratio": "", "reason": ""}
    counters = run.manifest()["models"].get("continuum", {}).get("counters", {})
    record["biot_time"] = counters.get("surface_limit_time", "")
    record["least_surface_ratio"] = counters.get("least_surface_stretch_ratio", "")
    energy = run.table("continuum").column("energy")
    departure = max(abs(x - energy[0]) for x in energy) / energy[0]
    record["energy_departure"] = departure
    if run.code == STOPPED:
        record.update({"outcome": "ended", "time": run.stop()[0], "reason": reason_without_numbers(run.stop()[1])})
    elif departure > BOUNDED:
        record["outcome"] = "lost"
    return record


def least_ratio_of_axes(program, a):
    """Of the reduced model in its pulsation: a₃/a₁, the stretch along the surface over that along its normal."""
    run = program.run({"Models": "reduced", "Initial state/Velocity": text(scaled(a, RELEASE)), "Time/End": 6,
                       "Time/Tolerance": 1e-8, "Output/Samples": 3000})
    table = run.table("reduced")
    return min(low / high for low, high in zip(table.column("a3"), table.column("a1")))


def biot_amplitude(program):
    """At which the reduced model first comes to Biot's ratio."""
    low, high = 0.1, 2.0
    while high - low > 1e-4:
        a = (low + high) / 2
        low, high = (a, high) if least_ratio_of_axes(program, a) > BIOT else (low, a)
    return (low + high) / 2


def run(program, quick, **_):
    records = [{"kind": "Biot's limit of the reduced model", "amplitude": biot_amplitude(program), "faults": ""}]
    for degree in (2,) if quick else DEGREES:
        limit = stability_limit(program, degree)
        for a in (0.2, 2.0) if quick else AMPLITUDES:
            for part in (0.8,) if quick else PARTS:
                result = program.run(entries(a, degree, part * limit), limit=LONGEST)
                record = {"kind": f"degree {degree}", "degree": degree, "amplitude": a, "part_of_limit": part,
                          "step": part * limit, "code": result.code, "seconds": round(result.seconds, 2),
                          "too_long": bool(result.too_long)}
                found = faults(result)
                if not found and not result.too_long:
                    record.update(outcome(result))
                record["faults"] = "; ".join(found)
                records.append(record)
    return records
