"""Whether the code on a page is that of the files: check_page.py docs/page.md

The comment <!-- file: path --> above a block of C++ says that all blocks so marked for a path, in order and with an empty
line between them, are that file. <!-- from: path --> says that the block stands in the file somewhere. Every block of
C++ has such a mark. Above a block of diff, with an empty line between places that are apart, <!-- changed: path --> says
that the file has these lines, and <!-- changes: path --> that it has those between which a reader adds some: in this order,
not necessarily one after the other, since others have added lines as the page says. So these blocks only add.
"""
import collections
import difflib
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:<!-- (file|from): (\S+) -->\n\n?)?^```cpp\n(.*?)^```$", re.MULTILINE | re.DOTALL)
CHANGES = re.compile(r"(?:<!-- (changes|changed): (\S+) -->\n\n?)?^```diff\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def follow(lines, text):
    """Whether the text has the lines in this order, however they are indented and aligned."""
    rest = iter([line.split() for line in text.splitlines()])
    return all(line.split() in rest for line in lines)


def problems_of_changes(page, read):
    for kind, path, changes in CHANGES.findall(page):
        if not kind:
            yield f"a block of diff says nothing of its file: {changes.splitlines()[0]}"
            continue
        for place in changes.split("\n\n"):
            lines = place.splitlines()
            if any(line.startswith("-") for line in lines):
                yield f"{path}: who adds after somebody else does not find the lines that are replaced in\n{place}"
            there = [line[1:] for line in lines if kind == "changed" or not line.startswith("+")]
            if not follow(there, read(path)):
                yield f"{path} has not the lines\n" + "\n".join(there)


def problems(page, read=lambda path: (SOURCE / path).read_text()):
    """One text for everything on the page that differs from its file."""
    wholes = collections.defaultdict(list)
    for kind, path, code in BLOCK.findall(page):
        if kind == "file":
            wholes[path].append(code)
        elif kind != "from":
            yield f"a block of C++ says nothing of its file: {code.splitlines()[0]}"
        elif code not in read(path):
            yield f"a block is not in {path}:\n{code}"
    if not BLOCK.search(page):
        yield "no code is on the page"
    for path, blocks in wholes.items():
        there, here = read(path), "\n".join(blocks)
        if here != there:
            yield "".join(difflib.unified_diff(there.splitlines(True), here.splitlines(True), path, "the page"))
    yield from problems_of_changes(page, read)


def main():
    found = list(problems(pathlib.Path(sys.argv[1]).read_text()))
    for problem in found:
        print(problem)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
