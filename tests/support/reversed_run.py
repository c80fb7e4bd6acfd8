"""Runs that start at the end of another one with the opposite velocity: a checkpoint can be such a state, a scene cannot."""
import shutil

import checkpoint_file
from program_test import DONE, ProgramTest


class ReversedRunTest(ProgramTest):
    def turn_round(self, folder, reversed_folder, n_samples):
        """Returns the table and the counters of the reversed run of finite elements. It does not look at the frequency, which
        may halve the step for good."""
        shutil.copytree(self.scratch / folder, self.scratch / reversed_folder)
        path = self.scratch / reversed_folder / "checkpoint-continuum.bin"
        state = checkpoint_file.read(path)
        self.assertEqual(state["sample"], n_samples)
        state.update({"sample": 0, "v": [-v for v in state["v"]], "memory": [], "halvings": 0, "next look": n_samples + 1,
                      "repeated intervals": 0, "failed intervals": 0, "counters": [0.0] * len(state["counters"])})
        state["numbers"][4] = 0.0  # the time
        checkpoint_file.write(path, state)
        self.assert_exit(self.run_program("run", "scene.prm", "--output", reversed_folder, "--resume"), DONE)
        return self.table(f"{reversed_folder}/continuum.csv"), self.json(reversed_folder, "manifest.json")["models"]["continuum"]["counters"]
