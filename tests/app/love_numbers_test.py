"""Love numbers of every model: values of the exact sphere, bounds that hold, files, and what is refused."""
import math
import unittest

from program_test import SOURCE, ProgramTest, overrides
from refused_input import RefusedInputTest

GRAVITY = {"Gravity/Constant": 3 / (4 * math.pi)}  # gamma = 1
LOVE = {"Analysis": "love numbers", "Models": "reduced, polynomial, continuum", "Polynomial/Degree": "3, 5",
        "Continuum/Degree": 4, "Love numbers/Degrees": "2, 3, 4", **GRAVITY}


def exact(n, gamma):
    """h and l of the homogeneous incompressible sphere."""
    h = (2 * n + 1) / (2 * (n - 1)) / (1 + (2 * n * n + 4 * n + 3) / n / gamma)
    return h, 3 / (n * (2 * n + 1)) * h


class LoveNumbers(ProgramTest):
    def test_every_model_is_within_its_bound_of_the_sphere(self):
        self.scene(LOVE)
        result = self.run_done("run", "scene.prm")
        self.assertIn("Love numbers", result.stdout)
        for name, best in ("polynomial-3", 2), ("polynomial", 4), ("continuum", 4):
            table = self.table(f"output/scene/love-{name}.csv")
            self.assertEqual(table.column("degree"), [2, 3, 4])
            for n, h, l, h_error, l_error in zip(*map(table.column, ("degree", "h", "l", "h_error", "l_error"))):
                h_exact, l_exact = exact(n, 1)
                self.assertLessEqual(abs(h - h_exact), h_error + 1e-11, (name, n))
                self.assertLessEqual(abs(l - l_exact), l_error + 1e-11, (name, n))
                if n <= best:
                    self.assertAlmostEqual(h / h_exact, 1, delta=1e-4, msg=(name, n))

    def test_other_numbers_are_in_proportion(self):
        self.scene({**LOVE, "Models": "polynomial", "Polynomial/Degree": 9})
        self.run_done("run", "scene.prm")
        table = self.table("output/scene/love-polynomial.csv")
        for row in zip(*map(table.column, ("degree", "h", "l", "k", "h_load", "l_load", "k_load", "h_exact", "l_exact",
                                           "k_exact"))):
            n, h, l, k, h_load, l_load, k_load, h_exact, l_exact, k_exact = row
            load = -2 * (n - 1) / 3
            for got, expected in ((k, 3 / (2 * n + 1) * h), (h_load, load * h), (l_load, load * l), (k_load, load * k),
                                  (h, h_exact), (l, l_exact), (k, k_exact)):
                self.assertAlmostEqual(got, expected, delta=1e-11)

    def test_pseudo_rigid_ball_has_degree_two_only(self):
        self.scene({**LOVE, "Models": "reduced"})
        self.run_done("run", "scene.prm")
        table = self.table("output/scene/love-reduced.csv")
        h = table.column("h")
        self.assertAlmostEqual(h[0], 2.5 / 13.5, delta=1e-14)
        self.assertAlmostEqual(table.column("l")[0], 1.25 / 13.5, delta=1e-14)
        self.assertEqual(h[1:], [0, 0])

    def test_units_of_the_scene_do_not_matter(self):
        """The moon of params/, and a ball of the same gamma in units of its own."""
        moon = (SOURCE / "params/love_numbers.prm").read_text()
        self.scene(moon, "moon.prm")
        choice = {"Models": "reduced, polynomial", "Polynomial/Degree": 5}
        self.run_done("run", "moon.prm", *overrides(choice))
        gamma = 1500**2 * 4 * math.pi / 3 * 6.6743e-11 * 2.5e5**2 / 4e9
        self.scene({**LOVE, **choice, "Gravity/Constant": 3 * gamma / (4 * math.pi), "Love numbers/Degrees": "auto"})
        self.run_done("run", "scene.prm")
        for name in "love-reduced", "love-polynomial":
            mine, other = self.table(f"output/scene/{name}.csv"), self.table(f"output/moon/{name}.csv")
            for column in mine.header:
                for a, b in zip(mine.column(column), other.column(column)):
                    self.assertAlmostEqual(a, b, delta=1e-13 + 1e-9 * abs(b), msg=column)

    def test_a_law_printed_with_a_stress_at_rest(self):
        """The shear modulus at rest determines the numbers in every model."""
        self.scene({**LOVE, "Material/Law": "saint-venant-kirchhoff (as printed)"})
        self.run_done("run", "scene.prm")
        h, h_exact = (self.table("output/scene/love-continuum.csv").column(name)[0] for name in ("h", "h_exact"))
        self.assertAlmostEqual(h / h_exact, 1, delta=1e-4)


class RefusedLoveNumbers(RefusedInputTest):
    def refuses(self, entries, entry, keyword):
        self.refused_entries({**LOVE, **entries}, entry, keyword)

    def test_refused(self):
        self.refuses({"Gravity/Constant": 0}, "Gravity/Constant", "self-gravity")
        self.refuses({"Love numbers/Degrees": "1, 2"}, "Love numbers/Degrees", "from 2")
        self.refuses({"Love numbers/Degrees": "2, 13"}, "Love numbers/Degrees", "12")
        self.refuses({"Love numbers/Degrees": "2, 5", "Models": "continuum"}, "Love numbers/Degrees", "4")
        self.refuses({"Love numbers/Degrees": "25"}, "Love numbers/Degrees", "24")
        self.refuses({"Body/Incompressible": "false", "Material/Lame lambda": 1}, "Body/Incompressible", "incompressible")
        self.refuses({"Material/Law": "none"}, "Material/Law", "elastic")
        self.refuses({"Material/Viscosity": 0.1}, "Material/Viscosity", "alone")
        self.refuses({"Initial state/Velocity": "1, 0, 0; 0, -1, 0; 0, 0, 0"}, "Initial state/Velocity", "rest")
        self.refuses({"Polynomial/Degree": "auto"}, "Polynomial/Degree", "number")
        self.refuses({"Continuum/Degree": "auto"}, "Continuum/Degree", "number")
        self.refuses({"Continuum/Degree": 1, "Love numbers/Degrees": "auto"}, "Continuum/Degree", "from 2")
        self.refuses({"Output/Graphics": "vtu"}, "Output/Graphics", "table")
        self.refuses({"Models": "reduced", "Body/Semi-axes": "1, 1, 2"}, "Body/Semi-axes", "ball")


if __name__ == "__main__":
    unittest.main()
