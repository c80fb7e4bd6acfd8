"""Another model, which only its own file and the table of a program know (third_model.cpp), where it stands first: it
runs beside the others, is compared, reported and swept. PSEUDORIGID is that program."""
import math
import re

from program_test import DONE, ProgramTest, main, words

SCENE = {"Models": "copy, reduced, continuum", "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8",
         "Continuum/Degree": 2, "Continuum/Error estimate": "none", "Time/End": 5, "Output/Samples": 50,
         "Output/Report": "true", "Output/Graphics": "vtu", "Output/Frames": 2}


class ThirdModel(ProgramTest):
    def test_runs_and_is_compared(self):
        result = self.run_done("run", self.scene(SCENE), "--output", "out")
        reduced, copy, continuum = (self.table("out", f"{model}.csv") for model in ("reduced", "copy", "continuum"))
        self.assertEqual(reduced.header, copy.header)
        for row, same in zip(reduced.column("Q11"), copy.column("Q11")):
            self.assertAlmostEqual(row, same, delta=2e-6)  # two estimates of time errors of 1e-6
        self.assertGreater(math.dist(copy.column("Q11"), continuum.column("Q11")), 0.01)

        # A line for each model but the richest, files for each, and an overview.
        self.assertRegex(result.stdout, r"(?m)^compared with continuum .*\ncopy +\S+.*\nreduced +\S+")
        names = self.files("out")
        for name in ("comparison-reduced.csv", "comparison-copy.csv", "comparison-copy.json", "copy.pvd", "report.html"):
            self.assertIn(name, names)
        self.assertNotIn("comparison.csv", names)
        overview = self.json("out", "comparison.json")
        self.assertEqual(overview["reference"], "continuum")
        self.assertEqual(sorted(overview["models"]), ["copy", "reduced"])
        self.assertIn("copied ball", self.json("out", "comparison-copy.json")["summary"])
        # Both are the pseudo-rigid body, whatever place they have in the table.
        for model in "copy", "reduced":
            frequency = self.json("out", f"comparison-{model}.json")["frequency"]
            self.assertAlmostEqual(frequency["exact_small_amplitude_ratio"], 1.186319, delta=1e-6)
        self.assertIn("copied ball", (self.scratch / "out/report.html").read_text())
        self.assertIn("copy", self.json("out", "manifest.json")["models"])

    def test_a_pair_without_elements_is_compared(self):
        scene = {**SCENE, "Models": "copy, reduced", "Output/Graphics": "none"}
        self.run_done("run", self.scene(scene), "--output", "out")
        self.assertLess(self.json("out", "comparison.json")["model_difference"]["value"], 1e-5)

    def test_runs_beside_every_other_model(self):
        """In this executable and in the other, which has no finite elements: a model that a program lists it can run."""
        for other in words("Models"):
            with self.subTest(other):
                scene = {**SCENE, "Models": ", ".join({"copy", other}), "Polynomial/Degree": 2, "Time/End": 1, "Output/Samples": 4,
                         "Output/Graphics": "none", "Output/Report": "false"}
                self.run_done("run", self.scene(scene), "--output", other)
                for model in {"copy", other}:
                    self.assertEqual(len(self.table(other, f"{model}.csv")), 5)

    def test_effort_is_that_of_the_pseudo_rigid_body(self):
        for models, named in (("copy, continuum", "copy"), ("reduced, continuum", "reduced"), ("continuum", None)):
            text = self.run_done("check", self.scene({**SCENE, "Models": models})).stdout
            self.assertEqual(re.findall(r"effort of the (\w+) model", text), [named] if named else [])

    def test_is_swept(self):
        scene = {"Models": "copy", "Sweep/Parameters": "a: 1.1, 1.2", "Time/End": 1, "Output/Samples": 2,
                 "Initial state/Deformation": "$(a), 0, 0; 0, 1, 0; 0, 0, $(1/a)"}
        self.run_done("run", self.scene(scene), "--output", "out")
        rows = self.table("out", "sweep.csv")
        self.assertEqual(rows.column("finished"), [1, 1])
        self.assertIn("Q11_end", rows.header)

    def test_files_of_an_earlier_run_are_removed(self):
        self.run_done("run", self.scene(SCENE), "--output", "out")
        self.run_done("run", self.scene({**SCENE, "Models": "reduced", "Output/Graphics": "none"}), "--output", "out")
        self.assertEqual([name for name in self.files("out") if "copy" in name], [])

    def test_is_listed_and_named_in_messages(self):
        page = self.run_done("parameters", "--format", "markdown").stdout
        self.assertIn("## Columns of copy.csv", page)
        result = self.run_program("check", self.scene({"Models": "none"}))
        self.assert_one_sentence(result, ", ".join(words("Models")))
        text = self.run_program("check", self.scene({"Models": "copy"}))
        self.assert_exit(text, DONE)
        self.assertIn("copy: the pseudo-rigid body once more", text.stdout)


if __name__ == "__main__":
    main()
