#!/usr/bin/python3
"""Writes README.md and pages of docs/ (PAGES) with what their commands print now.

    tools/print_pages.py build/release/bin/pseudorigid

Look at the difference before it is committed. A test (tests/app/documentation_test.py) runs the same commands and compares.
"""

import argparse
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "support"))

import documentation  # noqa: E402

PAGES = ("README.md", "docs/first_run.md", "docs/own_scene.md", "docs/accurate_runs.md", "docs/python.md", "docs/scope.md")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    arguments = parser.parse_args()
    for name in PAGES:
        page = ROOT / name
        with tempfile.TemporaryDirectory() as folder:
            documentation.make_workplace(pathlib.Path(folder), arguments.program.resolve())
            page.write_text(documentation.printed_anew(page.read_text(), pathlib.Path(folder)))
        print(name)


if __name__ == "__main__":
    main()
