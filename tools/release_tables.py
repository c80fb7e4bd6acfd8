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


def times_for_errors(data, names, levels):
    """[(error, times of the programs)], interpolated in logarithms on the front of each program."""
    runs = read_rows(data, "three_programs.csv")
    return [(level, [time_within_front(runs_of, level) for runs_of in
                     ([(float(r["seconds"]), float(r["error"])) for r in runs if r["program"] == name] for name in names)])
            for level in levels] if runs else []


def ratio(a, b):
    return two_digits(a / b) if a and b else NONE


def three_programs(data):
    rows = [[f"{level:.0e}", *(number(t, 2) if t else NONE for t in (own, *of_peers)), *(ratio(t, own) for t in of_peers)]
            for level, (own, *of_peers) in times_for_errors(data, ("pseudorigid", *PEERS), (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6))]
    return (["error", "s, pseudorigid", *(f"s, {name}" for name in PEERS), *(f"{name} / pseudorigid" for name in PEERS)],
            rows) if rows else None


def method_and_implementation(data):
    """The ratio to FEniCSx as a product: one method in two programs, and two methods in one program."""
    names = ("pseudorigid", "midpoint inside", "FEniCSx")
    rows = [[f"{level:.0e}", *(number(t, 2) if t else NONE for t in (own, inside, peer)), ratio(inside, own), ratio(peer, inside)]
            for level, (own, inside, peer) in times_for_errors(data, names, (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6))]
    return (["error", "s, explicit", "s, midpoint inside", "s, FEniCSx", "method: midpoint inside / explicit",
             "implementation: FEniCSx / midpoint inside"], rows) if rows else None


def ranks(data):
    """The wall time of a step on one and on two ranks."""
    rows = {}
    for r in read_rows(data, "release_ranks.csv") + read_rows(data, "fenicsx_ranks.csv"):
        of_case = rows.setdefault((r["program"], discretization(r), r["unknowns"], r["solver"]), {})
        of_case[r["ranks"]] = (r["seconds_factors"], float(r["seconds_step"]))
    result = []
    for case, of_ranks in rows.items():
        (factors_1, step_1), (factors_2, step_2) = of_ranks["1"], of_ranks["2"]
        set_up = [number(float(s), 2) if s else NONE for s in (factors_1, factors_2)]
        result.append([*case, *set_up, number(step_1, 2), number(step_2, 2), two_digits(step_1 / step_2)])
    return (["program", "discretisation", "unknowns", "method or solver", "s, set-up, 1 rank", "2 ranks", "s, step, 1 rank", "2 ranks",
             "1 rank / 2 ranks"], result) if result else None


def modes(data):
    """The 12 lowest frequencies with all their modes: one pair of matrices in both programs, and the best pair of FEniCSx."""
    others = {}
    for r in read_rows(data, "fenicsx_modes.csv"):
        others.setdefault((r["degree"], r["refinements"]), {})[r["mass"], r["pressure"], r["sectors"]] = r
    rows = []
    for own in read_rows(data, "mode_cost.csv"):
        of_mesh = others.get((own["degree"], own["refinements"]), {})
        same, usual = of_mesh.get(("lumped", "X", "4")), of_mesh.get(("consistent", "xi", "4"))
        rows.append([discretization(own), own["unknowns"], number(float(own["seconds"]), 2), f"{float(own['error_S2']):.0e}",
                     *(cell for other in (same, usual) for cell in ((number(float(other["seconds"]), 2), f"{float(other['error_S2']):.0e}")
                                                                     if other else (NONE, NONE)))])
    return (["discretisation", "coordinates", "s, pseudorigid", "error of S2", "s, FEniCSx, same matrices", "error of S2",
             "s, FEniCSx, its usual matrices", "error of S2"], rows) if rows else None


def nearly_incompressible(data):
    """The times of both forms of the bulk term for one error, interpolated in logarithms on their fronts."""
    runs, rows = read_rows(data, "nearly_incompressible.csv"), []
    for modulus in dict.fromkeys(r["lambda"] for r in runs):
        for level in (1e-4, 3e-5):
            times = [time_within_front([(float(r["seconds"]), float(r["error"])) for r in runs
                                        if (r["lambda"], r["bulk"]) == (modulus, bulk)], level) for bulk in ("pointwise", "projected")]
            rows.append([f"{float(modulus):g}", f"{level:.0e}", *(number(t, 2) if t else NONE for t in times), ratio(*times)])
    return (["λ/μ", "error", "s, pointwise", "s, projected", "pointwise / projected"], rows) if rows else None


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


def error_or_bound(error):
    """An error with one digit; the tables have twelve decimals."""
    return f"{error:.0e}" if error > 1e-12 else "< 1e-12"


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
                     *(error_or_bound(abs(float(of["Q33"]) - finest)) for of in (r, other)), number(float(r["seconds_figure"]), 2),
                     number(float(other["seconds"]), 2), ratio(float(other["seconds"]), float(r["seconds_figure"])),
                     number(float(r["seconds"]), 2)])
    return ["discretisation", "coordinates / unknowns of FEniCSx", "error of Q33, pseudorigid", "FEniCSx", "s, pseudorigid", "s, FEniCSx",
            "FEniCSx / pseudorigid", "s, with small motions and error bars"], rows


def static_figures_of_getfem(data):
    """The same by GetFEM, on its own meshes, with the cheapest figure of pseudorigid that is at least as accurate."""
    own, others = (read_rows(data, name) for name in ("static_figure.csv", "getfem_static.csv"))
    if not own or not others:
        return None
    finest = float(own[-1]["Q33"])
    figures = [{**r, "seconds": r["seconds_figure"], "error": abs(float(r["Q33"]) - finest)} for r in own[:-1]]
    rows = []
    for r in others:
        error = abs(float(r["Q33"]) - finest)
        figure = cheapest(figures, error)
        rows.append([discretization(r), r["unknowns"], error_or_bound(error), number(float(r["seconds"]), 2),
                     *((discretization(figure), error_or_bound(figure["error"]), number(float(figure["seconds"]), 2),
                        ratio(float(r["seconds"]), float(figure["seconds"]))) if figure else [NONE] * 4)])
    return ["GetFEM", "unknowns", "error of Q33", "s", "pseudorigid", "error of Q33", "s", "GetFEM / pseudorigid"], rows
