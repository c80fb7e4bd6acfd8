"""Puts the Python package of these sources on the path: the scripts of this folder import it before `pseudorigid`."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
