#!/usr/bin/python3
"""What a step of the continuum on several ranks takes, and what it sends.

    benchmarks/scaling.py build/release/bin/pseudorigid [--quick] > scaling.csv

Release with the velocity 0.3 (x, y, −2z), k = 4, fixed steps of symmetric-4 that meet the constraint to 1e-8. More ranks
than cores have the counts of a larger machine, and no times that mean anything. Columns: ranks, cores (of this machine),
unknowns, steps (with those of the start), seconds (of a step), messages, bytes (of one rank in a step, mean), reductions
and gram_iterations (in a step).
"""
import argparse
import os
import pathlib
import subprocess
import tempfile

import program
from ball_release import SCENE

ENTRIES = {"Continuum/Degree": 4, "Time/Method": "symmetric-4", "Time/Step": 0.002, "Time/Constraint tolerance": 1e-8,
           "Time/End": 0.1, "Output/Samples": 1}
CASES = [(ranks, refinements) for refinements in (1, 2) for ranks in (1, 2, 4)]


def run(executable, folder, ranks, refinements):
    scene = pathlib.Path(folder) / "release.prm"
    scene.write_text(SCENE)
    changes = [f"--set={path}={value}" for path, value in {**ENTRIES, "Continuum/Refinements": refinements}.items()]
    out = pathlib.Path(folder) / f"out-{ranks}-{refinements}"
    launcher = ["mpirun", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
    subprocess.run([*launcher, executable, "run", scene, "--quiet", "--output", out, *changes], check=True)
    model = program.read_manifest(out)["models"]["continuum"]
    c, steps = model["counters"], model["counters"]["substeps"]
    print(ranks, os.cpu_count(), int(c["unknowns"]), int(steps), f"{model['timers']['run'] / steps:.4g}",
          *(f"{c.get(name, 0) / steps:.4g}" for name in ("messages_of_a_rank", "message_bytes_of_a_rank", "reductions",
                                                         "gram_iterations")), sep=",", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    print("ranks,cores,unknowns,steps,seconds,messages,bytes,reductions,gram_iterations")
    with tempfile.TemporaryDirectory() as folder:
        for ranks, refinements in CASES[:2] if arguments.quick else CASES:
            run(arguments.program.resolve(), folder, ranks, refinements)


if __name__ == "__main__":
    main()
