"""A violent motion runs backwards through the same states, although the step changes on the way."""
import math
import unittest

from reversed_run import ReversedRunTest


class ReversedMotion(ReversedRunTest):
    N_SAMPLES = 10

    def test_steps_of_single_intervals_are_those_of_the_way_there(self):
        side = 1 / math.sqrt(2)
        self.scene({"Models": "continuum", "Continuum/Degree": 3, "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, 2",
                    "Initial state/Velocity": "0, -0.3, 0.2; 0.3, 0, 0; -0.1, 0, 0", "Time/End": 2, "Output/Samples": self.N_SAMPLES,
                    "Time/Method": "rattle-4", "Time/Tolerance": 1e-4, "Time/Constraint tolerance": 1e-13})
        self.run_done("run", "scene.prm", "--output", "first")
        there, counters_there = self.turn_round("first", "there", self.N_SAMPLES)
        back, counters_back = self.turn_round("there", "back", self.N_SAMPLES)
        for counters in counters_there, counters_back:
            self.assertGreater(counters["repeated_intervals"], 0)
            self.assertEqual(counters["failed_intervals"], 0)
        for prefix, sign in ("Q", 1), ("Qdot", -1), ("F", 1):
            for column in (f"{prefix}{i}{j}" for i in "123" for j in "123"):
                largest = max(abs(sign * a - b) for a, b in zip(reversed(there.column(column)), back.column(column)))
                self.assertLess(largest, 1e-10, column)
        for column in "J1", "J2", "J3":
            for of_run in there.column(column), back.column(column):
                self.assertLess(max(abs(x - of_run[0]) for x in of_run), 1e-12, column)


if __name__ == "__main__":
    unittest.main()
