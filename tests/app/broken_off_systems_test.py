"""Motions of the systems beside the ball that break off before their end."""
import math
import re
import unittest

from program_test import STOPPED, methods, overrides
from system_test import ELLIPSOID, INERTIAL, SystemTest, drift


class SystemBreaksOff(SystemTest):
    """Motions that end before Time/End: exit code 3, one sentence, and only numbers that mean something."""

    def check_breaks_off(self, scene, end, *reasons):
        """At the time `end`, by a message in the scene's units."""
        self.scene(scene)
        result = self.run_program("run", "scene.prm", "--quiet")
        self.assert_exit(result, STOPPED)
        (error,) = [line for line in result.stderr.splitlines() if not line.startswith("warning: ")]
        match = re.match(r"error: (\w+) stopped at t = ([0-9.e+-]+): (.*); the state at t = ([0-9.e+-]+)(?:, the last sample,)? is saved", error)
        self.assertIsNotNone(match, error)
        file, stopped_at, reason, saved_at = match.groups()
        self.assertAlmostEqual(float(stopped_at), end, delta=0.02 * end)
        self.assertAlmostEqual(float(saved_at), end, delta=0.02 * end)
        for other in re.findall(r" t = ([0-9.e+-]+)", reason):
            self.assertAlmostEqual(float(other), end, delta=0.02 * end, msg="in the units of the scene: " + error)
        for word in reasons:
            self.assertIn(word, reason)
        table = self.table(f"output/scene/{file}.csv")
        self.assertTrue(table.is_finite())
        self.assertLessEqual(table.column("time")[-1], end)
        self.assertGreater(table.column("time")[-1], 0.9 * end)
        manifest = self.json("output/scene/manifest.json")
        self.assertEqual((manifest["state"], manifest["exit_code"]), ("failed", STOPPED))
        self.assertIn(reason, manifest["message"])
        return table

    # Two points of 0.5 at distance 1 fall onto each other from rest: π/(2√2) by Kepler's third law.
    HEAD_ON = {"System": "mass points", "Mass points/Velocities": "0, 0, 0; 0, 0, 0", "Time/End": 2, "Output/Samples": 200}

    def check_collision(self, method):
        table = self.check_breaks_off({**self.HEAD_ON, "Time/Method": method}, math.pi / math.sqrt(8))
        return drift(table, "energy")

    def test_head_on_collision_with_error_control(self):
        self.assertLess(self.check_collision("explicit-8"), 1e-4)

    def test_head_on_collision_with_energy_momentum(self):
        self.assertLess(self.check_collision("energy-momentum"), 1e-9)

    def test_head_on_collision_with_stages(self):
        self.assertLess(self.check_collision("gauss-16"), 1e-4)

    def test_head_on_collision_with_a_chosen_method(self):
        self.assertLess(self.check_collision("auto"), 1e-4)

    def test_no_method_passes_a_collision_in_silence(self):
        """Of two points the energy at the end shows what the motion is worth; who breaks the tolerance has to say so."""
        self.scene({**self.HEAD_ON, "Time/Tolerance": 1e-4})
        for method in methods():
            with self.subTest(method):
                result = self.run_program("run", "scene.prm", "--quiet", "--output", "run",
                                          *overrides({"Time/Method": method}))
                table = self.table("run/mass_points.csv")
                kept = drift(table, "energy") < 0.01
                self.assertTrue(kept or "warning: " in result.stderr or result.returncode == STOPPED, method)

    def test_geodesic_into_a_pole(self):
        self.check_breaks_off({**ELLIPSOID, "Geodesic/Surface": "sphere", "Geodesic/Point": "1, 0",
                               "Geodesic/Velocity": "2, 0"}, (math.pi - 1) / 2, "pole")

    def test_jacobi_geodesic_at_the_edge_of_its_metric(self):
        # Upwards from x = 1 with h = −1/2 to x = 2, where U = h. The arc is ∫√(2(h − U)) ds = π/2 − 1.
        self.check_breaks_off({"System": "jacobi geodesic", "Jacobi geodesic/Direction": "1, 0", "Time/End": 2},
                              math.pi / 2 - 1)

    def test_fall_into_a_centre(self):
        for form in ({}, INERTIAL):
            self.check_breaks_off({"System": "moving frame", "Moving frame/Attraction": 1, "Moving frame/Spin rate": 0, **form,
                                   "Time/End": 2}, math.pi / math.sqrt(8))


if __name__ == "__main__":
    unittest.main()
