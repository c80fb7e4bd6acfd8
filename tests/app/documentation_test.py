"""The commands of README.md and of six pages of docs/ print what the pages say.

After a change of what the program prints, tools/print_pages.py writes the pages anew.
"""
import re
import shlex

import documentation
from program_test import ProgramTest, SOURCE, main


def anchors(text):
    """Of the headings of a page, as they are made where the pages are shown: lower case, no punctuation, hyphens."""
    headings = re.findall(r"^#+ (.*)$", text, re.M)
    return [re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings]


class Documentation(ProgramTest):
    def check(self, page):
        documentation.make_workplace(self.scratch, self.program)
        n_commands = 0
        for step in documentation.steps((SOURCE / page).read_text()):
            if isinstance(step, documentation.File):
                (self.scratch / step.name).write_text(step.text)
                continue
            n_commands += 1
            printed = step.run(self.scratch)
            difference = documentation.first_difference(step.expected, printed)
            self.assertIsNone(difference, "\n".join([f"{page}: $ {step.text}", *printed]))
        return n_commands

    def test_what_counts_as_the_same(self):
        for a, b, same in (("step 0.02336, 1.93 s", "step 0.02337, 0.5 s", True), ("drift   4.4e-06", "drift 4.6e-06", True),
                           ("drift 1.2e-15", "drift 0", True), ("step 0.02336", "step 0.0241", False),
                           ("drift 4.4e-06", "drift 6.4e-06", False), ("18.9 +- 0.4 %", "18.9 +- 1 %", False), ("2 runs", "2 of the runs", False)):
            self.assertEqual(documentation.same_line(a, b), same, (a, b))
        self.assertIsNone(documentation.first_difference(["a", "…", "d"], ["a", "b", "c", "d"]))
        for printed in (["a"], ["a", "b"], ["a", "b", "d", "e"]):
            self.assertIsNotNone(documentation.first_difference(["a", "…", "d"], printed))

    def test_scenes_of_all_pages_are_accepted(self):
        """Of every command `scripts/run.sh params/…` with its options, except those with a variable of the shell."""
        n_commands = 0
        for page in SOURCE / "README.md", *sorted((SOURCE / "docs").glob("*.md")):
            for block in re.findall(r"^```sh\n(.*?)^```", page.read_text(), re.S | re.M):
                for line in re.findall(r"^scripts/run\.sh (params/.*)", block.replace("\\\n", " "), re.M):
                    if re.search(r"\$[a-z]", line):
                        continue
                    words = shlex.split(line, comments=True)
                    words = [word for word, before in zip(words, ["", *words]) if "--output" not in (word, before) and word != "--resume"]
                    words[0] = str(SOURCE / words[0])
                    result = self.run_program("check", *words)
                    self.assertEqual(result.returncode, 0, f"{page}: {line}\n{result.stderr}")
                    n_commands += 1
        self.assertGreater(n_commands, 20)

    def test_readme(self):
        self.assertGreaterEqual(self.check("README.md"), 1)

    def test_python(self):
        self.assertGreaterEqual(self.check("docs/python.md"), 2)

    def test_scope(self):
        self.assertGreaterEqual(self.check("docs/scope.md"), 4)

    def test_first_run(self):
        self.assertGreaterEqual(self.check("docs/first_run.md"), 3)

    def test_own_scene(self):
        self.assertGreaterEqual(self.check("docs/own_scene.md"), 9)

    def test_accurate_runs(self):
        self.assertGreaterEqual(self.check("docs/accurate_runs.md"), 3)

    def test_results_name_every_key_and_column_of_a_comparison(self):
        self.scene({"Models": "reduced, continuum", "Continuum/Degree": 2, "Time/End": 10, "Material/Viscosity": 1e-3,
                    "Initial state/Velocity": "0.1, 0, 0; 0, 0.1, 0; 0, 0, -0.2"})
        self.run_done("run", "scene.prm")
        page = "".join((SOURCE / f"docs/{name}.md").read_text() for name in ("output", "data/comparison"))
        table, comparison = self.table("output/scene/comparison.csv"), self.json("output/scene/comparison.json")

        def names(value):
            items = value.items() if isinstance(value, dict) else [("", v) for v in value] if isinstance(value, list) else []
            return {name for name, _ in items}.union(*(names(v) for _, v in items)) - {""}
        for name in names(comparison) | set(table.header):
            if not name.isdigit() and not re.match(r"a[23]_", name):
                self.assertIn(f"`{name}`", page)

    def test_every_link_of_the_documentation_leads_somewhere(self):
        for page in [*sorted(SOURCE.glob("*.md")), *sorted((SOURCE / "docs").rglob("*.md")), SOURCE / "meshes" / "README.md"]:
            text = page.read_text()
            for target in re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'src="([^"]+)"', text):
                if re.match(r"https?:", target):
                    continue
                file, _, anchor = target.partition("#")
                path = page.parent / file if file else page
                self.assertTrue(path.exists(), f"{page.name}: {target}")
                if anchor:
                    self.assertIn(anchor, anchors(path.read_text()), f"{page.name}: {target}")


if __name__ == "__main__":
    main()
