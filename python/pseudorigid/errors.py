"""The exit codes of `pseudorigid` as exceptions. The text of each is one sentence."""

import contextlib
import pathlib
import sys
from collections.abc import Callable, Iterator


class Error(Exception):
    """Every error of this package."""

    exit_code = 1


class WrongInput(Error):
    """The user can mend the cause: a scene, an option, a missing file or package."""

    exit_code = 2


class Stopped(Error):
    """The run could not go on or was interrupted. Its last good state is saved, and run(…, resume=True) goes on from there."""

    exit_code = 3

    def __init__(self, message: str, directory: pathlib.Path | None = None):
        super().__init__(message)
        self.directory = directory  #: of the results until then, if it was given


class Defect(Error):
    """The program has failed by a fault of its own."""


@contextlib.contextmanager
def needs(packages: str) -> Iterator[None]:
    """Around `import`: a missing module is a WrongInput that names Debian's packages."""
    try:
        yield
    except ImportError as error:
        raise WrongInput(f"{error}; this needs Debian's {packages}, and to run with /usr/bin/python3") from error


def exit_code_of(main: Callable[[], None]) -> int:
    """Of `main` as a program: an Error is one sentence on standard error."""
    try:
        main()
    except Error as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code
    return 0
