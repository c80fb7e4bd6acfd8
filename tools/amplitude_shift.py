#!/usr/bin/python3
"""α of ω = ω₀(1 + αA² + βA⁴) from a sweep over the amplitude with Sweep/Trajectories = true, for docs/polynomial.md.

    scripts/run.sh params/amplitude.prm --set Sweep/Trajectories=true --output output/amplitude
    tools/amplitude_shift.py output/amplitude

ω is the column `frequency`, and A the amplitude of the line ω of ln Q33, fitted together with the mean and the multiples 2ω and 3ω.
For each N (or for all runs together without this parameter), α is printed for all motions, without the largest amplitude, and without
the smallest.
"""
import csv
import pathlib
import sys

import numpy as np


def read_rows(path):
    with open(path, newline="") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def amplitude(time, values, omega):
    columns = [np.ones_like(time)] + [f(k * omega * time) for k in (1, 2, 3) for f in (np.cos, np.sin)]
    fit = np.linalg.lstsq(np.stack(columns, 1), values, rcond=None)[0]
    return np.hypot(fit[1], fit[2])


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    samples = {}
    for row in read_rows(folder / "trajectories.csv"):
        samples.setdefault(row["run"], []).append((row["time"], np.log(row["Q33"])))
    families = {}
    for row in read_rows(folder / "sweep.csv"):
        omega = row["frequency"]
        families.setdefault(row.get("N"), []).append((amplitude(*np.array(samples[row["run"]]).T, omega), omega))
    for N, motions in families.items():
        A, omega = np.array(motions).T
        fits = (np.polyfit(A[chosen] ** 2, omega[chosen], 2) for chosen in (slice(None), slice(None, -1), slice(1, None)))
        print("" if N is None else f"N = {N:g}:", "alpha", *(f"{fit[1] / fit[2]:.4f}" for fit in fits))


if __name__ == "__main__":
    main()
