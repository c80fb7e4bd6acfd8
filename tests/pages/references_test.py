"""The reference of the release by FEniCSx alone (benchmarks/peers) agrees with the one of this program, within the bars of both."""
import csv
import pathlib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read_reference(path):
    """(bar, {time: Q33})"""
    first, *rows = path.read_text().splitlines()
    return float(first.split()[-1]), {float(row["time"]): float(row["Q33"]) for row in csv.DictReader(rows)}


class References(unittest.TestCase):
    def test_two_programs_agree(self):
        bar, own = read_reference(ROOT / "benchmarks/references/ball_release.csv")
        other_bar, other = read_reference(ROOT / "docs/benchmarks/data/fenicsx_reference.csv")
        self.assertEqual(list(own), list(other))
        self.assertEqual(len(own), 51)
        apart = max(abs(own[time] - other[time]) for time in own)
        print(f"apart {apart:.1e}, bars {bar:.1e} and {other_bar:.1e}")
        self.assertLessEqual(apart, bar + other_bar)
        self.assertLess(other_bar, 1e-5)


if __name__ == "__main__":
    unittest.main(verbosity=2)
