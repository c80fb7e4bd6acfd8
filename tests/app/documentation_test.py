"""The commands of README.md and docs/tutorial.md print what the pages say.

They run in a copy of what a clone has, where build/release/bin/pseudorigid is the program under test and scripts/run.sh
hands its arguments to it without building anything.
"""
import re
import subprocess

import documentation
from program_test import ProgramTest, SOURCE, TIME_LIMIT, main


class Documentation(ProgramTest):
    def make_clone(self):
        for folder in ("params", "meshes", "tools"):
            (self.scratch / folder).symlink_to(SOURCE / folder)
        binaries = self.scratch / "build" / "release" / "bin"
        binaries.mkdir(parents=True)
        for program in self.program.parent.iterdir():
            if program.name.startswith("pseudorigid"):
                (binaries / program.name).symlink_to(program)
        script = self.scratch / "scripts" / "run.sh"
        script.parent.mkdir()
        script.write_text('#!/bin/sh\n[ $# -gt 0 ] || set -- params/quickstart.prm\n'
                          'exec build/release/bin/pseudorigid run "$@"\n')
        script.chmod(0o755)

    def check(self, page):
        self.make_clone()
        n_commands = 0
        for step in documentation.steps((SOURCE / page).read_text()):
            if isinstance(step, documentation.File):
                (self.scratch / step.name).write_text(step.text)
                continue
            n_commands += 1
            result = subprocess.run(["bash", "-c", step.line], cwd=self.scratch, stdin=subprocess.DEVNULL, text=True,
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=TIME_LIMIT)
            difference = documentation.first_difference(step.expected, result.stdout.splitlines())
            self.assertIsNone(difference, f"{page}: $ {step.line}\n{result.stdout}")
        return n_commands

    def test_what_counts_as_the_same(self):
        for a, b, same in (("step 0.02336, 1.93 s", "step 0.02337, 0.5 s", True), ("drift   4.4e-06", "drift 4.6e-06", True),
                           ("drift 1.2e-15", "drift 0", True), ("step 0.02336", "step 0.0241", False),
                           ("drift 4.4e-06", "drift 6.4e-06", False), ("2 runs", "2 of the runs", False)):
            self.assertEqual(documentation.same_line(a, b), same, (a, b))
        self.assertIsNone(documentation.first_difference(["a", "…", "d"], ["a", "b", "c", "d"]))
        for printed in (["a"], ["a", "b"], ["a", "b", "d", "e"]):
            self.assertIsNotNone(documentation.first_difference(["a", "…", "d"], printed))

    def test_readme(self):
        self.assertGreaterEqual(self.check("README.md"), 1)

    def test_tutorial(self):
        self.assertGreaterEqual(self.check("docs/tutorial.md"), 10)

    def test_every_link_of_the_documentation_leads_to_a_file(self):
        for page in [SOURCE / "README.md", *sorted((SOURCE / "docs").glob("*.md")), SOURCE / "meshes" / "README.md"]:
            for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text()):
                if not re.match(r"https?:", target):
                    self.assertTrue((page.parent / target).exists(), f"{page.name}: {target}")


if __name__ == "__main__":
    main()
