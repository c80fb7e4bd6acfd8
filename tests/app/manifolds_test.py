"""The torus of 5.8: manifolds of its critical points, both halves of 5.8.6, motions backwards in time (5.8.9), and what
is said of motions that magnify round-off."""
import math
import unittest

from program_test import overrides
from system_test import LAGRANGE, PENDULUM, SystemTest, TORUS, distance

SINK, LOWER_SADDLE, UPPER_SADDLE, SOURCE = 1, 2, 3, 4  # by rising potential
UPRIGHT = {"System": "torus", "Analysis": "manifolds", "Time/End": 150, "Output/Samples": 150}


class Manifolds(SystemTest):
    def connections(self, scene, changes={}):
        folder = f"run{id(changes)}"
        self.run_done("run", self.scene(scene) if isinstance(scene, dict) else scene, "--quiet", "--output", folder,
                      *overrides(changes))
        self.folder = folder
        return self.table(folder, "connections.csv")

    @staticmethod
    def ends(table, start, stable=0):
        return [to for origin, s, to in zip(table.column("from"), table.column("stable"), table.column("to"))
                if (origin, s) == (start, stable)]

    def test_upright_torus(self):
        """5.8.8: the unstable manifold of the upper saddle is in the stable one of the lower saddle. Of 100 starts around
        the source, those along the tube come to the upper saddle, and all others to the sink."""
        table = self.connections(UPRIGHT, {"Manifolds/Starts": 100})
        self.assertEqual(self.ends(table, LOWER_SADDLE), [SINK, SINK])
        self.assertEqual(self.ends(table, UPPER_SADDLE), [LOWER_SADDLE, LOWER_SADDLE])
        from_source = self.ends(table, SOURCE)
        self.assertEqual(len(from_source), 100)
        self.assertEqual([k for k, to in enumerate(from_source) if to == UPPER_SADDLE], [0, 50])
        self.assertEqual(sum(to == SINK for to in from_source), 98)
        self.assertEqual(self.ends(table, SINK), [], "it has no unstable manifold")
        self.assertTrue(all(d < 1e-6 for d, to in zip(table.column("distance"), table.column("to")) if to))

    def test_rows(self):
        table = self.connections(UPRIGHT, {"Manifolds/Starts": 8, "Output/Report": "true"})
        rows = self.table(self.folder, "manifolds.csv")
        self.assertTrue(rows.is_finite())
        self.assertEqual(sorted(set(rows.column("curve"))), table.column("curve"))
        for curve, stable, w, t in zip(*(rows.column(c) for c in ("curve", "stable", "w", "time"))):
            origin = table.column("from")[int(curve) - 1]
            self.assertTrue(t <= 0 if stable else t >= 0)
            if origin == UPPER_SADDLE and not stable:
                self.assertEqual(w, math.pi, "the inner circle")
        self.assertEqual(self.table(self.folder, "equilibria.csv").column("morse_index"), [0, 1, 1, 2])
        self.assertIn("connections.csv", self.bytes(self.folder, "report.html").decode())

    def test_both_halves_of_5_8_6(self):
        """The connection is broken by a change of V with D as it is, and by one of D with V as it is; not by any c(q)."""
        for changes, to in (({"Torus/Tilt": 0.01}, SINK), ({"Torus/Grain": 0.05, "Torus/Grain angle": 0.5}, SINK),
                            ({"Torus/Damping variation": "0.5, -0.3"}, LOWER_SADDLE),
                            ({"Torus/Grain": 0.5}, LOWER_SADDLE),  # along the tube: the circle is still invariant
                            ({"Torus/Grain": 0.5, "Torus/Grain angle": math.pi / 2}, LOWER_SADDLE)):
            table = self.connections(UPRIGHT, {**changes, "Manifolds/Starts": 2})
            if changes == {"Torus/Grain": 0.5, "Torus/Grain angle": math.pi / 2}:
                self.assertIn(self.ends(table, UPPER_SADDLE)[0], (LOWER_SADDLE, SINK), "cos of pi/2 is 6e-17")
                continue
            self.assertEqual(self.ends(table, UPPER_SADDLE), [to, to], changes)

    def test_conservative_pendulum(self):
        """Without friction nothing comes to rest: energy keeps the motions that leave a point away from lower ones."""
        for form in ({}, LAGRANGE):
            table = self.connections({**PENDULUM, **form}, {"Analysis": "manifolds", "Time/End": 5, "Manifolds/Starts": 4,
                                                            "Output/Samples": 20})
            self.assertEqual(set(table.column("to")), {0})
            rows = self.table(self.folder, "manifolds.csv")
            points = self.table(self.folder, "equilibria.csv").column("potential")
            for curve, energy in zip(rows.column("curve"), rows.column("energy")):
                self.assertAlmostEqual(energy, points[int(table.column("from")[int(curve) - 1]) - 1], delta=1e-8)

    def test_a_motion_that_cannot_be_followed(self):
        """A point between a uniform field and an attracting center: on one side of the saddle it falls into the center."""
        scene = {"System": "mass points", "Analysis": "manifolds", "Mass points/Masses": 1,
                 "Mass points/Positions": "1.2, 0, 0", "Mass points/Velocities": "0, 0, 0",
                 "Mass points/Central attraction": 1, "Mass points/Field": "1, 0, 0",
                 "Time/End": 20, "Output/Samples": 20}
        result = self.run_program("run", self.scene(scene), "--output", "fall")
        self.assert_exit(result, 3)
        self.assertIn("curve 2", result.stderr)
        table = self.table("fall", "connections.csv")
        self.assertEqual(table.column("curve"), [1, 3, 4], "the other motions are followed")
        self.assertEqual(self.table("fall", "equilibria.csv").column("morse_index"), [1])

    def test_refusals(self):
        for scene, fragments in (({"System": "geodesic", "Analysis": "manifolds"}, ("Analysis", "no critical points")),
                                 ({"Analysis": "manifolds"}, ("Analysis", "other than the ball: mass points, ")),
                                 ({**UPRIGHT, "Manifolds/Starts": 0}, ("Manifolds/Starts", "1")),
                                 ({**UPRIGHT, "Time/Method": "rattle-4"}, ("Time/Method", "explicit-8"))):
            result = self.run_program("run", self.scene(scene))
            self.assert_exit(result, 2)
            self.assert_one_sentence(result, *fragments)


class Backwards(SystemTest):
    def test_there_and_back(self):
        """From the end of a motion back to its start; only c(q) and the grain tell the two directions of time apart."""
        for scene in ({**TORUS, "Torus/Damping variation": "0.3, -0.4", "Torus/Grain": 0.4, "Torus/Grain angle": 0.7},
                      {**PENDULUM, **LAGRANGE}):
            names = ("w", "u", "w_dot", "u_dot") if scene["System"] == "torus" else ("theta", "phi", "theta_dot", "phi_dot")
            section = "Torus" if scene["System"] == "torus" else "Double pendulum"
            scene = {**scene, "Time/End": 3, "Time/Tolerance": 1e-11}
            there = self.motion(scene)
            last = [there.column(name)[-1] for name in names]
            back = self.motion({**scene, f"{section}/Angles": f"{last[0]!r}, {last[1]!r}",
                                f"{section}/Rates": f"{last[2]!r}, {last[3]!r}", "Time/End": -3})
            self.assertEqual(back.column("time")[-1], -3)
            self.assertEqual([t + 3 for t in back.column("time")][::-1][0], there.column("time")[0])
            for name in names:
                self.assertAlmostEqual(back.column(name)[-1], there.column(name)[0], delta=1e-8)

    def test_bound_of_5_8_9(self):
        """E(t) + k <= (E(0) + k) exp(-2 mu t) for t < 0 and >= for t > 0, mu = max c and k = |min V|, with c(q)."""
        scene = {**TORUS, "Torus/Tilt": 0, "Torus/Grain": 0, "Torus/Damping variation": "0.5, 0.4"}
        mu, k = 0.2 * 1.9, 1.3 * (2.5 + 0.8)
        for end in (10, -10):
            table = self.motion(scene, {"Time/End": end})
            E0 = table.column("energy")[0]
            for t, E, bound in zip(*(table.column(c) for c in ("time", "energy", "energy_bound"))):
                self.assertAlmostEqual(bound, (E0 + k) * math.exp(-2 * mu * t) - k, delta=1e-9 * (1 + abs(bound)))
                self.assertTrue(E <= bound + 1e-9 if end < 0 else E >= bound - 1e-9)
            growth = math.log((table.column("energy")[-1] + k) / (E0 + k)) / (-2 * mu * end)
            self.assertTrue(0.2 < growth < 1, "the bound is not empty")
        constant = self.motion({**TORUS, "Torus/Tilt": 0, "Torus/Gravity": 0, "Torus/Grain": 0,
                                "Torus/Damping variation": "0, 0"}, {"Time/End": -10})
        for E, bound in zip(constant.column("energy"), constant.column("energy_bound")):
            self.assertAlmostEqual(E / bound, 1, delta=1e-6, msg="with V = 0 and c constant it is the motion's own energy")

    def test_resumed(self):
        for method in ("explicit-8", "gauss-16"):
            with self.subTest(method):
                self.check_resumed(method)

    def check_resumed(self, method):
        scene = {**TORUS, "Time/End": -4, "Time/Method": method}
        path = self.scene(scene)
        self.run_done("run", path, "--quiet", "--output", "short")
        self.run_done("run", path, "--quiet", "--output", "short", "--resume", "--set", "Time/End=-8")
        whole = self.motion({**scene, "Time/End": -8, "Output/Samples": 100})
        self.assertLess(distance(self.table("short", "torus.csv"), whole, ["w", "u"]), 1e-5)
        result = self.run_program("run", path, "--output", "short", "--resume", "--set", "Time/End=9")
        self.assert_exit(result, 2)
        self.assert_one_sentence(result, "Time/End = 9", "other side of the start")

    def test_refusals(self):
        for scene in ({}, {"System": "mass points"}, {**PENDULUM}, {"System": "rigid body"}, {"System": "geodesic"}):
            result = self.run_program("run", self.scene({**scene, "Time/End": -1}))
            self.assert_exit(result, 2)
            self.assert_one_sentence(result, "Time/End", "expected a number > 0", "backwards")
        result = self.run_program("run", self.scene({**TORUS, "Torus/Damping variation": "0.6, -0.5"}))
        self.assert_exit(result, 2)
        self.assert_one_sentence(result, "Torus/Damping variation", "less than 1")


class MagnifiedRoundOff(SystemTest):
    def estimate(self, scene):
        table = self.motion(scene)
        model = self.json(table.folder, "manifest.json")["models"][table.file]
        return model["counters"]["estimated_time_error"], table, self.bytes(table.folder, "log.txt").decode()

    def test_standing_pendulum(self):
        """The angles pi are no numbers of double precision: what happens after the fall is their rounding."""
        scene = {**PENDULUM, **LAGRANGE, "Double pendulum/Angles": f"{math.pi!r}, {math.pi!r}",
                 "Double pendulum/Rates": "0, 0", "Time/End": 30}
        error, table, log = self.estimate(scene)
        self.assertGreater(max(map(abs, table.column("theta_dot"))), 0.1, "it falls")
        self.assertGreater(error, 0.5)
        self.assertIn("round-off grows beyond the tolerance", log)

    def test_circles_of_the_torus(self):
        """On the exact circle nothing is magnified, and the estimate is that of the motion along it."""
        error, _, log = self.estimate({"System": "torus", "Torus/Angles": f"{math.pi!r}, 0.01", "Time/End": 200})
        self.assertLess(error, 1e-6)
        self.assertNotIn("round-off grows", log)

    def test_regular_motions(self):
        for scene in ({**TORUS, "Time/Tolerance": 1e-9}, {**PENDULUM, **LAGRANGE, "Time/Tolerance": 1e-9}):
            error, _, log = self.estimate(scene)
            self.assertLess(error, 1e-9)
            self.assertNotIn("round-off", log)


if __name__ == "__main__":
    unittest.main()
