"""Violent releases: the ball is let go at rest from a large stretch along z, over the stretch, the self-gravity γ = ρgr/μ and
the degree of the elements, on the unrefined mesh until t = 60 r/c. Method and step are chosen by the program. The part
`violent` has degrees 3 and 4, and `violent-high` degrees 5 to 8 and the largest stretches. The part `violent-map` has
degree 3, more stretches and gravities, spins ω r/c about the x axis, and other laws; it takes half an hour. The tolerance of the
steps is the default, and 1e-4 from degree 5 on, whose steps otherwise take hours.

Each run is one of: finished; ended, the program stopped and said why, which is admitted only after the surface has reached
Biot's limit; long, the time limit interrupted it. The drift is the largest change of the energy over the elastic energy at
the start. drift_of_motion is the same change over the energy of the motion, which the step control uses: with self-gravity, its
energy over that of the ball at rest is a part of it. Of a run that finished it must not exceed MOST_DRIFT. `forces` leaves out
repeated_forces, those of attempts that were repeated. stable_steps are the steps of RATTLE at its limit of stability along the
motion. q33_apart is the largest difference of Q33 from the run of one degree more, before both have reached Biot's limit.
docs/violent_motions.md has the results."""
import dataclasses
import math

from program import DONE, STOPPED, faults, reason_without_numbers

STRETCHES = (1.1, 1.2, 1.35, 1.5, 2.0)
GRAVITIES = (0, 5, 20)
DEGREES, HIGH_DEGREES = (3, 4), (5, 6, 7, 8)
MAP_STRETCHES, MAP_GRAVITIES = (1.05, 1.1, 1.2, 1.35, 1.5, 2.0, 3.0), (0, 1, 5, 20, 50)
MAP_SPINS, MAP_LAWS = (0.5, 1.0, 2.0), ("mooney-rivlin", "gent")
LAWS_WITH_SURFACE_LIMIT = ("neo-hookean", "mooney-rivlin")
END, INTERVAL = 60, 0.1
MOST_DRIFT = 1e-3
LONGEST, LONGEST_OF_HIGH = 90, 3600


@dataclasses.dataclass(frozen=True)
class Release:
    degree: int
    gamma: float
    stretch: float
    spin: float = 0
    law: str = "neo-hookean"
    tolerance: float = 1e-6

    def entries(self, end):
        side, spin = 1 / math.sqrt(self.stretch), self.spin
        return {"Models": "continuum", "Continuum/Degree": self.degree, "Material/Law": self.law,
                "Gravity/Constant": repr(3 * self.gamma / (4 * math.pi)),
                "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, {self.stretch!r}",
                "Initial state/Velocity": f"0, 0, 0; 0, 0, {-spin * self.stretch!r}; 0, {spin * side!r}, 0",
                "Time/End": end, "Time/Tolerance": self.tolerance, "Output/Samples": round(end / INTERVAL)}


def energy_of_motion(table, gamma):
    """At the start: kinetic and elastic energy, and that of self-gravity over the energy −(3/5)GM²/r of the ball at rest."""
    at_rest = -0.6 * 3 * gamma / (4 * math.pi) * (4 * math.pi / 3)**2
    return sum(table.column(name)[0] for name in ("kinetic", "elastic")) + (table.column("gravitational")[0] - at_rest if gamma else 0)


def outcome(run, gamma):
    counters = run.manifest()["models"]["continuum"]["counters"]
    table = run.table("continuum")
    energy, elastic = table.column("energy"), table.column("elastic")
    change = max(abs(x - energy[0]) for x in energy)
    record = {"outcome": "finished", "time": table.column("time")[-1], "biot_time": counters.get("surface_limit_time", ""),
              "drift": change / elastic[0], "drift_of_motion": change / energy_of_motion(table, gamma), "least_jacobian": min(table.column("min_jacobian")),
              "volume_error": max(table.column("volume_error")),
              "steps": counters.get("steps", ""), "forces": counters.get("forces", ""), "repeated_forces": counters.get("repeated_forces", ""),
              "stable_steps": round(counters.get("stable_steps", 0)),
              "repeated_intervals": counters.get("repeated_intervals", ""), "reason": ""}
    if run.too_long:
        record["outcome"] = "long"
    elif run.code == STOPPED:
        record.update({"outcome": "ended", "reason": reason_without_numbers(run.stop()[1])})
    return record


def judge(record):
    if not record["least_jacobian"] > 0:
        yield "an element is turned inside out in the table"
    if record["outcome"] == "ended" and record["biot_time"] == "" and record["law"] in LAWS_WITH_SURFACE_LIMIT:
        yield "ended before Biot's limit"
    if record["outcome"] == "finished" and record["drift_of_motion"] > MOST_DRIFT:
        yield f"the energy changes by {record['drift_of_motion']:.1e} of that of the motion"


def run(program, quick, **_):
    if quick:
        return releases(program, (Release(3, gamma, 1.5) for gamma in (0, 5)), 10, LONGEST)
    return releases(program, grid(DEGREES, GRAVITIES, STRETCHES), END, LONGEST)


def run_high(program, quick, **_):
    """Some hours of processor time; nothing in the short form."""
    if quick:
        return []
    list_of_releases = grid(HIGH_DEGREES, GRAVITIES, STRETCHES[2:])
    return releases(program, [dataclasses.replace(release, tolerance=1e-4) for release in list_of_releases], END, LONGEST_OF_HIGH)


def run_map(program, quick, **_):
    """Nothing in the short form, because the part `violent` has it."""
    if quick:
        return []
    variations = [{"spin": spin} for spin in MAP_SPINS] + [{"law": law} for law in MAP_LAWS]
    return releases(program, [*grid((3,), MAP_GRAVITIES, MAP_STRETCHES),
                              *(dataclasses.replace(release, **variation) for variation in variations
                                for release in grid((3,), GRAVITIES[:2], STRETCHES[::2]))], END, LONGEST_OF_HIGH)


def grid(degrees, gravities, stretches):
    return [Release(degree, gamma, stretch) for gamma in gravities for stretch in stretches for degree in degrees]


def releases(program, list_of_releases, end, longest):
    """The records of the releases. Neighbours in the list that differ by their degree alone are compared."""
    records, before = [], None
    for release in list_of_releases:
        result = program.run(release.entries(end), limit=longest)
        record = {"kind": f"degree {release.degree}", **dataclasses.asdict(release), "code": result.code,
                  "seconds": round(result.seconds, 2), "too_long": bool(result.too_long), "q33_apart": ""}
        found, table = list(faults(result)), None
        if not found and result.code in (DONE, STOPPED):
            record.update(outcome(result, release.gamma))
            found += judge(record)
            table = result.table("continuum")
        if before and table and dataclasses.replace(before[0], degree=release.degree) == release:
            of_before = before[1]
            of_before["q33_apart"] = apart(before[2], table, min(t or math.inf for t in (of_before["biot_time"], record["biot_time"])))
        record["faults"] = "; ".join(found)
        records.append(record)
        before = (release, record, table) if table else None
    return records


def apart(table, other, end):
    rows = zip(table.column("time"), table.column("Q33"), other.column("Q33"))
    return max(abs(a - b) for time, a, b in rows if time <= end)
