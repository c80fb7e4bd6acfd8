"""Self-gravity by gamma = rho g r/mu: the same runs as by Newton's constant, in files, sweeps, check and report."""
import math
import unittest

from program_test import ProgramTest, overrides

# A body with units of its own: rho = 2, r = 3, mu = 5.
BODY = {"Body/Density": 2, "Body/Radius": 3, "Material/Shear modulus": 5}
START = {"Initial state/Velocity": "0.1, 0, 0; 0, 0.1, 0; 0, 0, -0.2", "Time/End": 40, "Time/Tolerance": 1e-4, "Output/Samples": 200}


def constant(gamma, density=2, radius=3, modulus=5):
    """G, in the order of operations of the program."""
    mass_by_length = density * radius
    return 3 * gamma / (4 * math.pi) * (modulus / mass_by_length / mass_by_length)


class Gamma(ProgramTest):
    def scene_of(self, models, **entries):
        self.scene({**BODY, **START, "Models": models, "Polynomial/Degree": 3, "Continuum/Degree": 3, **entries})

    def test_is_the_constant_of_every_model(self):
        models = ("reduced", "polynomial", "continuum")
        self.scene_of(", ".join(models), **{"Gravity/Gamma": 7})
        self.run_done("run", "scene.prm", "--output", "by_gamma")
        self.run_done("run", "scene.prm", "--output", "by_constant", "--set", "Gravity/Gamma=0", "--set", f"Gravity/Constant={constant(7)!r}")
        for model in models:
            self.assertEqual(self.bytes(f"by_gamma/{model}.csv"), self.bytes(f"by_constant/{model}.csv"))

    def test_used_prm_repeats_the_run_and_it_can_be_resumed(self):
        self.scene_of("reduced", **{"Gravity/Gamma": 7})
        self.run_done("run", "scene.prm", "--output", "first")
        self.run_done("run", "first/used.prm", "--output", "again")
        self.assertEqual(self.bytes("first/reduced.csv"), self.bytes("again/reduced.csv"))
        self.run_done("run", "scene.prm", "--output", "first", "--resume", "--set", "Time/End=60")
        self.run_done("run", "first/used.prm", "--output", "whole")
        resumed, whole = (self.table(f"{run}/reduced.csv") for run in ("first", "whole"))
        self.assertEqual(len(resumed), 301)
        for a, b in zip(resumed.column("Q33"), whole.column("Q33"), strict=True):
            self.assertAlmostEqual(a, b, delta=1e-4)  # with steps of their own, each found for its end

    def test_sweep_over_gamma_is_that_over_the_constant(self):
        self.scene_of("reduced", **{"Sweep/Parameters": "g: 0, 1, 10"})
        self.run_done("run", "scene.prm", "--output", "by_gamma", "--set", "Gravity/Gamma=$(g)")
        expression = f"$({constant(1)!r}*g)"
        self.run_done("run", "scene.prm", "--output", "by_constant", "--set", f"Gravity/Constant={expression}")
        a, b = (self.table(f"{run}/sweep.csv") for run in ("by_gamma", "by_constant"))
        for name in a.header:
            for x, y in zip(a.column(name), b.column(name)):
                self.assertAlmostEqual(x, y, delta=1e-9 * max(1, abs(x)), msg=name)

    def test_no_error_is_predicted_for_a_compressible_ball(self):
        """Gravity compresses it, so the frequencies of a homogeneous ball of unit density do not hold."""
        for incompressible, predicted in (("true", 1), ("false", 0)):
            self.scene_of("reduced", **{"Gravity/Gamma": 5, "Body/Incompressible": incompressible, "Material/Lame lambda": 10})
            self.assertEqual(self.run_done("check", "scene.prm").stdout.count("slowest pulsation"), predicted)

    def test_check_log_and_report_name_it(self):
        self.scene_of("reduced", **{"Gravity/Gamma": 7, "Output/Report": "true"})
        self.assertIn("gamma = 7", self.run_done("check", "scene.prm").stdout.splitlines()[0])
        self.run_done("run", "scene.prm")
        self.assertIn("gamma = 7", self.json("output/scene/manifest.json")["scene"])
        sweep = overrides({"Sweep/Parameters": "g: 2, 0.5, 10", "Gravity/Gamma": "$(g)", "Output/Report": "false"})
        self.assertIn("gamma = 0.5 to 10", self.run_done("check", "scene.prm", *sweep).stdout.splitlines()[0])


if __name__ == "__main__":
    unittest.main()
