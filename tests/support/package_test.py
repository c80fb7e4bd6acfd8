"""Base of tests of the Python package: its commands in place of the program's, and runs of the program for them."""
import subprocess
import sys

from program_test import ProgramTest
from pseudorigid import Run


class PackageTest(ProgramTest):
    SCENE = {}  # the entries of every run

    def command(self, arguments):
        return [sys.executable, "-m", "pseudorigid", *map(str, arguments)]

    def make_run(self, **changes):
        self.scene({**self.SCENE, **changes})
        subprocess.run([self.program, "run", "scene.prm"], cwd=self.scratch, check=True, capture_output=True)
        return Run(self.scratch / "output/scene")
