#!/usr/bin/python3
"""report.html of a run directory: one page that holds the run's files and draws them in any browser, without links to
anything outside. The same as  pseudorigid run SCENE --set Output/Report=true  writes at the end of a run, for runs that
were made without, that are still going on, or that were killed. Needs nothing but Python.

    tools/report.py output/quickstart

Pictures of the continuum need shapes.csv, which only runs with Output/Report = true write.
"""

import argparse
import json
import pathlib
import re

from run_directory import existing, fail

PAGE = pathlib.Path(__file__).resolve().parents[1] / "src/io/report"


def page():
    """The page without files, its parts put together as src/io/CMakeLists.txt does."""
    text = (PAGE / "page.html.in").read_bytes()
    return re.sub(b"@([a-z]+[.][a-z]+)@", lambda part: (PAGE / part[1].decode()).read_bytes(), text)


def report(directory):
    """The page with the files of the directory; src/io/report.cpp does the same."""
    manifest = existing(directory, "manifest.json", "is this the directory of a run?")
    system = json.loads(manifest.read_bytes()).get("system", "")

    def filled(element):
        name = element[1].decode().replace("{system}", system)
        file = directory / name
        text = file.read_bytes() if file.is_file() else b""
        return f'data-file="{name}">'.encode() + text.replace(b"&", b"&amp;").replace(b"<", b"&lt;")

    return re.sub(b'data-file="([^"]*)">', filled, page())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path, metavar="RUN_DIRECTORY")
    parser.add_argument("--output", type=pathlib.Path, metavar="HTML", help="default: RUN_DIRECTORY/report.html")
    arguments = parser.parse_args()
    output = arguments.output or arguments.directory / "report.html"
    text = report(arguments.directory)
    try:
        output.write_bytes(text)
    except OSError as error:
        fail(f"--output: {error}")
    print(output)


if __name__ == "__main__":
    main()
