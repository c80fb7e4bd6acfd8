"""Runs of pseudorigid for the benchmarks: results, manifest, and what the process took of the machine."""
import csv
import dataclasses
import json
import os
import pathlib
import subprocess
import tempfile
import time


@dataclasses.dataclass
class Run:
    manifest: dict
    wall: float  # seconds from start to end of the process
    cpu: float  # seconds, user and system, of the process
    folder: pathlib.Path

    @property
    def megabytes(self):
        """Largest resident set; not that of wait4, which counts what a forked child holds before it is the program."""
        return self.manifest["peak_memory_bytes"] / 1e6

    def table(self, name):
        """Columns of a CSV file by name."""
        with open(self.folder / name, newline="") as file:
            header, *rows = csv.reader(file)
        return dict(zip(header, ([float(x) for x in column] for column in zip(*rows))))


# Environment of processes under mpirun. Each has one thread, and Open MPI also starts them for root.
ON_RANKS = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OMPI_ALLOW_RUN_AS_ROOT",
                                   "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")}


def run(program, scene, folder, entries=(), environment=(), launcher=()):
    """Runs a scene with entries {"Section/Entry": value} changed; a failed run ends the benchmark with its message."""
    changes = [f"--set={p}={v}" for p, v in dict(entries).items()]
    command = [*launcher, program, "run", scene, "--quiet", "--output", folder, *changes]
    start = time.monotonic()
    process = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL,
                               env={**os.environ, **dict(environment)})
    _, status, used = os.wait4(process.pid, 0)
    wall = time.monotonic() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"error: exit code {process.returncode} of {' '.join(map(str, command))}")
    folder = pathlib.Path(folder)
    return Run(read_manifest(folder), wall, used.ru_utime + used.ru_stime, folder)


def read_manifest(folder):
    return json.loads((pathlib.Path(folder) / "manifest.json").read_text())


SMALLEST = {"Models": "continuum", "Body/Incompressible": "false", "Material/Lame lambda": 1, "Continuum/Degree": 1,
            "Continuum/Refinements": 0, "Time/End": 0.1, "Time/Step": 0.1, "Time/Method": "rattle",
            "Output/Samples": 1, "Output/Report": "false", "Continuum/Error estimate": "none"}


def start_up(executable):
    """Processor time of a process that opens the finite elements and does next to nothing with them."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "smallest.prm"
        scene.write_text("")
        return run(executable, scene, pathlib.Path(folder) / "out", SMALLEST).cpu
