"""The continuum beside the reduced body: compressible, under loads, with dissipation; the same meaning in both models."""
import math
import re
import unittest

from program_test import SOURCE, largest_difference, overrides, words
from stopped_run import StoppedRunTest

BOTH = {"Models": "reduced, continuum", "Continuum/Degree": 2, "Time/End": 2, "Output/Samples": 20, "Time/Tolerance": 1e-5}
VOLUME = 4 * math.pi / 3


class ContinuumLoads(StoppedRunTest):
    def run_scene(self, entries, name="scene"):
        self.scene(entries, f"{name}.prm")
        self.run_done("run", f"{name}.prm")
        return [self.table(f"output/{name}/{model}.csv") for model in ("reduced", "continuum")]

    def run_params(self, name, *options):
        self.scene((SOURCE / f"params/{name}.prm").read_text(), f"{name}.prm")
        self.run_done("run", f"{name}.prm", *options)
        return [self.table(f"output/{name}/{model}.csv") for model in ("reduced", "continuum")]

    def assert_constant(self, column, tolerance):
        self.assertLess(max(column) - min(column), tolerance)

    def test_traction_scene(self):
        head = (SOURCE / "params/traction.prm").read_text()
        stretch, traction = map(float, re.search(r"l = (\S+) for P33 = ([\d.]+\d)", head).groups())
        self.assertAlmostEqual(stretch - 1 / stretch**2, traction, delta=1e-4)
        tables = self.run_params("traction")
        for q, external in zip(tables[0].column("Q33"), tables[0].column("external")):
            self.assertAlmostEqual(external, -VOLUME * traction * q, delta=1e-10)
        for table in tables:
            self.assertAlmostEqual(table.column("Q33")[-1], stretch, delta=2e-5)
            self.assertAlmostEqual(table.column("Q11")[-1], stretch**-0.5, delta=2e-5)
            self.assertAlmostEqual(table.column("external")[-1], -VOLUME * traction * stretch, delta=1e-3)
            self.assert_constant(table.column("energy"), 1e-3 * abs(table.column("external")[0]))
            self.assertGreater(table.column("dissipated")[-1], 0.01)

    def test_damped_scene(self):
        reduced, continuum = self.run_params("damped", *overrides({"Time/End": 8, "Output/Samples": 80}))
        for table, momentum in ((reduced, 1e-5), (continuum, 1e-12)):  # an explicit method, and RATTLE
            energy, dissipated = table.column("energy"), table.column("dissipated")
            print(max(energy) - min(energy), dissipated[-1])
            self.assert_constant(energy, 1e-3 * energy[0])
            self.assertGreater(dissipated[-1], 0.1 * energy[0])
            self.assertTrue(all(b >= a - 1e-12 for a, b in zip(dissipated, dissipated[1:])))
            self.assert_constant(table.column("J3"), momentum)

    def test_compressible_scene(self):
        reduced, continuum = self.run_params("compressible", *overrides({"Time/End": 5, "Output/Samples": 100}))
        for table in (reduced, continuum):
            energy, volume = table.column("energy"), table.column("volume_ratio")
            self.assert_constant(energy, 1e-4 * energy[0])
            self.assertGreater(max(volume) - min(volume), 0.02)
            self.assertEqual(set(table.column("multiplier")), {0.0})
        comparison = self.json("output/compressible/comparison.json")
        self.assertNotIn("18.6", comparison["summary"])
        manifest = self.json("output/compressible/manifest.json")
        counters = manifest["models"]["continuum"]["counters"]
        self.assertFalse({"multipliers", "gram_iterations", "max_scaled_constraint"} & set(counters))
        self.assertIn("pressure space: the body is compressible", (self.scratch / "output/compressible/log.txt").read_text())

    def test_every_law_of_the_compressible_body(self):
        others = {"none", "saint-venant-kirchhoff (as printed)"}  # refused; stressed at rest, below
        for law in sorted(set(words("Material/Law")) - others):
            with self.subTest(law):
                tables = self.run_scene({**BOTH, "Body/Incompressible": "false", "Material/Law": law, "Time/End": 0.5,
                                         "Initial state/Deformation": "1.05, 0, 0; 0, 1, 0; 0, 0, 0.98"})
                for table in tables:
                    energy = table.column("energy")
                    self.assert_constant(energy, 1e-3 * max(max(table.column("kinetic")), abs(energy[0])))
                log = (self.scratch / "output/scene/log.txt").read_text()
                self.assertEqual("Warnings:" in log, "saint" in law or "printed" in law)

    def test_a_law_that_is_stressed_at_rest_ends_in_a_message(self):
        """Saint Venant–Kirchhoff as printed: the wave from the surface, which is stressed, turns the centre inside out."""
        self.scene({**BOTH, "Models": "continuum", "Body/Incompressible": "false",
                    "Material/Law": "saint-venant-kirchhoff (as printed)"})
        result = self.run_program("run", "scene.prm")
        self.assertEqual(result.returncode, 3)
        self.assertIn("turned inside out", result.stderr)

    def test_nearly_incompressible_steps_are_stable(self):
        """Pressure waves 30 times as fast as shear waves set the step that the program chooses."""
        scene = {**BOTH, "Models": "continuum", "Body/Incompressible": "false", "Material/Lame lambda": 1000, "Time/End": 1,
                 "Time/Tolerance": 1e-3, "Initial state/Velocity": "0.3, 0, 0; 0, 0, 0; 0, 0, -0.3"}
        self.scene(scene)
        self.run_done("run", "scene.prm")
        energy = self.table("output/scene/continuum.csv").column("energy")
        step = self.json("output/scene/manifest.json")["models"]["continuum"]["counters"]["step"]
        self.assertLess(step, 2e-2)
        self.assert_constant(energy, 0.02 * energy[0])

    def test_falling_and_swinging(self):
        """The centre of mass goes its way as a point, in both models, and the body's own motion does not notice."""
        body = {**BOTH, "Initial state/Deformation": "1.1, 0, 0; 0, 1, 0; 0, 0, $(1/1.1)", "Time/Step": 0.005,
                "Time/Method": "rattle"}
        still = self.run_scene(body, "still")
        falling = self.run_scene({**body, "Loads/Acceleration": "0, 0, -2", "Initial state/Center": "0, 0, 3",
                                  "Initial state/Center velocity": "0, 0, 1"}, "falling")
        for rest, fall in zip(still, falling):
            for k, t in enumerate(fall.column("time")):
                self.assertAlmostEqual(fall.column("x3")[k], 3 + t - t * t, delta=1e-12)
                self.assertAlmostEqual(fall.column("v3")[k], 1 - 2 * t, delta=1e-12)
            self.assert_constant(fall.column("energy"), 1e-3)
            for name in ("Q11", "Q22", "Q33", "elastic", "multiplier"):
                for a, b in zip(rest.column(name), fall.column(name)):
                    self.assertAlmostEqual(a, b, delta=1e-9, msg=name)
        self.assertIn("quarter (planes x, y)", (self.scratch / "output/falling/log.txt").read_text())
        # A trap: x3 = 0.5 cos(2t); drag as well is that of a point.
        for c in (0, 0.8):
            tables = self.run_scene({**body, "Loads/Tidal matrix": "4, 0, 0; 0, 4, 0; 0, 0, 4", "Material/Drag": c,
                                     "Initial state/Center": "0, 0, 0.5"}, "trap")
            nu = math.sqrt(4 - c * c / 4)
            for table, tolerance in zip(tables, (1e-12, 1e-4)):  # the continuum's by steps of 0.005
                for t, x in zip(table.column("time"), table.column("x3")):
                    exact = 0.5 * math.exp(-c * t / 2) * (math.cos(nu * t) + c / (2 * nu) * math.sin(nu * t))
                    self.assertAlmostEqual(x, exact, delta=tolerance)
            for name in ("external", "dissipated", "energy"):  # the parts of the centre count in both
                self.assertAlmostEqual(tables[0].column(name)[0], tables[1].column(name)[0], delta=0.02)

    def test_pressure(self):
        """A compressible ball at the rest that its law gives, (2/3) W' = -2 p a^2; an incompressible one does not notice."""
        p, lame = 0.4, 1.5
        force = lambda a: (a - 1 / a) + lame / 2 * (a**5 - 1 / a) + p * a * a
        low, high = 0.5, 1
        while high - low > 1e-15:
            middle = (low + high) / 2
            low, high = (low, middle) if force(middle) > 0 else (middle, high)
        a = repr((low + high) / 2)
        at_rest = {**BOTH, "Body/Incompressible": "false", "Material/Lame lambda": lame, "Loads/Pressure": p,
                   "Initial state/Deformation": f"{a}, 0, 0; 0, {a}, 0; 0, 0, {a}", "Time/Step": 0.01, "Time/Method": "rattle"}
        for table in self.run_scene(at_rest):
            for q, external in zip(table.column("Q11"), table.column("external")):
                self.assertAlmostEqual(q, float(a), delta=1e-13)
            self.assertGreater(external, 0)
        self.assertIn("follower pressure on the surface", (self.scratch / "output/scene/log.txt").read_text())
        moving = {**at_rest, "Initial state/Deformation": "1.1, 0, 0; 0, 1, 0; 0, 0, 0.95"}
        for coarse, fine in zip(self.run_scene(moving), self.run_scene({**moving, "Time/Step": 0.005})):
            self.assertGreater(max(fine.column("external")) - min(fine.column("external")), 0.05)
            # RATTLE is of order 2: the energy comes and goes a quarter as much with half the step.
            variations = [max(table.column("energy")) - min(table.column("energy")) for table in (coarse, fine)]
            self.assertAlmostEqual(variations[0] / variations[1], 4, delta=0.2)
            self.assertLess(variations[1], 1e-3)
        release = {**BOTH, "Initial state/Deformation": "1.1, 0, 0; 0, 1, 0; 0, 0, $(1/1.1)", "Time/Step": 0.01,
                   "Time/Method": "rattle"}
        without = self.run_scene(release, "without")
        pressed = self.run_scene({**release, "Loads/Pressure": p}, "pressed")
        for one, other in zip(without, pressed):
            self.assertEqual(one.rows, other.rows)
        self.assertIn("the multiplier 2 higher", (self.scratch / "output/pressed/log.txt").read_text())

    def test_periodic_tide(self):
        """Both models under a periodic tide, their centre of mass on its own way: x3 of both agree."""
        for options in ({}, {"Body/Incompressible": "false", "Material/Drag": 0.1}):
            deformation = "1.05, 0, 0; 0, 1, 0; 0, 0, " + ("0.97" if options else "$(1/1.05)")
            tables = self.run_scene({**BOTH, **options, "Initial state/Deformation": deformation, "Time/Step": 0.005,
                                     "Time/Method": "rattle", "Loads/Tidal amplitude": "0.6, 0, 0; 0, -0.3, 0; 0, 0, -0.3",
                                     "Loads/Tidal frequency": 3, "Loads/Tidal phase": 0.5, "Loads/Acceleration": "0, 0, -0.3",
                                     "Initial state/Center": "0, 0, 0.5"})
            for table in tables:
                energy, external = table.column("energy"), table.column("external")
                self.assert_constant(energy, 1e-3 * (max(external) - min(external)))
            # The balls answer each in their own way, their centres of mass alike, to the error of the step.
            for name in "x3", "v3":
                for a, b in zip(*(table.column(name) for table in tables)):
                    self.assertAlmostEqual(a, b, delta=1e-5, msg=name)
        self.assertIn("periodic tide, and the energy that it gives", (self.scratch / "output/scene/log.txt").read_text())

    def test_a_driven_run_goes_on_after_an_interrupt(self):
        scene = {"Models": "reduced", "Time/End": 1e4, "Time/Step": 0.005, "Time/Method": "rattle", "Output/Samples": 100,
                 "Loads/Tidal amplitude": "0.2, 0, 0; 0, -0.1, 0; 0, 0, -0.1", "Loads/Tidal frequency": 7,
                 "Initial state/Center": "0, 0, 0.5", "Initial state/Velocity": "0, -0.3, 0; 0.3, 0, 0; 0, 0, 0"}
        self.check_control_c(scene, "reduced", 0)

    def test_loads_that_rise(self):
        """A traction that rises over four periods stretches the body with hardly an oscillation, in every model; at once, by twice as
        much for a while. The energy, less what the rise has given, is constant; the end is that of the static stretch."""
        stretch = 1.05
        scene = {"Models": "reduced, polynomial, continuum", "Polynomial/Degree": 3, "Continuum/Degree": 3,
                 "Loads/Nominal traction": f"0, 0, 0; 0, 0, 0; 0, 0, {stretch - stretch**-2!r}", "Loads/Acceleration": "0, 0, 1e-3",
                 "Time/End": 16, "Output/Samples": 160, "Time/Tolerance": 1e-6}
        models = "reduced", "polynomial", "continuum"
        for name, rise in ("rising", 10), ("at_once", 0):
            self.scene({**scene, "Loads/Rise time": rise}, f"{name}.prm")
            self.run_done("run", f"{name}.prm")
        for model in models:
            rising, at_once = (self.table(f"output/{name}/{model}.csv") for name in ("rising", "at_once"))
            late = [q for t, q in zip(rising.column("time"), rising.column("Q33")) if t >= 10]
            self.assertLess(max(abs(q - stretch) for q in late), 1e-3, model)
            self.assertGreater(max(at_once.column("Q33")) - stretch, 0.8 * (stretch - 1), model)
            bound = 4e-6 * math.sqrt(3) / (stretch - 1)  # of a motion whose Q has the error 1e-6 (analysis/motion.h)
            self.assert_constant(rising.column("energy"), bound * max(rising.column("elastic")))
            # b ∫s dt twice: T²/7 until T = 10 for this s (∫∫ of 10x³ − 15x⁴ + 6x⁵ is 1/7), v = b T/2 at T
            at = rising.column("time").index(16)
            self.assertAlmostEqual(rising.column("x3")[at], 1e-3 * (100 / 7 + 10 / 2 * 6 + 6**2 / 2), delta=1e-8)

    def test_a_run_under_rising_loads_goes_on_after_an_interrupt(self):
        self.check_control_c({"Models": "continuum", "Continuum/Degree": 2, "Loads/Nominal traction": "0, 0, 0; 0, 0, 0; 0, 0, 0.3",
                              "Loads/Rise time": 15, "Time/End": 20, "Output/Samples": 20, "Time/Step": 0.001, "Time/Method": "rattle"},
                             "continuum")

    def test_any_units_of_loads(self):
        def scene(length, mass, time):
            rate, speed, stress = 1 / time, length / time, mass / (length * time**2)
            row = lambda *v: ", ".join(repr(x) for x in v)
            return {**BOTH, "Models": "continuum", "Body/Incompressible": "false", "Body/Radius": repr(length),
                    "Body/Density": repr(mass / length**3), "Material/Shear modulus": repr(stress),
                    "Material/Lame lambda": repr(2 * stress), "Material/Viscosity": repr(0.02 * stress * time),
                    "Material/Drag": repr(0.1 * rate), "Loads/Tidal matrix": f"{0.3 * rate**2!r}, 0, 0; 0, 0, 0; 0, 0, 0",
                    "Loads/Acceleration": row(0.0, 0.0, -0.5 * speed * rate), "Initial state/Center": row(0.0, 0.0, length),
                    "Initial state/Center velocity": row(0.0, 0.0, speed),
                    "Loads/Nominal traction": f"0, 0, 0; 0, {0.2 * stress!r}, 0; 0, 0, 0",
                    "Loads/Pressure": repr(0.3 * stress), "Loads/Tidal frequency": repr(2 * rate),
                    "Loads/Tidal amplitude": f"0, 0, 0; 0, {0.4 * rate**2!r}, 0; 0, 0, 0", "Time/End": repr(time),
                    "Time/Step": repr(0.005 * time), "Time/Method": "rattle"}
        tables = {}
        for name, units in {"reference": (1.0, 1.0, 1.0), "scaled": (1e3, 1e-6, 1e2)}.items():
            self.scene(scene(*units), f"{name}.prm")
            self.run_done("run", f"{name}.prm")
            table = tables[name] = self.table(f"output/{name}/continuum.csv")
            length, mass, time = units
            unit = {"time": time, "x": length, "v": length / time, "Qdot": 1 / time, "J": mass * length**2 / time,
                    "Z": mass * length**2 / time, "multiplier": time**-2, "a": length}
            plain = {"Q", "F", "volume_ratio", "nonaffine_kinetic_fraction", "nonaffine_displacement", "min_jacobian", "volume_error",
                     "max_volume_error"}
            scale = [1 if column.rstrip("123") in plain else unit.get(column.rstrip("123"), mass * length**2 / time**2)
                     for column in table.header]
            table.rows = [[x / s for x, s in zip(values, scale)] for values in table.rows]
        self.assertLess(largest_difference(tables["reference"], tables["scaled"]), 1e-10)

    def test_a_damped_run_goes_on_after_an_interrupt(self):
        scene = {**BOTH, "Models": "continuum", "Continuum/Degree": 3, "Material/Viscosity": 0.01, "Time/End": 10,
                 "Time/Step": 0.005, "Time/Method": "rattle", "Output/Samples": 100,
                 "Initial state/Velocity": "0, -0.3, 0; 0.3, 0, 0; 0, 0, 0"}
        self.check_control_c(scene, "continuum", 1e-11)
        self.assert_constant(self.table("parts/continuum.csv").column("energy"), 1e-4)

    def test_compressible_modes(self):
        """omega beside the exact frequencies of the compressible sphere; radial: x cot x = 1 − (x²/4)(c_p/c_s)²."""
        self.scene({"Models": "continuum", "Analysis": "modes", "Body/Incompressible": "false", "Continuum/Degree": 6,
                    "Modes/Number": 6, "Material/Shear modulus": 4})
        self.run_done("run", "scene.prm")
        table = self.table("output/scene/modes.csv")
        rows = [dict(zip(table.header, row)) for row in table.rows]
        for row in rows:
            print(row["kind"], row["degree"], row["omega"], row["omega"] / row["exact"] - 1)
            self.assertAlmostEqual(row["omega"] / row["exact"], 1, delta=1e-6)
        radial = next(row for row in rows if (row["kind"], row["degree"]) == (1, 0))
        lame, shear = 1, 4
        cp = math.sqrt(lame + 2 * shear)
        x = radial["omega"] / cp
        slope = 1 / math.tan(x) - x / math.sin(x) ** 2 + x / 2 * (cp * cp / shear)
        self.assertLess(abs((x / math.tan(x) - 1 + x * x / 4 * cp * cp / shear) / (slope * x)), 1e-8)
        self.assertAlmostEqual(radial["reduced"], math.sqrt(5 * (3 * lame + 2 * shear)), delta=1e-12)

    def test_self_gravity(self):
        """Energies and multiplier of a ball at rest are known; a motion keeps its energy; both models mean the same."""
        scene = {**BOTH, "Continuum/Degree": 4, "Gravity/Constant": 2, "Time/Tolerance": 1e-6}
        for table in self.run_scene(scene, "rest"):
            self.assertAlmostEqual(table.column("gravitational")[-1], -2 * 16 * math.pi**2 / 15, delta=1e-5)
            self.assertAlmostEqual(table.column("multiplier")[-1], 2 * VOLUME, delta=1e-5)
            self.assertAlmostEqual(table.column("Q33")[-1], 1, delta=1e-6)
        released = {**scene, "Initial state/Deformation": "0.95, 0, 0; 0, 0.95, 0; 0, 0, 1.1080332409972299"}
        reduced, continuum = self.run_scene(released, "released")
        self.assertAlmostEqual(continuum.column("gravitational")[0] / reduced.column("gravitational")[0], 1, delta=1e-6)
        for table in reduced, continuum:
            self.assert_constant(table.column("energy"), 1e-4 * max(table.column("kinetic")))
            self.assertGreater(max(table.column("gravitational")) - min(table.column("gravitational")), 1e-2)

    def test_what_is_refused(self):
        def refuse(entries, *words):
            self.scene({**BOTH, **entries})
            result = self.run_program("run", "scene.prm")
            self.assert_one_sentence(result, *words)
        refuse({"Gravity/Constant": 1, "Body/Incompressible": "false"}, "Gravity/Constant: self-gravity of a compressible body", "set Models = reduced")
        refuse({"Body/Semi-axes": "1, 1, 2"}, "Body/Semi-axes", "set Models = reduced")
        refuse({"Material/Law": "none"}, "Material/Law: a fluid with neither")
        refuse({"Material/Viscosity": 0.1, "Time/Method": "rattle-4"}, "Time/Method", "backwards in time")
        refuse({"Loads/Nominal traction": "1, 0; 0, 1"}, "Loads/Nominal traction", "3x3 matrix")
        refuse({"Material/Viscosity": -1}, "Material/Viscosity")
        refuse({"Loads/Acceleration": "1, 0, 0", "Continuum/Symmetry": "octant"}, "Continuum/Symmetry", "normal x",
               "Loads/Acceleration")
        refuse({"Models": "continuum", "Analysis": "modes", "Material/Viscosity": 1}, "Material/Viscosity", "ball alone")
        tide = {"Models": "reduced", "Loads/Tidal amplitude": "0.2, 0, 0; 0, -0.1, 0; 0, 0, -0.1"}
        refuse({**tide, "Time/Method": "symmetric-8"}, "Time/Method", "depend on the position alone")
        refuse({**tide, "Time/Method": "energy-momentum"}, "Time/Method", "energy-momentum")
        refuse({**tide, "Analysis": "equilibrium"}, "Loads/Tidal amplitude", "no body is in equilibrium")
        refuse({"Models": "reduced", "Loads/Tidal amplitude": "0, 1, 0; 0, 0, 0; 0, 0, 0"}, "Loads/Tidal amplitude",
               "symmetric")

    def test_principal_stretches(self):
        """Those of the start are exact; later none of the mean exceeds the largest anywhere (norms are convex)."""
        tables = self.run_scene({**BOTH, "Initial state/Deformation": "0, 1.25, 0; 0.8, 0, 0; 0, 0, -1",
                                 "Output/Quantities": "stretches", "Output/Samples": 4})
        for table in tables:
            for i, exact in enumerate((1.25, 1, 0.8)):
                self.assertAlmostEqual(table.column(f"stretch{i + 1}")[0], exact, delta=1e-12)
        continuum = tables[1]
        self.assertEqual(tables[0].header + ["max_stretch", "min_stretch"], continuum.header)
        self.assertAlmostEqual(continuum.column("max_stretch")[0], 1.25, delta=1e-12)
        self.assertAlmostEqual(continuum.column("min_stretch")[0], 0.8, delta=1e-12)
        for largest, of_mean, least in zip(*map(continuum.column, ("max_stretch", "stretch1", "min_stretch"))):
            self.assertGreater(largest, of_mean - 1e-12)
            self.assertGreater(least, 0)
        self.assertGreater(continuum.column("max_stretch")[-1], continuum.column("stretch1")[-1] + 1e-4)


if __name__ == "__main__":
    unittest.main()
