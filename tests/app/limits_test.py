"""What numbers, memory, stability and laws do not admit: refused before a run with the numbers, or met by a stop."""
import re
import unittest

from program_test import DONE, STOPPED, WRONG_INPUT, overrides
from refused_input import RefusedInputTest

REDUCED = {"Models": "reduced", "Time/End": 10, "Output/Samples": 10,
           "Initial state/Velocity": "0.2, 0, 0; 0, -0.1, 0; 0, 0, -0.1"}
CONTINUUM = {**REDUCED, "Models": "continuum", "Continuum/Degree": 2, "Time/Method": "rattle", "Time/Tolerance": 1e-3,
             "Time/End": 1}
GENT = {"Material/Law": "gent", "Material/Gent limit": 0.05}


class Limits(RefusedInputTest):
    # Steps and times.

    def test_steps_that_cannot_be_counted(self):
        for step, n_steps in ((1e-19, "1e+20"), (1e-20, "1e+21"), (1e-300, "1e+301")):
            for method in ("rattle", "explicit-8", "auto"):
                self.refused_entries({"Time/Step": step, "Time/Method": method}, "Time/Step",
                                     f"would take {n_steps} steps; expected at most 1e+12", "at least 1e-11", base=REDUCED)

    def test_systems_count_their_steps_too(self):
        self.refused_entries({"Time/Step": 1e-20}, "Time/Step", "1e+21 steps",
                             base={"System": "double pendulum", "Time/End": 10})

    def test_ends_that_numbers_do_not_resolve(self):
        self.refused_entries({"Time/End": 1e300}, "Time/End", "expected at most 1e+15", base=REDUCED)
        self.refused_entries({"Time/End": 1e-320}, "Time/End", "that Output/Samples = 10 can divide", base=REDUCED)

    # Memory.

    def test_a_mesh_beyond_the_memory(self):
        """67 million nodes; before anything is built."""
        with open("/proc/meminfo") as file:
            kilobytes = next(int(line.split()[1]) for line in file if line.startswith("MemAvailable"))
        if kilobytes > 230e6:
            self.skipTest("this machine has the memory")
        huge = {"Continuum/Degree": 8, "Continuum/Refinements": 4, "Continuum/Symmetry": "none"}
        self.refused_entries(huge, "Continuum/Refinements: degree 8, refined 4 times takes 2.02e+08 unknowns and "
                             "1.57e+07 multipliers, about 234 GB, and ", " are available here", base=CONTINUUM)

    def test_check_tells_the_effort(self):
        self.scene({**CONTINUUM, "Continuum/Degree": 4, "Time/Step": 0.01})
        text = self.run_done("check", "scene.prm").stdout
        self.assertIn("effort of the continuum: 1107 unknowns and 80 multipliers, about 1 MB; rattle is stable at rest up "
                      "to a step of about 0.0216 and takes 100 steps of 0.01", text)
        self.assertNotIn("stability limit", text)

    # Stability.

    def test_a_step_above_the_stability_limit_is_told(self):
        """0.0792 by the fit; 0.0784 by Lanczos' method."""
        self.scene({**CONTINUUM, "Time/Step": 0.1})
        warning = "Time/Step: steps of 0.1 are above the stability limit of the continuum, about 0.0792"
        self.assertIn(warning, self.run_done("check", "scene.prm").stdout)
        self.assertIn(warning, self.run_program("run", "scene.prm").stderr)
        # Samples make the steps shorter; a method that the program chooses takes the step as a bound alone.
        for entries in ("Output/Samples=20", "Time/Method=auto"):
            self.assertNotIn("stability limit", self.run_done("check", "scene.prm", "--set", entries).stdout)
        bounded = self.run_done("check", "scene.prm", *overrides({"Time/Method": "auto", "Time/Step": 1e-5, "Time/End": 1})).stdout
        self.assertIn("roughly 1e+05 steps", bounded)

    VISCOUS = {**CONTINUUM, "Material/Viscosity": 1, "Time/End": 0.2, "Output/Samples": 2}

    def test_viscosity_does_not_bound_the_step(self):
        """Explicit forces would admit h eta = 5e-4 of the elements of degree 2, and 0.07 of the pseudo-rigid body."""
        for models, step in (("continuum", 0.05), ("polynomial", 0.1), ("reduced", 0.1)):
            for viscosity in (1, 1e3):
                self.scene({**self.VISCOUS, "Models": models, "Material/Viscosity": viscosity, "Time/Step": step, "Time/End": 4 * step})
                self.assertNotIn("Time/Step: ", self.run_done("check", "scene.prm").stdout)
                self.run_done("run", "scene.prm")
                (model,) = self.json("output/scene/manifest.json")["models"].values()
                self.assertEqual(model["counters"]["steps"], 4)

    def test_a_stiff_motion_is_found_by_rattle(self):
        """With a viscosity that is 160 times the impedance of the ball, nobody asks what the step may be."""
        self.scene({**self.VISCOUS, "Models": "reduced, polynomial", "Polynomial/Degree": 3, "Material/Viscosity": 160, "Time/End": 2,
                    "Time/Method": "auto"})
        self.run_done("run", "scene.prm")
        for model in self.json("output/scene/manifest.json")["models"].values():
            self.assertLess(model["counters"]["steps"], 1e5)
        reduced, polynomial = (self.table(f"output/scene/{name}.csv") for name in ("reduced", "polynomial"))
        self.assertAlmostEqual(reduced.column("Q33")[-1], polynomial.column("Q33")[-1], delta=1e-3)

    def test_the_effort_is_that_of_the_run(self):
        for symmetry in ("octant", "xy", "z", "none"):
            self.scene({**CONTINUUM, "Continuum/Symmetry": symmetry, "Time/Step": 0.05, "Time/End": 0.1, "Output/Samples": 1})
            self.run_done("run", "scene.prm")
            counters = self.json("output/scene/manifest.json")["models"]["continuum"]["counters"]
            self.assertIn(f"{counters['unknowns']:.0f} unknowns and {counters['multipliers']:.0f} multipliers",
                          self.run_done("check", "scene.prm").stdout)

    def test_the_estimated_limit_is_that_of_the_motion(self):
        """A step 5 % below it lasts, one 5 % above does not."""
        for degree, limit in ((2, 0.0792), (3, 0.0373), (4, 0.0216)):
            # Noise of round-off grows by 1.9 a step there: it needs some steps to be seen.
            scene = {**CONTINUUM, "Continuum/Degree": degree, "Time/End": 6}
            for factor, code in ((0.95, DONE), (1.05, STOPPED)):
                self.scene({**scene, "Time/Step": limit * factor})
                # Each interval holds a whole number of steps.
                result = self.run_program("run", "scene.prm", "--set", "Output/Samples=1")
                self.assertEqual(result.returncode, code, f"degree {degree}, {factor} of the limit: {result.stderr}")

    # Laws.

    def test_a_start_beyond_the_limit_of_the_law(self):
        stretched = {**GENT, "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8", "Initial state/Velocity":
                     "0, 0, 0; 0, 0, 0; 0, 0, 0"}
        for base in (REDUCED, CONTINUUM):
            self.refused_entries(stretched, "Initial state/Deformation: the law of the material admits no such "
                                 "deformation: I - 3 has reached Material/Gent limit", base=base)

    def test_a_motion_that_comes_to_the_limit_of_the_law(self):
        """Released with more energy than the step resolves near the limit: the time, of the finite elements the place."""
        fast = {**GENT, "Initial state/Velocity": "2, 0, 0; 0, -1, 0; 0, 0, -1", "Time/Step": 0.02}
        for base, place in (({**REDUCED, "Time/Method": "rattle"}, ""),
                            ({**CONTINUUM, "Continuum/Degree": 3}, r" at X/r = \([^)]*\)")):
            self.scene({**base, **fast})
            result = self.run_program("run", "scene.prm")
            self.assertEqual(result.returncode, STOPPED, result.stderr)
            self.assertRegex(result.stderr, r"stopped at t = [0-9.e-]+: the law of the material admits no such "
                                            r"deformation: I - 3 has reached Material/Gent limit" + place + "; the state at")
            self.assertTrue(self.table("output/scene", f"{base['Models']}.csv").is_finite())

    def test_motions_below_the_limit_of_the_law(self):
        """With a step found for it the body turns before the limit; I - 3 is a1^2 + a2^2 + a3^2 - 3."""
        self.scene({**REDUCED, **GENT, "Time/Tolerance": 1e-6, "Output/Samples": 1000})
        self.run_done("run", "scene.prm")
        table = self.table("output/scene/reduced.csv")
        most = max(sum(x * x for x in axes) - 3 for axes in zip(*(table.column(f"a{i}") for i in (1, 2, 3))))
        self.assertTrue(0.01 < most < 0.05, most)

    # Sweeps.

    def test_a_run_of_a_sweep_that_cannot_be(self):
        """Ends of the ranges are checked before anything is written, what lies between as its turn comes."""
        sweep = {**REDUCED, "Sweep/Parameters": "l: 1 .. 2 in 5"}
        self.scene({**sweep, "Material/Shear modulus": "$(1.9-l)"})
        self.refused("run", "scene.prm", fragments=("Material/Shear modulus", "in run 5 of the sweep, l = 2"))
        self.scene({**sweep, "Material/Shear modulus": "$(abs(l-1.5)-0.1)"})
        result = self.run_program("run", "scene.prm")
        self.assertEqual(result.returncode, WRONG_INPUT, result.stderr)
        self.assertRegex(result.stderr, r"Material/Shear modulus.*\(in run 3 of the sweep, l = 1.5\); the 2 rows before are kept")
        self.assertEqual(len(self.table("output/scene/sweep.csv")), 2)
        manifest = self.json("output/scene/manifest.json")
        self.assertEqual((manifest["state"], manifest["exit_code"]), ("failed", WRONG_INPUT))


if __name__ == "__main__":
    unittest.main()
