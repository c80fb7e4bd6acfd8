"""Pipes, links and devices in the place of files, names that lead out of the folder of results, and small stacks."""
import os
import resource
import threading
import unittest

from program_test import STOPPED
from refused_input import BASE, RefusedInputTest


class SpecialFiles(RefusedInputTest):
    def setUp(self):
        super().setUp()
        self.scene(BASE)

    def pipe(self, name):
        path = self.scratch / name
        path.unlink(missing_ok=True)
        os.mkfifo(path)
        return path

    def test_a_report_goes_into_a_pipe(self):
        self.run_done("run", "scene.prm", "--quiet")
        path = self.pipe("report")
        read = []
        reader = threading.Thread(target=lambda: read.append(path.read_text()))
        reader.start()
        self.run_done("report", "output/scene", "--output", "report")
        reader.join()
        self.assertIn("</html>", read[0])
        self.assertTrue(path.is_fifo())

    def test_a_report_goes_to_the_end_of_a_link(self):
        self.run_done("run", "scene.prm", "--quiet")
        target, link = self.scratch / "target.html", self.scratch / "link.html"
        target.write_text("old")
        link.symlink_to("target.html")
        self.run_done("report", "output/scene", "--output", "link.html")
        self.assertTrue(link.is_symlink())
        self.assertIn("</html>", target.read_text())

    def test_pipes_with_the_names_of_results(self):
        self.run_done("run", "scene.prm", "--quiet")
        for name in "reduced.csv", "manifest.json", "run.lock":
            with self.subTest(name):
                path = self.pipe(f"output/scene/{name}")
                self.refused("run", "scene.prm", fragments=(name,))
                path.unlink()

    def test_a_file_in_the_place_of_the_pictures_keeps_the_earlier_results(self):
        self.scene({"Models": "reduced", "Time/End": 1, "Output/Samples": 4})
        self.run_done("run", "scene.prm", "--output", "out")
        before = self.files("out")
        (self.scratch / "out/graphics").write_text("a file")
        self.refused("run", "scene.prm", "--output", "out", "--set", "Output/Graphics=vtu", "--set", "Output/Frames=2", fragments=("graphics",))
        self.assertEqual(self.files("out"), sorted([*before, "graphics"]))

    def test_damaged_files_are_seen_before_any_is_written(self):
        """The first model is whole; what is wrong with the second is said before the first goes on."""
        self.scene({**BASE, "Models": "reduced, polynomial", "Output/Graphics": "vtu", "Output/Frames": 3})
        self.run_done("run", "scene.prm", "--quiet")
        later = ("--resume", "--set", "Time/End=2")
        for name, old, new in ("polynomial.csv", "\n1,", "\nx,"), ("polynomial.pvd", 'timestep="1', 'timestep="'):
            with self.subTest(name):
                path = self.scratch / "output/scene" / name
                whole = path.read_text()
                self.assertIn(old, whole)
                path.write_text(whole.replace(old, new))
                self.refused("run", "scene.prm", *later, fragments=(name,))
                path.write_text(whole)
        self.run_done("run", "scene.prm", "--quiet", *later)

    def test_an_include_from_a_pipe(self):
        self.pipe("part.prm")
        (self.scratch / "scene.prm").write_text("include part.prm\n")
        self.refused("check", "scene.prm", fragments=("scene.prm:1:", "part.prm"))

    def test_names_that_lead_out_of_the_folder(self):
        for name in "..prm", "...prm":
            with self.subTest(name):
                self.scene(BASE, name)
                self.refused("run", name, fragments=(name, "--output"))
                self.run_done("run", name, "--quiet", "--output", f"here{name}")

    def test_a_small_stack(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_STACK, (80 * 1024, resource.RLIM_INFINITY))
        result = self.run_program("run", "scene.prm", preexec_fn=limit)
        self.assertEqual(result.returncode, STOPPED, result.stderr)
        self.assertIn("ulimit -s", result.stderr)
        self.assertFalse((self.scratch / "output").exists())


if __name__ == "__main__":
    unittest.main()
