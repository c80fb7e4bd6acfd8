"""The pictures of docs/gallery.md that are curves, of the other systems (tools/gallery.py)."""

import matplotlib.pyplot as plt
import numpy as np

from gallery_figures import (BLACK, BLUE, GREEN, ORANGE, SKY, figure, label_axes, legend_above, picture_of, save, table)

PICTURES = {}
picture = picture_of(PICTURES)


@picture
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


@picture
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


@picture
def double_pendulum_section(run, path):
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


@picture
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


@picture
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


@picture
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


@picture
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


@picture
def t_handle(run, path):
    t = table(run("t_handle"), "rigid_body")
    drawn, (ax,) = figure(height=3.2)
    names = ("about the bar", "about the stem", "across both")
    for i, (colour, line, name) in enumerate(zip((ORANGE, BLUE, GREEN), ("--", "-", ":"), names), 1):
        ax.plot(t["time"], t[f"Omega{i}"], line, color=colour, label=name)
    label_axes(ax, "time (s)", "angular velocity (1/s)")
    legend_above(ax, 3)
    save(drawn, path)


@picture
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
        ax.contourf(first, second, U, 12, cmap="Greys", vmin=U.min(), vmax=U.min() + 2 * np.ptp(U), zorder=-1)
        ax.set_rasterization_zorder(0)  # as curves its bands would be most of the file
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


@picture
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
