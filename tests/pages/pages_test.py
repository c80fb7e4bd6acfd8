"""Pages as a reader of CommonMark with GitHub's tables sees them, and the version that some of them repeat.

    pages_test.py            all tests; renders with Debian's python3-markdown-it
"""
import os
import pathlib
import re
import unittest

from markdown_it import MarkdownIt

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGES = [*sorted(SOURCE.glob("*.md")), *sorted((SOURCE / "docs").rglob("*.md")), SOURCE / "meshes" / "README.md"]
MARKDOWN = MarkdownIt("commonmark").enable(["table", "strikethrough"])


def torn_words(page):
    """Where emphasis begins or ends within a word or a formula: there a star or an underscore was meant, and is lost."""
    for token in MARKDOWN.parse(page):
        inline = token.children or []
        for before, here, after in zip([None, *inline], inline, [*inline[1:], None]):
            opens, closes = (here.type in (f"em_{end}", f"strong_{end}", f"s_{end}") for end in ("open", "close"))
            if opens and before and before.type == "text" and re.search(r"\w$", before.content):
                yield before.content[-20:] + here.markup + (after.content[:20] if after else "")
            if closes and after and after.type == "text" and re.match(r"\w", after.content):
                yield (before.content[-20:] if before else "") + here.markup + after.content[:20]


def cells(line):
    """How many cells a line of a table has: a bar after a backslash is none of its borders."""
    return len(re.findall(r"(?<!\\)\|", line.strip())) - 1


def uneven_rows(page):
    """Rows of tables that have another number of cells than the head, and rows outside any table."""
    lines, in_table = page.splitlines(), set()
    for token in MARKDOWN.parse(page):
        if token.type in ("table_open", "fence", "code_block", "html_block"):
            first, end = token.map
            in_table.update(range(first, end))
            if token.type == "table_open":
                yield from (line for line in lines[first:end] if cells(line) != cells(lines[first]))
    yield from (line for number, line in enumerate(lines) if line.startswith("|") and number not in in_table)


def bare_heads(page):
    """Tables whose head is empty: a browser draws it as an empty row."""
    lines = page.splitlines()
    for token in MARKDOWN.parse(page):
        if token.type == "table_open" and not re.search(r"[^|\s]", lines[token.map[0]]):
            yield f"line {token.map[0] + 1}"


def repeated_headings(page):
    """Headings that stand twice: a link to the second leads to the first."""
    tokens = MARKDOWN.parse(page)
    headings = [(token.tag, after.content) for token, after in zip(tokens, tokens[1:]) if token.type == "heading_open"]
    # Below different chapters the same heading may come again.
    parent, seen = "", set()
    for tag, text in headings:
        parent = text if tag == "h2" else parent
        key = (tag, text, parent if tag not in ("h1", "h2") else "")
        if key in seen:
            yield text
        seen.add(key)


def long_lines(page):
    """Lines of shell that a page shows only in part."""
    for token in MARKDOWN.parse(page):
        if token.type == "fence" and token.info.split(" ")[0] in ("console", "sh"):
            yield from (line for line in token.content.splitlines() if len(line) > 110)


def changed_formulas(page):
    """Displayed formulas, between two lines $$, that do not come through a renderer of CommonMark as one paragraph and
    letter for letter."""
    paragraphs = {}
    tokens = MARKDOWN.parse(page)
    for before, token in zip(tokens, tokens[1:]):
        if before.type == "paragraph_open":
            whole = all(part.type in ("text", "softbreak") for part in token.children)
            paragraphs[before.map[0]] = "".join(part.content or "\n" for part in token.children) if whole else None
    for formula in re.finditer(r"^ *\$\$\n.*?^ *\$\$$", page, re.MULTILINE | re.DOTALL):
        source = re.sub(r"^ *", "", formula[0], flags=re.MULTILINE)
        if paragraphs.get(page.count("\n", 0, formula.start())) != source:
            yield source
    if len(re.findall(r"\$\$", re.sub(r"`[^`\n]*`", "", page))) != len(re.findall(r"^ *\$\$$", page, re.MULTILINE)):
        yield "a $$ that has not a line of its own"


# Minus, dashes, spaces and quotation marks that are not those of a keyboard.
LOOKALIKES = re.compile("[\u2010-\u2015\u2212\u00a0\u2002-\u200b\u202f\u00d7\u2018\u2019\u201c\u201d]")
TYPED = re.compile(r"\b(set|subsection|include|end)\b|--|^\$ |\w+ = |\.prm\b")


def untypable(page):
    """Code that a reader types into a shell or a parameter file, with characters that only look like those of ASCII."""
    for token in MARKDOWN.parse(page):
        if token.type in ("fence", "code_block") and token.info.split(" ")[:1] in ([], [""], ["sh"], ["console"], ["prm"], ["text"]):
            yield from (line for line in token.content.splitlines() if LOOKALIKES.search(line) and TYPED.search(line))
        yield from (part.content for part in token.children or ()
                    if part.type == "code_inline" and LOOKALIKES.search(part.content) and TYPED.search(part.content))


class Pages(unittest.TestCase):
    def assert_none(self, problems):
        for path in PAGES:
            with self.subTest(page=path.name):
                self.assertEqual(list(problems(path.read_text())), [])

    def test_no_emphasis_within_a_word(self):
        for page, n in (("(5.121): d/dt(AΛ* − Ω*A) + ȦΛ*", 1), (r"(5.121): d/dt(AΛ\* − Ω\*A) + ȦΛ\*", 0), ("**bold**, *e*m", 1),
                        ("`AΛ* − Ω*A`, *emphasis*.", 0)):
            self.assertEqual(len(list(torn_words(page))), n, page)
        self.assert_none(torn_words)

    def test_rows_of_tables_have_the_cells_of_the_head(self):
        head = "| a | b |\n|---|---|\n"
        for page, n in ((head + "| 1 | 2 |\n", 0), (head + r"| \|x\| | 2 |" + "\n", 0), (head + "| |x| | 2 |\n", 1),
                        ("text\n\n| a | b |\n", 1), ("```\n| a |\n```\n", 0)):
            self.assertEqual(len(list(uneven_rows(page))), n, page)
        self.assert_none(uneven_rows)

    def test_tables_have_heads(self):
        for page, n in (("| | |\n|---|---|\n| 1 | 2 |\n", 1), ("| | b |\n|---|---|\n| 1 | 2 |\n", 0)):
            self.assertEqual(len(list(bare_heads(page))), n, page)
        self.assert_none(bare_heads)

    def test_no_heading_stands_twice(self):
        for page, n in (("## a\n\n## b\n\n## a\n", 1), ("## a\n\n### c\n\n## b\n\n### c\n", 0), ("## a\n\n```\n## a\n```\n", 0)):
            self.assertEqual(len(list(repeated_headings(page))), n, page)
        self.assert_none(repeated_headings)

    def test_lines_of_shell_fit_the_page(self):
        self.assertEqual(list(long_lines("```sh\n" + 111 * "x" + "\nshort\n```\n\n```c++\n" + 111 * "x" + "\n```\n")), [111 * "x"])
        self.assert_none(long_lines)

    def test_what_is_typed_is_ascii(self):
        for page, n in (("```prm\nset End = \u22120.2\n```\n", 1), ("`--set \u201cTime/End=1\u201d`", 1), ("`End = 1\u20132`", 1),
                        ("`I \u2212 3`, v = \u22120.2 and `--set Time/End=-1`", 0), ("```c++\n// a \u2212 b = c\n```\n", 0)):
            self.assertEqual(len(list(untypable(page))), n, page)
        self.assert_none(untypable)
        scenes = [*(SOURCE / "params").glob("*.prm"), *(SOURCE / "examples").rglob("*.prm")]
        self.assertGreater(len(scenes), 30)
        for path in scenes:
            settings = "\n".join(line.split("#")[0] for line in path.read_text().splitlines())
            self.assertIsNone(LOOKALIKES.search(settings), path.name)

    def test_displayed_formulas_are_left_as_they_are(self):
        for formula, n in ((r"a_{1}^{\ast} = \frac{b}{c}", 0), (r"\Omega*A - \Lambda*B", 1), (r"a \, b", 1),
                           ("a\n= b", 0), ("a\n=", 1), (r"a \\ b", 1), (r"f(a)_{1} + f(b)_{2} ", 1)):
            page = f"So\n\n$$\n{formula}\n$$\n\nholds.\n"
            self.assertEqual(len(list(changed_formulas(page))), n, page)
        self.assert_none(changed_formulas)

    def test_formulas_are_displayed(self):
        # A check that formulas are found at all.
        n = sum(path.read_text().count("\n$$\n") for path in PAGES)
        self.assertGreater(n, 20)


def named_paths(page):
    """Paths to files that a page names in backticks."""
    return re.findall(r"`([\w./-]+/[\w-]+\.\w+)`", page)


class Index(unittest.TestCase):
    def test_every_page_is_in_it(self):
        listed = set(re.findall(r"\]\(([\w/]+\.md)\)", (SOURCE / "docs/README.md").read_text()))
        pages = {path.relative_to(SOURCE / "docs").as_posix() for path in (SOURCE / "docs").rglob("*.md")} - {"README.md"}
        self.assertEqual(pages - listed, set())


class Architecture(unittest.TestCase):
    def test_places_exist(self):
        self.assertEqual(named_paths("`a/b.h`, `Time/Step`, `c.h`, `d/e-f.cmake`"), ["a/b.h", "d/e-f.cmake"])
        paths = named_paths((SOURCE / "docs/architecture.md").read_text())
        self.assertGreater(len(paths), 80)
        for path in paths:
            self.assertTrue((SOURCE / "src" / path).exists() or (SOURCE / path).exists(), path)


class Version(unittest.TestCase):
    def test_a_file_that_names_its_interpreter_can_be_executed(self):
        """scripts/documentation.sh and pages call such files by their names."""
        folders = (SOURCE / name for name in (".ci", "benchmarks", "examples", "meshes", "python", "scripts", "tests", "tools"))
        named = [path for folder in folders for path in folder.rglob("*") if path.is_file() and path.open("rb").read(2) == b"#!"]
        self.assertGreater(len(named), 20)
        self.assertEqual([str(path) for path in named if not os.access(path, os.X_OK)], [])

    def test_pages_repeat_the_version_of_the_project(self):
        version = re.search(r"^project\(pseudorigid VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text(), re.M)[1]
        citation, changes = ((SOURCE / name).read_text() for name in ("CITATION.cff", "CHANGELOG.md"))
        self.assertEqual(re.search(r"^version: (\S+)$", citation, re.M)[1], version)
        newest, date = re.search(r"^## (\S+) – (\S+)$", changes, re.M).groups()
        self.assertEqual(newest, version)
        package = (SOURCE / "python/pseudorigid/__init__.py").read_text()
        self.assertEqual(re.search(r'^__version__ = "(.*)"$', package, re.M)[1], version)
        self.assertEqual(re.search(r"^date-released: (\S+)$", citation, re.M)[1], date)


if __name__ == "__main__":
    unittest.main()
