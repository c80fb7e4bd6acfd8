"""What tests of the reduced body's scenes share."""
from stopped_run import StoppedRunTest

BALL = {"Models": "reduced", "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8",
        "Initial state/Velocity": "0.25, -1, 0.125; 0.6, -0.3, 0.2; 0, -0.08, 0.08",
        "Time/End": 5, "Output/Samples": 50}


class ReducedTest(StoppedRunTest):
    def run_scene(self, entries, *options, name="scene"):
        self.scene(entries, f"{name}.prm")
        return self.run_done("run", f"{name}.prm", *options)

    def refuse(self, entries, *words):
        self.scene(entries)
        result = self.run_program("run", "scene.prm")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertFalse((self.scratch / "output").exists())
