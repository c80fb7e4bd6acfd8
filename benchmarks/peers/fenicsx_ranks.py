#!/usr/bin/python3
"""The nonlinear release of the ball by FEniCSx on one and on two ranks: wall time of factors and of a step.

    benchmarks/peers/fenicsx_ranks.py [--quick] > fenicsx_ranks.csv

The midpoint rule, meshes and settings of fenicsx_release.py. dolfinx distributes the cells, without copies of cells of the other rank.
Factors are by MUMPS. In the last rows the iterations of saddle_point.py take their place. Each rank has one thread.
The script starts mpirun itself, for one rank as well. Two ranks need two idle cores.

Times are in seconds of the wall clock, because two ranks use two cores. They begin and end with the latest rank. (The times of
fenicsx_release.py --sizes are processor time.) Each time is the median of three runs, or of as many as begin within 10 seconds.
Columns: program, degree, refinements, unknowns, solver, ranks, seconds_factors (assembly of the tangent, and its factors or
preconditioner), seconds_step (mean of three midpoint steps of 0.0125 after four others). benchmarks/release_sizes.py --ranks has
the same columns. Q33 after these steps must agree on one and on two ranks to 1e-9, or the script ends with an error.

GetFEM is missing: Debian's python3-getfem++ 5.4.2 is built without MPI, and with the sequential MUMPS.
"""
import json
import logging
import os
import pathlib
import statistics
import subprocess
import sys
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import program  # noqa: E402

CASES = {"MUMPS": ((4, 0), (4, 1), (3, 2), (4, 2)), "iterations": ((3, 2), (4, 2))}
QUICK = {"MUMPS": ((4, 0), (4, 1)), "iterations": ((4, 1),)}
TOLERANCE, AGREEMENT = 1e-9, 1e-9  # of the steps of which Q33 is compared, and of Q33


def measure(degree, refinements, solver):
    """Prints what the ranks have measured. MPI starts with these imports, in a process that must not start mpirun."""
    from mpi4py import MPI

    from fenicsx_release import Ball
    from release import STEP_OF_SIZES, Motion, time_of_steps

    logging.disable(logging.WARNING)  # FFCx tells of each of its files
    comm = MPI.COMM_WORLD

    class MotionOnRanks(Motion):
        def change(self, dz):
            return comm.allreduce(super().change(dz), MPI.MAX)

    def clock():
        return comm.allreduce(time.monotonic(), MPI.MAX)

    ball, start, times = Ball(degree, refinements, solver, comm), clock(), []
    while len(times) < 3 and clock() - start < 10:
        motion = MotionOnRanks(ball)
        times.append(time_of_steps(motion, clock))
    exact = MotionOnRanks(ball, TOLERANCE)
    exact.factors = motion.factors
    for _ in range(motion.n_steps):
        exact.step(STEP_OF_SIZES, 0)
    unknowns, Q33 = comm.allreduce(len(ball.velocity)), 1 + comm.allreduce(ball.moment @ exact.u)
    if comm.rank == 0:
        print(json.dumps({"unknowns": unknowns, "Q33": Q33, "times": [of_run for of_run in times if of_run]}))


def run(degree, refinements, solver, ranks):
    """What measure() prints on so many ranks."""
    command = ["mpirun", "-np", str(ranks), sys.executable, __file__, "--case", str(degree), str(refinements), solver]
    process = subprocess.run(command, env={**os.environ, **program.ON_RANKS}, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
    if process.returncode:
        raise SystemExit(f"error: exit code {process.returncode} of {' '.join(command)}")
    return json.loads(process.stdout.splitlines()[-1])


def main():
    arguments = sys.argv[1:]
    if len(arguments) == 4 and arguments[0] == "--case":
        return measure(int(arguments[1]), int(arguments[2]), arguments[3])
    if arguments not in ([], ["--quick"]):
        raise SystemExit(__doc__)
    print("program,degree,refinements,unknowns,solver,ranks,seconds_factors,seconds_step", flush=True)
    for solver, meshes in (QUICK if arguments else CASES).items():
        for degree, refinements in meshes:
            results = []
            for ranks in (1, 2):
                measured = run(degree, refinements, solver, ranks)
                results.append(measured["Q33"])
                if measured["times"]:
                    seconds_factors, seconds_step, _ = (statistics.median(column) for column in zip(*measured["times"]))
                    print("FEniCSx", degree, refinements, measured["unknowns"], solver, ranks, f"{seconds_factors:.4g}",
                          f"{seconds_step:.4g}", sep=",", flush=True)
            if abs(results[1] - results[0]) > AGREEMENT:
                raise SystemExit(f"error: Q33 is {results} on one and two ranks, degree {degree} refined {refinements}, {solver}")


if __name__ == "__main__":
    main()
