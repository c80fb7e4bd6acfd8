"""Violent releases: the ball is let go at rest from a large stretch along z, over the stretch, the self-gravity γ = ρgr/μ and
the degree of the elements, on the unrefined octant until t = 60 r/c. Method and step are chosen by the program. The part
`violent` has degrees 3 and 4, and `violent-high` degrees 5 to 8 and the largest stretches.

Each run is one of: finished; ended, the program stopped and said why, which is admitted only after the surface has reached
Biot's limit; long, the time limit interrupted it. The drift is the largest change of the energy over the elastic energy at
the start. Of a run that finished it must not exceed MOST_DRIFT. q33_apart is the largest difference of Q33 from the run of one
degree more, before both have reached Biot's limit. docs/violent_motions.md has the results."""
import math

from program import DONE, STOPPED, faults, reason_without_numbers

STRETCHES = (1.1, 1.2, 1.35, 1.5, 2.0)
GRAVITIES = (0, 5, 20)
DEGREES, HIGH_DEGREES = (3, 4), (5, 6, 7, 8)
END, INTERVAL = 60, 0.1
MOST_DRIFT = 1e-3  # what the step control aims at
LONGEST, LONGEST_OF_HIGH = 90, 1200


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
    if quick:
        return releases(program, (3,), (0, 5), (1.5,), 10, LONGEST)
    return releases(program, DEGREES, GRAVITIES, STRETCHES, END, LONGEST)


def run_high(program, quick, **_):
    """An hour of processor time; nothing in the short form."""
    return [] if quick else releases(program, HIGH_DEGREES, GRAVITIES, STRETCHES[2:], END, LONGEST_OF_HIGH)


def releases(program, degrees, gravities, stretches, end, longest):
    records = []
    for gamma in gravities:
        for stretch in stretches:
            of_degrees = []
            for degree in degrees:
                result = program.run(entries(stretch, gamma, degree, end), limit=longest)
                record = {"kind": f"degree {degree}", "stretch": stretch, "gamma": gamma, "degree": degree, "code": result.code,
                          "seconds": round(result.seconds, 2), "too_long": bool(result.too_long), "q33_apart": ""}
                found = list(faults(result))
                if not found and result.code in (DONE, STOPPED):
                    record.update(outcome(result))
                    found += judge(record)
                    of_degrees.append((record, result.table("continuum")))
                record["faults"] = "; ".join(found)
                records.append(record)
            for (record, table), (other, of_other) in zip(of_degrees, of_degrees[1:]):
                record["q33_apart"] = apart(table, of_other, min(t or math.inf for t in (record["biot_time"], other["biot_time"])))
    return records


def apart(table, other, end):
    rows = zip(table.column("time"), table.column("Q33"), other.column("Q33"))
    return max(abs(a - b) for time, a, b in rows if time <= end)
