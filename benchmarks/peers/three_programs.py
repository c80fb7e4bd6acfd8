#!/usr/bin/python3
"""The runs of the nonlinear release by pseudorigid, FEniCSx and GetFEM in one table.

    benchmarks/peers/three_programs.py DATA > three_programs.csv

DATA is a folder with ball_release.csv, implicit_midpoint.csv, fenicsx_release.csv and getfem_release.csv of one day and machine. The
program "midpoint inside" is the implicit midpoint rule of FEniCSx inside pseudorigid. Columns: program,
degree, refinements, method, step, unknowns, seconds (of pseudorigid motion_seconds), error.
"""
import csv
import pathlib
import sys

FILES = {"pseudorigid": ("ball_release.csv", "method", "motion_seconds"),
         "midpoint inside": ("implicit_midpoint.csv", "scheme", "seconds"), "FEniCSx": ("fenicsx_release.csv", "scheme", "seconds"),
         "GetFEM": ("getfem_release.csv", "scheme", "seconds")}


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(("program", "degree", "refinements", "method", "step", "unknowns", "seconds", "error"))
    for program, (name, method, seconds) in FILES.items():
        with open(pathlib.Path(sys.argv[1]) / name, newline="") as file:
            for row in csv.DictReader(line for line in file if not line.startswith("#")):
                writer.writerow((program, *(row[column] for column in ("degree", "refinements", method, "step", "unknowns", seconds,
                                                                       "error"))))


if __name__ == "__main__":
    main()
