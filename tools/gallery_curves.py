"""The pictures of docs/gallery.md that are curves (tools/gallery.py)."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from run_directory import read_csv  # noqa: E402

# Okabe and Ito's colours: distinct with every kind of colour vision; curves differ in their strokes as well.
BLUE, ORANGE, GREEN, SKY, BLACK, GREY = "#0072B2", "#D55E00", "#009E73", "#56B4E9", "#000000", "#777777"
REDUCED = {"color": ORANGE, "linestyle": "--", "label": "pseudo-rigid ball"}
CONTINUUM = {"color": BLUE, "linestyle": "-", "label": "elastic ball"}
TIME = "time (r/c)"


def table(directory, name):
    return {column: np.array(values) for column, values in read_csv(directory / f"{name}.csv").items()}


def both(directory):
    return table(directory, "continuum"), table(directory, "reduced")


def figure(n_rows=1, n_columns=1, height=3.2, **options):
    plt.rcParams.update({"font.size": 10.5, "font.family": "DejaVu Sans", "lines.linewidth": 1.7})
    drawn, axes = plt.subplots(n_rows, n_columns, figsize=(8, height), layout="constrained", squeeze=False, **options)
    for ax in axes.flat:
        ax.grid(color="#dddddd", linewidth=0.6)
        ax.spines[["top", "right"]].set_visible(False)
    return drawn, list(axes.flat)


def save(drawn, path):
    drawn.savefig(path, dpi=100)
    plt.close(drawn)


def legend_above(ax, n_columns):
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=n_columns, frameon=False)


def label_axes(ax, x, y):
    ax.set_xlabel(x)
    ax.set_ylabel(y)


def two_models(ax, directory, column, y):
    for models_table, style in zip(both(directory), (CONTINUUM, REDUCED)):
        ax.plot(models_table["time"], column(models_table), **style)
    label_axes(ax, TIME, y)


def stretch_along_z(t):
    return np.sqrt(t["Q13"] ** 2 + t["Q23"] ** 2 + t["Q33"] ** 2)


def lamb(run, path):
    """The release with a velocity of lamb.prm: Q33 = 1 − 2·10⁻³ Σ f_k sin(ω_k t)/ω_k by Lamb's modes."""
    directory = run("lamb", "Time/End=20", "Output/Samples=400")
    drawn, (ax,) = figure(height=3.4)
    two_models(ax, directory, lambda t: 1e3 * (t["Q33"] - 1), "(Q$_{33}$ − 1) · 10³")
    t = table(directory, "reduced")["time"][::4]
    modes = ((0.9164349, 2.665622189236), (0.0754642, 5.473039811966), (0.0057270, 8.877243237))
    exact = -2 * sum(f * np.sin(omega * t) / omega for f, omega in modes)
    ax.plot(t, exact, ".", color=BLACK, markersize=4, label="exact sphere, three modes (Lamb 1882)")
    legend_above(ax, 3)
    save(drawn, path)


RUNGS = ((1, ORANGE, "--"), (3, GREEN, "-."), (5, SKY, (0, (5, 1, 1, 1, 1, 1))), (7, BLACK, ":"))


def ladder(run, path):
    directory = run("ladder")
    elements = table(directory, "continuum")
    drawn, (left, right) = figure(1, 2, height=3.6)
    left.plot(elements["time"], elements["Q33"] - 1, color=BLUE, label="finite elements")
    for degree, colour, line in RUNGS:
        body = table(directory, f"polynomial-{degree}" if degree < RUNGS[-1][0] else "polynomial")
        if degree <= 3:
            left.plot(body["time"], body["Q33"] - 1, color=colour, linestyle=line, label=f"N = {degree}")
        difference = np.abs(body["Q33"] - elements["Q33"])[1:].reshape(-1, 20)  # of two units of time each
        right.semilogy(body["time"][1:].reshape(-1, 20).mean(axis=1), difference.max(axis=1), color=colour,
                       linestyle=line, label=f"N = {degree}")
    left.set_xlim(0, 20)
    right.set_ylim(1e-5, 1e-1)
    label_axes(left, TIME, "stretch $Q_{33}$ − 1")
    label_axes(right, TIME, "largest difference from the elements")
    legend_above(left, 2)
    legend_above(right, 2)
    save(drawn, path)


def amplitude(run, path):
    t = table(run("amplitude"), "sweep")
    drawn, (ax,) = figure(height=3.6)
    A = t["amplitude"] / np.sqrt(6)  # C = diag(1/l, 1/l, l²) has the amplitude √6 A to leading order, A that of ln l
    for (degree, colour, line), marker in zip(RUNGS, "os^"):
        chosen = t["N"] == degree
        square, omega = A[chosen] ** 2, t["frequency"][chosen]
        slope, omega_0 = np.polyfit(square, omega, 1)
        ax.plot(square, 100 * (omega / omega_0 - 1), marker, color=colour, label=f"N = {degree}")
    square = np.array([0, 1.05 * max(A**2)])
    ax.plot(square, -100 * 5 / 48 * square, color=ORANGE, linestyle="--", linewidth=1.2, label="−(5/48) A², pseudo-rigid")
    ax.fill_between(square, -100 * 0.106 * square, -100 * 0.102 * square, color=BLUE, alpha=0.25, linewidth=0,
                    label="elastic ball")
    label_axes(ax, "A², A the amplitude of ln ℓ", "change of frequency (%)")
    ax.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    save(drawn, path)


def dirichlet(run, path):
    drawn, (motion, error) = figure(1, 2, height=3.6)
    for stretch, (colour, line) in zip((1.1, 1.3, 1.5), ((GREEN, ":"), (ORANGE, "--"), (BLUE, "-"))):
        narrow = stretch**-0.5
        directory = run("dirichlet", f"Initial state/Deformation={narrow}, 0, 0; 0, {narrow}, 0; 0, 0, {stretch}",
                        "Continuum/Error estimate=none")
        elements, exact = both(directory)
        motion.plot(elements["time"], elements["Q33"], line, color=colour)
        motion.plot(exact["time"][::8], exact["Q33"][::8], ".", color=BLACK, markersize=3.5,
                    label="Dirichlet's ellipsoid (lines: finite elements)" if stretch == 1.5 else None)
        error.semilogy(elements["time"][1:], np.maximum(abs(elements["Q33"] - exact["Q33"])[1:], 1e-10), line, color=colour,
                       label=f"from {stretch}")
    label_axes(motion, "time (1/√(Gρ))", "Q$_{33}$, the axis that was stretched (r)")
    legend_above(motion, 1)
    label_axes(error, "time (1/√(Gρ))", "difference of Q$_{33}$")
    legend_above(error, 3)
    save(drawn, path)


def gravitating_balls(run, path):
    drawn, (pulsation, spinning) = figure(1, 2, height=3.4)
    two_models(pulsation, run("gravitating_ball", "Time/End=10"), lambda t: 1e3 * (t["Q33"] - 1), "(Q$_{33}$ − 1) · 10³")
    pulsation.set_title("pulsation, γ = 5", fontsize=10.5, y=1.1)
    directory = run("spinning_elastic_spheroid", "Continuum/Error estimate=none")
    for models_table, style in zip(both(directory), (CONTINUUM, REDUCED)):
        for axis in "a1", "a3":
            spinning.plot(models_table["time"], models_table[axis], **{**style, "label": style["label"] * (axis == "a1")})
    label_axes(spinning, TIME, "longest and shortest semi-axis (r)")
    spinning.set_title("spinning spheroid, γ = 5", fontsize=10.5, y=1.1)
    for ax in pulsation, spinning:
        legend_above(ax, 2)
    save(drawn, path)


def tidal_passage(run, path):
    drawn, (ax,) = figure(height=3.4)
    for models_table, style in zip(both(run("tidal_passage", "Continuum/Error estimate=none")), (CONTINUUM, REDUCED)):
        ax.plot(models_table["time"] / 3600, 250 * (models_table["Q11"] - 1), **style)
    label_axes(ax, "time (hours)", "axis towards the planet, change (km)")
    legend_above(ax, 2)
    save(drawn, path)


def compressible(run, path):
    drawn, axes = figure(1, 2)
    directory = run("compressible")
    two_models(axes[0], directory, lambda t: t["volume_ratio"], "volume / volume at rest")
    two_models(axes[1], directory, lambda t: t["a1"], "longest semi-axis (r)")
    for ax in axes:
        legend_above(ax, 2)
    save(drawn, path)


def damped_and_pulled(run, path):
    drawn, (damped, pulled) = figure(1, 2)
    two_models(damped, run("damped", "Time/Tolerance=1e-3"), stretch_along_z, "viscous ball: stretch along z")
    two_models(pulled, run("traction"), stretch_along_z, "pulled ball: stretch along z")
    pulled.axhline(1.18234, color=BLACK, linestyle=":", linewidth=1.2, label="exact rest")
    legend_above(damped, 2)
    pulled.legend(loc="lower right", frameon=False)
    save(drawn, path)


def unstable_spheroid(run, path):
    t = table(run("unstable_spheroid"), "reduced")
    drawn, (axes, growth) = figure(1, 2)
    for i, (colour, line) in enumerate(((BLUE, "-"), (ORANGE, "--"), (GREEN, "-.")), 1):
        axes.plot(t["time"], t[f"a{i}"], line, color=colour, label=f"a$_{i}$")
    label_axes(axes, "time (1/√(πGρ))", "semi-axes (r)")
    legend_above(axes, 3)
    growth.semilogy(t["time"][1:], (t["a1"] - t["a2"])[1:], color=BLUE, label="a$_1$ − a$_2$")
    early = t["time"] < 60
    growth.semilogy(t["time"][early], 3e-6 * np.exp(0.1476 * t["time"][early]), ":", color=BLACK, label="∝ e$^{0.1476 t}$")
    label_axes(growth, "time (1/√(πGρ))", "difference of the axes (r)")
    legend_above(growth, 2)
    save(drawn, path)


def rivlin(run, path):
    """Equilibria under equal tension over the traction: axes and energies, by Morse index."""
    drawn, (axes, energies) = figure(1, 2, height=3.6)
    styles = {0: (BLUE, "o", "stable"), 1: (ORANGE, "^", "Morse index 1"), 2: (GREEN, "s", "Morse index 2"),
              5: (GREY, "x", "Morse index 5")}
    points = {index: [] for index in styles}
    for T in np.round(np.arange(1.6, 2.4001, 0.02), 2):
        t = table(run("rivlin", f"Loads/Nominal traction={T}, 0, 0; 0, {T}, 0; 0, 0, {T}"), "equilibria")
        ball = -3 * T * 4 * np.pi / 3
        for k, index in enumerate(t["morse_index"]):
            if t["Q11"][k] + t["Q22"][k] + t["Q33"][k] > 1.5:  # not turned against the traction
                one = t["a1"][k] if abs(t["a2"][k] - t["a3"][k]) < abs(t["a1"][k] - t["a2"][k]) else t["a3"][k]
                points[int(index)].append((T, one, 1e2 * (t["potential"][k] - ball)))
    for index, (colour, marker, label) in styles.items():
        T, one, energy = np.array(points[index]).reshape(-1, 3).T
        for ax, y in ((axes, one), (energies, energy)):
            ax.plot(T, y, marker, color=colour, markersize=3.5, label=label, linestyle="none")
    y = np.linspace(0.7, 2.2, 400)
    axes.plot(y + y**-2, y**-2, "-", color=BLACK, linewidth=0.7, zorder=0, label="exact")
    axes.set_xlim(1.58, 2.42)
    axes.set_ylim(0.15, 2)
    energies.set_ylim(-75, 25)
    label_axes(axes, "traction T (μ)", "axis that differs from the two others (r)")
    label_axes(energies, "traction T (μ)", "potential less that of the ball (10⁻² μr³)")
    axes.legend(frameon=False, fontsize=9)
    save(drawn, path)


def polhodes(run, path):
    """Curves of P on the sphere, and the turn about p in a period of P, from the trajectories."""
    t = table(run("polhodes"), "trajectories")
    drawn = plt.figure(figsize=(8, 4), layout="constrained")
    sphere, turns = drawn.add_subplot(1, 2, 1, projection="3d"), drawn.add_subplot(1, 2, 2)
    eye = np.array([np.cos(np.radians(22)) * np.cos(np.radians(35)), np.cos(np.radians(22)) * np.sin(np.radians(35)),
                    np.sin(np.radians(22))])
    x = np.linspace(-1, 1, 401)
    for sign in (1, -1):  # the separatrix: two planes through the second axis, 60 degrees from the first
        plane = np.array([[0, 1, 0], [0.5, 0, sign * np.sqrt(3) / 2]])
        way = np.cos(np.pi * x)[:, None] * plane[0] + np.sin(np.pi * x)[:, None] * plane[1]
        visible = way @ eye > 0
        sphere.plot(*np.where(visible[:, None], way, np.nan).T, "--", color=BLACK, linewidth=0.9)
    for run_number in range(1, 25):
        chosen = t["run"] == run_number
        P = np.array([t[f"J_body{i}"][chosen] for i in (1, 2, 3)]).T
        first = abs(P[0, 0]) > 0.5
        colour = ORANGE if first else BLUE
        sphere.plot(*np.where((P @ eye > 0)[:, None], P, np.nan).T, color=colour, linewidth=1.3)
        angle = turn_in_a_period(t, chosen, P)
        turns.plot(7.5 + 15 * (run_number - 1), angle / (2 * np.pi), "o" if first else "s", color=colour, markersize=4)
    outline = np.linspace(0, 2 * np.pi, 200)
    across, up = np.cross([0, 0, 1], eye), np.cross(eye, np.cross([0, 0, 1], eye))
    across, up = across / np.linalg.norm(across), up / np.linalg.norm(up)
    sphere.plot(*(np.cos(outline)[:, None] * across + np.sin(outline)[:, None] * up).T, color=GREY, linewidth=0.8)
    for axis, name in zip(np.eye(3), ("1", "2", "3")):
        sphere.text(*(1.25 * axis), name)
        sphere.plot(*np.array([axis, 1.15 * axis]).T, color=BLACK, linewidth=0.8)
    sphere.view_init(22, 35)
    sphere.set_box_aspect((1, 1, 1), zoom=1.25)
    sphere.set_axis_off()
    turns.grid(color="#dddddd", linewidth=0.6)
    turns.spines[["top", "right"]].set_visible(False)
    a = np.arange(0.125, 360, 0.25)
    turns.plot(a, [montgomery(np.radians(angle)) / (2 * np.pi) % 1 for angle in a], ".", color=BLACK, markersize=0.8, zorder=0)
    turns.set_xticks(range(0, 361, 60))
    label_axes(turns, "start on the meridian, from axis 1 (degrees)", "turn about p in a period of P (turns)")
    save(drawn, path)


def montgomery(a, moments=(1.0, 2.0, 3.0)):
    """2ET/L − S, the turn about P = (cos a, 0, sin a) in a period of P."""
    I = np.array(moments)
    E2 = np.cos(a) ** 2 / I[0] + np.sin(a) ** 2 / I[2]
    third = 1 > E2 * I[1]
    i, j, k = I if third else I[::-1]
    rate, m = np.sqrt((k - j) * (1 - E2 * i) / (i * j * k)), (j - i) * (E2 * k - 1) / ((k - j) * (1 - E2 * i))
    x, y = 1.0, np.sqrt(1 - m)
    for _ in range(8):
        x, y = (x + y) / 2, np.sqrt(x * y)
    T, phi = 2 * np.pi / (x * rate), np.linspace(0, 2 * np.pi, 4096, endpoint=False)
    sine2 = (E2 - 1 / k) / (np.cos(phi) ** 2 / i + np.sin(phi) ** 2 / j - 1 / k)
    solid = 2 * np.pi * np.mean(1 - np.sqrt(1 - sine2))
    return E2 * T - solid * (1 if third else -1)


def turn_in_a_period(t, chosen, P):
    """Of the body about p, in [0, 2π): P returns to the plane P2 = 0 on its own side, in its own sense."""
    time, p2 = t["time"][chosen], P[:, 1]
    sense = np.sign(p2[1] - p2[0])
    for n in range(2, len(time)):
        if sense * p2[n - 1] < 0 <= sense * p2[n]:
            break
    weight = p2[n - 1] / (p2[n - 1] - p2[n])  # samples are close enough for a line
    R = [np.array([[t[f"R{i}{j}"][chosen][m] for j in (1, 2, 3)] for i in (1, 2, 3)]) for m in (n - 1, n)]
    R = (1 - weight) * R[0] + weight * R[1]
    p = P[0]  # R = 1 at the start
    across = np.cross(p, [0, 1, 0])
    across /= np.linalg.norm(across)
    return np.arctan2(R @ across @ np.cross(p, across), R @ across @ across) % (2 * np.pi)


def tide(run, path):
    t = table(run("tide"), "reduced")
    drawn, (axes, energy) = figure(1, 2)
    for i, rest, (colour, line) in ((1, 1.01532, (BLUE, "-")), (3, 0.99242, (ORANGE, "--"))):
        axes.plot(t["time"], t[f"a{i}"], line, color=colour, label=f"a$_{i}$")
        axes.axhline(rest, color=BLACK, linestyle=":", linewidth=1.1)
    label_axes(axes, TIME, "longest and shortest semi-axis (r)")
    legend_above(axes, 2)
    energy.plot(t["time"], t["kinetic"], color=BLUE, label="kinetic")
    energy.plot(t["time"], t["dissipated"], "--", color=ORANGE, label="taken by viscosity")
    label_axes(energy, TIME, "energy (ρ c² r³)")
    legend_above(energy, 2)
    save(drawn, path)


def gravitating_tumbler(run, path):
    t = table(run("gravitating_tumbler"), "reduced")
    part = t["time"] <= 8
    drawn, (axes, residual) = figure(2, 1, height=4.4, sharex=True, height_ratios=(2.4, 1))
    for i, (colour, line) in enumerate(((BLUE, "-"), (ORANGE, "--"), (GREEN, "-.")), 1):
        axes.plot(t["time"][part], t[f"A{i}"][part], line, color=colour, label=f"A$_{i}$, followed")
    axes.plot(t["time"][part], t["a2"][part], ":", color=BLACK, linewidth=2.4, label="a$_2$, the middle one")
    axes.set_ylabel("semi-axes (r)")
    legend_above(axes, 4)
    residual.semilogy(t["time"][part], np.maximum(t["bipolar_residual"][part], 1e-17), color=GREY)
    label_axes(residual, TIME, "residual\nof (5.121)")
    save(drawn, path)


def sweep_of_releases(run, path):
    t = table(run("sweep_of_releases"), "sweep")
    drawn, (ax,) = figure(height=3.6)
    strokes = ((BLUE, "-"), (SKY, "--"), (GREEN, "-."), (ORANGE, (0, (5, 1, 1, 1, 1, 1))), (GREY, ":"))
    for b, (colour, line) in zip(sorted(set(t["b"])), strokes):
        chosen = t["b"] == b
        ax.plot(t["l"][chosen], t["a3_min"][chosen], color=colour, linestyle=line, label=f"b = {b:g}")
    l = np.linspace(1.02, 2, 15)
    ax.plot(l, (np.sqrt(l**2 + 8 / l) - l) / 2, ".", color=BLACK, label="b = 0, exact")
    label_axes(ax, "stretch ℓ at which the ball is let go", "least thickness reached (r)")
    ax.legend(frameon=False)
    save(drawn, path)


def three_bodies_and_kepler(run, path):
    drawn, (eight, ellipse) = figure(1, 2, height=3.4)
    t = table(run("three_bodies", "Output/Samples=600"), "mass_points")
    strokes = ((BLUE, "-", "o"), (ORANGE, "--", "s"), (GREEN, ":", "^"))
    for i, (colour, line, marker) in enumerate(strokes, 1):
        third = slice(0, 101)  # of a period: two of them are 600 intervals
        eight.plot(t[f"x{i}"][third], t[f"y{i}"][third], linestyle=line, color=colour, label=f"point {i}")
        eight.plot(t[f"x{i}"][0], t[f"y{i}"][0], marker, color=colour)
    eight.set_aspect("equal", "datalim")
    eight.set_title("three bodies, a third of a period", fontsize=10.5)
    label_axes(eight, "x (unit of length)", "y (unit of length)")
    eight.legend(frameon=False, loc="upper center", ncols=3, fontsize=9)
    t = table(run("jacobi_kepler", "Output/Samples=80"), "jacobi_geodesic")
    first = slice(0, 41)
    ellipse.plot(t["x"][first], t["y"][first], "o-", color=BLUE, markersize=4, linewidth=1)
    ellipse.plot([0], [0], "*", color=BLACK, markersize=10)
    ellipse.set_aspect("equal", "datalim")
    ellipse.set_title("Kepler: equal arcs of the Jacobi metric", fontsize=10.5)
    label_axes(ellipse, "x (unit of length)", "y (unit of length)")
    save(drawn, path)


def double_pendulum(run, path):
    here = table(run("double_pendulum", "Output/Samples=1000"), "double_pendulum")
    there = table(run("double_pendulum", "Output/Samples=1000", "Double pendulum/Angles=2.000001, 2.5"),
                  "double_pendulum")
    drawn, (way, apart) = figure(1, 2, height=3.6)
    way.plot(here["x2"], -here["y2"], color=BLUE, linewidth=0.9, label="lower point")
    way.plot([0, here["x1"][0], here["x2"][0]], [0, -here["y1"][0], -here["y2"][0]], "o-", color=BLACK, linewidth=1.4,
             label="start")
    way.set_aspect("equal", "datalim")
    label_axes(way, "x (m)", "height (m)")
    way.legend(frameon=False, fontsize=9)
    distance = np.hypot(here["x2"] - there["x2"], here["y2"] - there["y2"])
    apart.semilogy(here["time"][1:], distance[1:], color=ORANGE)
    label_axes(apart, "time (s)", "distance of the lower points (m)")
    apart.set_title("two starts 10⁻⁶ apart", fontsize=10.5)
    save(drawn, path)


def sections(run, path):
    """At theta = 0 with unit masses and rods and g = 1: K = E + 2 + cos phi, of which the lower rod's own rate takes a part."""
    drawn, axes = figure(2, 2, height=7)
    for ax, energy in zip(axes, (-2.4, -1.6, -1.0, 0.5)):
        starts = []
        for part in (0, 0.25, 0.5, 0.75):
            widest = np.arccos(max(-1, -energy - 2))
            starts += [(part * widest, 0), (-part * widest, 0)] if part else [(0, 0), (0, 0.6), (0, -0.6)]
        for k, (phi, share) in enumerate(starts):
            # K = a² + ½b² + a b with the rates a of theta and b of phi, at phi: a b cos phi; b = share · its greatest.
            kinetic, c = energy + 2 + np.cos(phi), np.cos(phi)
            b = share * np.sqrt(kinetic / (0.5 - c * c / 4))
            a = -b * c / 2 + np.sqrt(b * b * c * c / 4 - b * b / 2 + kinetic)
            crossings = table(run("double_pendulum_section", f"Double pendulum/Angles=0, {phi:.6f}", "Output/Report=false",
                                  f"Double pendulum/Rates={a:.8f}, {b:.8f}", "Time/End=1500"), "section")
            ax.plot(crossings["phi"], crossings["phi_dot"], ".", markersize=1.1, color=plt.cm.tab20(k % 20), rasterized=True)
        ax.set_title(f"energy {energy:g}".replace("-", "−"), fontsize=10.5)
        label_axes(ax, "φ", "rate of φ")
    save(drawn, path)


def torus_manifolds(run, path):
    drawn, axes = figure(1, 2, height=4)
    for ax, overrides, title in zip(axes, ((), ("Torus/Grain=0.3", "Torus/Grain angle=0.8")),
                                    ("friction the same in all directions", "greater along an oblique grain")):
        directory = run("torus_manifolds", *overrides)
        curves, points = table(directory, "manifolds"), table(directory, "equilibria")
        low = -np.pi / 2
        wrapped = {name: low + np.mod(curves[name] - low, 2 * np.pi) for name in ("w", "u")}
        for curve in np.unique(curves["curve"]):
            of = (curves["curve"] == curve) & (curves["stable"] == 0)
            if not of.any():
                continue
            colour, width = {4: (SKY, 0.7), 3: (ORANGE, 2.2), 2: (BLACK, 1.8)}[int(curves["point"][of][0])]
            w, u = wrapped["w"][of], wrapped["u"][of]
            breaks = np.flatnonzero((np.abs(np.diff(w)) > np.pi) | (np.abs(np.diff(u)) > np.pi)) + 1
            ax.plot(np.insert(w, breaks, np.nan), np.insert(u, breaks, np.nan), color=colour, linewidth=width,
                    zorder=width)
        ax.plot(low + np.mod(points["w"] - low, 2 * np.pi), low + np.mod(points["u"] - low, 2 * np.pi), "o", color=BLACK,
                markersize=5, zorder=5)
        for name, w, u in zip(("sink", "lower saddle", "upper saddle", "source"), points["w"], points["u"]):
            ax.annotate(name, (low + np.mod(w - low, 2 * np.pi), low + np.mod(u - low, 2 * np.pi)), (-6, 5), ha="right",
                        textcoords="offset points", fontsize=9, zorder=6, bbox={"fc": "white", "ec": "none", "pad": 0.5})
        ax.set_title(title, fontsize=10.5)
        label_axes(ax, "w, around the tube", "u, around the axis")
        for ticks in (ax.set_xticks, ax.set_yticks):
            ticks([0, np.pi / 2, np.pi, 3 * np.pi / 2], ["0", "π/2", "π", "3π/2"])
    save(drawn, path)


def tops(run, path):
    drawn, (heavy, free) = figure(1, 2, height=3.8)
    t = table(run("heavy_top", "Output/Samples=1600"), "rigid_body")
    heavy.plot(t["R13"], t["R23"], color=BLUE)
    heavy.plot(t["R13"][:1], t["R23"][:1], "o", color=BLACK)
    heavy.annotate("start", (t["R13"][0], t["R23"][0]), (-0.05, -0.42), ha="right")
    heavy.plot([0], [0], "+", color=BLACK, markersize=10)
    heavy.annotate("upright", (0, 0), (0.04, 0.04))
    heavy.set_aspect("equal", "datalim")
    heavy.set_title("axis of the heavy top, from above", fontsize=10.5)
    label_axes(heavy, "R$_{13}$ (x of the axis)", "R$_{23}$ (y of the axis)")
    t = table(run("free_body", "Output/Samples=1000"), "rigid_body")
    for i, (colour, line) in enumerate(((GREEN, ":"), (BLUE, "-"), (ORANGE, "--")), 1):
        free.plot(t["time"], t[f"Omega{i}"], line, color=colour, label=f"Ω$_{i}$")
    free.set_title("free body, angular velocity along its axes", fontsize=10.5)
    label_axes(free, "time (unit of time)", "Ω (1/unit of time)")
    free.set_ylim(-1.1, 1.5)
    free.legend(frameon=False, ncols=3, loc="upper center", fontsize=9)
    save(drawn, path)


def spherical_pendulum(run, path):
    t = table(run("spherical_pendulum"), "spherical_pendulum")
    drawn, (way, forces) = figure(1, 2, height=3.6)
    way.plot(t["x"], t["y"], color=BLUE, linewidth=0.9)
    way.plot(t["x"][0], t["y"][0], "o", color=BLACK)
    way.set_aspect("equal", "datalim")
    way.set_title("from above", fontsize=10.5)
    label_axes(way, "x (m)", "y (m)")
    early = t["time"] < 5
    forces.plot(t["time"][early], t["tension"][early], color=BLUE, label="by the multiplier")
    forces.plot(t["time"][early][::6], t["tension_by_curvature"][early][::6], ".", color=BLACK, markersize=4,
                label="by the curvature of the sphere")
    label_axes(forces, "time (s)", "force of the rod (N)")
    legend_above(forces, 1)
    save(drawn, path)


def rotor(run, path):
    """The forces of both bearings in space over a turn, for one weight, two and three."""
    drawn, axes = figure(1, 2, height=3.8)
    weights = (("one weight", "0.2, 0, 0.1, 0.05", BLUE, "-"),
               ("and one opposite, in another plane", "0.2, 0, 0.1, 0.05; -0.2, 0, -0.1, 0.05", ORANGE, "--"),
               ("and one opposite, in its plane", "0.2, 0, 0.1, 0.05; -0.2, 0, 0.1, 0.05", GREEN, "o"))
    for label, rows, colour, line in weights:
        t = table(run("rotor", f"Fixed axis/Weights={rows}"), "fixed_axis")
        for ax, letter in zip(axes, "AB"):
            ax.plot(t[f"{letter}2"], t[f"{letter}1"], line, color=colour, label=label, markersize=5)
    for ax, name in zip(axes, ("first bearing", "second bearing")):
        ax.set_aspect("equal", "datalim")
        label_axes(ax, f"{name}: horizontal force (N)", "vertical force (N)")
    legend_above(axes[0], 1)
    save(drawn, path)


def t_handle(run, path):
    t = table(run("t_handle"), "rigid_body")
    drawn, (ax,) = figure(height=3.2)
    names = ("about the bar", "about the stem", "across both")
    for i, (colour, line, name) in enumerate(zip((ORANGE, BLUE, GREEN), ("--", "-", ":"), names), 1):
        ax.plot(t["time"], t[f"Omega{i}"], line, color=colour, label=name)
    label_axes(ax, "time (s)", "angular velocity (1/s)")
    legend_above(ax, 3)
    save(drawn, path)


def jacobi_geodesics(run, path):
    """Geodesics in the plane of the angles, with dots at equal arcs, over the potential."""
    drawn, axes = figure(1, 2, height=3.9)
    a = np.linspace(-np.pi, np.pi, 200)
    first, second = np.meshgrid(a, a)
    potentials = {"jacobi_torus": (3 + np.cos(first)) * np.cos(second),
                  "jacobi_pendulum": -9.81 * (2 * np.cos(first) + np.cos(second))}
    titles = {"jacobi_torus": "particle on a torus", "jacobi_pendulum": "double pendulum"}
    labels = {"jacobi_torus": ("w", "u"), "jacobi_pendulum": ("angle of the upper rod", "angle of the lower rod")}
    for ax, (scene, U) in zip(axes, potentials.items()):
        ax.contourf(first, second, U, 12, cmap="Greys", alpha=0.45)
        t = table(run(scene), "jacobi_geodesic")
        shown = slice(0, 201)
        q = [np.remainder(t[name][shown] + np.pi, 2 * np.pi) - np.pi for name in ("q1", "q2")]
        jump = np.hypot(np.diff(q[0]), np.diff(q[1])) > np.pi
        for x in q:
            x[1:][jump] = np.nan
        ax.plot(*q, color=BLUE, linewidth=1)
        ax.plot(q[0][::4], q[1][::4], ".", color=BLACK, markersize=4)
        ax.set_aspect("equal")
        ax.set_xlim(-np.pi, np.pi)
        ax.set_ylim(-np.pi, np.pi)
        ax.set_title(titles[scene], fontsize=10.5)
        label_axes(ax, *(f"{name} (radians)" for name in labels[scene]))
    save(drawn, path)


def foucault(run, path):
    t = table(run("foucault", "Output/Samples=3000"), "moving_frame")
    drawn, (ax,) = figure(height=4.2)
    for first, last, colour, line, name in ((0, 200, BLUE, "-", "swings 1 and 2"), (1400, 1600, GREEN, "--", "15 and 16"),
                                            (2800, 3000, ORANGE, "-.", "29 and 30")):
        ax.plot(t["relative_x"][first:last + 1], t["relative_y"][first:last + 1], color=colour, linestyle=line, label=name)
    ax.set_aspect("equal", "datalim")
    label_axes(ax, "x, away from the nearer pole (amplitudes)", "y (amplitudes)")
    ax.legend(frameon=False, loc="center left", bbox_to_anchor=(0.78, 0.5))
    save(drawn, path)


PICTURES = {
    "lamb": lamb,
    "ladder": ladder,
    "amplitude": amplitude,
    "dirichlet": dirichlet,
    "gravitating_balls": gravitating_balls,
    "tidal_passage": tidal_passage,
    "compressible": compressible,
    "damped_and_pulled": damped_and_pulled,
    "unstable_spheroid": unstable_spheroid,
    "rivlin": rivlin,
    "polhodes": polhodes,
    "tide": tide,
    "gravitating_tumbler": gravitating_tumbler,
    "sweep_of_releases": sweep_of_releases,
    "three_bodies_and_kepler": three_bodies_and_kepler,
    "double_pendulum": double_pendulum,
    "double_pendulum_section": sections,
    "torus_manifolds": torus_manifolds,
    "tops": tops,
    "spherical_pendulum": spherical_pendulum,
    "rotor": rotor,
    "t_handle": t_handle,
    "jacobi_geodesics": jacobi_geodesics,
    "foucault": foucault,
}
