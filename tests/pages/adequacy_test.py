"""The numbers behind docs/adequacy.md (docs/data/adequacy) meet the exact values at the limits of their families, within their bars;
their number is that of the page."""
import csv
import math
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "docs/data/adequacy"
SMALL = 0.003  # amplitudes below it change a frequency by less than the bars


def rows(family):
    with open(DATA / f"{family}.csv", newline="") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def j(n, x):
    """Spherical Bessel function by upward recursion, stable for x > n."""
    a, b = math.sin(x) / x, math.sin(x) / x**2 - math.cos(x) / x
    for m in range(1, n):
        a, b = b, (2 * m + 1) / x * b - a
    return b if n else a


def lowest_root(f, x=0.5, step=0.01):
    while f(x) * f(x + step) > 0:
        x += step
    low, high = x, x + step
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if f(low) * f(middle) <= 0 else (middle, high)
    return low


def incompressible(gamma):
    """Slowest frequency of degree 2, PHYSICS.md 3 and 11 (Lamb 1882; Bromwich 1898), in c/r."""
    def equation(x):
        dj, pull = j(1, x) - 3 / x * j(2, x), 2 * gamma / 5
        return (4 - x * x + 2 * pull) * ((10 - x * x) * j(2, x) - 2 * x * dj) - 12 * (2 * (x * dj - j(2, x)) + pull * j(2, x))
    return lowest_root(equation)


def compressible(lame):
    def equation(x):
        y = x / math.sqrt(lame + 2)
        T11 = (2 - x * x / 2) * j(2, y) + 2 * y * j(3, y)
        T13 = 6 * (j(2, x) - x * j(3, x))
        T41 = j(2, y) - y * j(3, y)
        T43 = (3 - x * x / 2) * j(2, x) + x * j(3, x)
        return T11 * T43 - T13 * T41
    return lowest_root(equation, 1.0)


class Adequacy(unittest.TestCase):
    def check(self, row, model, exact):
        self.assertGreater(row[f"{model}_frequency_ratio_error"], 0)
        self.assertLess(abs(row[f"{model}_frequency_ratio"] - exact), row[f"{model}_frequency_ratio_error"], row)

    def test_small_motions_of_a_free_ball(self):
        held = [row for row in rows("amplitude") if row["a"] < SMALL]
        self.assertEqual(len(held), 5)
        for row in held:
            self.check(row, "reduced", 10**0.5 / 2.665622189236)

    def test_small_motions_under_self_gravity(self):
        """Up to the crossing of two frequencies near gamma = 30."""
        held = [row for row in rows("gravity") if row["a"] < SMALL and row["g"] < 18]
        self.assertGreater(len(held), 8)
        for row in held:
            self.check(row, "reduced", math.sqrt(10 + 0.8 * row["g"]) / incompressible(row["g"]))

    def test_small_motions_of_a_compressible_ball(self):
        held = [row for row in rows("compressibility") if row["a"] < SMALL]
        self.assertGreater(len(held), 10)
        for row in held:
            self.check(row, "reduced", 10**0.5 / compressible(row["l"]))

    def test_the_page_counts_the_comparisons(self):
        """All with finite elements, and those of them that have a ratio of frequencies without a bar."""
        swept = [row for path in DATA.glob("*.csv") if path.stem not in ("shape", "equilibria", "static_tide", "sample_static_tide") for row in rows(path.stem)]
        barless = [row for row in swept if any(name.endswith("_frequency_ratio") and value > 0 and row[f"{name}_error"] < 0
                                               for name, value in row.items())]
        page = (ROOT / "docs/adequacy.md").read_text()
        said = re.search(r"([\d,]+) comparisons of motions with finite elements.*, and (\d+) of figures.*\n?.* but for (\d+) of", page)
        figures = [row for family in ("equilibria", "static_tide", "sample_static_tide") for row in rows(family) if row["compared"]]
        self.assertEqual((int(said[1].replace(",", "")), int(said[2]), int(said[3])), (len(swept), len(figures), len(barless)))

    def test_bulge_of_a_slow_spin(self):
        """The ratio of the exact Love numbers h2 of ellipsoid and sphere; the quadrature of gravity errs by 1e-6 radii of the bulge."""
        held = [row for row in rows("equilibria") if row["s"] < 0.2]
        self.assertEqual(len(held), 6)
        for row in held:
            self.assertAlmostEqual(row["reduced_bulge_ratio"], (row["g"] + 9.5) / (row["g"] + 12.5), delta=3e-4)

    def test_bulge_of_a_weak_tide(self):
        """The mean of a tide that stretches and one that flattens, whose errors of second order cancel."""
        for gamma in 0, 1, 10, 100, 1000:
            pair = [row for row in rows("static_tide") if row["g"] == gamma and abs(row["s"]) < 0.02]
            self.assertEqual(len(pair), 2)
            exact = (gamma + 9.5) / (gamma + 12.5)
            for measure, delta in ("bulge", 5e-4), ("strain", 3e-4):
                self.assertAlmostEqual(sum(row[f"reduced_{measure}_ratio"] for row in pair) / 2, exact, delta=delta)

    def test_rule_of_the_bulge_within_a_factor_of_two(self):
        """The prediction for weak tides on the sample that was not used for it."""
        sample = rows("sample_static_tide")
        self.assertEqual([row["compared"] for row in sample], [1] * 20)
        for row in sample:
            found, predicted = 1 - row["reduced_bulge_ratio"], 3 / (12.5 + row["g"])
            self.assertTrue(0.5 < found / predicted < 2, row)


if __name__ == "__main__":
    unittest.main()
