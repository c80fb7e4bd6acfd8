#!/usr/bin/python3
"""A picture of the first part of an HTML page, such as a report, as Chromium draws it without a screen.

    apt-get install chromium python3-pil
    tools/page_picture.py output/quickstart/report.html --output report.png --size 1200x888
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

from PIL import Image

import package  # noqa: F401
from pseudorigid.errors import WrongInput, exit_code_of


def size(text):
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit()):
        raise argparse.ArgumentTypeError(f'"{text}" is not WIDTHxHEIGHT in pixels')
    return int(width), int(height)


def draw(page, width, height, picture):
    """Writes the page's uppermost width × height pixels as a PNG file."""
    with tempfile.TemporaryDirectory() as profile:
        # Without its sandbox Chromium also runs as root; the page is the user's own file.
        run = subprocess.run(
            ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--virtual-time-budget=8000",
             f"--user-data-dir={profile}", f"--window-size={width},{height}", f"--screenshot={picture}", page.as_uri()],
            capture_output=True, text=True, timeout=120)
    if run.returncode or not picture.is_file():
        raise WrongInput(f"chromium did not draw {page}: {run.stderr.strip().splitlines()[-1:]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=pathlib.Path, help="HTML file")
    parser.add_argument("--output", type=pathlib.Path, required=True, help="PNG file")
    parser.add_argument("--size", type=size, default=(1200, 888), help="WIDTHxHEIGHT in pixels (default 1200x888)")
    arguments = parser.parse_args()
    if not arguments.page.is_file():
        raise WrongInput(f"{arguments.page} does not exist")
    if not shutil.which("chromium"):
        raise WrongInput("chromium is missing: apt-get install chromium")
    with tempfile.TemporaryDirectory() as directory:
        drawn = pathlib.Path(directory) / "page.png"
        draw(arguments.page.resolve(), *arguments.size, drawn)
        Image.open(drawn).convert("RGB").save(arguments.output, optimize=True)


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
