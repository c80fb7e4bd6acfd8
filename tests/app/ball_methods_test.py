#!/usr/bin/python3
"""Methods and constraint tolerance of the finite-element ball."""
from program_test import STOPPED, WRONG_INPUT, ProgramTest, main, overrides

RELEASE = {"Models": "continuum", "Continuum/Degree": 3, "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6",
           "Time/End": 3, "Output/Samples": 30, "Output/Quantities": "state, energies"}


class BallMethods(ProgramTest):
    def counters(self, name, entries):
        self.scene(RELEASE)
        self.run_done("run", "scene.prm", "--output", name, *overrides(entries))
        return self.json(name, "manifest.json")["models"]["continuum"]["counters"]

    def log(self, name):
        return (self.scratch / name / "log.txt").read_text()

    def difference(self, a, b, column="Q33"):
        return max(abs(x - y) for x, y in zip(self.table(a, "continuum.csv").column(column), self.table(b, "continuum.csv").column(column)))

    def test_auto_takes_a_multistep_method_and_says_what_it_keeps(self):
        chosen = self.counters("auto", {"Time/Tolerance": 1e-5})
        rattle = self.counters("rattle", {"Time/Tolerance": 1e-5, "Time/Method": "rattle"})
        self.assertIn("continuum: symmetric-4 (symmetric, not symplectic), step", self.log("auto"))
        self.assertNotIn("symplectic", self.log("rattle"))
        self.assertLess(chosen["forces"], rattle["forces"] / 4)
        # Where accuracy has much room, a glance at an eighth of the pilots' window does.
        at_a_glance = self.counters("glance", {"Time/Tolerance": 1e-3})
        self.assertLess(at_a_glance["pilot_forces"], rattle["pilot_forces"] / 3)
        self.assertLess(self.difference("auto", "rattle"), 1e-5)

    def test_damped_ball(self):
        """Multistep methods are for conservative forces."""
        damped = {"Material/Viscosity": 0.05, "Time/Tolerance": 1e-3}
        self.counters("damped", damped)
        self.assertIn("continuum: rattle, step", self.log("damped"))
        refused = self.run_program("run", "scene.prm", *overrides({**damped, "Time/Method": "symmetric-4"}))
        self.assert_exit(refused, WRONG_INPUT)
        self.assertIn("Time/Method: symmetric multistep methods are for conservative forces", refused.stderr)

    def test_violent_motion_goes_on_with_smaller_steps(self):
        """The steps that are stable at the start turn an element inside out at t = 2.9; a step that is given does so and stops."""
        violent = {"Continuum/Degree": 4, "Initial state/Velocity": "2, 0, 0; 0, 2, 0; 0, 0, -4", "Time/End": 3,
                   "Time/Tolerance": 1e-3, "Output/Samples": 30}
        counters = self.counters("violent", violent)
        self.assertIn("since it fails at t = 2.9", self.log("violent"))
        table = self.table("violent", "continuum.csv")
        self.assertEqual(len(table), 31)
        self.assertTrue(table.is_finite())
        times = table.column("time")
        self.assertEqual(times, sorted(set(times)))
        given = self.run_program("run", "scene.prm", "--output", "given", *overrides(
            {**violent, "Time/Step": 2 * counters["step"], "Time/Method": "symmetric-4"}))
        self.assert_exit(given, STOPPED)

    def test_constraint_tolerance(self):
        loose = self.counters("loose", {"Time/Tolerance": 1e-4})
        tight = self.counters("tight", {"Time/Tolerance": 1e-4, "Time/Constraint tolerance": 1e-13})
        given = self.counters("given", {"Time/Step": loose["step"], "Time/Method": "symmetric-4"})
        asked = self.counters("asked", {"Time/Step": loose["step"], "Time/Method": "symmetric-4", "Time/Constraint tolerance": 1e-6})
        for counters, least, most in (loose, 1e-10, 1e-8), (tight, 0, 1e-13), (given, 0, 1e-13), (asked, 1e-8, 1e-6):
            for name in "max_scaled_constraint", "max_scaled_constraint_rate":
                self.assertLessEqual(counters[name], most)
            self.assertGreaterEqual(counters["max_scaled_constraint"], least)
        self.assertLess(loose["gram_iterations"], 0.7 * tight["gram_iterations"])
        self.assertLess(self.difference("loose", "tight"), 1e-7)  # a thousandth of Time/Tolerance
        self.assertLess(self.difference("asked", "given"), 1e-5)
        # What the steps do to the energy is far more than what they leave of the constraint.
        self.assertLess(self.difference("loose", "tight", "energy"), 1e-7)


if __name__ == "__main__":
    main()
