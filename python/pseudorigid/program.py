"""Runs the program `pseudorigid`."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from pseudorigid.errors import Defect, Error, Stopped, WrongInput

if TYPE_CHECKING:
    from pseudorigid.results import Run

Path = str | os.PathLike[str]
Entries = Mapping[str, Any]  # "Section/Entry": value
ERRORS = {error.exit_code: error for error in (WrongInput, Stopped)}
RESULTS = "results are in "


def find_program() -> pathlib.Path:
    """The path of the program. The environment variable PSEUDORIGID comes first, then the sources or the installation of this
    package, then PATH."""
    chosen = os.environ.get("PSEUDORIGID")
    if chosen:
        return existing(pathlib.Path(chosen))
    above = pathlib.Path(__file__).resolve().parents
    for folder in (*(root / "build/release/bin" for root in above[2:3]), *(prefix / "bin" for prefix in above[4:5])):
        if (folder / "pseudorigid").is_file():
            return folder / "pseudorigid"
    found = shutil.which("pseudorigid")
    if not found:
        raise WrongInput("the program pseudorigid is not found; install it, or set the environment variable PSEUDORIGID to its path")
    return pathlib.Path(found)


def existing(program: pathlib.Path) -> pathlib.Path:
    if not program.is_file():
        raise WrongInput(f"{program} {'is a directory' if program.is_dir() else 'does not exist'}; scripts/run.sh builds the program")
    return program.resolve()


def entry_text(value: Any) -> str:
    """The text of a value in a scene. A semicolon separates the rows of a matrix, a comma its entries."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return value
    if hasattr(value, "tolist"):  # an array or a scalar of numpy
        return entry_text(value.tolist())
    rows = any(not isinstance(item, str) and (isinstance(item, Sequence) or getattr(item, "ndim", 0)) for item in value)
    return ("; " if rows else ", ").join(map(entry_text, value))


def run(scene: Path | Entries, options: Entries | None = None, *, output: Path | None = None, resume: bool = False,
        quiet: bool = True, program: Path | None = None, launcher: Sequence[str] = ()) -> "Run":
    """Runs a scene and returns its results.

    scene     a parameter file, or the entries themselves: {"Models": "reduced", "Time/End": 3}
    options   entries that replace those of the scene: {"Initial state/Deformation": np.diag([0.8, 1, 1.25])}
    output    the directory of the results; by default the scene names it
    resume    goes on from the last checkpoint in that directory
    quiet     False shows what the program prints
    program   path of the program; default: find_program()
    launcher  words before the command, such as ["mpirun", "-n", "4"]

    WrongInput, Stopped or Defect is raised if the program does not exit with code 0.
    """
    from pseudorigid.results import Run

    words = ["--output", os.fspath(output)] if output else []
    words += ["--resume"] if resume else []
    with tempfile.TemporaryDirectory() as folder:
        command = [*launcher, *command_of("run", scene, options, pathlib.Path(folder), program), *words]
        try:
            said = execute(command, quiet)
        except Stopped as stopped:
            stopped.directory = pathlib.Path(output) if output else None
            raise
    directory = output or next(line.removeprefix(RESULTS) for line in reversed(said) if line.startswith(RESULTS))
    return Run(directory)


def check(scene: Path | Entries, options: Entries | None = None, *, program: Path | None = None) -> str:
    """The lines that list the needs of the scene and the parts that are skipped. WrongInput if the scene cannot run."""
    with tempfile.TemporaryDirectory() as folder:
        return printed(command_of("check", scene, options, pathlib.Path(folder), program))


def parameters(*, program: Path | None = None) -> list[dict[str, Any]]:
    """Every entry of a scene, with default, range, unit and documentation."""
    return json.loads(printed([path_of(program), "parameters", "--format", "json"]))


def path_of(program: Path | None) -> str:
    return str(existing(pathlib.Path(program)) if program else find_program())


def command_of(subcommand: str, scene: Path | Entries, options: Entries | None, folder: pathlib.Path, program: Path | None) -> list[str]:
    """Entries alone are options of an empty scene in `folder`."""
    entries = dict(options or {})
    if isinstance(scene, Mapping):
        entries = {**scene, **entries}
        scene = folder / "scene.prm"
        scene.touch()
    sets = [word for entry, value in entries.items() for word in ("--set", f"{entry}={entry_text(value)}")]
    return [path_of(program), subcommand, os.fspath(scene), *sets]


def execute(command: Sequence[str], quiet: bool) -> list[str]:
    """The lines on standard error. Ctrl-C interrupts the program once, which then saves its state and exits with code 3."""
    with tempfile.TemporaryFile("w+") as output, started(command, output, process_group=0) as process:
        lines: list[str] = []
        try:
            lines.extend(shown(process, quiet))
        except KeyboardInterrupt:
            process.send_signal(signal.SIGINT)
            lines.extend(shown(process, quiet))
        code = process.wait()
        if not quiet:
            output.seek(0)
            print(output.read(), end="")
    if code:
        raise error_of(code, lines)
    return lines


def started(command: Sequence[str], output: Any, **options: Any) -> "subprocess.Popen[str]":
    try:
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE, text=True, **options)
    except OSError as error:
        raise WrongInput(f"{command[0]} cannot be started: {error.strerror}") from error


def shown(process: "subprocess.Popen[str]", quiet: bool) -> Iterator[str]:
    assert process.stderr
    for line in process.stderr:
        if not quiet:
            print(line, end="", file=sys.stderr)
        yield line.rstrip("\n")


def error_of(code: int, lines: Sequence[str]) -> Error:
    """The exception has the program's one sentence."""
    sentences = [line.removeprefix("error: ") for line in lines if line.startswith("error: ")]
    return ERRORS.get(code, Defect)(sentences[0] if sentences else f"the program ended with code {code} and without a message")


def printed(command: Sequence[str]) -> str:
    with started(command, subprocess.PIPE) as process:
        output, errors = process.communicate()
    if process.returncode:
        raise error_of(process.returncode, errors.splitlines())
    return output
