"""The systems beside the ball, from parameter file to CSV: what the scenes of params/ promise, and columns."""
import math
import re
import unittest

from program_test import DONE, SOURCE, words
from system_test import (BODY_OF_POINTS, ELLIPSOID, INERTIAL, LAGRANGE, PENDULUM, ROTATION, ROTOR, SCENES,
                         SPHERICAL_PENDULUM, SystemTest, distance, drift)


def without_jumps(angles):
    """The angles with whole turns added, each within half a turn of the one before."""
    path = angles[:1]
    for angle in angles[1:]:
        path.append(path[-1] + math.remainder(angle - path[-1], 2 * math.pi))
    return path


class SystemScenes(SystemTest):
    """What the comment at the head of each scene promises."""

    def test_files_columns_and_samples(self):
        for scene, file in SCENES.items():
            with self.subTest(scene):
                table = self.motion(scene)
                self.assertEqual(self.files(table.folder), sorted(
                    [f"checkpoint-{file}.bin", "log.txt", "manifest.json", "used.prm", f"{file}.csv"]))
                self.assertEqual(table.header, [name for name, _ in self.documented_columns(file, n_points=3)])
                used = self.used_entries(table.folder)
                end, n = float(used["Time/End"]), int(used["Output/Samples"])
                self.assertEqual(len(table), n + 1)
                self.assertEqual(table.column("time")[-1], end)
                for k, t in enumerate(table.column("time")):
                    self.assertAlmostEqual(t, end * k / n, delta=1e-15 * end)
                self.assertTrue(table.is_finite())
                self.assertEqual(self.json(table.folder, "manifest.json")["exit_code"], DONE)

    def test_every_system_has_a_scene(self):
        texts = [(SOURCE / "params" / f"{scene}.prm").read_text() for scene in SCENES]
        systems = {re.search(r"^set System\s*=\s*(.*\S)", text, re.M)[1] for text in texts}
        self.assertEqual(systems, set(words("System")) - {"ball"})

    def test_columns_of_other_numbers_of_points_and_surfaces(self):
        for n in (1, 2, 5):
            row = [f"{i}, 0, 0" for i in range(n)]
            table = self.motion({"System": "mass points", "Mass points/Masses": ", ".join(["1"] * n),
                                 "Mass points/Positions": "; ".join(row), "Mass points/Velocities": "; ".join(row),
                                 "Time/End": 0.1, "Output/Samples": 3})
            self.assertEqual(table.header, [name for name, _ in self.documented_columns("mass_points", n)])
        plane = self.motion({**ELLIPSOID, "Geodesic/Surface": "hyperbolic plane"})
        self.assertEqual(plane.header, [name for name, _ in self.documented_columns("geodesic") if name not in "xyz"])

    def test_three_bodies(self):
        # 180 samples: a third of the period is 30 of them.
        table = self.motion("three_bodies", {"Output/Samples": 180})
        self.assertAlmostEqual(table.column("energy")[0], -1.28714, delta=5e-6)
        self.assertLess(drift(table, "energy"), 1e-9)  # of a tolerance of 1e-8
        for name in ("P1", "P2", "P3", "L1", "L2", "L3"):
            # The velocities are given with eight decimals, so P starts at 1e-8.
            self.assertLess(abs(table.column(name)[0]), 1.01e-8, name)
            self.assertLess(drift(table, name), 1e-14, name)
        start = table.rows[0][1:19]
        for period in (90, 180):  # initial data of eight decimals, about four times that error a period
            self.assertLess(max(abs(x - y) for x, y in zip(table.rows[period][1:19], start)), 2e-7)
        path = {i: list(zip(table.column(f"x{i}"), table.column(f"y{i}"))) for i in (1, 2, 3)}
        later = {i: min((1, 2, 3), key=lambda j: math.dist(path[j][30], path[i][0])) for i in (1, 2, 3)}
        self.assertEqual(sorted(later.values()), [1, 2, 3])
        for i, j in later.items():
            self.assertNotEqual(i, j)
            self.assertLess(max(math.dist(a, b) for a, b in zip(path[i], path[j][30:])), 3e-7, "one curve")

    def test_double_pendulum(self):
        table = self.motion("double_pendulum")
        self.assertLess(drift(table, "energy") / table.column("energy")[0], 1e-9)
        near = self.motion("double_pendulum", {"Double pendulum/Angles": "2.000001, 2.5"})
        self.assertGreater(distance(table, near, ["theta"]), 0.1, "chaos shows a change of 1e-6")
        other = self.motion("double_pendulum", LAGRANGE)
        self.assertLess(distance(table, other, ["x1", "y1", "x2", "y2"]), 2e-6, "each has the tolerance 1e-6")

    def test_tensions_of_the_double_pendulum_are_newtons(self):
        """m r̈ of both points by central differences, h = 1/1000: an error of h² r⁗/12, some 1e-5 times r̈."""
        table = self.motion("double_pendulum", {"Time/End": 1, "Output/Samples": 1000, "Time/Tolerance": 1e-12})
        x1, y1, x2, y2, tension1, tension2 = map(table.column, ("x1", "y1", "x2", "y2", "tension1", "tension2"))
        for k in range(1, 1000):
            def acceleration(x):
                return (x[k + 1] - 2 * x[k] + x[k - 1]) * 1e6
            pull1 = [-tension1[k] * x1[k], -tension1[k] * y1[k]]  # rods of length 1
            pull2 = [-tension2[k] * (x2[k] - x1[k]), -tension2[k] * (y2[k] - y1[k])]
            self.assertAlmostEqual(acceleration(x2), pull2[0], delta=1e-2)
            self.assertAlmostEqual(acceleration(y2), pull2[1] + 9.81, delta=1e-2)
            self.assertAlmostEqual(acceleration(x1), pull1[0] - pull2[0], delta=1e-2)
            self.assertAlmostEqual(acceleration(y1), pull1[1] - pull2[1] + 9.81, delta=1e-2)

    def test_reactions_of_the_double_pendulum_without_multipliers(self):
        """(5.43): R2 pulls along the lower rod, R1 + R2 along the upper one, with the tensions that the multipliers are."""
        for form in ({}, LAGRANGE):
            table = self.motion(PENDULUM, form)
            for row in (dict(zip(table.header, row)) for row in table.rows):
                upper, lower = (row["x1"], row["y1"]), (row["x2"] - row["x1"], row["y2"] - row["y1"])
                for k, axis in enumerate("xy"):
                    self.assertAlmostEqual(row[f"R2{axis}"], -row["tension2"] * lower[k] / 0.9, delta=1e-12)
                    self.assertAlmostEqual(row[f"R1{axis}"] + row[f"R2{axis}"], -row["tension1"] * upper[k] / 1.2, delta=1e-12)

    def test_spherical_pendulum(self):
        table = self.motion("spherical_pendulum")
        self.assertLess(drift(table, "energy", "momentum"), 1e-6)
        self.assertAlmostEqual(min(table.column("z")), -0.89074, delta=2e-5)  # of 1000 samples
        self.assertAlmostEqual(max(table.column("z")), -math.cos(1), delta=1e-6)
        for scene in ("spherical_pendulum", SPHERICAL_PENDULUM):
            table = self.motion(scene)
            for a, b in zip(table.column("tension"), table.column("tension_by_curvature")):
                self.assertAlmostEqual(a, b, delta=1e-12)
                self.assertGreater(a, 1)

    def test_rotor(self):
        """Forces of 30 N and 70 N in the body; in space the bearings carry the weight on average."""
        table = self.motion("rotor")
        mean = {name: sum(table.column(name)[:-1]) / (len(table) - 1) for name in table.header}  # over a turn
        self.assertAlmostEqual(mean["A_body1"], -30, delta=0.02)  # the weight falls: the rate varies by 1e-4
        self.assertAlmostEqual(mean["B_body1"], -70, delta=0.05)
        weight = 10 * 9.81 / 2
        for name, part in (("A1", weight + 0.3 * 0.05 * 9.81), ("B1", weight + 0.7 * 0.05 * 9.81), ("A2", 0), ("B2", 0)):
            self.assertAlmostEqual(mean[name], part, delta=0.1)
        couple = self.motion("rotor", {"Fixed axis/Weights": "0.2, 0, 0.1, 0.05; -0.2, 0, -0.1, 0.05", "Fixed axis/Gravity": "0, 0, 0"})
        for sign, letter in ((1, "A"), (-1, "B")):
            for name, force in ((f"{letter}_body1", 40 * sign), (f"{letter}_body2", 0), (f"{letter}_body3", 0)):
                self.assertLess(max(abs(x - force) for x in couple.column(name)), 1e-9, name)
        balanced = self.motion("rotor", {"Fixed axis/Weights": "0.2, 0, 0.1, 0.05; -0.2, 0, 0.1, 0.05", "Fixed axis/Gravity": "0, 0, 0"})
        self.assertLess(max(abs(x) for name in ("A_body1", "B_body1", "A_body2") for x in balanced.column(name)), 1e-10)

    def test_bearings_change_momentum_and_angular_momentum(self):
        """By central differences of order 4 of the momentum m R (omega x G) and of the angular momentum along a motion."""
        h, n = 2e-3, 50
        table = self.motion(ROTOR, {"Time/End": h * n, "Output/Samples": n, "Time/Tolerance": 1e-13})
        points = [((0.3, 0.2, 0.1), 0.4), ((0, -0.5, 0.6), 0.1)]
        axis = [x / math.hypot(0.3, -0.2, 1) for x in (0.3, -0.2, 1)]
        mass, first_moment = 2.5, [2 * c + sum(m * x[i] for x, m in points) for i, c in enumerate((0.1, 0, 0.2))]
        A = [[1, 0.1, 0], [0.1, 1.2, 0.05], [0, 0.05, 0.9]]
        for x, m in points:
            for i in range(3):
                for j in range(3):
                    A[i][j] += m * ((i == j) * sum(u * u for u in x) - x[i] * x[j])
        def cross(u, v):
            return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        def turned(u, angle):
            along, across = sum(a * b for a, b in zip(axis, u)), cross(axis, u)
            return [math.cos(angle) * u[i] + math.sin(angle) * across[i] + (1 - math.cos(angle)) * along * axis[i]
                    for i in range(3)]
        angles, rates = table.column("angle"), table.column("rate")
        momenta = [turned([rate * p for p in cross(axis, first_moment)], angle) for angle, rate in zip(angles, rates)]
        spins = [turned([rate * sum(a * b for a, b in zip(row, axis)) for row in A], angle) for angle, rate in zip(angles, rates)]
        def derivative(values, k, i):
            return (8 * (values[k + 1][i] - values[k - 1][i]) - (values[k + 2][i] - values[k - 2][i])) / (12 * h)
        gravity = (0, 0.5, -2)
        for k in range(2, n - 1):
            forces = [[table.column(f"{letter}{i}")[k] for i in (1, 2, 3)] for letter in "AB"]
            torques = [cross([place * e for e in axis], f) for place, f in zip((-0.4, 0.7), forces)]
            of_weight = cross(turned(first_moment, angles[k]), gravity)
            for i in range(3):
                self.assertAlmostEqual(forces[0][i] + forces[1][i] + mass * gravity[i], derivative(momenta, k, i), delta=1e-7)
                self.assertAlmostEqual(torques[0][i] + torques[1][i] + of_weight[i] - 0.05 * rates[k] * axis[i],
                                       derivative(spins, k, i), delta=1e-7)

    def test_t_handle(self):
        """Half a period of Jacobi's functions between the turns, by the arithmetic-geometric mean (1e-6 from the separatrix)."""
        table = self.motion("t_handle")
        time, Omega2 = table.column("time"), table.column("Omega2")
        turns = [t + (s - t) * a / (a - b) for t, s, a, b in zip(time, time[1:], Omega2, Omega2[1:]) if a * b < 0]
        self.assertGreaterEqual(len(turns), 3)
        for a, b in zip(turns, turns[1:]):
            self.assertAlmostEqual(b - a, 2.34591, delta=2e-4)
        self.assertAlmostEqual(turns[0], 2.34591 / 2, delta=2e-4)
        by_inertia = self.motion("t_handle", {"Rigid body/Points": "", "Rigid body/Mass": 0.11,
                                              "Rigid body/Inertia": "7.2e-5, 0, 0; 0, 2.16e-4, 0; 0, 0, 2.88e-4"})
        self.assertLess(distance(table, by_inertia, ROTATION), 1e-6)

    def test_bodies_of_mass_points(self):
        """As by mass, centre of mass and inertia, computed here; springs of a free body shift with its origin."""
        points = [((0.5, 0.1, 0), 0.7), ((-0.3, 0.8, 0.2), 0.4), ((0, -0.6, 0.3), 0.5), ((0.1, 0, 0.9), 0.4)]
        mass = sum(m for _, m in points)
        center = [sum(m * x[i] for x, m in points) / mass for i in range(3)]
        def inertia(origin):
            A = [[0.0] * 3 for _ in range(3)]
            for x, m in points:
                y = [a - b for a, b in zip(x, origin)]
                for i in range(3):
                    for j in range(3):
                        A[i][j] += m * ((i == j) * sum(u * u for u in y) - y[i] * y[j])
            return "; ".join(", ".join(map(repr, row)) for row in A)
        spring = [a - b for a, b in zip((0.3, 0, 0.1), center)]
        free = self.motion({**BODY_OF_POINTS, "Time/Tolerance": 1e-10})
        explicit = {**{path: value for path, value in BODY_OF_POINTS.items() if path != "Rigid body/Points"},
                    "Rigid body/Mass": mass, "Time/Tolerance": 1e-10}
        self.assertLess(distance(free, self.motion({
            **explicit, "Rigid body/Inertia": inertia(center),
            "Rigid body/Springs": ", ".join(map(repr, spring)) + ", 1, 0.2, 0, 0.8, 0.2"})), 1e-8)
        fixed = {"Rigid body/Fixed point": "true", "Rigid body/Position": "0, 0, 0", "Rigid body/Velocity": "0, 0, 0"}
        self.assertLess(distance(self.motion({**BODY_OF_POINTS, **fixed, "Time/Tolerance": 1e-10}), self.motion({
            **explicit, **fixed, "Rigid body/Inertia": inertia((0, 0, 0)),
            "Rigid body/Center": ", ".join(map(repr, center))})), 1e-8)

    def test_heavy_top(self):
        table = self.motion("heavy_top", {"Output/Samples": 1600})
        for name in ("energy", "J3", "J_body3"):
            self.assertLess(drift(table, name) / table.column(name)[0], 1e-7, name)  # of a Tolerance of 1e-6
        theta, phi = table.column("theta"), without_jumps(table.column("phi"))
        self.assertAlmostEqual(theta[0], math.pi / 6, delta=1e-12)
        # Where θ̇ = 0 energy and momenta give, with u = cos θ:  J_body3² (u₀ − u) = 2 I₁ m g l (1 − u²).
        lost = 2 * 0.5 * 9.81 * 0.05 * 0.0015625 / 0.0625**2
        u0 = math.cos(math.pi / 6)
        lowest = (1 - math.sqrt(1 - 4 * lost * (u0 - lost))) / (2 * lost)
        self.assertAlmostEqual(max(theta), math.acos(lowest), delta=1e-5)  # 1600 samples of 8 nutations
        self.assertAlmostEqual(min(theta), math.pi / 6, delta=2e-6)
        cusps = [k for k in range(1, 1600) if theta[k] <= min(theta[k - 1], theta[k + 1])]
        self.assertGreaterEqual(len(cusps), 7, "nutation")
        mean_rate = (phi[cusps[-1]] - phi[0]) / table.column("time")[cusps[-1]]
        self.assertAlmostEqual(mean_rate, 4.29, delta=0.005)
        for k in cusps:
            # Near a cusp φ grows with the third power of the time.
            self.assertLess(abs(phi[k + 1] - phi[k - 1]) / 0.002, 0.01 * mean_rate, "φ stands still")
        for form in ("euler", "lagrange"):
            other = self.motion("heavy_top", {"Rigid body/Form": form, "Output/Samples": 1600})
            self.assertLess(distance(table, other, ROTATION), 2e-6, f"{form}: each has the tolerance 1e-6")

    def test_euler_angles_end_where_the_third_axis_is_vertical(self):
        # A plane pendulum, Omega along the nodal line, swings through the vertical; the other forms go on.
        entries = {"System": "rigid body", "Rigid body/Center": "0, 0, 1", "Rigid body/Inertia": "2, 0, 0; 0, 2, 0; 0, 0, 2",
                   "Rigid body/Gravity": "0, 0, -1", "Rigid body/Rotation": "1, 0, 0; 0, 0.8, -0.6; 0, 0.6, 0.8",
                   "Rigid body/Angular velocity": "0.3, 1e-6, 0", "Time/End": 12}
        self.scene(entries)
        stopped = self.run_program("run", "scene.prm", "--quiet", "--set", "Rigid body/Form=lagrange", "--output", "lagrange")
        self.assert_exit(stopped, 3)
        self.assertIn("Euler angles are singular", stopped.stderr)
        for form in ("euler", "constrained"):
            self.run_done("run", "scene.prm", "--quiet", "--set", f"Rigid body/Form={form}", "--output", form)

    def test_free_body(self):
        table = self.motion("free_body")
        Omega2 = table.column("Omega2")
        self.assertGreater(max(Omega2), 0.99)
        self.assertLess(min(Omega2), -0.99)
        self.assertGreaterEqual(sum(a * b < 0 for a, b in zip(Omega2, Omega2[1:])), 2, "again and again")
        self.assertLess(drift(table, "energy", "J1", "J2", "J3"), 1e-12)
        for k, t in enumerate(table.column("time")):
            J_body = [table.column(f"J_body{i}")[k] for i in (1, 2, 3)]
            self.assertAlmostEqual(math.hypot(*J_body), 2, delta=1e-6)
            x = [table.column(f"x{i}")[k] for i in (1, 2, 3)]
            self.assertLess(math.dist(x, (0.1 * t, 0, 0)), 1e-12)
        # On the separatrix 2 I₂ K = |J|².
        rotation = table.column("kinetic")[0] - 0.5 * 0.1**2
        self.assertAlmostEqual(2 * 2 * rotation, 4, delta=1e-5)

    def test_foucault(self):
        table = self.motion("foucault")
        self.assertLess(drift(table, "jacobi") / table.column("jacobi")[0], 1e-9)
        place = list(zip(table.column("relative_x"), table.column("relative_y")))
        # After whole swings the point is at the end of its swing, which has turned clockwise. (One part in 1e4: the
        # planet also makes the swing slower and rounder.)
        for k, angle in ((0, 0), (100, 30), (200, 60), (300, 90)):
            turned = math.cos(math.radians(angle)), -math.sin(math.radians(angle))
            self.assertLess(math.dist(place[k], turned), 2e-4, f"{angle} degrees")
        self.assertLess(max(map(abs, table.column("relative_z"))), 1e-4)
        Q, force = self.vectors(table, "relative_v"), self.vectors(table, "coriolis_")
        for v, f in zip(Q, force):
            self.assertAlmostEqual(sum(a * b for a, b in zip(v, f)), 0, delta=1e-13, msg="the Coriolis force has no power")
        other = self.motion("foucault", INERTIAL)
        self.assertLess(distance(table, other, ["relative_x", "relative_y", "relative_z"]), 2e-8, "each has 1e-8")
        at_rest = self.motion("foucault", {"Moving frame/Spin rate": 0})
        self.assertEqual(set(at_rest.column("relative_y")), {0.0}, "without rotation the plane stays")

    @staticmethod
    def vectors(table, prefix):
        return list(zip(*(table.column(prefix + axis) for axis in "xyz")))

    def test_inner_circle_of_the_torus(self):
        """5.8.8: w = pi is invariant: the particle stays on it, though every other motion leaves the lower saddle."""
        for turns in (0, 1, -1, 50):
            w = math.pi * (2 * turns + 1)
            table = self.motion("torus", {"Time/End": 1000, "Torus/Angles": f"{w!r}, 0.01"})
            self.assertEqual(set(table.column("w")), {w})
            self.assertAlmostEqual(table.column("u")[-1], math.pi, delta=1e-9)
            self.assertAlmostEqual(table.column("z")[-1], -2, delta=1e-12)
        beside = self.motion("torus", {"Time/End": 200, "Torus/Angles": f"{math.nextafter(math.pi, 4)!r}, 0.01"})
        self.assertAlmostEqual(beside.column("z")[-1], -4, delta=1e-9, msg="4e-16 beside it there is the sink")
        geodesic = self.motion("geodesic", {"Geodesic/Point": f"{math.pi!r}, 0", "Geodesic/Velocity": "0, 0.5",
                                            "Time/End": 200})
        self.assertEqual(set(geodesic.column("q1")), {math.pi}, "an unstable geodesic")
        self.assertAlmostEqual(geodesic.column("q2")[-1], 100, delta=1e-6)

    def test_torus(self):
        table = self.motion("torus", {"Output/Samples": 4000})
        self.assertAlmostEqual(table.column("z")[0], 2, delta=1e-3)
        self.assertAlmostEqual(table.column("z")[-1], -2, delta=1e-9)
        self.assertLess(table.column("kinetic")[-1], 1e-12, "at rest")
        energy, power, h = table.column("energy"), table.column("dissipated_power"), 0.01
        self.assertTrue(all(b <= a + 1e-12 for a, b in zip(energy, energy[1:])), "friction takes energy away")
        lost = h * (sum(power) - 0.5 * (power[0] + power[-1]))  # trapezoids: an error of some h²
        self.assertAlmostEqual(energy[0] - energy[-1], lost, delta=1e-4)
        tilted = self.motion("torus", {"Torus/Tilt": 0.05})
        sink = 3 + math.cos(0.05)  # below the middle of the tube by the tilted vertical
        self.assertAlmostEqual(tilted.column("z")[-1], -sink, delta=1e-4)
        self.assertAlmostEqual(tilted.column("potential")[-1], -(3 * math.cos(0.05) + 1), delta=1e-6)
        self.assertLess(tilted.column("kinetic")[-1], 1e-8)

    def test_geodesic(self):
        table = self.motion("geodesic")
        self.assertLess(drift(table, "speed", "clairaut"), 1e-10)
        self.assertAlmostEqual(table.column("speed")[0], 1, delta=1e-6)
        self.assertAlmostEqual(table.column("clairaut")[0], 2.001, delta=1e-12)
        w = table.column("q1")
        self.assertLess(max(map(abs, w)), math.pi, "not through the hole")
        self.assertTrue(max(w) > 3 and min(w) < -3, "near the inner equator on both sides")
        self.assertGreater(sum(x > 3 for x in w), 10, "it stays there for more than 2 of 50")
        through = self.motion("geodesic", {"Geodesic/Velocity": "0.8661697, 0.124938"})
        self.assertLess(through.column("clairaut")[0], 2)
        w = through.column("q1")
        self.assertTrue(all(a < b for a, b in zip(w, w[1:])), "always on")
        self.assertGreater(w[-1], 2 * math.pi, "through the hole and round")

    def test_jacobi_kepler(self):
        table = self.motion("jacobi_kepler")
        self.assertAlmostEqual(table.column("t")[-1], 4 * math.pi, delta=1e-9)
        self.assertLess(max(table.column("deviation")), 1e-9, "the tolerance")
        self.assertAlmostEqual(table.column("x")[100], 0.4, delta=1e-9)
        self.assertAlmostEqual(table.column("x")[-1], 0.4, delta=1e-9)
        self.assertAlmostEqual(table.column("t")[100], 2 * math.pi, delta=1e-9)
        for name, value in (("energy", -0.5), ("angular_momentum", 0.8), ("jacobi_speed", 1)):
            self.assertLess(max(abs(x - value) for x in table.column(name)), 1e-8, name)
        self.assertLess(max(abs(a - b) for a, b in zip(table.column("time"), table.column("jacobi_length"))), 1e-8)
        # The ellipse (x + 0.6)² + y²/0.64 = 1 about the centre of force.
        for x, y in zip(table.column("x"), table.column("y")):
            self.assertAlmostEqual((x + 0.6)**2 + y**2 / 0.64, 1, delta=1e-8)


    def test_jacobi_geodesics_of_torus_and_double_pendulum(self):
        """Motions of energy h as geodesics; the same in other units."""
        for scene, energy in (("jacobi_torus", 5), ("jacobi_pendulum", 40)):
            table = self.motion(scene)
            self.assertEqual(table.header, ["time", "t", "q1", "q2", "q1_dot", "q2_dot", "energy", "jacobi_speed",
                                            "jacobi_length", "deviation"])
            self.assertLess(max(table.column("deviation")), 1e-6)
            self.assertLess(max(abs(x - energy) for x in table.column("energy")), 1e-8 * energy)
            self.assertLess(max(abs(x - 1) for x in table.column("jacobi_speed")), 1e-8)
            self.assertLess(max(abs(a - b) for a, b in zip(table.column("time"), table.column("jacobi_length"))),
                            1e-8 * table.column("time")[-1])
        other = self.motion("jacobi_pendulum", {
            "Jacobi geodesic/Radius": 2, "Jacobi geodesic/Second length": 2, "Jacobi geodesic/Gravity": 9.81 * 2 / 9,
            "Jacobi geodesic/Energy": 40 * 4 / 9, "Time/End": 300 * 4 / 3})  # lengths double, times three times as long
        self.assertLess(distance(table, other, ["q1", "q2"]), 1e-6)
        self.assertAlmostEqual(other.column("t")[-1], 3 * table.column("t")[-1], delta=1e-6)

    def test_jacobi_geodesics_of_the_double_pendulum_are_its_motions(self):
        """The motion that System = double pendulum computes, at the time that the geodesic has come to."""
        geodesic = self.motion("jacobi_pendulum", {"Output/Samples": 1})
        t, rates = geodesic.column("t")[-1], [geodesic.column(name)[0] for name in ("q1_dot", "q2_dot")]
        motion = self.motion({"System": "double pendulum", "Double pendulum/Form": "lagrange", "Double pendulum/Angles": "0.5, 0.3",
                              "Double pendulum/Rates": ", ".join(map(repr, rates)), "Time/End": repr(t), "Time/Tolerance": 1e-12,
                              "Output/Samples": 1})
        for angle, name in (("theta", "q1"), ("phi", "q2")):
            self.assertAlmostEqual(math.remainder(motion.column(angle)[-1] - geodesic.column(name)[-1], 2 * math.pi), 0, delta=1e-6)

if __name__ == "__main__":
    unittest.main()
