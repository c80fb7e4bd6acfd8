"""Local volume of the finite elements: the release of params/quickstart.prm (stretch 1.108) and one from 1.35, over the degree, the
refinements and the volumetric stiffness κ, until t = 10 r/c. A row has the largest root mean square of ln J over the body, the
least J, the error of Q until t = 5 and until t = 10 against degree 8 with κ = 0, the number of forces and the processor time.

Not as it must be is a run that ends before its time, and a degree with more error of the local volume than the one two below it
at the same κ. docs/violent_motions.md has the results."""
import math

from program import DONE, faults

STRETCHES = (1.108, 1.35)
DEGREES, KAPPAS = (3, 4, 5, 6), (0, 1, 3, 10, 30)
REFINED = ((3, 1), (4, 1))  # degree, refinements
REFERENCE = 8
END, N_SAMPLES = 10, 200


def entries(stretch, degree, refinements, kappa):
    side = 1 / math.sqrt(stretch)
    return {"Models": "continuum", "Continuum/Degree": degree, "Continuum/Refinements": refinements, "Continuum/Volumetric stiffness": kappa,
            "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, {stretch!r}", "Time/End": END,
            "Output/Samples": N_SAMPLES, "Time/Tolerance": 1e-5}


def positions(run):
    """(time, Q11, Q22, Q33) at the samples: Q is diagonal."""
    table = run.table("continuum")
    return list(zip(*(table.column(name) for name in ("time", "Q11", "Q22", "Q33"))))


def error(rows, reference, end):
    """max |Q − Q_reference|/√3 until the time `end`."""
    return max(math.dist(a[1:], b[1:]) for a, b in zip(rows, reference) if a[0] < end * (1 + 1e-9)) / math.sqrt(3)


def run(program, quick, **_):
    records = []
    cases = [(degree, 0, kappa) for degree in DEGREES for kappa in KAPPAS] + [(*case, kappa) for case in REFINED for kappa in (0, 3)]
    if quick:
        cases = [(2, 0, 0), (2, 0, 3), (4, 0, 0), (4, 0, 3)]
    for stretch in STRETCHES[:1] if quick else STRETCHES:
        reference = positions(program.run(entries(stretch, 5 if quick else REFERENCE, 0, 0), limit=600))
        by_case = {}
        for degree, refinements, kappa in cases:
            result = program.run(entries(stretch, degree, refinements, kappa), limit=600)
            record = {"kind": f"stretch {stretch}", "stretch": stretch, "degree": degree, "refinements": refinements, "kappa": kappa,
                      "code": result.code}
            found = list(faults(result))
            if not found and result.code == DONE:
                table, model = result.table("continuum"), result.manifest()["models"]["continuum"]
                record.update({"volume_error": max(table.column("volume_error")), "max_volume_error": max(table.column("max_volume_error")),
                               "least_jacobian": min(table.column("min_jacobian")),
                               "q_error_5": error(positions(result), reference, 5), "q_error_10": error(positions(result), reference, 10),
                               "forces": model["counters"]["forces"], "seconds": round(model["timers"]["run"], 3)})
                by_case[degree, refinements, kappa] = record["volume_error"]
                below = by_case.get((degree - 2, refinements, kappa))
                if below and record["volume_error"] > below:
                    found.append("more error of the local volume than two degrees below")
            elif not found:
                found.append("the run did not reach its end")
            record["faults"] = "; ".join(found)
            records.append(record)
    return records
