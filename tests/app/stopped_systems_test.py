"""Runs of the systems beside the ball that are interrupted or killed and go on with --resume: the same bytes."""
import unittest

from stopped_run import StoppedRunTest
from system_test import JACOBI, PENDULUM, POINTS, TOP, TORUS

# About half a second each.
SAMPLES = {"Output/Samples": 2000}
FIXED = {**PENDULUM, **SAMPLES, "Time/Method": "rattle-8", "Time/Step": 5e-4, "Time/End": 40}
MULTISTEP = {**POINTS, **SAMPLES, "Time/Method": "symmetric-8", "Time/Step": 1e-5, "Time/End": 4}
CONSERVING = {**TOP, **SAMPLES, "Time/Method": "energy-momentum", "Time/Step": 5e-5, "Time/End": 3}
ADAPTIVE = {**SAMPLES, "Time/Method": "explicit-8", "Time/Tolerance": 1e-9}
SPINNING = {"Rigid body/Angular velocity": "0.3, 1, 20"}


class StoppedSystems(StoppedRunTest):
    def check(self, scene, file):
        self.check_control_c(scene, file)
        for result in self.scratch.joinpath("parts").iterdir():
            result.unlink()
        self.check_kills(scene, file, 0.0, 4)

    def test_fixed_steps(self):
        self.check(FIXED, "double_pendulum")

    def test_multistep(self):
        self.check(MULTISTEP, "mass_points")

    def test_energy_momentum(self):
        self.check(CONSERVING, "rigid_body")

    def test_stages_in_lanes(self):
        self.check({**PENDULUM, **SAMPLES, "Time/Method": "gauss-16", "Time/Step": 2e-3, "Time/End": 60}, "double_pendulum")

    def test_error_control(self):
        self.check({**PENDULUM, **ADAPTIVE, "Time/End": 1500}, "double_pendulum")

    def test_error_control_on_a_chart(self):
        self.check({**TORUS, **ADAPTIVE, "Torus/Damping": 0, "Time/End": 5000}, "torus")

    def test_error_control_with_a_motion_beside_it(self):
        self.check({**JACOBI, **ADAPTIVE, "Time/End": 5000}, "jacobi_geodesic")

    # Columns of angles: interrupted when they have gone round more than once.

    def check_turns(self, scene, file):
        self.check_control_c(scene, file, after_rows=500)

    def test_turns_of_a_double_pendulum(self):
        self.check_turns({**FIXED, "Double pendulum/Rates": "20, 20"}, "double_pendulum")

    def test_turns_of_a_top(self):
        self.check_turns({**CONSERVING, **SPINNING}, "rigid_body")

    def test_turns_in_eulers_form(self):
        self.check_turns({**TOP, **ADAPTIVE, **SPINNING, "Rigid body/Form": "euler", "Time/End": 1000}, "rigid_body")


if __name__ == "__main__":
    unittest.main()
