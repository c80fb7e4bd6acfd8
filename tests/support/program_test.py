"""The base of the end-to-end tests: runs the executable under test in a scratch folder of its own.

The executable's path is in the environment variable PSEUDORIGID; ctest sets it. By hand:
    export PYTHONPATH=tests/support:python
    PSEUDORIGID=build/release/bin/pseudorigid /usr/bin/python3 tests/app/bad_input_test.py -v
"""
import csv
import functools
import json
import math
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PATIENCE = float(os.environ.get("PSEUDORIGID_PATIENCE", 1))  # a factor to limits of time, for slow builds
TIME_LIMIT = 120 * PATIENCE  # of one run, only so that a hanging test ends

DONE, DEFECT, WRONG_INPUT, STOPPED = 0, 1, 2, 3

BODY_COLUMNS = (
    "time,Q11,Q12,Q13,Q21,Q22,Q23,Q31,Q32,Q33,"
    "Qdot11,Qdot12,Qdot13,Qdot21,Qdot22,Qdot23,Qdot31,Qdot32,Qdot33,x1,x2,x3,v1,v2,v3,"
    "kinetic,elastic,gravitational,external,dissipated,energy,J1,J2,J3,Z1,Z2,Z3,volume_ratio,multiplier,a1,a2,a3"
).split(",")
CONTINUUM_COLUMNS = BODY_COLUMNS + (
    "F11,F12,F13,F21,F22,F23,F31,F32,F33,nonaffine_kinetic_fraction,nonaffine_displacement,min_jacobian,volume_error,max_volume_error"
).split(",")


def scene_text(entries):
    """A parameter file: {"Time/End": 3, "Models": "reduced"} → its lines, one subsection an entry."""
    lines = []
    for path, value in entries.items():
        *section, name = path.split("/")
        lines += [f"subsection {s}" for s in section] + [f"set {name} = {value}"] + ["end" for _ in section]
    return "\n".join(lines) + "\n"


@functools.cache
def words(entry):
    """The words that an entry takes, by the program's own list of parameters: words("Material/Law")."""
    page = subprocess.run([os.environ["PSEUDORIGID"], "parameters", "--format", "json"], check=True, capture_output=True)
    (found,) = [about["words"] for about in json.loads(page.stdout) if about["entry"] == entry]
    return tuple(found)


def methods():
    """All methods, by the table of the program."""
    return tuple(name for name in words("Time/Method") if name != "auto")


def matrix(*diagonal):
    """A diagonal matrix as an entry of a scene."""
    return "; ".join(", ".join(str(diagonal[i] if i == j else 0) for j in range(3)) for i in range(3))


def overrides(entries):
    """The same as options of the command line."""
    return [word for path, value in entries.items() for word in ("--set", f"{path}={value}")]


def without_free_space(text):
    """Lines of `check` and of the log, without the room on the disk, which changes."""
    return re.sub(r"; [\d.]+ [kMG]B are free for .*", "", text)


class Table:
    """A CSV file of the program."""

    def __init__(self, path):
        with open(path, newline="") as file:
            header, *rows = list(csv.reader(file))
        self.header = header
        self.rows = [[float(x) for x in row] for row in rows]
        if any(len(row) != len(header) for row in self.rows):
            raise AssertionError(f"{path} has rows of different length")

    def __len__(self):
        return len(self.rows)

    def column(self, name):
        index = self.header.index(name)
        return [row[index] for row in self.rows]

    def is_finite(self):
        return all(math.isfinite(x) for row in self.rows for x in row)


def largest_difference(a, b, floor=1e-3):
    """Of two tables: the largest difference relative to the largest value of the column's quantity (all entries of Q, of
    J …, since an entry that is zero but for round-off has no scale of its own). `floor` is the least such value, for
    quantities like the centre of mass that are round-off altogether."""
    if a.header != b.header or len(a) != len(b):
        raise AssertionError(f"different tables: {len(a)} and {len(b)} rows, {a.header} and {b.header}")
    quantity = [name.rstrip("123") for name in a.header]
    scale = {"volume_error": 1, "max_volume_error": 1}  # errors of ln det F are those of det F, about 1
    for j, name in enumerate(quantity):
        scale[name] = max([scale.get(name, floor)] + [abs(row[j]) for row in a.rows])
    return max((abs(x - y) / scale[name] for r, s in zip(a.rows, b.rows) for name, x, y in zip(quantity, r, s)),
               default=0.0)


class ProgramTest(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.program = pathlib.Path(os.environ["PSEUDORIGID"]).resolve()
        self.scratch = pathlib.Path(tempfile.mkdtemp(prefix="pseudorigid-test-"))
        self.addCleanup(shutil.rmtree, self.scratch, ignore_errors=True)

    # Running.

    def scene(self, entries, name="scene.prm"):
        """Writes a parameter file (entries or text) into the scratch folder; its name."""
        text = entries if isinstance(entries, str) else scene_text(entries)
        (self.scratch / name).write_text(text)
        return name

    def command(self, arguments):
        return [str(self.program), *map(str, arguments)]

    def run_program(self, *arguments, **options):
        """The finished process; its stdout and stderr as text."""
        options = {"capture_output": True, "text": True, "timeout": TIME_LIMIT, "cwd": self.scratch, **options}
        return subprocess.run(self.command(arguments), stdin=subprocess.DEVNULL, **options)

    def start_program(self, *arguments, **options):
        options = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": self.scratch, **options}
        process = subprocess.Popen(self.command(arguments), stdin=subprocess.DEVNULL, **options)
        self.addCleanup(self.end_process, process)
        return process

    @staticmethod
    def end_process(process):
        if process.poll() is None:
            process.kill()
        process.wait()
        for stream in (process.stdout, process.stderr):
            if stream:
                stream.close()

    def run_done(self, *arguments, **options):
        result = self.run_program(*arguments, **options)
        self.assertEqual(result.returncode, DONE, result.stderr)
        return result

    def terminal_output(self, *arguments):
        """Of a run whose stderr is a terminal."""
        ours, theirs = pty.openpty()
        process = self.start_program(*arguments, stderr=theirs)
        os.close(theirs)
        text = b""
        try:
            while part := os.read(ours, 4096):
                text += part
        except OSError:  # the other side is closed
            pass
        os.close(ours)
        self.assertEqual(process.wait(), 0)
        return text.decode()

    def wait_until(self, condition, what, seconds=TIME_LIMIT):
        deadline = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), deadline, f"waited in vain until {what}")
            time.sleep(0.002)

    def skip_if_sanitized(self):
        program = self.program.read_bytes()
        if b"__asan_init" in program or b"__tsan_init" in program:
            self.skipTest("sanitizers need memory and addresses of their own")

    # Looking at results.

    def table(self, *path):
        return Table(self.scratch.joinpath(*path))

    def json(self, *path):
        return json.loads(self.scratch.joinpath(*path).read_text())

    def bytes(self, *path):
        return self.scratch.joinpath(*path).read_bytes()

    def files(self, folder="."):
        """Every file and folder below, as relative names."""
        top = self.scratch / folder
        return sorted(str(path.relative_to(top)) for path in top.rglob("*"))

    def pvd(self, path):
        """[(time, file)] of a collection."""
        text = self.scratch.joinpath(path).read_text()
        return [(float(t), file) for t, file in re.findall(r'timestep="([^"]*)" part="0" file="([^"]*)"', text)]

    def assert_exit(self, result, code):
        self.assertEqual(result.returncode, code, f"stdout: {result.stdout}\nstderr: {result.stderr}")

    def assert_one_sentence(self, result, *fragments):
        """Exit code 2, nothing on stdout, one line of stderr with the fragments in it."""
        self.assert_exit(result, WRONG_INPUT)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"\Aerror: [^\n]+\n\Z")
        for fragment in fragments:
            self.assertIn(fragment, result.stderr)


def main():
    unittest.main(verbosity=2)
