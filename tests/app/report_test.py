"""report.html of runs that need no continuum, and `pseudorigid report`."""
import math
import signal
import unittest

from program_test import STOPPED, without_free_space
from refused_input import RefusedInputTest
from report_page import Page, REPORTED, ReportTest

SCENE = {
    "Title": "A </script> tumbling & <b>ball", "Models": "reduced",
    "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8",
    "Initial state/Velocity": "0.25, -1, 0.125; 0.6, -0.3, 0.2; 0, -0.08, 0.08",
    "Time/End": 5, "Output/Samples": 50,
}
SLOW = {**SCENE, "Time/End": 1000, "Time/Step": 1e-5, "Time/Method": "rattle-4"}


class Report(ReportTest, RefusedInputTest):
    def test_reduced_model(self):
        page = self.run_reported(SCENE)
        self.check_samples(page, "reduced.csv")
        self.assertNotIn("continuum.csv", page.files)
        self.assertFalse((self.scratch / "output/scene/shapes.csv").exists())

    def test_system(self):
        page = self.run_reported({"System": "double pendulum", "Time/End": 2, "Output/Samples": 20})
        self.check_samples(page, "double_pendulum.csv")
        manifest = self.json("output/scene/manifest.json")
        self.assertEqual(manifest["system"], "double_pendulum")
        names = [column["name"] for column in manifest["columns"]["double_pendulum.csv"]]
        self.assertEqual(["time", *names], self.table("output/scene/double_pendulum.csv").header)

    def test_equilibria(self):
        self.check_samples(self.run_reported({"Models": "reduced", "Analysis": "equilibrium", "Material/Law": "none",
                                              "Gravity/Constant": 0.3, "Equilibrium/Number": 9}), "equilibria.csv")

    def test_critical_points_of_a_system(self):
        self.check_samples(self.run_reported({"System": "double pendulum", "Analysis": "equilibrium"}), "equilibria.csv")

    def test_manifolds_and_sections(self):
        self.check_samples(self.run_reported({"System": "torus", "Analysis": "manifolds", "Manifolds/Starts": 3}),
                           "manifolds.csv")
        self.check_samples(self.run_reported({"System": "double pendulum", "Analysis": "section",
                                              "Section/Column": "theta"}), "section.csv")

    def test_sweep(self):
        page = self.run_reported({**SCENE, "Time/End": 1, "Output/Samples": 4, "Material/Shear modulus": "$(m)", "Sweep/Parameters": "m: 1, 2"})
        self.check_samples(page, "sweep.csv")
        self.assertIn("energy_drift", page.files["sweep.csv"].splitlines()[0].split(","))

    def test_polynomial_bodies(self):
        """Every run has its own rows and its own points; degree 1 moves as x = QX, degree 3 does not."""
        page = self.run_reported({"Models": "reduced, polynomial", "Polynomial/Degree": "1, 3", "Time/End": 1, "Output/Samples": 20,
                                  "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6", "Body/Radius": 2, "Continuum/Symmetry": "none"})
        for name in ("reduced", "polynomial-1", "polynomial", "shapes-polynomial-1", "shapes-polynomial", "comparison-polynomial-1"):
            self.check_samples(page, f"{name}.csv")
        for model, is_affine in ("polynomial-1", True), ("polynomial", False):
            rows, shapes = self.table(f"output/scene/{model}.csv"), self.table(f"output/scene/shapes-{model}.csv")
            self.assertEqual(shapes.header, ["time", "face", "plane", "X1", "X2", "X3", "x1", "x2", "x3"])
            samples = {row[0]: dict(zip(rows.header, row)) for row in rows.rows}
            self.assertEqual(sorted(set(shapes.column("time"))), [rows.rows[k][0] for k in (0, 3, 6, 9, 14, 20)])
            off = {time: 0 for time in samples}
            for time, _, plane, *point in shapes.rows:
                X, x = point[:3], point[3:]
                self.assertAlmostEqual(math.hypot(*X), 2, delta=1e-14) if plane == 0 else self.assertEqual(X[int(plane) - 1], 0)
                for i in range(3):
                    QX = sum(samples[time][f"Q{i + 1}{j + 1}"] * X[j] for j in range(3))
                    off[time] = max(off[time], abs(x[i] - QX))
            self.assertLess(off[0], 1e-13)
            (self.assertLess if is_affine else self.assertGreater)(max(off.values()), 1e-12 if is_affine else 1e-3)
        names = [(ball["name"], ball["adjective"], ball["affine"]) for ball in self.json("output/scene/manifest.json")["ball"]]
        self.assertEqual(names, [("reduced", "pseudo-rigid", True), ("polynomial-1", "polynomial N = 1", False), ("polynomial", "polynomial N = 3", False)])
        for model in "reduced", "polynomial-1":
            self.assertIn("polynomial N = 3 ball", self.json(f"output/scene/comparison-{model}.json")["summary"])

    def test_shapes_of_a_resumed_polynomial_body(self):
        entries = {"Models": "polynomial", "Polynomial/Degree": 3, "Time/End": 1, "Output/Samples": 20, "Time/Method": "rattle",
                   "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6"}
        self.run_reported({**entries, "Time/Step": 1e-3})
        whole = self.table("output/scene/shapes-polynomial.csv")
        self.scene({**entries, **REPORTED, "Time/Step": 1e-3})
        self.run_done("run", "scene.prm", "--output", "half", "--set", "Time/End=0.5", "--set", "Output/Samples=10")
        self.run_done("run", "scene.prm", "--output", "half", "--resume")
        page = self.check_page("half")
        self.check_samples(page, "shapes-polynomial.csv", "half")
        rows = {tuple(row[:3] + row[3:6]): row for row in whole.rows}
        half = self.table("half/shapes-polynomial.csv")
        last = [row for row in half.rows if row[0] == 1]
        self.assertEqual(len(last), len(half) // len(set(half.column("time"))))
        for row in last:
            self.assertEqual(row, rows[tuple(row[:6])])

    def test_a_found_degree_is_named(self):
        self.run_reported({"Models": "reduced, polynomial", "Polynomial/Degree": "auto", "Polynomial/Tolerance": 0.1, "Time/End": 1,
                           "Output/Samples": 20, "Initial state/Velocity": "0.1, 0, 0; 0, 0.1, 0; 0, 0, -0.2"})
        degree = self.json("output/scene/manifest.json")["models"]["polynomial"]["counters"]["degree"]
        self.assertIn(f"polynomial N = {degree} ball", self.json("output/scene/comparison.json")["summary"])

    def test_a_report_changes_no_other_file(self):
        self.assertEqual(self.check_nothing_else_changes({**SCENE, "Output/Graphics": "vtu", "Output/Frames": 3}), {"report.html"})

    def test_check_and_manifest_name_it(self):
        self.scene(SCENE)
        self.assertIn("  report: Output/Report is false\n", self.run_done("check", "scene.prm").stdout.split("Skipped:\n")[1])
        with_report = self.run_done("check", "scene.prm", "--set", "Output/Report=true").stdout
        self.assertIn("  report: report.html\n", with_report.split("Skipped:\n")[0])
        self.run_done("run", "scene.prm", "--set", "Output/Report=true")
        manifest = self.json("output/scene/manifest.json")
        needed, skipped = with_report.split("Needed:\n")[1].split("Skipped:\n")
        self.assertEqual(["  " + without_free_space(line) for line in manifest["needed"]], without_free_space(needed).splitlines())
        self.assertEqual(["  " + line for line in manifest["skipped"]], skipped.splitlines())

    def test_a_new_run_removes_an_old_report(self):
        self.run_reported(SCENE)
        self.run_done("run", "scene.prm", "--set", "Output/Report=false")
        self.assertNotIn("report.html", self.files("output/scene"))

    def test_interrupted_and_resumed(self):
        self.scene({**SLOW, **REPORTED})
        process = self.start_program("run", "scene.prm")
        csv = self.scratch / "output/scene/reduced.csv"
        self.wait_until(lambda: csv.exists() and (self.scratch / "output/scene/checkpoint-reduced.bin").exists(), "the motion begins")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), STOPPED)
        self.assertIn('"state": "interrupted"', self.check_page("output/scene").files["manifest.json"])
        self.scene({**SCENE, **REPORTED})
        self.run_done("run", "scene.prm")
        whole = self.bytes("output/scene/reduced.csv")
        self.run_done("run", "scene.prm", "--resume")
        page = self.check_page("output/scene")
        self.assertEqual(page.files["reduced.csv"].encode(), whole)
        self.assertIn('"state": "done"', page.files["manifest.json"])

    def test_a_report_that_cannot_be_written(self):
        (self.scratch / "output/scene/report.html/in the way").mkdir(parents=True)
        self.scene({**SCENE, **REPORTED})
        result = self.run_program("run", "scene.prm")
        self.assert_exit(result, STOPPED)
        self.assertIn("error: cannot write 'output/scene/report.html': Is a directory", result.stderr)
        manifest = self.json("output/scene/manifest.json")
        self.assertEqual((manifest["state"], manifest["exit_code"]), ("failed", STOPPED))

    # The command `report`.

    def test_command_on_a_run_without_report(self):
        self.scene(SCENE)
        self.run_done("run", "scene.prm")
        before = {name: self.bytes("output/scene", name) for name in self.files("output/scene")}
        for _ in "new", "in place of the old one":
            self.assertEqual(self.run_done("report", "output/scene").stdout, "output/scene/report.html\n")
        page = self.check_page("output/scene")
        self.check_samples(page, "reduced.csv")
        self.assertEqual({name: self.bytes("output/scene", name) for name in before}, before)
        self.assertEqual(self.files("output/scene"), sorted([*before, "report.html"]))

    def test_command_on_a_run_at_work_and_on_a_killed_one(self):
        self.scene(SLOW)
        process = self.start_program("run", "scene.prm")
        csv = self.scratch / "output/scene/reduced.csv"
        self.wait_until(lambda: csv.exists() and csv.read_bytes().count(b"\n") > 1, "the motion begins")
        self.run_done("report", "output/scene")
        page = Page(self.scratch / "output/scene/report.html")
        self.assertIn('"state": "running"', page.files["manifest.json"])
        self.assertGreater(page.files["reduced.csv"].count("\n"), 1)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.run_done("report", "output/scene")
        self.check_page("output/scene")

    def test_command_without_a_run(self):
        self.refused("report", "nowhere", fragments=("DIR: expected the directory of a run; ", "'nowhere/manifest.json'", "No such file"))
        self.scene(SCENE, "file")
        self.refused("report", "file", fragments=("DIR: ", "'file/manifest.json'", "Not a directory"))
        self.refused("report", "", fragments=("DIR: expected the directory of a run, got nothing",))
        self.refused("report", fragments=("DIR is required", "--help"))

    def test_command_on_what_is_no_manifest(self):
        (self.scratch / "run").mkdir()
        for text in ("", "{", "[]", "3", "{}", '{"program": 3}', '{"program": "another"}',
                     '{"program": "pseudorigid", "system": "../secret"}'):
            with self.subTest(text):
                (self.scratch / "run/manifest.json").write_text(text)
                self.refused("report", "run", fragments=("'run/manifest.json' is not the manifest of a run of pseudorigid",))

    def test_command_on_a_run_of_an_earlier_version(self):
        (self.scratch / "run").mkdir()
        (self.scratch / "run/manifest.json").write_text('{"program": "pseudorigid", "state": "done"}')
        self.refused("report", "run", fragments=("DIR: ", "'run/manifest.json' is of an earlier version", "used.prm"))

    def test_command_that_cannot_write(self):
        self.scene(SCENE)
        self.run_done("run", "scene.prm")
        self.refused("report", "output/scene", "--output", "no/folder.html", fragments=("--output: cannot write 'no/folder.html'",))
        self.refused("report", "output/scene", "--output", "output", fragments=("--output: cannot write 'output'", "directory"))
        (self.scratch / "output/scene/report.html/in the way").mkdir(parents=True)
        self.refused("report", "output/scene", fragments=("DIR: cannot write 'output/scene/report.html'", "directory"))


if __name__ == "__main__":
    unittest.main()
