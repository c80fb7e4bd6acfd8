"""Pictures of the benchmarks. Needs Debian's python3-matplotlib."""

import statistics
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.patheffects as effects  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter  # noqa: E402

from benchmark_data import (  # noqa: E402
    discretization, errors_of, front, read_rows, release_uncertainty, runs_of_skipping, work_precision)
from pseudorigid import figures  # noqa: E402  (on the path by benchmark_data)

# Okabe and Ito's colours and some more; marker and kind of line alone tell the methods apart. Own methods have full
# lines, rivals broken ones.
STYLES = {
    "symmetric-8": ("#0072B2", "o", "-"),
    "symmetric-12": ("#56B4E9", "s", "-"),
    "explicit-8": ("#009E73", "D", "-"),
    "gauss-16": ("#A50F15", "o", "-"),
    "rattle-8": ("#000000", "^", "-"),
    "rattle-6": ("#555555", "v", "-"),
    "rattle-4": ("#777777", "<", "-"),
    "rattle": ("#999999", ">", "-"),
    "energy-momentum": ("#7F3C8D", "P", "-"),
    "GSL rk8pd": ("#D55E00", "o", "--"),
    "odeint rkf78": ("#E69F00", "s", "--"),
    "odeint Bulirsch-Stoer": ("#CC79A7", "D", "--"),
    "odeint Bulirsch-Stoer dense": ("#CC79A7", "X", "-."),
    "CVODE Adams": ("#8B4513", "^", ":"),
    "CVODE BDF": ("#8B4513", "<", ":"),
    "ARKODE order 8": ("#999933", "v", ":"),
    "SciPy DOP853": ("#333333", "P", ":"),
}
PROBLEMS = {
    "sl3": "neo-Hookean pseudo-rigid ball on SL(3)",
    "rigid_body": "free rigid body",
    "double_pendulum": "double pendulum",
    "gravitating": "fluid ellipsoid with gravity",
}
DEGREES = {2: ("#000000", "o"), 3: ("#E69F00", "s"), 4: ("#56B4E9", "D"), 5: ("#009E73", "^"), 6: ("#0072B2", "v"),
           7: ("#D55E00", "<"), 8: ("#CC79A7", ">")}
LINES = ("-", "--", ":", "-.")  # by refinements
KERNELS = {"force": ("#0072B2", "o", "force"), "constraint": ("#009E73", "s", "constraint"),
           "rate": ("#E69F00", "D", "rate of the constraint"), "reaction": ("#CC79A7", "^", "reaction"),
           "gram": ("#000000", "v", "action of S"),
           "FEEvaluation/1": ("#D55E00", "x", "force by dealii::FEEvaluation, 1 lane"),
           "FEEvaluation/4": ("#8B4513", "+", "force by dealii::FEEvaluation, 4 lanes"),
           "FEEvaluation/8": ("#8B4513", "+", "force by dealii::FEEvaluation, 8 lanes")}


def make(width=8, height=4.8):
    plt.rcParams.update({"font.size": 11, "font.family": "DejaVu Sans"})
    return plt.subplots(figsize=(width, height), layout="constrained")


def finish(axes, legend_columns=1):
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False, fontsize=9.5, ncols=legend_columns)


def plain_numbers(axis):
    """10, 20, 50, 100 … on a logarithmic axis."""
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    axis.set_minor_formatter(FuncFormatter(lambda v, _: f"{v:g}" if f"{v:g}"[0] in "25" else ""))


def save(figure, path):
    figures.save(figure, path, dpi=120)
    return path


def bare(method):
    return method.removesuffix(" (constrained)").removesuffix(" (angles)")


def draw_methods(data, images, problem):
    methods = work_precision(data).get(problem)
    if not methods:
        return None
    figure, axes = make(9, 5.2 + 0.1 * max(0, len(methods) - 15))
    for method in sorted(methods, key=lambda m: (m.endswith("(angles)"), list(STYLES).index(bare(m)))):
        color, marker, line = STYLES[bare(method)]
        points = front(methods[method])
        axes.loglog([1e3 * p[0] for p in points], [p[1] for p in points], color=color, marker=marker, linestyle=line,
                    linewidth=1.6, markersize=5, label=method,
                    markerfacecolor="white" if method.endswith("(angles)") else color)
    axes.set_xlabel("processor time of the run (ms)")
    axes.set_ylabel("largest error of positions and velocities")
    axes.set_title(f"{PROBLEMS[problem]}, 0 ≤ t ≤ 100", loc="left", fontsize=12)
    axes.set_ylim(1e-14, 1e-2)
    finish(axes)
    return save(figure, images / f"benchmark_{problem}.svg")


def draw_discretizations(axes, rows):
    """Every discretisation's front, in the order of degree and refinements."""
    runs = defaultdict(list)
    for row in rows:
        runs[int(row["degree"]), int(row["refinements"])].append((float(row["seconds"]), float(row["error"]), row))
    for (degree, refinements), points in sorted(runs.items()):
        colour, marker = DEGREES[degree]
        points = front(points)
        axes.loglog([p[0] for p in points], [p[1] for p in points], color=colour, marker=marker, markersize=5.5,
                    linewidth=1.3, linestyle=LINES[refinements], label=discretization(points[0][2]),
                    markerfacecolor=colour if refinements == 0 else "white")


def draw_uncertainty(axes, data):
    """Errors near this line are those of the reference as much as of the run."""
    uncertainty = release_uncertainty(data)
    if uncertainty is None:
        return
    axes.axhline(uncertainty, color="#777777", linewidth=0.8)
    axes.annotate(f"uncertainty of the reference, {uncertainty:.1e}", (0, uncertainty), xytext=(4, 3), fontsize=9,
                  xycoords=("axes fraction", "data"), textcoords="offset points", color="#555555")


def draw_release(data, images):
    rows = read_rows(data, "ball_release.csv")
    if not rows:
        return None
    figure, axes = make(9, 5.4)
    draw_discretizations(axes, rows)
    draw_uncertainty(axes, data)
    peers = read_rows(data, "fenicsx_release.csv")
    for scheme, marker, line in (("midpoint", "P", "-."), ("midpoint, order 4", "X", (0, (1, 1)))):
        points = front([(float(r["seconds"]), float(r["error"])) for r in peers if r["scheme"] == scheme])
        if points:
            axes.loglog(*zip(*points), color="#8B4513", marker=marker, markersize=7, linewidth=1.6, linestyle=line,
                        label=f"FEniCSx, {scheme}")
    axes.set_xlabel("processor time of the run after start-up (s)")
    axes.set_ylabel("largest error of $Q_{33}$, 0 ≤ t ≤ 5")
    axes.set_title("nonlinear release of the ball, velocity 0.3 (x, y, −2z)", loc="left", fontsize=12)
    finish(axes)
    return save(figure, images / "benchmark_ball_release.svg")


def draw_three_programs(data, images):
    """Every run, and the front of each program."""
    rows = read_rows(data, "three_programs.csv")
    if not rows:
        return None
    figure, axes = make()
    for program, colour, marker in (("pseudorigid", "#0072B2", "o"), ("midpoint inside", "#CC79A7", "D"), ("FEniCSx", "#D55E00", "s"),
                                    ("GetFEM", "#009E73", "^")):
        points = [(float(r["seconds"]), float(r["error"])) for r in rows if r["program"] == program]
        axes.loglog(*zip(*points), color=colour, marker=marker, markersize=4, linestyle="", alpha=0.4)
        axes.loglog(*zip(*front(points)), color=colour, marker=marker, markersize=6, linewidth=1.6, label=program)
    draw_uncertainty(axes, data)
    axes.set_xlabel("time of the motion (s)")
    axes.set_ylabel("largest error of $Q_{33}$, 0 ≤ t ≤ 5")
    axes.set_title("nonlinear release of the ball by three programs, one run", loc="left", fontsize=12)
    finish(axes)
    return save(figure, images / "benchmark_three_programs.svg")


def draw_ladder(data, images):
    """Error against the time of the whole process, each rung by the cheapest of its runs with nearly its least error."""
    rows = read_rows(data, "ladder.csv")
    if not rows:
        return None
    figure, axes = make()
    for model, colour, marker, label, letter in (
            ("polynomial", "#009E73", "o", "polynomial bodies of degree N", "N"),
            ("continuum", "#0072B2", "s", "finite elements of degree k", "k")):
        rungs = defaultdict(list)
        for row in rows:
            if row["model"] == model:
                rungs[int(row["degree"])].append((float(row["seconds"]), float(row["error"])))
        points = []
        for degree, runs in sorted(rungs.items()):
            least = min(error for _, error in runs)
            points.append((*min(run for run in runs if run[1] <= 1.1 * least), degree))
        axes.loglog([p[0] for p in points], [p[1] for p in points], color=colour, marker=marker, markersize=6,
                    linewidth=1.4, label=label)
        for seconds, error, degree in points:
            axes.annotate(f"{letter} = {degree}", (seconds, error), xytext=(7, 4), textcoords="offset points", fontsize=9,
                          color=colour)
    draw_uncertainty(axes, data)
    plain_numbers(axes.xaxis)
    axes.set_xlabel("processor time from the start of the process to its end (s)")
    axes.set_ylabel("largest error of $Q_{33}$, 0 ≤ t ≤ 5")
    axes.set_title("ladder of models: nonlinear release of the ball", loc="left", fontsize=12)
    finish(axes)
    return save(figure, images / "benchmark_ladder.svg")


def draw_summary(data, images):
    """The picture of README.md, which is shown small: no more than the two fronts of the release."""
    own, peers = errors_of(data, "ball_release.csv"), errors_of(data, "fenicsx_release.csv")
    if not own:
        return None
    figure, axes = make(5, 4)
    for points, name, colour, marker, line, place, side in (
            (own, "pseudorigid", "#0072B2", "o", "-", (-6, -14), "right"),
            (peers, "FEniCSx", "#D55E00", "s", "--", (8, 8), "left")):
        if points := front(points):
            axes.loglog(*zip(*points), color=colour, marker=marker, linestyle=line, linewidth=1.8, markersize=6)
            axes.annotate(name, points[len(points) // 2], xytext=place, textcoords="offset points", color=colour,
                          ha=side, fontsize=12)
    draw_uncertainty(axes, data)
    axes.set_xlabel("processor time of the run (s)")
    axes.set_ylabel("largest error of $Q_{33}$ (dimensionless)")
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    return save(figure, images / "benchmark_summary.svg")


REFINED = (("#0072B2", "unrefined"), ("#D55E00", "refined once"), ("#000000", "refined twice"))


def draw_degrees(axes, points, refinements, marker, prefix=""):
    """(seconds, error, degree) of discretisations with the same refinements, each with its degree beside it."""
    colour, name = REFINED[refinements]
    points = sorted(points, key=lambda point: point[2])
    axes.loglog([p[0] for p in points], [p[1] for p in points], color=colour, marker=marker, markersize=6,
                linestyle=LINES[refinements], label=prefix + name,
                markerfacecolor="white" if marker == "s" else colour)
    for seconds, error, degree in points:
        axes.annotate(str(degree), (seconds, error), xytext=(6, 3), textcoords="offset points", fontsize=9, zorder=5,
                      color=colour, path_effects=[effects.withStroke(linewidth=2.5, foreground="white")])


def draw_lamb(data, images):
    rows = read_rows(data, "lamb_response.csv")
    if not rows:
        return None
    figure, axes = make()
    for refinements in range(3):
        own = [(float(r["seconds"]), float(r["error"]), int(r["degree"])) for r in rows
               if int(r["refinements"]) == refinements]
        if own:
            fastest = [min(p for p in own if p[2] == degree) for degree in {p[2] for p in own}]
            draw_degrees(axes, fastest, refinements, "o")
    axes.set_xlabel("processor time of one run, set-up included (s)")
    axes.set_ylabel("largest error / largest response, 0 ≤ t ≤ 5")
    axes.set_title("small affine release; numbers are degrees", loc="left", fontsize=12)
    finish(axes)
    return save(figure, images / "benchmark_lamb.svg")


def draw_frequency(data, images):
    rows = read_rows(data, "ball_frequency.csv")
    if not rows:
        return None
    figure, axes = make()
    for way, marker in (("octant", "o"), ("all parities", "s")):
        for refinements in range(3):
            own = [(float(r["seconds"]), float(r["error"]), int(r["degree"])) for r in rows
                   if r["way"] == way and int(r["refinements"]) == refinements]
            if own:
                draw_degrees(axes, own, refinements, marker, f"{way}, ")
    axes.set_xlabel("processor time from mesh to eigenvalue (s)")
    axes.set_ylabel("relative error of the frequency S2")
    axes.set_title("lowest spheroidal frequency; numbers are degrees", loc="left", fontsize=12)
    finish(axes)
    return save(figure, images / "benchmark_frequency.svg")


def draw_kernels(data, images):
    rows = read_rows(data, "kernels.csv")
    if not rows:
        return None
    figure, axes = make()
    for kernel, (colour, marker, label) in KERNELS.items():
        points = sorted((int(r["degree"]), float(r["per_second"]) / 1e6) for r in rows if r["kernel"] == kernel)
        if points:
            axes.semilogy(*zip(*points), color=colour, marker=marker, linewidth=1.3,
                          linestyle="--" if "/" in kernel else "-", label=label)
    axes.set_xlabel("degree k")
    axes.set_ylabel("million unknowns a second, one core")
    axes.xaxis.set_major_locator(plt.MultipleLocator(1))
    plain_numbers(axes.yaxis)
    axes.set_title("cell kernels on the octant, at least 100,000 unknowns", loc="left", fontsize=12)
    finish(axes)
    return save(figure, images / "benchmark_kernels.svg")


def draw_steps(data, images):
    rows = [r for r in read_rows(data, "ball_steps.csv") if r["ranks"] == "1"]
    if not rows:
        return None
    figure, axes = make()
    for degree in sorted({int(r["degree"]) for r in rows}):
        colour, marker = DEGREES[degree]
        own = sorted((int(r["unknowns"]), float(r["step_per_force"])) for r in rows if int(r["degree"]) == degree)
        axes.semilogx(*zip(*own), color=colour, marker=marker, linewidth=1.3, label=f"k = {degree}")
    axes.set_xlabel("unknowns")
    axes.set_ylabel("a step of symmetric-4 in evaluations of the force")
    axes.set_ylim(bottom=0)
    axes.set_title("cost of a step, released ball, one core", loc="left", fontsize=12)
    finish(axes)
    return save(figure, images / "benchmark_steps.svg")


def draw_skipping(data, images):
    rows = runs_of_skipping(data)
    if not rows:
        return None
    parts = list(dict.fromkeys(r["part"] for r in rows))[::-1]
    figure, axes = make(8, 0.42 * len(parts) + 1.4)
    for y, part in enumerate(parts):
        ratios = [float(r["seconds_with"]) / float(r["seconds"]) for r in rows if r["part"] == part]
        axes.plot(ratios, [y] * len(ratios), "o", color="#0072B2", markersize=6, alpha=0.45, markeredgewidth=0)
        axes.plot(statistics.median(ratios), y, "|", color="#000000", markersize=16, markeredgewidth=2)
    axes.axvline(1, color="#777777", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yticks(range(len(parts)), parts)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.set_xlabel("processor time with the part / without")
    axes.set_title("scenes of params/, with finite elements shortened to t ≤ 1\n"
                   "a dot for each scene, a bar at the median", loc="left", fontsize=10)
    axes.grid(axis="x", color="#dddddd", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    return save(figure, images / "benchmark_skipping.svg")


LONG_RUN = {"rattle-8": ("#000000", "^", "-"), "symmetric-8": ("#0072B2", "o", "--"),
            "symmetric-12": ("#56B4E9", "s", ":"), "energy-momentum": ("#D55E00", "P", "-."),
            "gauss-16": ("#009E73", "D", "-")}
N_INTERVALS = 20


def largest_of_intervals(times, values):
    """(middles, largest values) of N_INTERVALS parts of the time, each with as many samples."""
    cuts = [len(times) * i // N_INTERVALS for i in range(N_INTERVALS + 1)]
    parts = [slice(a, b) for a, b in zip(cuts, cuts[1:]) if b > a]
    return [statistics.mean(times[part]) for part in parts], [max(values[part]) for part in parts]


def draw_errors_of_long_run(axes, rows, column, draw_line):
    """Dots for the samples, a line for the largest error of each interval."""
    for method, (colour, marker, line) in LONG_RUN.items():
        own = [r for r in rows if r["method"] == method]
        if not own:
            continue
        times = [float(r["time"]) / 2e6 for r in own]
        errors = [max(abs(float(r[column])), 1e-17) for r in own]
        draw_line(times, errors, ".", markersize=1.6, color=colour, alpha=0.4, rasterized=True)
        draw_line(*largest_of_intervals(times, errors), color=colour, marker=marker, markersize=4.5, linestyle=line,
                  linewidth=1.1, label=method)
    axes.grid(color="#dddddd", linewidth=0.6)


def draw_long_run(data, images):
    rows = read_rows(data, "long_run.csv")
    if not rows:
        return None
    body, rigid = ([r for r in rows if r.get("problem", "sl3") == problem] for problem in ("sl3", "rigid_body"))
    plt.rcParams.update({"font.size": 11})
    figure, all_axes = plt.subplots(3, 2, sharex="col", figsize=(11, 7.2), layout="constrained")
    columns = [(body, [("energy_error", "energy"), ("J_error", "angular\nmomentum"), ("Z_error", "circulation")]),
               (rigid, [("energy_error", "energy"), ("J_error", "angular\nmomentum"), ("error", "coordinates")])]
    for side, (own, quantities) in enumerate(columns):
        for axes, (column, label) in zip(all_axes[:, side], quantities):
            draw_errors_of_long_run(axes, own, column, axes.loglog if side else axes.semilogy)
            axes.set_ylabel(f"|error| of\n{label}")
    # The growth of a random walk.
    all_axes[0, 1].loglog((1e-2, 1), (1e-13, 1e-12), color="#777777", linewidth=0.9, linestyle="--")
    all_axes[0, 1].annotate("time$^{1/2}$", (0.1, 3e-13), xytext=(4, -12), textcoords="offset points", color="#555555", fontsize=9)
    all_axes[0, 0].set_title("pseudo-rigid ball", fontsize=11)
    all_axes[0, 1].set_title("rigid body", fontsize=11)
    named = {label: line for axes in all_axes[0] for line, label in zip(*axes.get_legend_handles_labels())}
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.95))
    figure.legend(named.values(), named.keys(), loc="upper center", ncols=5, frameon=False, fontsize=10)
    all_axes[-1, 0].set_xlabel("time (millions of pulsations)")
    all_axes[-1, 1].set_xlabel("time / (2·10⁶)")
    return save(figure, images / "benchmark_long_run.png")
