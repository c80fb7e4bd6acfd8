"""pyproject.toml: the package is installed without network, with its version and the mark that it is typed."""
import os
import re
import shutil
import subprocess
import sys

from program_test import ProgramTest, SOURCE, main


class Packaging(ProgramTest):
    def test_pip_installs_it_without_network(self):
        shutil.copytree(SOURCE / "python", self.scratch / "python", ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
        pip = [sys.executable, "-m", "pip", "install", "--no-index", "--no-build-isolation", "--no-deps", "--target", "installed", "./python"]
        installed = subprocess.run(pip, cwd=self.scratch, capture_output=True, text=True)
        self.assertEqual(installed.returncode, 0, installed.stderr)
        environment = {**os.environ, "PYTHONPATH": str(self.scratch / "installed"), "PSEUDORIGID": str(self.program)}
        ask = ("import pseudorigid, importlib.metadata as m; from pseudorigid import Run; print(pseudorigid.__file__, m.version('pseudorigid'));"
               "print(pseudorigid.run({'Models': 'reduced', 'Time/End': 1}).models)")
        said = subprocess.run([sys.executable, "-c", ask], cwd=self.scratch, check=True, capture_output=True, text=True, env=environment).stdout
        version = re.search(r"^project\(pseudorigid VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
        folder = self.scratch / "installed" / "pseudorigid"
        self.assertEqual(said, f"{folder / '__init__.py'} {version}\n['reduced']\n")
        self.assertEqual({path.name for path in folder.iterdir() if path.is_file()},
                         {path.name for path in (SOURCE / "python/pseudorigid").iterdir() if path.is_file()})


if __name__ == "__main__":
    main()
