"""Whether the estimated error of the quadrature of polynomial bodies holds it: random motions against the same bodies with
many more points, integrated with the same method and step, whose errors are common to both. Every scene follows from the
seed of the part and its number. A record has the largest difference of Q over the samples as a part of the estimate."""
import random
import statistics

from program import DONE, words
from random_scenes import text
from tolerances import LONGEST, error_of_Q, record_of, start

MOST_POINTS = 24
ROUND_OFF = 1e-11
POINTS_MORE = 4


def scene(rng, quick):
    N = rng.randint(2, 4 if quick else 9)
    incompressible = rng.random() < 0.6
    Q, Qdot = start(rng, incompressible, N > 5 or rng.random() < 0.5, rng.choice((0.01, 0.05, 0.1, 0.2)))
    end = rng.uniform(2, 5 if quick else 30 if N < 4 else 8)
    entries = {"Models": "polynomial", "Polynomial/Degree": N, "Body/Incompressible": str(incompressible).lower(),
               "Material/Law": rng.choice([law for law in words("Material/Law") if law != "none"]),
               "Material/Lame lambda": repr(10 ** rng.uniform(-0.7, 0.7)), "Material/Mooney fraction": repr(rng.random()),
               "Initial state/Deformation": text(Q), "Initial state/Velocity": text(Qdot), "Time/Method": "rattle-8",
               "Time/End": repr(end), "Time/Tolerance": 1e-6 if rng.random() < 0.6 else repr(10 ** rng.uniform(-9, -6)),
               "Output/Samples": 8 * round(end)}
    if incompressible and N <= 5 and rng.random() < 0.3:
        entries["Gravity/Constant"] = repr(10 ** rng.uniform(-1, 0.5))
    if rng.random() < 0.2:
        entries["Polynomial/Quadrature points"] = (N + 4) // 2 + 1
    return entries


def finer(entries, counters):
    """Its rules have an error that is far below."""
    N = entries["Polynomial/Degree"]
    return {**entries, "Time/Step": repr(counters["step"]),
            "Polynomial/Quadrature points": min(MOST_POINTS, round(counters["quadrature_points"]) + POINTS_MORE),
            "Polynomial/Gravity points": min(MOST_POINTS, 2 * (N + 4))}


def one(program, seed, number, quick):
    rng = random.Random(f"quadrature/{seed}/{number}")
    entries = scene(rng, quick)
    run = program.run(entries, f"scene{number}", limit=10 if quick else LONGEST)
    kind = f"degree {entries['Polynomial/Degree']}"
    return record_of(run, number, kind, entries, lambda record: judge(program, entries, run, record, 10 if quick else LONGEST))


def judge(program, entries, run, record, limit):
    counters = run.manifest()["models"]["polynomial"]["counters"]
    reference = program.run(finer(entries, counters), "reference", limit=limit)
    if reference.code != DONE:
        record["said"] = "no reference"
        return
    error = error_of_Q(run, reference, "polynomial")
    record.update(points=counters["quadrature_points"], error=error, forces=counters["forces"] + counters.get("pilot_forces", 0),
                  quadrature_forces=counters.get("quadrature_pilot_forces", 0))
    if "estimated_quadrature_error" not in counters:
        record["said"] = "not known"
        return
    record["estimate"] = counters["estimated_quadrature_error"]
    record["of_tolerance"] = error / float(entries["Time/Tolerance"])
    if error < ROUND_OFF:
        return
    record["of_estimate"] = error / record["estimate"] if record["estimate"] else float("inf")
    if error > record["estimate"]:
        record["faults"] = f"the error of Q is {error:.2e}, {record['of_estimate']:.2g} of the estimate"


def run(program, number, seed, quick, **_):
    records = [one(program, seed, i, quick) for i in range(number // (5 if quick else 4))]
    held = [record["of_estimate"] for record in records if record["of_estimate"] != ""]
    unknown = sum(record["said"] == "not known" for record in records)
    print(f"quadrature: {len(held)} of {len(records)} motions are held against a finer rule; the error of Q is at most "
          f"{max(held, default=0):.2g} of the estimate, in the median {statistics.median(held or [0]):.2g}; it is not known of {unknown}")
    return records
