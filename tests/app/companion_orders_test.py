"""The order of every method, for a body with a companion in an eccentric orbit: the error of state, orbit and energies at the end."""
import math
import unittest

import numpy as np

from program_test import WRONG_INPUT, ProgramTest

END = 4
SCENE = {"Models": "reduced", "Gravity/Gamma": 1, "Companions/Masses": 40, "Companions/Positions": "5, 0, 0",
         "Companions/Velocities": "0, 1.4, 0.2", "Initial state/Deformation": "1.1, 0, 0; 0, 1, 0; 0, 0, 0.90909090909090906",
         "Initial state/Velocity": "0, -0.5, 0; 0.6, 0, 0; 0, 0, 0", "Time/End": END, "Output/Samples": 1, "Output/Quantities": "state, orbit"}
# Method, its order, and numbers of steps whose errors are above round-off.
METHODS = (("rattle", 2, (100, 200, 400)), ("rattle-4", 4, (50, 100, 200)), ("rattle-6", 6, (40, 60, 80, 120)),
           ("rattle-8", 8, (32, 40, 48, 64)), ("symmetric-4", 4, (100, 200, 400)), ("symmetric-8", 8, (100, 140, 200)),
           ("symmetric-12", 12, (100, 120, 150)), ("gauss-16", 16, (4, 5, 6)), ("explicit-8", 8, (36, 44, 56)))
COLUMNS = [*(f"Q{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)), *(f"companion{i}" for i in (1, 2, 3)), *(f"companion_velocity{i}" for i in (1, 2, 3))]


class CompanionOrders(ProgramTest):
    def end(self, entries):
        self.scene({**SCENE, **entries})
        self.run_done("run", "scene.prm", "--output", "out")
        table = self.table("out", "reduced.csv")
        return np.array([table.column(name)[-1] for name in COLUMNS])

    def test_every_method_has_its_order(self):
        reference = self.end({"Time/Method": "gauss-16", "Time/Tolerance": 1e-13})
        for method, order, counts in METHODS:
            errors = [np.abs(self.end({"Time/Method": method, "Time/Step": END / n}) - reference).max() for n in counts]
            fitted = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
            with self.subTest(method=method, errors=errors, fitted=fitted):
                if order <= 8:
                    self.assertAlmostEqual(fitted, order, delta=0.3)
                else:  # three errors above round-off are not far enough in the limit of small steps
                    self.assertGreater(fitted, order - 0.5)
                self.assertTrue(all(math.isfinite(error) and error > 0 for error in errors))

    def test_energy_momentum_is_refused(self):
        self.scene({**SCENE, "Time/Method": "energy-momentum", "Time/Step": 0.1})
        result = self.run_program("check", "scene.prm")
        self.assertEqual(result.returncode, WRONG_INPUT)
        self.assertIn("energy-momentum", result.stderr)
        self.assertIn("companions", result.stderr)


if __name__ == "__main__":
    unittest.main()
