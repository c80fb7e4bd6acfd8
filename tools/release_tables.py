"""Tables of the release of the ball by this and by other programs as (header, rows of texts), from the files of
docs/benchmarks/data; None without data."""

import pathlib

from benchmark_data import cheapest, discretization, read_notes, read_rows, release_times, time_for
from benchmark_tables import NONE, number, two_digits

PEERS = ("FEniCSx", "GetFEM")
REFERENCES = pathlib.Path(__file__).resolve().parents[1] / "benchmarks" / "references"


def release_ratio(data, level, column):
    own, peer = release_times(data, level, column)
    return peer / own


def release(data):
    rows, peers = read_rows(data, "ball_release.csv"), read_rows(data, "fenicsx_release.csv")
    if not rows:
        return None
    result = []
    for level in (3e-4, 1e-4, 5e-5, 2.5e-5, 1.3e-5, 1e-5, 5e-6, 2e-6):
        own, peer = cheapest(rows, level), cheapest(peers, level)
        line = [f"{level:.1e}"]
        line += [f"{discretization(own)} ({own['unknowns']}), {own['method']}, tolerance {float(own['tolerance']):.0e}",
                 number(float(own["seconds"])), number(float(own["motion_seconds"])),
                 f"{float(own['error']):.1e}"] if own else [NONE] * 4
        line += [f"{discretization(peer)} ({peer['unknowns']}), {peer['scheme']}, step {peer['step']}", number(float(peer["seconds"])),
                 *(number(release_ratio(data, level, column), 2) for column in ("motion_seconds", "seconds"))] \
            if own and peer else [NONE] * 4
        result.append(line)
    return ["error at most", "pseudorigid (coordinates)", "s, process", "s, motion", "its error",
            "FEniCSx (coordinates and pressures)", "s",
            "FEniCSx / our motion, interpolated", "FEniCSx / our process, interpolated"], result


def release_runs(data):
    rows = read_rows(data, "ball_release.csv")
    return (["discretisation", "method", "tolerance", "step", "unknowns", "s, process", "s, motion", "error"],
            [[discretization(r), r["method"], f"{float(r['tolerance']):.0e}", number(float(r["step"])), r["unknowns"],
              number(float(r["seconds"])), number(float(r["motion_seconds"])), f"{float(r['error']):.1e}"] for r in rows]) if rows else None


def runs_of_peer(data, name):
    rows = read_rows(data, name)
    return (["discretisation", "scheme", "step", "unknowns", "s", "error", "iterations a step", "factorisations"],
            [[discretization(r), r["scheme"], r["step"], r["unknowns"], number(float(r["seconds"])),
              f"{float(r['error']):.1e}", r["iterations_per_step"], r["factorizations"]]
             for r in rows]) if rows else None


def time_within_front(runs, level):
    """Of the cheapest run if it has more than twice this accuracy, None: it would not be a time for the error `level`."""
    return time_for(runs, level) if min(runs)[1] > level / 2 else None


def three_programs(data):
    """The times for one error, interpolated in logarithms on the front of each program."""
    runs = read_rows(data, "three_programs.csv")
    rows = []
    for level in (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6):
        own, *of_peers = (time_within_front([(float(r["seconds"]), float(r["error"])) for r in runs if r["program"] == name], level)
                          for name in ("pseudorigid", *PEERS))
        rows.append([f"{level:.0e}", *(number(t, 2) if t else NONE for t in (own, *of_peers)),
                     *(two_digits(t / own) if t and own else NONE for t in of_peers)])
    return (["error", "s, pseudorigid", *(f"s, {name}" for name in PEERS), *(f"{name} / pseudorigid" for name in PEERS)],
            rows) if runs else None


def sizes(data):
    """The time of a step over the number of unknowns: of symmetric-4, and of the midpoint rule with factors or a preconditioner that
    are made once."""
    rows = [["pseudorigid", discretization(r), r["unknowns"], "symmetric-4", NONE, number(float(r["seconds_step"])),
             two_digits(1e6 * float(r["seconds_step"]) / int(r["unknowns"]))] for r in read_rows(data, "release_sizes.csv")]
    for name in PEERS:
        rows += [[name, discretization(r), r["unknowns"], r["solver"], number(float(r["seconds_factors"])),
                  number(float(r["seconds_step"])), two_digits(1e6 * float(r["seconds_step"]) / int(r["unknowns"]))]
                 for r in read_rows(data, f"{name.lower()}_sizes.csv")]
    return (["program", "discretisation", "unknowns", "method or solver", "s, set-up", "s, step", "µs a step and unknown"],
            rows) if rows else None


def references(data):
    """How far the reference of FEniCSx alone is from ours, and the bars of both."""
    other = read_rows(data, "fenicsx_reference.csv")
    if not other:
        return None
    own = read_rows(REFERENCES, "ball_release.csv")
    apart = max(abs(float(a["Q33"]) - float(b["Q33"])) for a, b in zip(own, other))
    bars = [read_notes(folder, name)[0].split()[-1] for folder, name in
            ((REFERENCES, "ball_release.csv"), (data, "fenicsx_reference.csv"))]
    return (["reference", "uncertainty of Q33"],
            [["pseudorigid, degrees 4 to 6 refined once", bars[0]], ["FEniCSx alone, degrees 3 to 5 refined once", bars[1]],
             ["largest difference of the two", f"{apart:.1e}"]])


def static_figures(data):
    """A ball at rest in a trap, mesh by mesh. The error is the difference from the finest mesh of pseudorigid."""
    own = read_rows(data, "static_figure.csv")
    others = {(r["degree"], r["refinements"]): r for r in read_rows(data, "fenicsx_static.csv")}
    if not own or not others:
        return None
    finest = float(own[-1]["Q33"])
    rows = []
    for r in own[:-1]:
        other = others[r["degree"], r["refinements"]]
        rows.append([discretization(r), f"{r['unknowns']} / {other['unknowns']}",
                     *(f"{abs(float(of['Q33']) - finest):.0e}" for of in (r, other)), number(float(r["seconds"]), 2),
                     number(float(other["seconds"]), 2)])
    return ["discretisation", "coordinates / unknowns of FEniCSx", "error of Q33, pseudorigid", "FEniCSx",
            "s, pseudorigid with small motions and error bars", "s, FEniCSx"], rows
