"""Sweeps that SIGINT, SIGTERM or SIGKILL end at a random moment, up to three times. Resumed, they leave the same bytes of sweep.csv
as a sweep that was not disturbed."""
import shutil
import signal
import subprocess

from program import DONE, PATIENCE, STOPPED, faults

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)
RELEASE = {"Initial state/Deformation": "$(1/sqrt(l)), 0, 0; 0, $(1/sqrt(l)), 0; 0, 0, $(l)", "Time/Tolerance": 1e-4}
COMPARED = {**RELEASE, "Output/Samples": 60, "Output/Quantities": "state, energies, stresses", "Time/End": 6}
SWEEPS = {
    "elements compared": {**COMPARED, "Models": "reduced, polynomial, continuum", "Polynomial/Degree": 3, "Continuum/Degree": 3,
                          "Sweep/Parameters": "l: 1.02 .. 1.2 in 9"},
    "polynomial bodies compared": {**COMPARED, "Models": "reduced, polynomial", "Polynomial/Degree": "1, 3, 4",
                                   "Sweep/Parameters": "l: 1.02 .. 1.3 in 17"},
    "in lanes": {**RELEASE, "Models": "reduced", "Sweep/Parameters": "l: 1.02 .. 1.4 in 1003", "Time/End": 100, "Output/Samples": 500},
    "runs alone": {**RELEASE, "Models": "reduced", "Sweep/Parameters": "l: 1.02 .. 1.4 in 203", "Time/End": 100, "Output/Samples": 500,
                   "Material/Viscosity": 0.01, "Sweep/Trajectories": "true"},
    "modes": {"Analysis": "modes", "Models": "reduced, polynomial, continuum", "Polynomial/Degree": 3, "Continuum/Degree": 3,
              "Gravity/Gamma": "$(g)", "Sweep/Parameters": "g: 0 .. 10 in 11"},
}


def end_early(program, rng, seconds, *arguments):
    """Runs the program, and ends it after `seconds`. Returns its exit code, or minus the number of the signal."""
    process = subprocess.Popen(program.command(*arguments), cwd=program.scratch, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        process.send_signal(rng.choice(SIGNALS))
    return process.wait(30 * PATIENCE)


def resume(folder):
    """A sweep that ended before its first checkpoint begins anew."""
    return ["--resume"] if (folder / "checkpoint-sweep.bin").exists() else []


def faults_after_interruptions(program, rng, whole):
    folder = program.scratch / "parts"
    arguments = "run", "whole.prm", "--output", "parts"
    shutil.rmtree(folder, ignore_errors=True)
    for _ in range(rng.randint(1, 3)):
        code = end_early(program, rng, rng.uniform(0, whole.seconds), *arguments, *resume(folder))
        if code not in (DONE, STOPPED, *(-number for number in SIGNALS)):
            return [f"ended early with exit code {code}"]
    run = program.call(*arguments, *resume(folder), folder=folder)
    if run.code != DONE:
        return [f"resumed, exit code {run.code}: {run.stderr.strip()[-300:]}"]
    return faults(run) + [f"{path.name} is another" for path in whole.files(".csv") if (folder / path.name).read_bytes() != path.read_bytes()]


def interrupted_sweeps(program, rng, number, with_continuum):
    for kind, entries in SWEEPS.items():
        if "continuum" in entries["Models"] and not with_continuum:
            continue
        whole = program.run(entries, "whole")
        for _ in range(number):
            found = faults_after_interruptions(program, rng, whole) if whole.code == DONE else [f"exit code {whole.code}: {whole.stderr}"]
            yield {"kind": f"sweep, {kind}", "code": whole.code, "faults": "; ".join(found)}
