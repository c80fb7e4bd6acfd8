"""Damaged files. The readers are called in process by test programs (mutants_test.cpp, prm_mutants_test.cpp, and those of
io and scene); here the whole program resumes from damaged checkpoints of real runs, also from such whose checksum was
made right again, which no accident does."""
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess

from program import DONE, WRONG_INPUT, faults

from checkpoint_file import HEADER, with_right_checksum

REDUCED = {"Models": "reduced", "Initial state/Velocity": "0.1, 0, 0; 0, 0.1, 0; 0, 0, -0.2", "Time/End": 1,
           "Time/Method": "rattle", "Time/Step": 0.01, "Output/Samples": 5}
SCENES = {"reduced": REDUCED, "double_pendulum": {"System": "double pendulum", "Time/End": 1, "Output/Samples": 5},
          "continuum": {**REDUCED, "Models": "continuum", "Continuum/Degree": 2, "Time/End": 0.2}}
MESHES = "Gmsh.*:MeshFiles.*"  # the test cases of io_test that read meshes
TALLY = re.compile(r"mutants of (.*): (\d+) refused, (\d+) accepted")


def damaged(rng, data, first):
    data = bytearray(data)
    for _ in range(rng.randint(1, 3)):
        at = rng.randrange(first, len(data))
        match rng.randrange(4):
            case 0:
                data[at] ^= 1 << rng.randrange(8)
            case 1:
                data[at:at + 8] = struct.pack("<d", rng.choice((float("nan"), float("inf"), -1.0, 1e300, 0.0)))[:len(data) - at]
            case 2:
                data[at:at + 8] = (b"\xff" * 8)[:len(data) - at]
            case 3:
                del data[at:at + rng.randrange(20)]
        if len(data) <= first:
            break
    return bytes(data)


def in_process(quick):
    folder = pathlib.Path(os.environ["PSEUDORIGID_TESTS"])
    number = "1000" if quick else "10000"
    for name, test in (("stress_mutants_test", "Mutants*"), ("stress_prm_mutants_test", "Mutants*"),
                       ("io_checkpoint_test", "*"), ("io_test", MESHES), ("scene_oracle_test", "*")):
        if not (folder / name).exists():
            continue
        result = subprocess.run([folder / name, f"--gtest_filter={test}"], capture_output=True, text=True, timeout=3000,
                                env={**os.environ, "PSEUDORIGID_MUTANTS": number}, errors="replace")
        found = "" if result.returncode == 0 else (result.stdout + result.stderr)[-500:]
        for of, refused, accepted in TALLY.findall(result.stdout):
            yield {"kind": f"mutants of {of}", "runs": int(refused), "code": WRONG_INPUT, "faults": found}
            yield {"kind": f"mutants of {of}", "runs": int(accepted), "code": DONE, "faults": ""}
        if found or not TALLY.search(result.stdout):
            yield {"kind": f"{name} {test}".removesuffix(" *"), "code": result.returncode, "faults": found}


def resumed(program, number, rng, with_continuum):
    """A checkpoint damaged as accidents do is refused. A forged one may be taken for true; whatever it says, the program
    ends as it always does."""
    for model, entries in SCENES.items():
        if model == "continuum" and not with_continuum:
            continue
        whole = program.run(entries, model)
        good = (whole.folder / f"checkpoint-{model}.bin").read_bytes()
        for i in range(number):
            for kind, first in (("damaged", 0), ("forged", HEADER)):
                mutant = damaged(rng, good, first)
                mutant = with_right_checksum(mutant) if kind == "forged" else mutant
                folder = program.scratch / f"{model}-mutant"
                shutil.rmtree(folder, ignore_errors=True)
                shutil.copytree(whole.folder, folder)
                (folder / f"checkpoint-{model}.bin").write_bytes(mutant)
                run = program.call("run", f"{model}.prm", "--output", folder.name, "--resume", folder=folder, limit=30)
                found = faults(run, resumed=kind == "forged" or mutant == good)
                if run.code == WRONG_INPUT:
                    one = re.search(r"^error: [^\n]{15,}\n\Z", run.stderr, re.M)
                    found = [] if one else [f"exit code 2 without one sentence: {run.stderr[-300:]!r}"]
                elif kind == "damaged" and mutant != good:
                    found.append(f"exit code {run.code} after a damaged checkpoint")
                yield {"kind": f"--resume from a {kind} checkpoint, {model}", "name": i, "code": run.code,
                       "too_long": bool(run.too_long), "faults": "; ".join(found)}


def run(program, seed, quick, with_continuum=True, **_):
    records = [] if quick else [*in_process(quick)]
    return records + [*resumed(program, 10 if quick else 100, random.Random(seed), with_continuum)]
