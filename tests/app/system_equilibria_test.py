"""Critical points of the systems beside the ball, from parameter file to equilibria.csv."""
import math
import re
import unittest

from system_test import ELLIPSOID, EULER, FRAME, JACOBI, LAGRANGE, PENDULUM, SystemTest


class SystemEquilibria(SystemTest):
    def equilibria(self, scene, changes={}):
        table = self.motion(scene, {**changes, "Analysis": "equilibrium"})
        self.assertEqual(table.file, "equilibria")
        self.assertEqual(table.column("index"), list(range(1, len(table) + 1)))
        self.assertTrue(table.is_finite())
        return table

    def test_double_pendulum(self):
        for form in ({}, LAGRANGE):
            table = self.equilibria("double_pendulum", form)
            self.assertEqual(table.column("morse_index"), [0, 1, 1, 2])
            self.assertEqual(table.column("nullity"), [0] * 4)
            self.assertEqual(table.column("n_unstable"), [0, 1, 1, 2])
            self.assertEqual(table.column("n_stable"), [4, 3, 3, 2])
            for V, units_of_g in zip(table.column("potential"), (-3, -1, 1, 3)):
                self.assertAlmostEqual(V, units_of_g * 9.81, delta=1e-10)
            # Of equal masses and rods: ω² = (2 ± √2) g/l, and the same with the other sign where both stand.
            for row, sign in ((0, 1), (3, -1)):
                curvatures = sorted(abs(table.column(f"hessian_{k}")[row]) for k in (1, 2))
                for curvature, root in zip(curvatures, (-1, 1)):
                    self.assertAlmostEqual(curvature, (2 + root * math.sqrt(2)) * 9.81, delta=1e-6)
                self.assertTrue(all(sign * table.column(f"hessian_{k}")[row] > 0 for k in (1, 2)))
            # Rates are those of the pendulum itself, without friction.
            rates = sorted(table.column(f"rate_{k}_im")[0] for k in (1, 2, 3, 4))
            slow, fast = (math.sqrt((2 + root * math.sqrt(2)) * 9.81) for root in (-1, 1))
            for rate, expected in zip(rates, (-fast, -slow, slow, fast)):
                self.assertAlmostEqual(rate, expected, delta=1e-7)
            for k in (1, 2, 3, 4):
                self.assertEqual(table.column(f"rate_{k}_re")[0], 0)
                self.assertEqual(table.column(f"rate_{k}_im")[3], 0)
        self.assertEqual([[round(math.cos(x)) for x in (row[1], row[2])] for row in table.rows],
                         [[1, 1], [1, -1], [-1, 1], [-1, -1]])

    def test_documented_columns(self):
        documented = [name for name, _ in self.documented_columns("equilibria", of=" of systems other than the ball")][1:]  # there is no time
        for scene in ("double_pendulum", "torus", "heavy_top"):
            header = self.equilibria(scene).header
            known = [name for name in documented if name in header]
            self.assertEqual(known, documented)
            others = [name for name in header if name not in known]
            self.assertTrue(all(re.fullmatch(r"(hessian_\d|rate_\d_re|rate_\d_im|theta|phi|[xy][12]|w|u|R\d\d)", name)
                                for name in others), others)

    def test_torus(self):
        table = self.equilibria("torus")
        heights = [(3 + math.cos(w)) * math.cos(u) for w, u in zip(table.column("w"), table.column("u"))]
        for height, V, expected in zip(heights, table.column("potential"), (-4, -2, 2, 4), strict=True):
            self.assertAlmostEqual(height, expected, delta=1e-12)
            self.assertAlmostEqual(V, expected, delta=1e-12)
        self.assertEqual(table.column("morse_index"), [0, 1, 1, 2])
        self.assertEqual(table.column("n_unstable"), [0, 1, 1, 2])
        for k in range(4):  # rates s² + c s + κ = 0 with c = 1
            rates = [complex(table.column(f"rate_{i}_re")[k], table.column(f"rate_{i}_im")[k]) for i in (1, 2, 3, 4)]
            curvatures = [table.column(f"hessian_{i}")[k] for i in (1, 2)]
            for s in rates:
                self.assertLess(min(abs(s * s + s + curvature) for curvature in curvatures), 1e-9)
        self.assertEqual(self.equilibria("torus", {"Torus/Tilt": 0.05}).column("morse_index"), [0, 1, 1, 2])

    def test_heavy_top(self):
        for form in ({}, EULER, {"Rigid body/Form": "lagrange"}):
            table = self.equilibria("heavy_top", form)
            self.assertEqual(table.column("morse_index"), [0, 2])
            self.assertEqual(table.column("nullity"), [1, 1], "turns about the vertical")
            self.assertEqual([round(x, 12) for x in table.column("R33")], [-1, 1])
            for V, sign in zip(table.column("potential"), (-1, 1)):
                self.assertAlmostEqual(V, sign * 0.5 * 9.81 * 0.05, delta=1e-12)

    def test_every_place_of_a_free_body(self):
        table = self.equilibria("free_body")
        self.assertEqual(set(zip(table.column("morse_index"), table.column("nullity"))), {(0, 6)})

    def test_double_pendulum_without_gravity(self):
        for form in ({}, LAGRANGE):
            table = self.equilibria("double_pendulum", {**form, "Double pendulum/Gravity": 0})
            self.assertEqual([table.column("morse_index"), table.column("nullity")], [[0], [2]], "one torus of places")

    def test_points_on_a_spring(self):
        table = self.equilibria({"System": "mass points", "Mass points/Masses": "1, 1", "Mass points/Springs": "1, 2, 1, 1",
                                 "Mass points/Gravitational constant": 0, "Mass points/Confinement": 1})
        # Confinement k x against the spring 1 − 2x: x = 1/3 from the centre, in any direction.
        self.assertEqual((table.column("morse_index"), table.column("nullity")), ([0], [2]))
        self.assertAlmostEqual(math.hypot(*(table.column(x)[0] for x in ("x1", "y1", "z1"))), 1 / 3, delta=1e-9)

    def test_units(self):
        reference = self.equilibria(PENDULUM)
        length, time, mass = 1e6, 1e-9, 1e6
        entries = self.used_entries(reference.folder)
        del entries["Output/Directory"]
        scaled = self.equilibria(self.scaled_entries(entries, {"length": length, "mass": mass, "time": time}, {}))
        for name, factor in (("potential", mass * length**2 / time**2), ("y1", length), ("hessian_1", 1 / time**2),
                             ("rate_1_im", 1 / time)):
            for a, b in zip(reference.column(name), scaled.column(name), strict=True):
                self.assertAlmostEqual(b / factor, a, delta=1e-9 * abs(a), msg=name)

    def test_refused_where_there_is_none(self):
        for scene in (FRAME, ELLIPSOID, JACOBI):
            self.scene({**scene, "Analysis": "equilibrium"})
            for command in ("run", "check"):
                self.assert_one_sentence(self.run_program(command, "scene.prm"), "scene.prm:", "Analysis", scene["System"])
            self.assertEqual(self.files(), ["scene.prm"])


if __name__ == "__main__":
    unittest.main()
