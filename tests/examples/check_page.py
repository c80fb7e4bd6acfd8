"""Whether the code on a page is that of the files: check_page.py docs/page.md

The comment <!-- file: path --> above a block of C++ says that all blocks so marked for a path, in order and with an empty
line between them, are that file. <!-- from: path --> says that the block stands in the file somewhere. Every block of
C++ has such a mark. <!-- changes: path --> above a block of diff, with an empty line between places that are apart, says
that the file has the lines that are changed and those around them, before the change or after it.
"""
import collections
import difflib
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:<!-- (file|from): (\S+) -->\n\n?)?^```cpp\n(.*?)^```$", re.MULTILINE | re.DOTALL)
CHANGES = re.compile(r"<!-- changes: (\S+) -->\n\n?^```diff\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def problems(page):
    """One text for everything on the page that differs from its file."""
    wholes = collections.defaultdict(list)
    for kind, path, code in BLOCK.findall(page):
        if kind == "file":
            wholes[path].append(code)
        elif kind != "from":
            yield f"a block of C++ says nothing of its file: {code.splitlines()[0]}"
        elif code not in (SOURCE / path).read_text():
            yield f"a block is not in {path}:\n{code}"
    if not wholes:
        yield "no file is on the page"
    for path, blocks in wholes.items():
        there, here = (SOURCE / path).read_text(), "\n".join(blocks)
        if here != there:
            yield "".join(difflib.unified_diff(there.splitlines(True), here.splitlines(True), path, "the page"))
    for path, changes in CHANGES.findall(page):
        for place in changes.split("\n\n"):
            before, after = ("\n".join(line[1:] for line in place.splitlines() if not line.startswith(other)) + "\n"
                             for other in "+-")
            if not any(lines in (SOURCE / path).read_text() for lines in (before, after)):
                yield f"{path} has not the lines\n{before}"


def main():
    found = list(problems(pathlib.Path(sys.argv[1]).read_text()))
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)


main()
