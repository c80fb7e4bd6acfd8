"""Runs scenes of the program `pseudorigid` and reads their results.

    import pseudorigid

    run = pseudorigid.run("params/quickstart.prm", {"Time/End": 7})    # or Run("output/quickstart")
    run.table("reduced")["a1"]                                          a column of a pandas table
    run.unit("reduced", "J1")                                           'mass*length^2/time'
    run.comparison["summary"]                                           the differences in words
    run.frames("continuum")[-1].read().fields["cauchy_stress"]          of shape (points, 3, 3)

`python3 -m pseudorigid` lists the commands that draw. docs/python.md shows the package at work.
"""

import importlib
from typing import TYPE_CHECKING, Any

from pseudorigid.errors import Defect, Error, Stopped, WrongInput

if TYPE_CHECKING:
    from pseudorigid.frames import Frame, Picture
    from pseudorigid.program import check, find_program, parameters, run
    from pseudorigid.results import Run, printed_error

__version__ = "0.2.0"
__all__ = ["Defect", "Error", "Frame", "Picture", "Run", "Stopped", "WrongInput", "check", "find_program", "parameters", "printed_error",
           "run"]

_MODULES = {"frames": ("Frame", "Picture"), "program": ("check", "find_program", "parameters", "run"),
            "results": ("Run", "printed_error")}


def __getattr__(name: str) -> Any:
    """Modules are imported when they are used, so that the commands can name a package that is missing in one sentence."""
    for module, names in _MODULES.items():
        if name in names:
            return getattr(importlib.import_module(f"pseudorigid.{module}"), name)
    raise AttributeError(f"module 'pseudorigid' has no attribute {name!r}")
