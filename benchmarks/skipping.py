#!/usr/bin/python3
"""What every scene of params/ skips, and what it would have cost.

    benchmarks/skipping.py build/release/bin/pseudorigid [--quick] [SCENE.prm …] > skipping.csv

`pseudorigid check` says what a scene skips. The scene is run as it is and, for each skipped part, with that part asked
for (PARTS below): three runs each, or as many as 5 seconds hold, medians; --quick takes four scenes and one run. Where
finite elements are on either side both runs are shortened to t ≤ 1 with 20 samples. Parts that the program cannot do
for the scene have a reason and no numbers. tests/app/skipping_test.py shows that results do not change.

Columns: scene, part, seconds and seconds_with (processor time of the process, start-up included), megabytes and
megabytes_with (largest resident set), work and work_with (of the continuum unknowns × forces, else forces, by the
manifest's counters), refused (what the program says).
"""
import argparse
import csv
import dataclasses
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import program

SCENES = pathlib.Path(__file__).resolve().parents[1] / "params"
QUICK = ("reduced_only", "quickstart", "tide", "modes")
ZERO = 1e-300  # a part with this coefficient is computed and contributes nothing
UNIT, ZERO_MATRIX = "1, 0, 0; 0, 1, 0; 0, 0, 1", "0, 0, 0; 0, 0, 0; 0, 0, 0"
ONE_ENTRY = f"{ZERO}, 0, 0; 0, 0, 0; 0, 0, 0"


@dataclasses.dataclass
class Part:
    name: str
    skipped: str  # words of `check` that say so
    entries: dict = dataclasses.field(default_factory=dict)  # that ask for it
    libraries: bool = False  # that the process opens those of finite elements


PARTS = [
    Part("libraries of finite elements", "no deal.II, MPI or PETSc", libraries=True),
    Part("continuum", "continuum: not among Models", {"Models": "reduced, continuum"}),
    Part("rest of the ball", "motions that would break the symmetry are excluded", {"Continuum/Symmetry": "none"}),
    Part("self-gravity", "self-gravity: Gravity/Constant is 0", {"Gravity/Constant": ZERO}),
    Part("external potential", "external potential: Loads", {"Loads/Tidal matrix": ONE_ENTRY}),
    Part("traction", "traction: Loads", {"Loads/Nominal traction": ONE_ENTRY}),
    Part("contact", "contact: Loads", {"Loads/Plane normals": "0, 0, 1", "Loads/Plane points": "0, 0, -1e6"}),
    Part("viscosity", "dissipation: neither", {"Material/Viscosity": ZERO, "Time/Method": "auto"}),
    Part("viscoelastic branches", "viscoelastic branches: Material", {"Material/Branch moduli": ZERO, "Material/Branch times": "1", "Time/Method": "rattle"}),
    Part("pictures", "Output/Graphics is none", {"Output/Graphics": "vtu"}),
    Part("quantities", "not among Output/Quantities)", {"Output/Quantities": "all"}),
    Part("modes", "modes: Analysis is motion",
         {"Analysis": "modes", "Models": "continuum", "Initial state/Deformation": UNIT,
          "Initial state/Velocity": ZERO_MATRIX}),
    Part("critical points", "critical points: Analysis is motion", {"Analysis": "equilibrium"}),
]


def opened_at_start(executable):
    """The environment in which a process opens the finite elements, whatever its scene needs."""
    (library,) = executable.parents[1].glob("**/pseudorigid/libpseudorigid-continuum.so")
    return {"LD_PRELOAD": str(library)}


def described(executable, scene):
    return subprocess.run([executable, "check", scene], check=True, capture_output=True, text=True).stdout


def shortened(scene):
    end = re.search(r"set End\s*=\s*(\S+)", scene.read_text())
    return {"Time/End": min(float(end[1]), 1), "Output/Samples": 20, "Output/Frames": 5} if end else {}


def refusal(executable, scene, entries):
    """What the program says to the scene with other entries, or nothing."""
    result = subprocess.run([executable, "check", scene.name, *(f"--set={p}={v}" for p, v in entries.items())],
                            capture_output=True, text=True, cwd=scene.parent)
    return re.sub(r"^error: |^.*\.prm:\d+: |^--set: ", "", result.stderr.strip()) if result.returncode else ""


def work(run):
    models = {name: model["counters"] for name, model in run.manifest["models"].items()}
    if "work" in models.get("continuum", {}):
        return models["continuum"]["work"]
    return sum(counters.get("forces", 0) for counters in models.values())


class Scene:
    """The runs of one scene, each kept for all parts that are compared with it."""

    def __init__(self, executable, path, folder):
        self.executable, self.path, self.folder = executable, path, folder / path.stem
        self.text = described(executable, path)
        self.runs = {}

    def parts(self):
        return [part for part in PARTS if part.skipped in self.text]

    def run(self, part, is_short, n_rounds):
        """At most n_rounds runs of the scene as it is (part None) or with a part."""
        key = (part.name if part else None, is_short)
        if key not in self.runs:
            entries = {**(shortened(self.path) if is_short else {}), **(part.entries if part else {})}
            environment = opened_at_start(self.executable) if part and part.libraries else {}
            runs = self.runs[key] = []
            while len(runs) < n_rounds and sum(run.wall for run in runs) < 5:
                runs.append(program.run(self.executable, self.path, self.folder, entries, environment))
        return self.runs[key]

    def row(self, part, n_rounds):
        is_short = "finite elements on" in self.text or part.name in ("continuum", "modes")
        refused = refusal(self.executable, self.path, part.entries)
        if refused:
            return [self.path.stem, part.name, *[""] * 6, refused]
        cells = [self.path.stem, part.name]
        without, having = self.run(None, is_short, n_rounds), self.run(part, is_short, n_rounds)
        for value, together in ((lambda r: r.cpu, sum), (lambda r: r.megabytes, max), (work, sum)):
            pair = [statistics.median(map(value, runs)) for runs in (without, having)]
            if "Analysis" in part.entries:  # in place of the motion; the scene and this beside it
                pair[1] = together(pair)
            cells += [f"{x:.4g}" for x in pair]
        return [*cells, ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    executable = arguments.program.resolve()
    scenes = arguments.scenes or sorted(SCENES.glob("*.prm"))
    if arguments.quick and not arguments.scenes:
        scenes = [SCENES / f"{name}.prm" for name in QUICK]
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow("scene,part,seconds,seconds_with,megabytes,megabytes_with,work,work_with,refused".split(","))
    with tempfile.TemporaryDirectory() as folder:
        for path in scenes:
            scene = Scene(executable, path.resolve(), pathlib.Path(folder))
            for part in scene.parts():
                rows.writerow(scene.row(part, 1 if arguments.quick else 3))
                sys.stdout.flush()


if __name__ == "__main__":
    main()
