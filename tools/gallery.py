#!/usr/bin/python3
"""Makes every picture of docs/gallery.md again: runs the scenes with the program and draws their results,
curves as SVG and bodies as PNG with all their colours.

Needs Debian's python3-matplotlib and python3-vtk9, which draws through an X server; without a screen:

    apt-get install python3-matplotlib python3-vtk9 xvfb xauth libgl1-mesa-dri
    xvfb-run -a tools/gallery.py build/release/bin/pseudorigid
    xvfb-run -a tools/gallery.py build/release/bin/pseudorigid --only torus geodesic
"""

import argparse
import functools
import pathlib
import sys

import gallery_bodies
import gallery_curves
import gallery_systems
import package  # noqa: F401
from pseudorigid.errors import WrongInput, exit_code_of
from pseudorigid.program import run as run_scene

ROOT = pathlib.Path(__file__).resolve().parents[1]
CURVES = {**gallery_curves.PICTURES, **gallery_systems.PICTURES}  # name -> drawing(run, its path)
PICTURES = {**gallery_bodies.PICTURES, **CURVES}


class Runs:
    """Runs of scenes, each made once."""

    def __init__(self, program, directory):
        self.program, self.directory = program, directory

    @functools.cache
    def __call__(self, scene, *overrides):
        """The run directory of params/SCENE.prm with overrides "Section/Entry=value"."""
        directory = self.directory / "-".join([scene, *(o.split("=")[1].replace("/", "_") for o in overrides)])
        options = dict(o.split("=", 1) for o in overrides)
        return run_scene(ROOT / "params" / f"{scene}.prm", options, output=directory, program=self.program).directory


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=sorted(PICTURES), metavar="NAME", default=list(PICTURES))
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "docs/images/gallery", help="of the pictures")
    parser.add_argument("--runs", type=pathlib.Path, default=pathlib.Path("output/gallery"), help="of the runs")
    arguments = parser.parse_args()
    if not arguments.program.is_file():
        raise WrongInput(f"{arguments.program} does not exist; scripts/run.sh builds it")
    arguments.output.mkdir(parents=True, exist_ok=True)
    run = Runs(arguments.program, arguments.runs)
    for name in arguments.only:
        path = arguments.output / f"{name}.{'svg' if name in CURVES else 'png'}"
        PICTURES[name](run, path)
        print(f"{path}: {path.stat().st_size // 1000} kB")
        sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
