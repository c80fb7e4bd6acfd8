"""Spin over angular momentum and the Campbell diagram of figures of equilibrium: families, frequencies, picture, refusals."""
import math

import numpy as np

from package_test import PackageTest
from program_test import main
from pseudorigid.campbell import families, frequencies

SCENE = {"Analysis": "equilibrium", "Models": "reduced, polynomial", "Polynomial/Degree": "2, 3", "Equilibrium/Family": "spinning",
         "Equilibrium/First": 0.02, "Equilibrium/Last": 1.5, "Equilibrium/Number": 4}


class Campbell(PackageTest):
    SCENE = SCENE

    def test_families(self):
        found = families(self.make_run())
        self.assertEqual(list(found), ["reduced", "polynomial-2", "polynomial-3"])
        for family in found.values():
            np.testing.assert_allclose(family["omega3"], np.linspace(0.02, 1.5, 4), rtol=1e-12)

    def test_frequencies_of_a_slow_spin(self):
        """The five modes of a resting ellipsoid have the frequency sqrt(10) c/r; Coriolis forces change it by at most twice the spin."""
        found = families(self.make_run())
        spins, values = frequencies(found["reduced"])
        slow = values[np.isclose(spins, 0.02)]
        self.assertEqual(len(slow), 5)
        self.assertLess(np.abs(slow - math.sqrt(10)).max(), 2 * 0.02 + 1e-3)
        self.assertGreater(np.ptp(slow), 0.02)  # they are split
        for family in found.values():  # ten rates in each of four rows, in conjugate pairs
            values = np.sort(frequencies(family)[1])
            np.testing.assert_array_equal(values, np.sort(np.concatenate([v[v > 0] for k, v in family.items() if k.endswith("_im")])))
            self.assertGreaterEqual(len(values), 16)

    def test_picture(self):
        run = self.make_run()
        picture = self.scratch / "picture.svg"
        self.run_done("campbell", run.directory, "--output", picture)
        text = picture.read_text()
        for words in ("pseudo-rigid", "N = 2", "N = 3", "angular momentum"):
            self.assertIn(words, text)

    def test_refusals(self):
        motion = self.make_run(Analysis="motion", **{"Time/End": 1, "Models": "reduced"}).directory
        self.assert_one_sentence(self.run_program("campbell", motion), "Analysis = equilibrium")
        static = self.make_run(**{"Models": "reduced", "Equilibrium/Family": "static"}).directory
        self.assert_one_sentence(self.run_program("campbell", static), "static")


if __name__ == "__main__":
    main()
