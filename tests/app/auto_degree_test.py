"""Continuum/Degree = auto meets its tolerance, costs a few times the best discretisation found by hand, survives
interrupts; every comparison says its discretisation error.

The references are Q(t) of the same scenes on much finer discretisations, in auto_degree_reference.json, made by
    PSEUDORIGID=build/release/bin/pseudorigid python3 tests/app/auto_degree_test.py reference [SCENE …]
Times on these scenes, by hand and by auto, are measured by benchmarks/auto_discretization.py.
"""
import json
import pathlib
import resource
import sys
import unittest

from program_test import STOPPED, ProgramTest

REFERENCES = pathlib.Path(__file__).with_name("auto_degree_reference.json")
Q = [f"Q{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]

SCENES = {
    "release": {"Initial state/Deformation": "0.95, 0, 0; 0, 0.95, 0; 0, 0, 1.1080332409972299"},
    "velocity": {"Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6"},
    "compressible": {"Body/Incompressible": "false", "Material/Law": "ciarlet-geymonat", "Material/Lame lambda": 1,
                     "Loads/Tidal matrix": "0.2, 0, 0; 0, -0.1, 0; 0, 0, -0.1",
                     "Initial state/Velocity": "0.2, 0, 0; 0, -0.1, 0; 0, 0, -0.1"},
}
# Scenes that nothing of the search was fitted to: other laws, a traction, motions that begin at rest.
OTHER_SCENES = {
    "mooney": {"Material/Law": "mooney-rivlin", "Material/Mooney fraction": 0.7,
               "Initial state/Deformation": "1.08, 0, 0; 0, 0.96, 0; 0, 0, $(1/(1.08*0.96))"},
    "triaxial": {"Body/Incompressible": "false", "Material/Law": "ciarlet-geymonat (as printed)",
                 "Initial state/Deformation": "1.05, 0, 0; 0, 1.02, 0; 0, 0, 0.94"},
    "pulled": {"Body/Incompressible": "false", "Material/Law": "neo-hookean", "Material/Lame lambda": 3,
               "Loads/Nominal traction": "0.3, 0, 0; 0, 0, 0; 0, 0, -0.1"},
}
ALL_SCENES = {**SCENES, **OTHER_SCENES}
COMMON = {"Models": "continuum", "Time/End": 2, "Output/Samples": 10, "Output/Quantities": "state"}
AUTO = {"Continuum/Degree": "auto", "Continuum/Refinements": "auto"}
TOLERANCE_OF_TIME = 1 / 20  # over that of the discretisation, whose error is then what is seen
# Finer than anything that the tolerances ask for.
FINEST = (6, 1)


class AutoDegree(ProgramTest):
    def run_scene(self, entries, name="scene", *options):
        self.scene({**COMMON, **entries}, f"{name}.prm")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        self.run_done("run", f"{name}.prm", *options, timeout=3000)
        self.cpu = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        return self.json(f"output/{name}/manifest.json")["models"]["continuum"]["counters"]

    def deformation(self, name="scene"):
        table = self.table(f"output/{name}/continuum.csv")
        return list(zip(*(table.column(q) for q in Q)))

    @staticmethod
    def distance(a, b):
        return max(abs(x - y) for row, other in zip(a, b) for x, y in zip(row, other))

    def at_tolerance(self, scene, tolerance):
        return {**ALL_SCENES[scene], "Time/Tolerance": tolerance * TOLERANCE_OF_TIME}

    def check_tolerance(self, scene, tolerance):
        counters = self.run_scene({**self.at_tolerance(scene, tolerance), **AUTO, "Continuum/Tolerance": tolerance})
        error = self.distance(self.deformation(), json.loads(REFERENCES.read_text())[scene])
        print(f"{scene} {tolerance:.0e}: degree {counters['degree']}, refinements {counters['refinements']}, "
              f"estimated {counters['estimated_space_error']:.1e}, error {error:.1e}, "
              f"search/run {counters['search_work'] / counters['work']:.2f}")
        self.assertLessEqual(counters["estimated_space_error"], tolerance)
        self.assertLessEqual(error, tolerance)
        return counters

    def check_cost(self, scene, tolerance, best):
        """`best`: the cheapest (k, refinements) whose error meets the tolerance, found by hand."""
        auto = self.check_tolerance(scene, tolerance)
        hand = self.run_scene({**self.at_tolerance(scene, tolerance), "Continuum/Degree": best[0],
                               "Continuum/Refinements": best[1]}, "hand")
        ratio = (auto["work"] + auto["search_work"]) / hand["work"]
        print(f"counted work, estimation included: {ratio:.2f} times that of {best}")
        self.assertLessEqual(ratio, 8)

    def test_release(self):
        self.check_cost("release", 1e-3, (3, 0))
        self.check_cost("release", 1e-4, (4, 0))

    def test_velocity(self):
        self.check_cost("velocity", 1e-3, (3, 0))
        self.check_cost("velocity", 1e-4, (4, 0))
        self.check_cost("velocity", 1e-5, (5, 0))

    def test_compressible(self):
        self.check_cost("compressible", 1e-3, (3, 0))
        self.check_cost("compressible", 1e-4, (3, 0))
        self.check_cost("compressible", 1e-5, (4, 0))

    def test_other_scenes(self):
        for scene in OTHER_SCENES:
            for tolerance in (1e-3, 1e-4):
                with self.subTest(scene, tolerance=tolerance):
                    self.check_tolerance(scene, tolerance)

    def test_fixed_refinements_are_honoured(self):
        counters = self.run_scene({**self.at_tolerance("velocity", 1e-3), "Continuum/Degree": "auto",
                                   "Continuum/Refinements": 1, "Continuum/Tolerance": 1e-3})
        self.assertEqual(counters["refinements"], 1)
        used = (self.scratch / "output/scene/used.prm").read_text()
        self.assertRegex(used, r"set Degree\s*= auto")
        self.assertRegex(used, r"set Refinements\s*= 1")

    def test_interrupted_and_resumed(self):
        """Ctrl-C in the search and in the run that writes: the same numbers as without."""
        entries = {**self.at_tolerance("release", 1e-4), **AUTO, "Continuum/Tolerance": 1e-4}
        self.scene({**COMMON, **entries})
        self.run_done("run", "scene.prm", "--output", "whole")
        whole = self.json("whole/manifest.json")["models"]["continuum"]["counters"]
        for name, ready in (("search", lambda: (self.scratch / "search/checkpoint-discretization.bin").exists()),
                            ("run", lambda: (self.scratch / "run/checkpoint-continuum.bin").exists())):
            process = self.start_program("run", "scene.prm", "--output", name)
            self.wait_until(ready, "the run has begun")
            process.send_signal(2)
            self.assertEqual(process.wait(), STOPPED)
            self.assertEqual(self.json(f"{name}/manifest.json")["state"], "interrupted")
            self.run_done("run", "scene.prm", "--output", name, "--resume")
            resumed = self.json(f"{name}/manifest.json")["models"]["continuum"]["counters"]
            for counter in ("degree", "refinements", "search_work"):
                self.assertEqual(resumed[counter], whole[counter])
            self.assertAlmostEqual(resumed["estimated_space_error"] / whole["estimated_space_error"], 1, delta=1e-6)

    # Comparisons

    def compare(self, entries):
        self.scene({**COMMON, **SCENES["velocity"], "Models": "reduced, continuum", **entries})
        result = self.run_done("run", "scene.prm")
        return result.stdout, self.json("output/scene/comparison.json")["model_difference"]

    def test_comparison_tells_its_error(self):
        text, difference = self.compare({"Continuum/Degree": 4})
        self.assertRegex(text, r"model difference 0\.\d+ \+- \S+ \(discretisation error, estimated: time \S+, space \S+\)\n")
        self.assertTrue(difference["resolved"])
        reference = json.loads(REFERENCES.read_text())["velocity"]
        error = max(sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5 / sum(y * y for y in b) ** 0.5
                    for a, b in zip(self.deformation(), reference))
        print(f"space error {difference['space_error']:.1e}, true {error:.1e}")
        self.assertGreaterEqual(difference["space_error"], error / 2)
        self.assertLessEqual(difference["space_error"], 20 * error)

    def test_comparison_without_an_estimate(self):
        text, difference = self.compare({"Continuum/Degree": 2, "Continuum/Error estimate": "none"})
        self.assertIn("error in space not known", text)
        self.assertIsNone(difference["uncertainty"])

    def test_comparison_of_models_that_hardly_differ(self):
        """In the first tenth of its time unit the shear front has not left the surface: what the coarsest elements see is
        their own error."""
        text, difference = self.compare({"Continuum/Degree": 2, "Time/End": 0.1, "Time/Tolerance": 1e-7})
        self.assertIn("the two overlap: the difference is not resolved", text)
        self.assertFalse(difference["resolved"])


def make_references(scenes):
    run = AutoDegree()
    run.setUp()
    references = json.loads(REFERENCES.read_text())
    for scene in scenes or ALL_SCENES:
        k, r = FINEST
        run.run_scene({**ALL_SCENES[scene], "Time/Tolerance": 1e-6, "Continuum/Degree": k, "Continuum/Refinements": r})
        references[scene] = run.deformation()
        print(scene, f"{run.cpu:.0f} s", flush=True)
    REFERENCES.write_text(json.dumps(references).replace("], [", "],\n["))
    run.doCleanups()


if __name__ == "__main__":
    if sys.argv[1:2] == ["reference"]:
        make_references(sys.argv[2:])
    else:
        unittest.main()
