"""The base of tests of reports: what a page holds, and whether it is one that any browser takes."""
import html.parser
import re
import shutil
import subprocess

from program_test import ProgramTest, Table

VOID = {"meta"}
REPORTED = {"Output/Report": "true"}


class Page(html.parser.HTMLParser):
    """Elements that are opened and closed in order, and the files that the page holds, as text."""

    def __init__(self, path):
        super().__init__(convert_charrefs=False)
        self.open, self.files, self.scripts, self.references = [], {}, [], []
        self.text = path.read_text()
        self.feed(self.text)
        self.close()
        if self.open:
            raise AssertionError(f"{path}: {self.open} are not closed")

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.references += [value for name, value in attributes.items() if name in ("src", "href", "action", "srcset")]
        if tag in VOID:
            return
        self.open.append(tag)
        if tag == "script" and "data-file" in attributes:
            self.name = attributes["data-file"]
            self.files[self.name] = ""
        else:
            self.name = None
            if tag == "script":
                self.scripts.append("")

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            raise AssertionError(f"</{tag}> ends nothing")

    def handle_data(self, data):
        if not self.open or self.open[-1] != "script":
            return
        if self.name is None:
            self.scripts[-1] += data
        else:
            self.files[self.name] += data.replace("&lt;", "<").replace("&amp;", "&")


class ReportTest(ProgramTest):
    def run_reported(self, entries, *arguments, name="scene.prm", folder=None):
        """The page of a run."""
        self.scene({**entries, **REPORTED}, name)
        self.run_done("run", name, *arguments)
        return self.check_page(folder or "output/scene")

    def check_page(self, folder):
        """What is true of every report; the page."""
        path = self.scratch / folder / "report.html"
        page = Page(path)
        self.assertEqual(page.references, [])
        self.assertNotRegex(page.text, r"@import|url\(|\bfetch\(|XMLHttpRequest|import\(")
        self.assertEqual(set(re.findall(r"\w+://[^\"' ]*", "".join(page.scripts))), {"http://www.w3.org/2000/svg"})
        for name, text in page.files.items():
            if name.startswith("frames-"):
                continue  # made from pictures of the run
            file = path.parent / name
            self.assertEqual(text, file.read_text() if file.is_file() else "", name)
        results = {file for file in self.files(folder) if file.endswith((".csv", ".json", ".prm"))}
        self.assertLessEqual(results, page.files.keys())
        self.check_command_makes_the_same(folder, path)
        if shutil.which("node"):  # of the scripts at least the grammar
            script = self.scratch / "script.js"
            script.write_text("".join(page.scripts))
            checked = subprocess.run(["node", "--check", script], capture_output=True, text=True)
            self.assertEqual(checked.returncode, 0, checked.stderr)
        return page

    def check_command_makes_the_same(self, folder, path):
        made = self.run_done("report", folder, "--output", "again.html")
        self.assertEqual(made.stdout, "again.html\n")
        self.assertEqual(self.bytes("again.html"), path.read_bytes())

    def check_samples(self, page, name, folder="output/scene"):
        """Every sample of the file, at every column, is in the page."""
        table = Table(self.scratch / folder / name)
        header, *rows = page.files[name].splitlines()
        self.assertEqual(header.split(","), table.header)
        self.assertEqual([[float(x) for x in row.split(",")] for row in rows], table.rows)

    def check_nothing_else_changes(self, entries):
        """The other files of a run are the same with a report and without."""
        self.scene(entries)
        for folder, report in ("without", "false"), ("with", "true"):
            self.run_done("run", "scene.prm", "--output", folder, "--set", f"Output/Report={report}")
        added = set(self.files("with")) - set(self.files("without"))
        for name in self.files("without"):
            if name.endswith((".csv", ".vtu", ".pvd")) or name == "comparison.json":
                self.assertEqual(self.bytes("with", name), self.bytes("without", name), name)
        steps = [{m: model["counters"] for m, model in self.json(folder, "manifest.json")["models"].items()} for folder in ("with", "without")]
        self.assertEqual(*steps)
        return added
