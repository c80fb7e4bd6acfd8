"""Runs that end before their time. The tests of tests/app/stopped_*_test.py (Ctrl-C, SIGTERM, SIGKILL at random moments, a
limit of file sizes; resumed, the run ends like an uninterrupted one) are repeated with new random moments; sweeps are ended
(interrupted_sweeps.py); and a disk of 1 MB, where the system lets us mount one, fills up at random places."""
import os
import pathlib
import random
import subprocess
import sys
import unittest

from interrupted_sweeps import interrupted_sweeps
from program import DONE, STOPPED, faults, largest_difference

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))
from program_test import ProgramTest  # noqa: E402

KINDS = ("control_c", "kill", "full_disk", "another_method", "far_too_large_step", "velocity_that_no_mesh_stands")
REDUCED = {"Models": "reduced", "Initial state/Velocity": "0.1, 0.3, 0; -0.2, 0.1, 0; 0, 0, -0.2", "Time/End": 50,
           "Time/Method": "rattle-4", "Time/Step": 0.01, "Output/Samples": 2000, "Output/Graphics": "vtu", "Output/Frames": 5}
POLYNOMIAL = {**REDUCED, "Models": "polynomial", "Polynomial/Degree": 3, "Time/End": 10, "Time/Step": 0.02}
CONTINUUM = {"Models": "continuum", "Initial state/Velocity": "0.1, 0, 0; 0, 0.1, 0; 0, 0, -0.2", "Time/End": 2,
             "Continuum/Degree": 2, "Time/Method": "rattle", "Time/Step": 0.01, "Output/Samples": 200,
             "Output/Graphics": "vtu", "Output/Frames": 3}


class Counted(unittest.TestResult):
    """Counts processes that were started to be ended, beside what unittest counts."""
    def __init__(self):
        super().__init__()
        self.n_started = 0


def repeated_tests(rounds, with_continuum):
    modules = ["stopped_systems_test"] + (["stopped_run_test"] if with_continuum else [])
    start = ProgramTest.start_program
    for name in modules:
        suite = unittest.defaultTestLoader.loadTestsFromName(name)
        for test in (test for group in suite for test in group):
            method = test._testMethodName
            if name == "stopped_run_test" and not any(kind in method for kind in KINDS):
                continue
            for _ in range(rounds):
                result = Counted()

                def counting(self, *arguments, **options):
                    result.n_started += 1
                    return start(self, *arguments, **options)
                ProgramTest.start_program = counting
                with open(os.devnull, "w") as silence:
                    stdout, sys.stdout = sys.stdout, silence
                    try:
                        type(test)(method).run(result)
                    finally:
                        sys.stdout = stdout
                        ProgramTest.start_program = start
                wrong = [text.strip().splitlines()[-1] for _, text in result.failures + result.errors]
                yield {"kind": f"{name}: {method.removeprefix('test_')}", "code": DONE, "faults": "; ".join(wrong),
                       "runs": max(1, result.n_started)}


class SmallDisk:
    """A file system of its own in memory, unmounted at the end. `mounted` is false where that is not allowed."""

    def __init__(self, place, size):
        place.mkdir(parents=True)
        self.place = place
        self.mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", place],
                                      capture_output=True).returncode == 0

    def __enter__(self):
        return self

    def grow(self):
        subprocess.run(["mount", "-o", "remount,size=100m", self.place], check=True)

    def __exit__(self, *_):
        if self.mounted:
            subprocess.run(["umount", self.place], check=True)


def full_disks(program, rng, number, with_continuum):
    scenes = {"reduced": REDUCED, "polynomial": POLYNOMIAL, **({"continuum": CONTINUUM} if with_continuum else {})}
    for model, entries in scenes.items():
        whole = program.run(entries, "whole")
        total = sum(path.stat().st_size for path in whole.files(".csv") + whole.files(".vtu"))
        for i in range(number):
            size = rng.randint(8, max(9, total // 1000 - 40))
            with SmallDisk(program.scratch / f"disk-{model}-{i}", size) as disk:
                if not disk.mounted:
                    return
                folder = disk.place / "results"
                run = program.call("run", "whole.prm", "--output", folder, folder=folder)
                found = faults_of_full_disk(run) or after_more_space(program, disk, folder, model, whole)
            yield {"kind": f"full disk (tmpfs), {model}", "name": f"{size} kB", "code": run.code, "faults": "; ".join(found)}


def faults_of_full_disk(run):
    if run.code != STOPPED or "No space left on device" not in run.stderr:
        return [f"exit code {run.code}: {run.stderr.strip()[-300:]}"]
    return []


def after_more_space(program, disk, folder, model, whole):
    """Taken up again where there is a checkpoint, begun anew where there is none yet, the run gives the results of one that
    was not disturbed: reduced and polynomial models to the last bit, and a continuum, which does not save its caches, to 1e-11."""
    disk.grow()
    resume = ["--resume"] if (folder / f"checkpoint-{model}.bin").exists() else []
    run = program.call("run", "whole.prm", "--output", folder, *resume, folder=folder)
    found = faults(run)
    if run.code != DONE:
        return found or [f"resumed, exit code {run.code}: {run.stderr.strip()[-300:]}"]
    if model == "continuum":
        difference = largest_difference(run.table(model), whole.table(model))
        return found + ([] if difference < 1e-11 else [f"{model}.csv differs by {difference}"])
    return found + [f"{path.name} is another" for path in whole.files(".csv") + whole.files(".vtu")
                    if next(folder.rglob(path.name)).read_bytes() != path.read_bytes()]


def run(program, seed, quick, with_continuum=True, **_):
    records = [*full_disks(program, random.Random(seed), 2 if quick else 25, with_continuum)]
    if not quick:
        records += interrupted_sweeps(program, random.Random(seed), 10, with_continuum)
    return records + ([] if quick else [*repeated_tests(5, with_continuum)])
