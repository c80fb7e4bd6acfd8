"""report.html and shapes.csv of runs with the continuum."""
import signal
import unittest

from program_test import STOPPED, largest_difference
from report_page import REPORTED, ReportTest

SCENE = {
    "Models": "reduced, continuum", "Continuum/Degree": 2, "Continuum/Error estimate": "none",
    "Initial state/Deformation": "0.95, 0, 0; 0, 0.95, 0; 0, 0, 1.1080332409972299",
    "Time/End": 2, "Time/Step": 0.02, "Time/Method": "rattle", "Output/Samples": 40,
}
SHAPE_COLUMNS = ["time", "face", "plane", "X1", "X2", "X3", "x1", "x2", "x3"]
TIMES = [0, 0.25, 0.6, 0.95, 1.4, 2]  # of samples 0, 5, 12, 19, 28, 40


class ContinuumReport(ReportTest):
    def test_comparison(self):
        page = self.run_reported(SCENE)
        for name in "reduced.csv", "continuum.csv", "comparison.csv", "shapes.csv":
            self.check_samples(page, name)
        self.assertTrue(page.files["comparison.json"])

    def test_shapes(self):
        self.run_reported(SCENE)
        table = self.table("output/scene/shapes.csv")
        self.assertEqual(table.header, SHAPE_COLUMNS)
        self.assertEqual(sorted(set(table.column("time"))), TIMES)
        self.assertEqual(len(table) % len(TIMES), 0)
        faces = {row[1]: row[2] for row in table.rows}
        # An octant has three cells at its surface; each of its planes cuts the block in the middle and two of them.
        self.assertEqual(sorted(faces.values()), [0] * 3 + [1] * 3 + [2] * 3 + [3] * 3)
        for time, _, plane, *point in table.rows:
            X, x = point[:3], point[3:]
            radius = sum(v * v for v in X) ** 0.5
            if plane == 0:
                self.assertAlmostEqual(radius, 1, delta=1e-2)  # curved elements of degree 2 leave the sphere a little
            else:
                self.assertEqual((X[int(plane) - 1], x[int(plane) - 1]), (0, 0))  # symmetry keeps the plane
            if time == 0:
                for got, wanted in zip(x, (0.95 * X[0], 0.95 * X[1], 1.1080332409972299 * X[2])):
                    self.assertAlmostEqual(got, wanted, delta=1e-14)
        moved = max(abs(row[8] - 1.1080332409972299 * row[5]) for row in table.rows if row[0] == 0.95)
        self.assertGreater(moved, 0.05)  # near half a pulsation the ball has become flat

    def test_pictures_give_the_bodies_with_their_stress(self):
        """The same material faces as in shapes.csv, reflected, at the times of pictures; the pseudo-rigid body has one stress."""
        for cells in "linear", "lagrange":
            page = self.run_reported({**SCENE, "Output/Graphics": "vtu", "Output/Frames": 3, "Output/Cells": cells})
            table = [[float(x) for x in line.split(",")] for line in page.files["frames-continuum.csv"].splitlines()[1:]]
            self.assertEqual(page.files["frames-continuum.csv"].splitlines()[0].split(","), [*SHAPE_COLUMNS, "von_mises"])
            self.assertEqual(sorted({row[0] for row in table}), [0, 1, 2])
            planes = {row[1]: row[2] for row in table}
            self.assertEqual(sorted(planes.values()), [0] * 24 + [1] * 12 + [2] * 12 + [3] * 12)
            self.assertEqual(len(table), 3 * len(planes) * 9)
            for time, _, plane, *point, stress in table:
                X, x = point[:3], point[3:]
                if plane:
                    self.assertLess(abs(X[int(plane) - 1]) + abs(x[int(plane) - 1]), 1e-6)
                if time == 0:
                    self.assertAlmostEqual(x[2], 1.1080332409972299 * X[2], delta=1e-6)
                self.assertGreaterEqual(stress, 0)
            # An affine deformation of a neo-Hookean body has sigma = B and one stress everywhere: |s_33 - s_11| of B.
            exact = 1.1080332409972299**2 - 0.95**2
            self.assertLess(max(abs(row[-1] - exact) for row in table if row[0] == 0), 1e-4 * exact)
            rigid = [[float(x) for x in line.split(",")] for line in page.files["frames-reduced.csv"].splitlines()[1:]]
            self.assertEqual([row[0] for row in rigid], [0, 1, 2])
            self.assertAlmostEqual(rigid[0][-1], exact, delta=1e-4 * exact)

    def test_command_draws_bodies_of_a_run_without_shapes(self):
        self.scene({**SCENE, "Output/Graphics": "vtu", "Output/Frames": 3})
        self.run_done("run", "scene.prm")
        self.assertNotIn("shapes.csv", self.files("output/scene"))
        self.run_done("report", "output/scene")
        self.assertIn("von_mises", self.check_page("output/scene").files["frames-continuum.csv"])
        # A picture that is damaged or missing is no obstacle.
        picture = self.scratch / "output/scene" / next(name for name in self.files("output/scene") if "continuum-" in name and name.endswith(".vtu"))
        whole = picture.read_bytes()
        for damaged in whole[: len(whole) // 2], whole.replace(b"AppendedData", b"ReplacedData"), b"":
            picture.write_bytes(damaged)
            self.run_done("report", "output/scene")
            self.assertEqual(self.check_page("output/scene").files["frames-continuum.csv"], "")
        picture.unlink()
        self.run_done("report", "output/scene")

    def test_shapes_are_in_the_units_of_the_scene(self):
        self.run_reported({**SCENE, "Models": "continuum", "Body/Radius": 3, "Time/End": 6, "Time/Step": 0.06})
        table = self.table("output/scene/shapes.csv")
        self.assertAlmostEqual(max(abs(x) for row in table.rows for x in row[3:6]), 3, delta=1e-12)

    def test_a_report_changes_no_other_file(self):
        added = self.check_nothing_else_changes({**SCENE, "Output/Graphics": "vtu", "Output/Frames": 3})
        self.assertEqual(added, {"report.html", "shapes.csv"})

    def test_modes(self):
        self.check_samples(self.run_reported({"Models": "continuum", "Analysis": "modes", "Modes/Number": 3, "Continuum/Degree": 3}), "modes.csv")

    def test_interrupted_and_resumed(self):
        entries = {**SCENE, "Models": "continuum", "Time/Step": 0.0005}
        self.scene({**entries, **REPORTED})
        self.run_done("run", "scene.prm", "--output", "whole")
        process = self.start_program("run", "scene.prm")
        shapes = self.scratch / "output/scene/continuum.csv"
        self.wait_until(lambda: shapes.exists() and shapes.read_bytes().count(b"\n") > 0, "the motion begins")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), STOPPED)
        page = self.check_page("output/scene")
        self.assertIn('"state": "interrupted"', page.files["manifest.json"])
        self.run_done("run", "scene.prm", "--resume")
        page = self.check_page("output/scene")
        self.check_samples(page, "shapes.csv")
        # To round-off, as continuum.csv is (stopped_run_test.py).
        self.assertLess(largest_difference(self.table("whole/shapes.csv"), self.table("output/scene/shapes.csv")), 1e-11)


if __name__ == "__main__":
    unittest.main()
