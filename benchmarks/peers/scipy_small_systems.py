#!/usr/bin/python3
"""The problems of benchmarks/problem_data.h by SciPy's DOP853, an explicit method of order 8 with dense output.

    scipy_small_systems.py [--quick] > FILE.csv

Columns as those of work_precision.cpp; right-hand sides in NumPy and Python. The samples are interpolated by the method. The error is that from the same
references. Processor times of the solver alone; medians.
"""

import argparse
import csv
import math
import pathlib
import statistics
import sys
import time

import numpy as np
import scipy
from scipy.integrate import solve_ivp

REFERENCES = pathlib.Path(__file__).resolve().parents[1] / "references"
N_SAMPLES, END = 100, 100.0


def sl3():
    Q = np.diag([1.3, 1, 1 / 1.3])
    L = np.array([[0.2, -0.8, 0.1], [0.6, -0.3, 0.2], [0, -0.1, 0.1]])

    def rate(_, y):
        Q, V = y[:9].reshape(3, 3), y[9:].reshape(3, 3)
        a, b, c = Q
        C = np.array([cross(b, c), cross(c, a), cross(a, b)])
        P = C.T @ V
        s = (np.sum(P * P.T) / (a @ C[0]) + 5 * np.sum(C * Q)) / np.sum(C * C)
        return np.concatenate([y[9:], (s * C - 5 * Q).ravel()])
    return rate, np.concatenate([Q.ravel(), (Q @ L).ravel()]), lambda y: y


def cross(u, v):
    """numpy.cross takes ten times as long."""
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def rigid_body():
    """Euler's equation on quaternions (x, y, z, w); coordinates: R by rows, Ω."""
    def rate(_, y):
        x, v = y[:4], y[4:]
        Omega = body_velocity(x, v)
        p, q, r = Omega
        change = (-0.5 * q * r, 0.75 * r * p, -0.4 * p * q)
        return [*v, *(0.5 * (product(v, Omega) + product(x, change)))]

    def product(q, w):
        u = cross(q, w)
        return np.array([q[3] * w[0] + u[0], q[3] * w[1] + u[1], q[3] * w[2] + u[2],
                         -(q[0] * w[0] + q[1] * w[1] + q[2] * w[2])])

    def body_velocity(q, v):
        u = cross(q, v)
        factor = 2 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
        return tuple(factor * (q[3] * v[i] - v[3] * q[i] - u[i]) for i in range(3))

    def coordinates(y):
        x, v = y[:4], y[4:]
        Omega = body_velocity(x, v)
        x = x / math.sqrt(x @ x)
        K = np.array([[0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]])
        return np.concatenate([(np.eye(3) + 2 * x[3] * K + 2 * K @ K).ravel(), Omega])
    start = np.array([0, 0, 0, 1.0])
    return rate, np.concatenate([start, 0.5 * product(start, (0.4, 1.0, 0.6))]), coordinates


def double_pendulum():
    """In angles."""
    def rate(_, y):
        a, b, u, v = y
        c, s = math.cos(a - b), math.sin(a - b)
        r1, r2 = -s * v * v - 2 * math.sin(a), s * u * u - math.sin(b)
        inverse = 1 / (2 - c * c)
        return (u, v, (r1 - c * r2) * inverse, (2 * r2 - c * r1) * inverse)

    def coordinates(y):
        a, b, u, v = y
        first, second = np.array([math.sin(a), math.cos(a)]), np.array([math.sin(b), math.cos(b)])
        of_first, of_second = u * np.array([first[1], -first[0]]), v * np.array([second[1], -second[0]])
        return np.concatenate([first, first + second, of_first, of_first + of_second])
    return rate, np.array([0.6, 0.8, 0, 0]), coordinates


def reference(problem):
    lines = (REFERENCES / f"{problem}.csv").read_text().splitlines()[2:]
    return np.array([[float(cell) for cell in line.split(",")[1:]] for line in lines])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true")
    n_rounds = 1 if parser.parse_args().quick else 3
    print(f"# SciPy {scipy.__version__}; medians of {n_rounds} rounds")
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow("problem,method,parameter_name,parameter,evaluations,seconds,error".split(","))
    times = END * np.arange(1, N_SAMPLES + 1) / N_SAMPLES
    for problem, name in ((sl3, "sl3"), (rigid_body, "rigid_body"), (double_pendulum, "double_pendulum")):
        rate, start, coordinates = problem()
        exact = reference(name)
        for exponent in range(6, 14):
            tolerance, seconds = 10.0**-exponent, []
            for _ in range(n_rounds):
                begin = time.process_time()
                motion = solve_ivp(rate, (0, END), start, method="DOP853", t_eval=times, rtol=tolerance, atol=tolerance)
                seconds.append(time.process_time() - begin)
            samples = np.array([coordinates(y) for y in motion.y.T])
            method = "SciPy DOP853" + (" (angles)" if name == "double_pendulum" else "")
            out.writerow([name, method, "tolerance", f"{tolerance:g}", motion.nfev, f"{statistics.median(seconds):.6g}",
                          f"{np.abs(samples - exact).max():.6g}"])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
