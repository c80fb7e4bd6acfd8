"""Sweeps that keep their trajectories, and the polhodes of a free body: after a period of the angular momentum in the body
it has turned by one angle about the angular momentum in space (Oliva, Geometric Mechanics, after 5.6.15)."""
import math
import unittest

from program_test import SOURCE, STOPPED
from stopped_run import StoppedRunTest

#: A tumbling ball; tr(Q^-1 Qdot) = w (0.2 - 0.3 + 0.1) = 0.
BALL = {"Models": "reduced", "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8",
        "Initial state/Velocity": "$(w*0.25), -1, 0.125; 0.6, $(-w*0.3), 0.2; 0, -0.08, $(w*0.08)",
        "Time/End": 5, "Output/Samples": 50, "Sweep/Parameters": "w: 0.5, 1, 1.5", "Sweep/Trajectories": "true"}


class Polhode:
    """The curve of P, |P| = L, of a body with the moments of inertia I1 < I2 < I3 and the energy E."""

    def __init__(self, I, P):
        self.L, self.E = math.hypot(*P), sum(p * p / i for p, i in zip(P, I)) / 2
        self.about_third = self.L**2 > 2 * self.E * I[1]
        self.I = I if self.about_third else I[::-1]  # the axis that it goes round is the last

    def period(self):
        """Four quarter periods of Jacobi's functions, by the arithmetic-geometric mean."""
        a, b, c = self.I
        L2, E2 = self.L**2, 2 * self.E
        rate = math.sqrt((c - b) * (L2 - E2 * a) / (a * b * c))
        m = (b - a) * (E2 * c - L2) / ((c - b) * (L2 - E2 * a))
        x, y = 1, math.sqrt(1 - m)
        while abs(x - y) > 1e-15:
            x, y = (x + y) / 2, math.sqrt(x * y)
        return 4 * math.pi / (2 * x * rate)

    def solid_angle(self, n=1024):
        """That the curve encloses about its axis, by the trapezoidal rule over the azimuth."""
        a, b, c = self.I
        def one_minus_cosine(phi):
            squared_sine = (2 * self.E / self.L**2 - 1 / c) / (math.cos(phi) ** 2 / a + math.sin(phi) ** 2 / b - 1 / c)
            return 1 - math.sqrt(1 - squared_sine)
        return 2 * math.pi / n * sum(one_minus_cosine(2 * math.pi * k / n) for k in range(n))

    def turn(self):
        """Montgomery's angle about P in a period, in [0, 2 pi): 2ET/L less the solid angle, which P runs round in the
        positive sense about the third axis and in the negative one about the first."""
        sense = 1 if self.about_third else -1
        return (2 * self.E * self.period() / self.L - sense * self.solid_angle()) % (2 * math.pi)


def rotation_about(axis, angle):
    n = math.hypot(*axis)
    x, y, z = (u / n for u in axis)
    c, s = math.cos(angle), math.sin(angle)
    return [c + (1 - c) * x * x, (1 - c) * x * y - s * z, (1 - c) * x * z + s * y,
            (1 - c) * x * y + s * z, c + (1 - c) * y * y, (1 - c) * y * z - s * x,
            (1 - c) * x * z - s * y, (1 - c) * y * z + s * x, c + (1 - c) * z * z]


class Trajectories(StoppedRunTest):
    def sweep(self, entries, folder, *options):
        self.scene(entries)
        return self.run_done("run", "scene.prm", "--output", folder, *options)

    # What is kept.

    def test_they_are_the_samples_of_single_runs(self):
        self.sweep({**BALL, "Sweep/Lanes": "false"}, "all")
        kept = self.table("all/trajectories.csv")
        rows = iter(kept.rows)
        for k, w in enumerate((0.5, 1, 1.5), 1):
            single = {path: str(value).replace("$(w*", f"$({w}*").replace("$(-w*", f"$(-{w}*")
                      for path, value in BALL.items() if not path.startswith("Sweep")}
            self.sweep(single, "single")
            table = self.table("single/reduced.csv")
            self.assertEqual(kept.header, ["run", *table.header])
            for row in table.rows:
                self.assertEqual(next(rows), [k, *row])
        self.assertEqual(list(rows), [])

    def test_they_are_those_of_the_rows_in_lanes(self):
        self.sweep({**BALL, "Sweep/Parameters": "w: 0.5 .. 1.5 in 8"}, "lanes")
        kept, rows = self.table("lanes/trajectories.csv"), self.table("lanes/sweep.csv")
        self.assertEqual(self.json("lanes/manifest.json")["models"]["sweep"]["counters"]["runs_in_lanes"], 8)
        for k, largest in enumerate(rows.column("a1_max"), 1):
            column = [a1 for run, a1 in zip(kept.column("run"), kept.column("a1")) if run == k]
            self.assertEqual((len(column), max(column)), (51, largest))

    def test_without_the_entry_there_are_none(self):
        self.sweep({**BALL, "Sweep/Trajectories": "true"}, "run")
        self.assertIn("trajectories.csv", self.files("run"))
        self.sweep({**BALL, "Sweep/Trajectories": "false"}, "run")
        self.assertNotIn("trajectories.csv", self.files("run"), "a fresh run removes those of the one before")

    def test_an_interrupted_sweep_goes_on(self):
        entries = {**BALL, "Sweep/Parameters": "w: 0.5 .. 1.5 in 300", "Time/End": 100, "Output/Samples": 500,
                   "Output/Quantities": "energies", "Sweep/Threads": 2}
        self.sweep(entries, "whole")
        self.assertEqual(self.interrupt("sweep", "parts"), STOPPED)
        self.assertLess(len(self.table("parts/sweep.csv")), 300)
        self.run_done("run", "scene.prm", "--output", "parts", "--resume")
        for name in ("sweep.csv", "trajectories.csv"):
            self.assertEqual(self.bytes("parts", name), self.bytes("whole", name))

    def test_what_the_disk_has_no_room_for_is_refused(self):
        self.scene({**BALL, "Sweep/Parameters": "w: 0.5 .. 1.5 in 10000000", "Output/Samples": 1000000})
        result = self.run_program("run", "scene.prm")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertIn("Sweep/Trajectories: 1e+13 rows of ", result.stderr)
        self.assertIn("are free on the disk", result.stderr)
        self.assertFalse((self.scratch / "output").exists())

    # Polhodes.

    def test_polhodes(self):
        """What the head of the scene says; a closed curve about the first or the third axis each."""
        self.run_done("run", SOURCE / "params/polhodes.prm", "--output", "run")
        table = self.table("run/trajectories.csv")
        runs = {}
        for row in table.rows:
            runs.setdefault(int(row[0]), []).append(dict(zip(table.header, row)))
        self.assertEqual([len(runs[k]) for k in range(1, 25)], [801] * 24)
        for k, run in runs.items():
            angle = math.radians(7.5 + 15 * (k - 1))
            P = [[row[f"J_body{i}"] for i in (1, 2, 3)] for row in run]
            start = (math.cos(angle), 0, math.sin(angle))
            self.assertLess(math.dist(P[0], start), 1e-15)
            axis = 0 if abs(start[0]) > 0.5 else 2  # 60 degrees
            for p, row in zip(P, run):
                self.assertAlmostEqual(math.hypot(*p), 1, delta=1e-9)
                self.assertAlmostEqual(row["energy"], run[0]["energy"], delta=1e-9)
                self.assertGreater(p[axis] * start[axis], 0.1, "round this axis")
            T = Polhode((1, 2, 3), start).period()
            self.assertLess(T, 40, "the curve closes within the run")
            # The nearest samples after a period are up to half of their distance of 0.05 away, where P moves by 0.03.
            nearest = round(T / 0.05)
            self.assertLess(math.dist(P[nearest], P[0]), 0.05)

    def test_montgomery(self):
        """The turn in a period, from two places of each curve, for five bodies and both kinds of curves."""
        for I, P in (((2, 3, 4), (0.9, 0.4, 1.1)), ((1, 2, 2.5), (0.5, 0.2, 1.4)), ((0.6, 0.7, 1.25), (0.3, 1.1, 1.2)),
                     ((1, 2, 3), (0.9, 0.1, 0.2)), ((2, 3, 4), (1.2, 0.3, 0.5))):
            curve = Polhode(I, P)
            omega = [p / i for p, i in zip(P, I)]
            for start in (0, 1):
                table_entries = {
                    "System": "rigid body", "Rigid body/Form": "euler", "Rigid body/Inertia":
                    "; ".join(", ".join(str(I[i] if i == j else 0) for j in range(3)) for i in range(3)),
                    "Rigid body/Angular velocity": ", ".join(map(repr, omega)), "Time/End": repr(curve.period()),
                    "Time/Tolerance": 1e-13, "Output/Samples": 10}
                self.sweep(table_entries, f"run{start}")
                table = self.table(f"run{start}/rigid_body.csv")
                J = [table.column(f"J{i}")[0] for i in (1, 2, 3)]
                R = [table.column(f"R{i}{j}")[-1] for i in (1, 2, 3) for j in (1, 2, 3)]
                error = max(abs(a - b) for a, b in zip(R, rotation_about(J, curve.turn())))
                print(I, P, start, error)
                self.assertLess(error, 1e-9)
                self.assertGreater(abs(math.remainder(curve.turn(), 2 * math.pi)), 0.01, "not periodic")
                omega = [table.column(f"Omega{i}")[3] for i in (1, 2, 3)]  # 0.3 T later, from R = 1 again


if __name__ == "__main__":
    unittest.main()
