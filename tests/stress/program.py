"""Runs the program on a scene and judges what it left: how it ended, what it said, what is in its files.

A run is sound if it ends with exit code 0, 2 or 3; if no file of results holds a number that is not one; if with code 2
it said one sentence and wrote nothing; and if with code 3 it said when and why, and left a checkpoint from which a run
with a smaller step starts and gets at least as far. A run beyond its time is interrupted and must obey.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import time

import meshio
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from program_test import (DONE, PATIENCE, STOPPED, Table, WRONG_INPUT, largest_difference, methods,  # noqa: E402, F401
                          overrides, scene_text, words)

SECONDS_TO_OBEY = 30 * PATIENCE
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
       "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_mpi_yield_when_idle": "1"}
STOPPED_AT = re.compile(r"stopped at t = ([-+0-9.e]+): (.*?)(?:; the state at t = ([-+0-9.e]+)(?:, the last sample,)? is saved"
                        r"(, least det F = [0-9.e+-]+ at X/r = \(.*?\))?)?(?: \(--resume|$)", re.M)


class Run:
    """What came of one call of the program."""

    def __init__(self, folder, code, seconds, stdout, stderr, too_long, ranks):
        self.folder, self.seconds, self.ranks = folder, seconds, ranks
        self.stdout, self.stderr, self.too_long = stdout, stderr, too_long
        # An interrupted mpirun ends with a code of its own, even if its program has just come to the end.
        of_mpirun = too_long and ranks > 1 and code > 0
        self.code = code if not of_mpirun else DONE if self.manifest()["state"] == "done" else STOPPED

    def stop(self):
        """(time, reason) of a run that could not go on."""
        found = STOPPED_AT.search(self.stderr)
        return (float(found[1]), found[2]) if found else None

    def files(self, suffix):
        return sorted(self.folder.rglob(f"*{suffix}"))

    def table(self, model):
        return Table(self.folder / f"{model}.csv")

    def manifest(self):
        return json.loads((self.folder / "manifest.json").read_text())


class Program:
    def __init__(self, scratch, executable=None):
        self.executable = pathlib.Path(executable or os.environ["PSEUDORIGID"]).resolve()
        self.scratch = pathlib.Path(scratch)
        self.scratch.mkdir(parents=True, exist_ok=True)

    def command(self, *arguments, ranks=1):
        launcher = [] if ranks == 1 else ["mpirun", "--oversubscribe", "--bind-to", "none", "--quiet", "-np", str(ranks)]
        return [*launcher, str(self.executable), *map(str, arguments)]

    def version(self):
        """Its name, version and commit."""
        return subprocess.run([self.executable, "--version"], capture_output=True, text=True, check=True).stdout.strip()

    def call(self, *arguments, folder, limit=60, ranks=1, **options):
        """Runs; beyond `limit` seconds, times PATIENCE, it is interrupted, and killed if it does not obey."""
        start, too_long = time.monotonic(), False
        process = subprocess.Popen(self.command(*arguments, ranks=ranks), stdin=subprocess.DEVNULL, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=self.scratch,
                                   env={**os.environ, **MPI}, errors="replace", **options)
        try:
            stdout, stderr = process.communicate(timeout=limit * PATIENCE)
        except subprocess.TimeoutExpired:
            too_long = True
            process.send_signal(signal.SIGINT)
            try:
                stdout, stderr = process.communicate(timeout=SECONDS_TO_OBEY)
            except subprocess.TimeoutExpired:
                process.kill()
                stdout, stderr = process.communicate()
                too_long = "hangs"
        return Run(folder, process.returncode, time.monotonic() - start, stdout, stderr, too_long, ranks)

    def run(self, entries, name="scene", changes={}, resume=False, **options):
        """Of a scene given by its entries; the results are in a folder of its name, which is made anew."""
        folder = self.scratch / name
        if not resume:
            shutil.rmtree(folder, ignore_errors=True)
            (self.scratch / f"{name}.prm").write_text(scene_text(entries))
        return self.call("run", f"{name}.prm", "--output", name, *(["--resume"] if resume else []), *overrides(changes),
                         folder=folder, **options)


# What is wrong with a run: a list of sentences, empty if it is sound.

def faults_of_numbers(run):
    faults = []
    for path in run.files(".csv"):
        try:
            if not Table(path).is_finite():
                faults.append(f"{path.name} holds a number that is not finite")
        except (AssertionError, ValueError) as error:
            faults.append(f"{path.name} is no table: {error}")
    for path in run.files(".json"):
        try:
            json.loads(path.read_text(), parse_constant=lambda word: faults.append(f"{path.name} holds {word}"))
        except ValueError as error:
            faults.append(f"{path.name} is not JSON: {error}")
    faults += [f"{path.name} holds a number that is not finite" for path in run.files(".vtu") if not vtu_is_finite(path)]
    return faults


def vtu_is_finite(path):
    mesh = meshio.read(path)
    return all(np.isfinite(values).all() for values in (mesh.points, *mesh.point_data.values()))


def faults_of_end(run):
    if run.too_long == "hangs":
        return [f"it went on {SECONDS_TO_OBEY} s after an interruption"]
    if run.code < 0:
        return [f"it died of signal {-run.code}"]
    if run.code not in (DONE, WRONG_INPUT, STOPPED):
        return [f"exit code {run.code}: {run.stderr.strip()[-300:]}"]
    return []


def faults_of_refusal(run):
    faults = []
    if not re.fullmatch(r"error: [^\n]{15,}\n", run.stderr):
        faults.append(f"exit code 2 without one sentence: {run.stderr[:300]!r}")
    if run.folder.exists():
        faults.append("exit code 2, and something was written")
    return faults


def found_nothing(run):
    """A search for equilibria has no time at which it stops. A start that does not exist leaves nothing to resume."""
    return any(sentence in run.stderr for sentence in ("no equilibrium at rest was found", "the family has no member in this range",
                                                       "stopped at t = 0: Initial state/", "stopped at t = 0: Continuum/Symmetry"))


def faults_of_stop(run):
    """Of a run that could not go on, without trying to."""
    if run.too_long:
        # mpirun kills ranks that take more than some seconds to end, as they may while a step is sought.
        allowed = ("interrupted",) if run.ranks == 1 else ("interrupted", "running")
        state = run.manifest()["state"]
        return [] if state in allowed else [f"interrupted, its manifest says {state}"]
    if found_nothing(run):
        return [] if run.manifest()["state"] == "failed" else ["nothing was found, and the manifest does not say failed"]
    stop = run.stop()
    if not stop or len(stop[1]) < 15 or "nan" in stop[1].replace("det F = nan", ""):
        return [f"exit code 3 without time and reason: {run.stderr.strip()[-300:]!r}"]
    _, _, saved, place = STOPPED_AT.search(run.stderr).groups()
    if saved and not place and "continuum stopped" in run.stderr:
        return [f"the ball's stop has no place: {run.stderr.strip()[-300:]!r}"]
    faults = [] if run.manifest()["state"] == "failed" else ["exit code 3, and the manifest does not say failed"]
    return faults if run.files(".bin") else faults + ["exit code 3 without a checkpoint"]


def faults(run, resumed=False):
    found = faults_of_end(run)
    if found:
        return found
    if run.code == WRONG_INPUT:
        return [f"the checkpoint cannot be used: {run.stderr.strip()}"] if resumed else faults_of_refusal(run)
    return faults_of_numbers(run) + (faults_of_stop(run) if run.code == STOPPED else [])


def last_time(run):
    """Of the rows of all models, the one that got least far."""
    return min((Table(path).rows[-1][0] for path in run.files(".csv") if path.stem != "comparison" and len(Table(path))),
               default=0.0)


def faults_of_resume(program, run, name="scene", **options):
    """A run that could not go on, taken up with a smaller step: (faults, resumed run)."""
    before, at = last_time(run), run.stop()[0]
    counters = next((m["counters"] for m in reversed(run.manifest()["models"].values()) if "step" in m["counters"]), {})
    step = (counters.get("step") or 1e-3) / 4  # 0: it stopped before one was chosen
    again = program.run(None, name, resume=True, changes={"Time/Step": repr(step)}, **options)
    found = faults(again, resumed=True)
    if not found and again.code == STOPPED and not again.too_long and last_time(again) < before:
        found.append(f"resumed, it got to t = {last_time(again)}, before {before}")
    return [f"after --resume: {fault}" for fault in found], again


def reason_without_numbers(text):
    text = re.sub(r"[-+]?[0-9]+(?:\.[0-9]*)?(?:e[-+]?[0-9]+)?|-?nan|-?inf", "#", text)
    return textwrap.shorten(text, 110, placeholder=" …")
