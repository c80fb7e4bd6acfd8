"""docs/data/chapter5.md against the program and the other pages: what it tells to run can be run, what to look at exists, the tests
it names are in docs/data/statements.md, and no numbered statement of the chapter is missing."""
import re

from program_test import ProgramTest, SOURCE, main

PAGE = (SOURCE / "docs/data/chapter5.md").read_text()
# Propositions, exercises, examples and remarks of each section, which the book counts together.
N_STATEMENTS = {1: 2, 2: 2, 3: 1, 4: 1, 5: 2, 6: 20, 7: 12, 8: 9}
BOOK, SAYS, RUN, LOOK, TEST, CORRECTION = range(6)


def rows():
    for line in PAGE.splitlines():
        if line.startswith("| ") and not line.startswith(("| book", "|---")):
            yield [cell.strip() for cell in line.strip("|").split("|")]


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


def numbers_of(cell):
    """The statements that a cell names, ranges written out: "5.6.1–5.6.3, 5.6.5" → those four."""
    found = set(re.findall(r"5\.\d\.\d+", cell))
    for section, first, last in re.findall(r"5\.(\d)\.(\d+)–5\.\1\.(\d+)", cell):
        found |= {f"5.{section}.{n}" for n in range(int(first), int(last) + 1)}
    return found


class OlivaPage(ProgramTest):
    def test_every_row_has_all_its_cells(self):
        self.assertGreater(len(list(rows())), 50)
        for row in rows():
            self.assertEqual(len(row), 6, row)
            self.assertTrue(row[BOOK] and row[SAYS] and row[RUN] and row[TEST], row)

    def test_every_numbered_statement_is_on_the_page(self):
        found = set().union(*(numbers_of(row[BOOK]) for row in rows()))
        for section, n in N_STATEMENTS.items():
            for k in range(1, n + 1):
                self.assertIn(f"5.{section}.{k}", found)

    def test_what_it_tells_to_run_is_a_scene(self):
        n_runs = 0
        for row in rows():
            for run in row[RUN].split(";"):
                words = quoted(run)
                if not words:
                    continue
                scene, *entries = words
                options = [word for entry in entries for word in ("--set", entry)]
                result = self.run_program("check", SOURCE / "params" / f"{scene}.prm", *options)
                self.assertEqual(result.returncode, 0, f"{run}: {result.stderr}")
                n_runs += 1
        self.assertGreater(n_runs, 40)

    def test_what_to_look_at_is_a_column_or_an_entry(self):
        known = set(re.findall(r"`(\w+)`", (SOURCE / "docs/parameters.md").read_text()))
        for name, last in re.findall(r"`(\w+?\d+) \.\.\. (\w+?\d+)`", (SOURCE / "docs/parameters.md").read_text()):
            known |= {name, last}
        for row in rows():
            for word in quoted(row[LOOK]):
                if "=" not in word and not word.endswith(".csv"):
                    self.assertIn(word, known, row)

    def test_tests_and_corrections_exist(self):
        suites = set(re.findall(r"`((?:Statement|Correction)_\w+)` `", (SOURCE / "docs/data/statements.md").read_text()))
        corrections = set()
        for row in rows():
            for suite in quoted(row[TEST]):
                self.assertIn(suite, suites, row)
            corrections |= set(re.findall(r"\d+", row[CORRECTION]))
        self.assertEqual(corrections, {str(n) for n in range(1, 14)})


if __name__ == "__main__":
    main()
