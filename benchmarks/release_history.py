#!/usr/bin/python3
"""Run time of the nonlinear release over commits: a line for the results that stand in a directory of data.

    benchmarks/release_history.py docs/benchmarks/data

release_history.csv has for each commit the cheapest run with an error of at most 1e-4 and 1e-5, and that of FEniCSx.
Machines differ; the ratio of two programs that ran after one another differs less. Results of the same commit take the
place of earlier ones.
"""
import csv
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tools"))

from benchmark_data import HISTORY_LEVELS, cheapest, read_rows, read_runs  # noqa: E402


def main():
    data = pathlib.Path(sys.argv[1])
    run = read_runs(data)["release"]
    line = {"commit": run["commit"], "date": run["date"], "processor": run["processor"]}
    for name, file in ("seconds", "ball_release.csv"), ("fenicsx", "fenicsx_release.csv"):
        for level in HISTORY_LEVELS:
            best = cheapest(read_rows(data, file), level)
            line[f"{name}_{level:.0e}"] = best["seconds"] if best else ""
    rows = [row for row in read_rows(data, "release_history.csv") if row["commit"] != line["commit"]] + [line]
    with open(data / "release_history.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, line.keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
