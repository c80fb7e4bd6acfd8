"""What the tools read from a run directory of pseudorigid."""

import csv
import json
import pathlib
import sys
import xml.etree.ElementTree


def fail(message):
    """The user can mend it: one sentence, exit code 2, as pseudorigid does."""
    print(f"error: {message}", file=sys.stderr)
    raise SystemExit(2)


def existing(directory, name, remedy):
    path = pathlib.Path(directory) / name
    if not path.is_file():
        fail(f"{path} does not exist; {remedy}")
    return path


def read_csv(path):
    """Columns by name, as lists of numbers."""
    with open(path, newline="") as file:
        rows = csv.reader(file)
        names = next(rows, [])
        values = [[float(text) for text in row] for row in rows]
    if not values:
        fail(f"{path} holds no samples")
    return dict(zip(names, map(list, zip(*values))))


def read_pvd(path):
    """[(time, path of the .vtu)] in the order of time."""
    sets = xml.etree.ElementTree.parse(path).getroot().iter("DataSet")
    return [(float(s.get("timestep")), path.parent / s.get("file")) for s in sets]


def read_manifest(directory):
    return json.loads(existing(directory, "manifest.json", "is this the directory of a run?").read_text())


def entry(directory, path):
    """The value that an entry had in the run: entry(directory, "Body/Radius")."""
    values = read_manifest(directory).get("entries", {})
    if path not in values:
        fail(f"{directory}/manifest.json has no value of {path}; run the scene again")
    return values[path]
