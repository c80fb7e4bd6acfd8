"""Violent releases: the ball is let go at rest from a large stretch along z, over the stretch, the self-gravity γ = ρgr/μ and
the degree of the elements, on the unrefined octant until t = 60 r/c. Method and step are chosen by the program.

Each run is one of: finished; ended, the program stopped and said why, which is admitted only after the surface has reached
Biot's limit; long, the time limit interrupted it. The drift is the largest change of the energy over the elastic energy at
the start. Of a run that finished it must not exceed MOST_DRIFT. docs/violent_motions.md has the results."""
import math

from program import DONE, STOPPED, faults, reason_without_numbers

STRETCHES = (1.1, 1.2, 1.35, 1.5, 2.0)
GRAVITIES = (0, 5, 20)
DEGREES = (3, 4)
END, INTERVAL = 60, 0.1
MOST_DRIFT = 1e-3  # what the step control aims at
LONGEST = 90


def entries(stretch, gamma, degree, end):
    side = 1 / math.sqrt(stretch)
    return {"Models": "continuum", "Continuum/Degree": degree, "Gravity/Constant": repr(3 * gamma / (4 * math.pi)),
            "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, {stretch!r}", "Time/End": end,
            "Output/Samples": round(end / INTERVAL)}


def outcome(run):
    counters = run.manifest()["models"]["continuum"]["counters"]
    table = run.table("continuum")
    energy, elastic = table.column("energy"), table.column("elastic")
    record = {"outcome": "finished", "time": table.column("time")[-1], "biot_time": counters.get("surface_limit_time", ""),
              "drift": max(abs(x - energy[0]) for x in energy) / elastic[0], "least_jacobian": min(table.column("min_jacobian")),
              "volume_error": max(table.column("volume_error")),
              "steps": counters.get("steps", ""), "forces": counters.get("forces", ""),
              "repeated_intervals": counters.get("repeated_intervals", ""), "reason": ""}
    if run.too_long:
        record["outcome"] = "long"
    elif run.code == STOPPED:
        record.update({"outcome": "ended", "reason": reason_without_numbers(run.stop()[1])})
    return record


def judge(record):
    if not record["least_jacobian"] > 0:
        yield "an element is turned inside out in the table"
    if record["outcome"] == "ended" and record["biot_time"] == "":
        yield "ended before Biot's limit"
    if record["outcome"] == "finished" and record["drift"] > MOST_DRIFT:
        yield f"the energy changes by {record['drift']:.1e}"


def run(program, quick, **_):
    records = []
    for degree in (3,) if quick else DEGREES:
        for gamma in (0, 5) if quick else GRAVITIES:
            for stretch in (1.5,) if quick else STRETCHES:
                end = 10 if quick else END
                result = program.run(entries(stretch, gamma, degree, end), limit=LONGEST)
                record = {"kind": f"degree {degree}", "stretch": stretch, "gamma": gamma, "degree": degree, "code": result.code,
                          "seconds": round(result.seconds, 2), "too_long": bool(result.too_long)}
                found = list(faults(result))
                if not found and result.code in (DONE, STOPPED):
                    record.update(outcome(result))
                    found += judge(record)
                record["faults"] = "; ".join(found)
                records.append(record)
    return records
