"""Analysis = section: the points against an independent integration, and what is refused."""
import math
import unittest

from program_test import overrides, words
from system_test import (ELLIPSOID, FRAME, JACOBI, JACOBI_PENDULUM, JACOBI_TORUS, LAGRANGE, PENDULUM, POINTS, ROTOR,
                         SPHERICAL_PENDULUM, SystemTest, TOP, TORUS)

SECTION = {"Analysis": "section", "Section/Column": "theta"}
# Unit masses and lengths, g = 1: regular at this energy.
SMALL = {"System": "double pendulum", "Double pendulum/Gravity": 1, "Double pendulum/Angles": "0.3, 0.2",
         "Double pendulum/Rates": "0.1, 0.4", "Time/End": 60, "Time/Tolerance": 1e-12}


def pendulum_rates(y):
    """Of (theta, phi) and their rates, of unit masses and rods and g = 1, by the textbook's formula."""
    a, b, u, v = y
    s, c = math.sin(a - b), math.cos(a - b)
    d = 3 - math.cos(2 * (a - b))
    du = (-3 * math.sin(a) - math.sin(a - 2 * b) - 2 * s * (v * v + u * u * c)) / d
    dv = 2 * s * (2 * u * u + 2 * math.cos(a) + v * v * c) / d
    return [u, v, du, dv]


def extrapolated_step(rates, y, h):
    """Gragg, Bulirsch and Stoer: the modified midpoint rule with 2, 4, ... 16 substeps, extrapolated to order 16."""
    table = []
    for j in range(1, 9):
        n = 2 * j
        s = h / n
        before, here = y, [x + s * f for x, f in zip(y, rates(y))]
        for _ in range(n - 1):
            before, here = here, [x + 2 * s * f for x, f in zip(before, rates(here))]
        row = [[(x + z + s * f) / 2 for x, z, f in zip(before, here, rates(here))]]
        for k in range(1, j):
            factor = (j / (j - k))**2 - 1
            row.append([p + (p - q) / factor for p, q in zip(row[k - 1], table[j - 2][k - 1])])
        table.append(row)
    return table[-1][-1]


def crossings(rates, y, end, level, rising, h=0.05):
    """(time, state) where level(y) passes 0, by bisection and the secant rule on steps from the same start."""
    t, found = 0.0, []
    while t < end - 1e-12:
        h = min(h, end - t)
        after = extrapolated_step(rates, y, h)
        f, g = level(y), level(after)
        if (f < 0 <= g) if rising else (f > 0 >= g):
            low, high = 0.0, h
            for _ in range(60):
                s = low - f * (high - low) / (g - f)
                if not low < s < high:
                    break
                z = extrapolated_step(rates, y, s)
                x = level(z)
                if (x < 0) == (f < 0):
                    low, f, g = s, x, g / 2  # Illinois
                else:
                    high, g, f = s, x, f / 2
                if abs(x) < 1e-16:
                    break
            found.append((t + s, z))
        t, y = t + h, after
    return found


class Sections(SystemTest):
    def section(self, scene, changes={}):
        table = self.motion(scene, {"Analysis": "section", **changes})
        self.assertEqual(table.file, "section")
        return table

    def test_points_are_those_of_an_independent_integration(self):
        expected = crossings(pendulum_rates, [0.3, 0.2, 0.1, 0.4], 60, lambda y: y[0], True)
        self.assertGreater(len(expected), 5)
        for form in ({}, LAGRANGE):
            table = self.section(SMALL, {**SECTION, **form})
            self.assertEqual(len(table), len(expected))
            for k, (t, (theta, phi, theta_dot, phi_dot)) in enumerate(expected):
                self.assertAlmostEqual(table.column("time")[k], t, delta=1e-10)
                for name, value in (("theta", 0), ("phi", phi), ("theta_dot", theta_dot), ("phi_dot", phi_dot)):
                    self.assertAlmostEqual(table.column(name)[k], value, delta=1e-10, msg=f"{name} of crossing {k}")
                self.assertLess(abs(table.column("theta")[k]), 1e-12, "located to round-off")

    def test_directions(self):
        times = {d: self.section(SMALL, {**SECTION, "Section/Direction": d}).column("time") for d in ("up", "down", "both")}
        self.assertEqual(sorted(times["up"] + times["down"]), times["both"])
        for up, down in zip(times["up"], times["down"]):
            self.assertNotEqual(up, down)
        rates = self.section(SMALL, {**SECTION, "Section/Direction": "down"}).column("theta_dot")
        self.assertTrue(all(rate < 0 for rate in rates))
        self.assertEqual(len(self.section(SMALL, {**SECTION, "Section/Value": 3})), 0, "it does not come so high")

    def test_jumps_are_no_crossings(self):
        """theta jumps from pi to -pi where the pendulum turns over; with a period the upper rod stands up there."""
        whirl = {**SMALL, "Double pendulum/Rates": "6, 6", "Time/End": 5, "Time/Tolerance": 1e-9}
        motion = self.motion(whirl, {"Output/Samples": 5000})
        turns = sum(b < a - 3 for a, b in zip(motion.column("theta"), motion.column("theta")[1:]))
        self.assertGreater(turns, 2)
        both = {**SECTION, "Section/Direction": "both"}
        self.assertTrue(all(abs(x) < 1e-12 for x in self.section(whirl, both).column("theta")))
        upright = self.section(whirl, {**both, "Section/Value": math.pi, "Section/Period": 2 * math.pi})
        self.assertEqual(len(upright), turns)
        self.assertTrue(all(abs(abs(x) - math.pi) < 1e-12 for x in upright.column("theta")))

    def test_turns_are_counted_by_a_period(self):
        spun = {"System": "geodesic", "Geodesic/Surface": "torus", "Geodesic/Point": "0, 0.1", "Geodesic/Velocity": "0, 1",
                "Time/End": 20, "Time/Tolerance": 1e-12}
        table = self.section(spun, {"Section/Column": "q2", "Section/Period": 2 * math.pi})
        self.assertEqual(len(table), 3)
        for k, (t, u) in enumerate(zip(table.column("time"), table.column("q2")), 1):
            self.assertAlmostEqual(u, 2 * math.pi * k, delta=1e-12)
            self.assertAlmostEqual(t, 2 * math.pi * k - 0.1, delta=1e-11)

    def test_units(self):
        """The value is in the column's unit."""
        table = self.section(POINTS, {"Section/Column": "x1", "Section/Value": 0.9, "Section/Direction": "both"})
        self.assertGreater(len(table), 0)
        self.assertTrue(all(abs(x - 0.9) < 1e-12 for x in table.column("x1")))
        pendulum = self.section(PENDULUM, {"Section/Column": "x2", "Section/Value": 0.1})
        self.assertTrue(all(abs(x - 0.1) < 1e-12 for x in pendulum.column("x2")))

    def test_backwards(self):
        forwards = self.section(TORUS, {"Section/Column": "u", "Section/Value": 0.71, "Section/Direction": "both"})
        backwards = self.section(TORUS, {"Section/Column": "u", "Section/Value": 0.71, "Section/Direction": "both",
                                         "Time/End": -10})
        self.assertTrue(all(t > 0 for t in forwards.column("time")))
        self.assertTrue(all(t < 0 for t in backwards.column("time")))
        self.assertTrue(all(abs(u - 0.71) < 1e-12 for u in backwards.column("u")))

    def test_geodesics_of_the_jacobi_metric(self):
        """On the circle of Kepler's motion with |q| = |v| = 1 the arc is the time and y = sin t; it stopped at the first crossing."""
        scene = {"System": "jacobi geodesic", "Jacobi geodesic/Potential": "kepler", "Jacobi geodesic/Energy": -0.5,
                 "Jacobi geodesic/Position": "1, 0", "Jacobi geodesic/Direction": "0, 1", "Time/End": 40, "Time/Tolerance": 1e-11}
        table = self.section(scene, {"Section/Column": "y", "Section/Value": 0.5, "Section/Direction": "both"})
        expected = sorted(t for k in range(7) for t in (math.pi / 6 + 2 * math.pi * k, 5 * math.pi / 6 + 2 * math.pi * k) if t < 40)
        self.assertEqual(len(table), len(expected))
        for k, t in enumerate(expected):
            self.assertAlmostEqual(table.column("time")[k], t, delta=1e-9)
            self.assertAlmostEqual(table.column("jacobi_length")[k], t, delta=1e-9)
            self.assertLess(table.column("deviation")[k], 1e-9)

    def test_every_system(self):
        """Through the value in the middle of its range the watched column goes more than once."""
        scenes = {"double pendulum": PENDULUM, "mass points": POINTS, "rigid body": TOP, "spherical pendulum": SPHERICAL_PENDULUM,
                  "fixed axis": ROTOR, "moving frame": FRAME, "torus": TORUS, "geodesic": ELLIPSOID}
        columns = {"double pendulum": "phi", "mass points": "x1", "rigid body": "R11", "spherical pendulum": "x", "fixed axis": "A1",
                   "moving frame": "relative_x", "torus": "u", "geodesic": "q1"}
        self.assertEqual({*scenes, "jacobi geodesic", "ball"}, set(words("System")))
        cases = [(name, scene, columns[name]) for name, scene in scenes.items()]
        cases += [(f"jacobi {k}", scene, column) for k, (scene, column) in enumerate(
            ((JACOBI, "x"), (JACOBI_TORUS, "q1"), (JACOBI_PENDULUM, "q2")))]
        for name, scene, column in cases:
            with self.subTest(name):
                watched = self.motion(scene).column(column)
                value = (min(watched) + max(watched)) / 2
                table = self.section(scene, {"Section/Column": column, "Section/Value": value, "Section/Direction": "both"})
                self.assertGreater(len(table), 0)
                size = max(map(abs, watched))
                self.assertTrue(all(abs(x - value) < 1e-11 * size for x in table.column(column)))

    def test_the_report_shows_it(self):
        folder = self.section("double_pendulum_section", {"Time/End": 20}).folder
        self.assertIn("report.html", self.files(folder))
        page = self.bytes(folder, "report.html").decode()
        self.assertIn('data-file="section.csv">time,theta', page)

    def test_refusals(self):
        for changes, fragments in (
                ({"Section/Column": "q"}, ("Section/Column", "one of theta, phi")),
                ({}, ("Section/Column", "double_pendulum.csv")),
                ({**SECTION, "Time/Method": "rattle"}, ("Time/Method", "explicit-8")),
                ({**SECTION, "Time/Method": "gauss-16"}, ("Time/Method", "explicit-8")),
                ({**SECTION, "Section/Direction": "left"}, ("Section/Direction", "up")),
                ({**SECTION, "Section/Period": -1}, ("Section/Period", ">= 0")),
                ({**SECTION, "Sweep/Parameters": "a: 1, 2"}, ("Analysis", "motions"))):
            result = self.run_program("run", self.scene({**SMALL, "Analysis": "section", **changes}))
            self.assert_exit(result, 2)
            self.assert_one_sentence(result, *fragments)
        result = self.run_program("run", self.scene({"Analysis": "section", "Section/Column": "Q11"}))
        self.assert_exit(result, 2)
        self.assert_one_sentence(result, "Analysis", "other than the ball: mass points, ")


if __name__ == "__main__":
    unittest.main()
