"""The pictures of docs/gallery.md that are curves, of the ball (tools/gallery.py)."""

import matplotlib.pyplot as plt
import numpy as np

from gallery_figures import (BLACK, BLUE, CONTINUUM, GREEN, GREY, ORANGE, REDUCED, SKY, STYLES, TIME, both, figure, label_axes,
                             legend_above, picture_of, save, stretch_along_z, table, two_models)

PICTURES = {}
picture = picture_of(PICTURES)


@picture
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


@picture
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


@picture
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


@picture
def dirichlet(run, path):
    drawn, (motion, error) = figure(1, 2, height=3.6)
    for stretch, (colour, line) in zip((1.1, 1.3, 1.5), ((BLACK, ":"), (SKY, "--"), (BLUE, "-"))):
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


@picture
def gravitating_balls(run, path):
    drawn = plt.figure(figsize=(8, 3.9), layout="constrained")
    axes = drawn.subplot_mosaic("ab\nac")
    pulsation = axes["a"]
    two_models(pulsation, run("gravitating_ball", "Time/End=10"), lambda t: 1e3 * (t["Q33"] - 1), "(Q$_{33}$ − 1) · 10³")
    pulsation.set_title("pulsation, γ = 5", fontsize=10.5, y=1.1)
    directory = run("spinning_elastic_spheroid", "Continuum/Error estimate=none")
    for models_table, style in zip(both(directory), (CONTINUUM, REDUCED)):
        for axis, panel in ("a1", "b"), ("a3", "c"):
            axes[panel].plot(models_table["time"], models_table[axis], **style)
    label_axes(axes["b"], "", "longest\nsemi-axis (r)")
    label_axes(axes["c"], TIME, "shortest\nsemi-axis (r)")
    axes["b"].set_title("spinning spheroid, γ = 5", fontsize=10.5, y=1.27)
    for panel in "ab":
        legend_above(axes[panel], 2)
    save(drawn, path)


@picture
def tidal_passage(run, path):
    drawn, (ax,) = figure(height=3.4)
    for models_table, style in zip(both(run("tidal_passage", "Continuum/Error estimate=none")), (CONTINUUM, REDUCED)):
        ax.plot(models_table["time"] / 3600, 250 * (models_table["Q11"] - 1), **style)
    label_axes(ax, "time (hours)", "axis towards the planet, change (km)")
    legend_above(ax, 2)
    save(drawn, path)


@picture
def tidal_locking(run, path):
    t = table(run("tidal_locking"), "reduced")
    drawn, (left, right) = figure(1, 2, height=3.4)
    r, v = ([t[f"companion{kind}{i}"] for i in (1, 2)] for kind in ("", "_velocity"))
    left.plot(t["time"], t["spin3"], color=ORANGE, label="spin")
    left.plot(t["time"], (r[0] * v[1] - r[1] * v[0]) / (r[0] ** 2 + r[1] ** 2), color=BLUE, label="orbit")
    right.plot(t["time"], np.degrees(t["lag"]), color=ORANGE)
    label_axes(left, TIME, "angular velocity")
    label_axes(right, TIME, "bulge ahead (degrees)")
    legend_above(left, 2)
    save(drawn, path)


@picture
def spin_orbit(run, path):
    """Spin over mean motion, and the circular orbit of the binary."""
    drawn, (left, right) = figure(1, 2, height=3.4)
    t = table(run("spin_orbit"), "reduced")
    orbits = t["time"] / (2 * np.pi) * rate_of_orbit(t)[1]
    left.plot(orbits, t["spin3"] / rate_of_orbit(t)[1], color=ORANGE, linewidth=1)
    left.axhline(1.5, color=GREY, linewidth=1)
    label_axes(left, "orbits", "spin over mean motion")
    t = table(run("binary"), "reduced")
    right.plot(t["time"], t["eccentricity"], color=BLUE, label="eccentricity", linewidth=1)
    right.plot(t["time"], t["spin3"] / rate_of_orbit(t)[1], color=ORANGE, label="spin over mean motion", linewidth=1)
    label_axes(right, TIME, "")
    legend_above(right, 2)
    save(drawn, path)


def rate_of_orbit(t):
    """The angular velocity of the companion, and the mean motion of its Kepler orbit."""
    x, y, vx, vy = (t[f"companion{kind}"] for kind in ("1", "2", "_velocity1", "_velocity2"))
    area = x * vy - y * vx
    return area / (x * x + y * y), area / (t["semi_major_axis"] ** 2 * np.sqrt(1 - t["eccentricity"] ** 2))


@picture
def bounce(run, path):
    """The ball rests on the floor at the height of 1."""
    directory = run("bounce", "Output/Graphics=none", "Output/Samples=600")
    drawn, (height, force) = figure(1, 2, height=3.6)
    for name, style in (("continuum", CONTINUUM), ("polynomial", {**STYLES["polynomial"], "label": "polynomial, N = 5"}),
                        ("reduced", REDUCED)):
        t = table(directory, name)
        height.plot(t["time"], t["x3"], **style)
        first = t["time"] < 6.5
        force.plot(t["time"][first], t["contact_force"][first], **{**style, "linewidth": 1.2})
    force.set_xlim(2, 6.5)
    label_axes(height, TIME, "height of the centre (r)")
    label_axes(force, TIME, "force of the floor (μr²)")
    for ax in (height, force):
        legend_above(ax, 2)
    save(drawn, path)


@picture
def compressible(run, path):
    drawn, axes = figure(1, 2)
    directory = run("compressible")
    two_models(axes[0], directory, lambda t: t["volume_ratio"], "volume / volume at rest")
    two_models(axes[1], directory, lambda t: t["a1"], "longest semi-axis (r)")
    for ax in axes:
        legend_above(ax, 2)
    save(drawn, path)


@picture
def damped_and_pulled(run, path):
    drawn, (damped, pulled) = figure(1, 2)
    two_models(damped, run("damped", "Time/Tolerance=1e-3"), stretch_along_z, "viscous ball: stretch along z")
    two_models(pulled, run("traction"), stretch_along_z, "pulled ball: stretch along z")
    pulled.axhline(1.18234, color=BLACK, linestyle=":", linewidth=1.2, label="exact rest")
    legend_above(damped, 2)
    pulled.legend(loc="lower right", frameon=False)
    save(drawn, path)


@picture
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


@picture
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


@picture
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
        start = 7.5 + 15 * (run_number - 1)
        whole = np.round((montgomery(np.radians(start)) - angle) / (2 * np.pi))  # turns that the angle does not show
        turns.plot(start, angle / (2 * np.pi) + whole, "o" if first else "s", color=colour, markersize=4)
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
    formula = np.array([montgomery(np.radians(angle)) / (2 * np.pi) for angle in a])
    turns.plot(a, np.where(np.abs(np.gradient(formula)) < 0.2, formula, np.nan), color=BLACK, linewidth=0.9, zorder=0, label="Montgomery's formula")
    turns.set_ylim(0.8, 4)
    turns.legend(frameon=False, fontsize=8)
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


@picture
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


@picture
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


@picture
def sweep_of_releases(run, path):
    t = table(run("sweep_of_releases"), "sweep")
    drawn, (ax,) = figure(height=3.6)
    strokes = ((BLUE, "-"), (SKY, "--"), (GREEN, "-."), (ORANGE, (0, (5, 1, 1, 1, 1, 1))), (GREY, ":"))
    for b, (colour, line) in zip(sorted(set(t["b"])), strokes):
        chosen = t["b"] == b
        ax.plot(t["l"][chosen], t["a3_min"][chosen], color=colour, linestyle=line, label=f"b = {b:g}")
    l = np.linspace(1.02, 2, 15)
    ax.plot(l, (np.sqrt(l**2 + 8 / l) - l) / 2, ".", color=BLACK, label="b = 0, exact")
    label_axes(ax, "stretch ℓ at which the ball is released", "least thickness reached (r)")
    ax.legend(frameon=False)
    save(drawn, path)
