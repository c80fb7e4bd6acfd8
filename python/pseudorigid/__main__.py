"""python3 -m pseudorigid COMMAND …: draws and joins the results of runs."""

import argparse
import importlib
import os
import sys

from pseudorigid.errors import exit_code_of

# name: (module, what it makes); a module is imported when its command is used.
COMMANDS = {
    "plot": ("plot", "curves of a run: deformation over time, difference of the models, energies"),
    "render": ("render", "the bodies of a run at one time, with their stress, as a picture"),
    "animate": ("animate", "the bodies of a run at all times, as an animated GIF"),
    "orbit": ("orbit", "a body and its companions in orbit, and the bulge of the body, as an animated GIF"),
    "paraview": ("paraview_view", "the bodies of a run in ParaView: a window, a picture or an animation"),
    "cells": ("cells", "a body with linear cells and with Lagrange cells"),
    "equilibria": ("equilibria", "figures of equilibrium, computed by the program: tables, or a picture"),
    "campbell": ("campbell", "spin over angular momentum, and frequencies over the spin, of figures of equilibrium"),
    "merge": ("merge", "the tables of the parts of a sweep, joined to one"),
    "adequacy": ("adequacy", "the maps of docs/adequacy.md from sweeps of several models"),
    "map": ("stability_map", "the map of stability of the stress suite"),
}


def main() -> None:
    listed = "\n".join(f"  {name:12}{text}" for name, (_, text) in COMMANDS.items())
    parser = argparse.ArgumentParser(prog="python3 -m pseudorigid", formatter_class=argparse.RawDescriptionHelpFormatter,
                                     description=f"Draws and joins the results of runs of pseudorigid.\n\ncommands:\n{listed}")
    parser.add_argument("command", choices=COMMANDS, metavar="COMMAND", help="COMMAND --help says more")
    command = parser.parse_args(sys.argv[1:2]).command
    os.environ.setdefault("MPLBACKEND", "Agg")  # into files, without a screen
    module = importlib.import_module(f"pseudorigid.{COMMANDS[command][0]}")
    of_command = argparse.ArgumentParser(prog=f"{parser.prog} {command}", description=module.__doc__,
                                         formatter_class=argparse.RawDescriptionHelpFormatter)
    module.add_arguments(of_command)
    module.main(of_command.parse_args(sys.argv[2:]))


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
