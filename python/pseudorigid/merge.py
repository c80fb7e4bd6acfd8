"""Joins the tables of the parts of a sweep (Sweep/Part), in the order of their runs.

    python3 -m pseudorigid merge output/part1 output/part2 --output output/whole

writes output/whole/sweep.csv. A run that two parts have, or that is missing between two runs, is refused.
"""

import argparse
import os
import pathlib

from pseudorigid.errors import WrongInput


def merged_rows(directories: list[str | os.PathLike[str]], name: str = "sweep.csv") -> list[str]:
    """The lines of the joined table, the header first. WrongInput if the tables do not fit together."""
    header, rows = None, {}
    for directory in directories:
        path = pathlib.Path(directory) / name
        if not path.is_file():
            raise WrongInput(f"{path} does not exist; run that part of the sweep first")
        first, *lines = path.read_text().splitlines() or [""]
        if header not in (None, first):
            raise WrongInput(f"{path} has other columns than the parts before; all parts must have the same scene")
        header = first
        for line in lines:
            run = int(line.split(",", 1)[0])
            if run in rows:
                raise WrongInput(f"run {run} is in two parts, the second of them {path}")
            rows[run] = line
    runs = sorted(rows)
    missing = sorted(set(range(runs[0], runs[-1] + 1)) - rows.keys()) if runs else []
    if missing:
        raise WrongInput(f"run {missing[0]} is in no part; finish the part that has it with --resume")
    return [header or "", *(rows[run] for run in runs)]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("parts", nargs="+", help="directories of the parts")
    parser.add_argument("--output", required=True, help="directory of the joined table")


def main(arguments: argparse.Namespace) -> None:
    lines = merged_rows(arguments.parts)
    folder = pathlib.Path(arguments.output)
    if (folder / "sweep.csv").exists():
        raise WrongInput(f"{folder / 'sweep.csv'} exists; give another --output")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "sweep.csv").write_text("\n".join(lines) + "\n")
