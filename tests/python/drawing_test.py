"""The commands of `python3 -m pseudorigid`: curves, bodies before they are drawn, refusals."""
import os
import subprocess
import sys

import numpy as np
import PIL.Image

from package_test import PackageTest
from program_test import WRONG_INPUT, main
from pseudorigid import WrongInput, gif, render, window
from pseudorigid.figures import STYLES
from pseudorigid.plot import component, curves

SCENE = {"Models": "reduced, polynomial", "Polynomial/Degree": 2, "Continuum/Error estimate": "none", "Time/End": 1, "Output/Samples": 10,
         "Initial state/Deformation": "0.8, 0, 0; 0, 1.25, 0; 0, 0, 1", "Output/Graphics": "vtu", "Output/Frames": 2}


class Drawing(PackageTest):
    SCENE = SCENE

    def test_help_lists_the_commands(self):
        listed = self.run_done("--help").stdout
        for name in "plot", "render", "animate", "orbit", "paraview", "cells", "equilibria", "campbell", "map":
            self.assertIn(f"\n  {name} ", listed)
            self.assertIn(f"pseudorigid {name}", self.run_done(name, "--help").stdout)
        self.assert_exit(self.run_program("draw"), WRONG_INPUT)

    def test_curves(self):
        run = self.make_run()
        figure = curves(run, "Q11")
        drawn = {line.get_label(): line.get_ydata() for line in figure.axes[0].lines}
        self.assertEqual(list(drawn), [run.title(model) for model in reversed(run.models)])
        for model in run.models:
            np.testing.assert_array_equal(drawn[run.title(model)], run.columns(model)["Q11"])
        np.testing.assert_array_equal(figure.axes[1].lines[0].get_ydata(),
                                      component(run, "reduced", "Q11") - component(run, "polynomial", "Q11"))
        # The same picture is the same file.
        for name in "one.svg", "two.svg":
            self.assertIn("C11 of 11 samples", self.run_done("plot", run.directory, "--quantity", "C11", "--output", name).stdout)
        self.assertEqual(self.bytes("one.svg"), self.bytes("two.svg"))
        self.run_done("plot", run.directory)
        self.assertTrue((run.directory / "comparison.svg").is_file())

    def test_every_model_of_a_ladder_has_a_curve_and_a_colour(self):
        run = self.make_run(**{"Polynomial/Degree": "1, 2, 3"})
        colours = [line.get_color() for line in curves(run, "Q11").axes[0].lines]
        self.assertEqual(len(colours), 4)
        self.assertEqual(len(set(colours)), 3)  # that of degree 1 is the colour of the pseudo-rigid model
        self.assertEqual((colours[0], colours[-1]), (STYLES["polynomial"]["color"], STYLES["reduced"]["color"]))

    def test_curves_of_one_model(self):
        figure = curves(self.make_run(Models="reduced"))
        self.assertEqual([line.get_label() for line in figure.axes[1].lines], ["a1", "a2", "a3"])

    def test_misuse_is_one_sentence(self):
        run = self.make_run()
        for arguments, fragment in ((("plot", "nowhere"), "nowhere/manifest.json"), (("plot", run.directory, "--quantity", "Q14"), "Q14"),
                                    (("plot", run.directory, "--output", "a.xyz"), "--output"), (("map", "nowhere.csv", "a.svg"), "nowhere.csv"),
                                    (("map", run.directory / "reduced.csv", "a.svg"), "reduced.csv"),
                                    (("equilibria", "--program", "nowhere"), "nowhere"), (("render", run.directory, "--frame", 9), "")):
            environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
            self.assert_one_sentence(self.run_program(*arguments, env=environment), fragment)

    def test_bodies(self):
        """The faces on the surface have the radius at rest; a quarter taken out adds those of the cut."""
        run = self.make_run()
        time, radius, bodies = render.read_bodies(run, -1, cut=False)
        self.assertEqual((time, radius, list(bodies)), (1, 1, [run.title(model) for model in ("polynomial", "reduced")]))
        Q = run.matrices("reduced", "Q")[-1]
        x, stress = bodies[run.title("reduced")]
        np.testing.assert_allclose(np.linalg.norm(x @ np.linalg.inv(Q).T, axis=-1), 1, atol=1e-4)  # faces are polynomials of degree 4
        self.assertEqual(x.shape[:-1], stress.shape[:-1])
        _, _, with_cut = render.read_bodies(run, -1, cut=True)
        self.assertLess(np.linalg.norm(with_cut[run.title("reduced")][0], axis=-1).min(), 1e-6)
        with self.assertRaisesRegex(Exception, "--frame: expected a number from 0 to 1, got 2"):
            render.read_bodies(run, 2, cut=True)

    def test_a_file_that_cannot_be_read(self):
        """VTK's own lines are not shown. Files are read before anything is drawn: no screen is needed."""
        run = self.make_run(Models="reduced")
        environment = {**os.environ, "DISPLAY": ":nowhere"}
        (self.scratch / "damaged.vtu").write_text("nothing")
        for name in "nowhere.vtu", "damaged.vtu":
            self.assert_one_sentence(self.run_program("cells", name, name, env=environment), name)
        picture = run.frames("reduced")[-1].path
        picture.unlink()
        self.assert_one_sentence(self.run_program("render", run.directory, env=environment), picture.name)
        with self.assertRaisesRegex(WrongInput, picture.name):
            run.frames("reduced")[-1].read()
        (run.directory / "reduced.pvd").write_text("<VTKFile>")
        with self.assertRaisesRegex(WrongInput, "reduced.pvd"):
            run.frames("reduced")

    def test_a_file_that_cannot_be_written(self):
        (self.scratch / "file").write_text("no folder")
        with self.assertRaisesRegex(WrongInput, "--output"):
            window.write_png(window.new_window(8, 8), self.scratch / "file/a.png")
        for name in "file/a.gif", "a.txt":
            with self.assertRaisesRegex(WrongInput, "--output"):
                gif.write_gif([PIL.Image.new("RGB", (8, 8))], 100, self.scratch / name)

    def test_a_missing_package_is_named(self):
        # -S: without the folder of Debian's packages, as with another Python.
        for tool in "plot", "render", "animate", "orbit", "map", "cells":
            result = subprocess.run([sys.executable, "-S", "-m", "pseudorigid", tool, "nowhere"], capture_output=True, text=True)
            self.assert_one_sentence(result, "No module named", "this needs Debian's python3-")

    def test_paraview_refuses(self):
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        run = self.make_run(Models="reduced").directory
        for arguments, fragments in ((("nowhere",), ("nowhere holds no pictures", "Output/Graphics=vtu")),
                                     ((run, "--picture", "a.png", "--animation", "a.avi"), ("exclude one another",)),
                                     ((run, "--picture", "a.png", "--frame", 2), ("--frame: expected a number from 0 to 1, got 2",)),
                                     ((run, "--picture", "a.png"), ("xvfb-run",))):
            self.assert_one_sentence(self.run_program("paraview", *arguments, env=environment), *fragments)


if __name__ == "__main__":
    main()
