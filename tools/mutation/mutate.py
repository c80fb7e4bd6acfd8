#!/usr/bin/env python3
"""Mutation testing: changes one sign, factor, term, condition or statement of the program at a time, and looks whether a
test notices. docs/testing.md says what was found.

    tools/mutation/mutate.py make        a copy of the sources with the mutants of every layer in it, chosen by --seed
    tools/mutation/mutate.py build       compiles its tests; mutants that no compiler takes are dropped
    tools/mutation/mutate.py run         the tests that reach each mutant, the fastest first, until one fails
    tools/mutation/mutate.py report      numbers and survivors, as Markdown

All mutants are compiled together, and PSEUDORIGID_MUTANT says which one lives (mutant_switch.h). `run` goes on where it
stopped; after a change of tests, `build` takes over tests/ into the copy, and `run --survivors` tries those again that lived.
Mutants of a layer meet the tests of its folder in tests/, survivors those of FURTHER as well.
"""
import argparse
import collections
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import time

import operators

SOURCE = pathlib.Path(__file__).resolve().parents[2]
# Mutants of each layer.
LAYERS = {"mechanics": 50, "reduced": 45, "materials": 15, "scene": 30, "io": 30, "continuum": 40}
FURTHER = {"mechanics": ["reduced", "systems"], "reduced": ["mechanics"], "materials": ["reduced", "examples"],
           "scene": ["io"], "io": ["analysis"], "continuum": []}
# Tests of programs beside these are not asked: they take minutes a mutant.
LEFT_OUT = {"reduced_stress_test", "scene_oracle_test", "test_example_program"}
QUICK = 0.5  # seconds
MEMORY = 6 << 30


def sources_of_tests(folder):
    """{test program: its sources}, as a folder of tests/ declares them."""
    text = (SOURCE / "tests" / folder / "CMakeLists.txt").read_text()
    return {target: re.findall(r"\w+\.cpp", sources)
            for target, sources in re.findall(r"^\s*pseudorigid_test\((\w+)\s([^)]*)\)", text, re.M)}


class Workplace:
    name = "mutation"
    shares = LAYERS

    def __init__(self, options):
        self.options = options
        self.folder = options.build
        self.copy, self.binaries = self.folder / "source", self.folder / "build"
        self.scratch = self.folder / "scratch"

    # What is kept between the commands.

    def load(self, name, default=None):
        path = self.folder / f"{name}.json"
        return json.loads(path.read_text()) if path.exists() else default

    def save(self, name, value):
        path = self.folder / f"{name}.json"
        path.with_suffix(".new").write_text(json.dumps(value, indent=1))
        path.with_suffix(".new").replace(path)

    def mutants(self):
        return {int(number): operators.Mutant(**mutant) for number, mutant in self.load("mutants").items()}

    # make

    def choose(self):
        """A sample of each layer: at most one mutant a line, no file with more than a fifth of them."""
        generator = random.Random(self.options.seed)
        chosen = []
        for layer, share in self.shares.items():
            count = round(share * self.options.scale)
            files = sorted(path for path in (SOURCE / "src" / layer).rglob("*") if path.suffix in (".h", ".cpp"))
            candidates = [mutant for path in files
                          for mutant in operators.mutants_of(str(path.relative_to(SOURCE)), path.read_text())]
            generator.shuffle(candidates)
            lines, per_file, taken = set(), collections.Counter(), []
            for mutant in candidates:
                if len(taken) < count and (mutant.file, mutant.line) not in lines and per_file[mutant.file] < max(2, count / 5):
                    lines.add((mutant.file, mutant.line))
                    per_file[mutant.file] += 1
                    taken.append(mutant)
            chosen += sorted(taken, key=lambda m: (m.file, m.line))
        return dict(enumerate(chosen, 1))

    def make(self):
        mutants = self.choose()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.save("mutants", {number: dataclasses.asdict(mutant) for number, mutant in mutants.items()})
        for name in ("dropped", "reached", "results"):
            (self.folder / f"{name}.json").unlink(missing_ok=True)
        self.take_over("")
        self.instrument()
        print(f"{len(mutants)} mutants in {self.copy}")

    def take_over(self, folder):
        """The tracked and the new files of the folder, where they differ."""
        listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", folder or "."], cwd=SOURCE,
                                check=True, capture_output=True, text=True).stdout.split("\n")
        for name in filter(None, listed):
            there, here = SOURCE / name, self.copy / name
            if there.is_file() and not (here.exists() and here.read_bytes() == there.read_bytes()):
                here.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(there, here)

    def instrument(self):
        dropped = set(self.load("dropped", []))
        of_file = collections.defaultdict(list)
        for number, mutant in self.mutants().items():
            of_file[mutant.file].append((number, mutant))
        for file, numbered in of_file.items():
            text = operators.instrumented((SOURCE / file).read_text(), [pair for pair in numbered if pair[0] not in dropped],
                                          SOURCE / "tools/mutation/mutant_switch.h")
            if (self.copy / file).read_text() != text:
                (self.copy / file).write_text(text)

    # build

    def layers(self):
        return self.options.layers.split(",")

    def targets(self, folders):
        found = [name for folder in folders for name in sources_of_tests(folder)]
        return [name for name in dict.fromkeys(found) if name not in LEFT_OUT]

    def tests_of(self, layer, further):
        return self.targets([layer] + (FURTHER[layer] if further else []))

    def targets_to_build(self):
        return [name for layer in self.layers() for name in self.tests_of(layer, self.options.further)]

    def build(self):
        self.take_over("tests")
        if not (self.binaries / "build.ninja").exists():
            with_continuum = "ON" if self.options.continuum else "OFF"
            subprocess.run(["cmake", "-G", "Ninja", "-S", self.copy, "-B", self.binaries, "-DCMAKE_BUILD_TYPE=Release",
                            f"-DPSEUDORIGID_CONTINUUM={with_continuum}", "-DPSEUDORIGID_UNITY=OFF", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG",
                            "-DCMAKE_CXX_FLAGS=-ftemplate-backtrace-limit=0"],
                           check=True, stdout=subprocess.DEVNULL)
        command = ["nice", "-n", "10", "ninja", "-C", self.binaries, "-k", "0", f"-j{self.options.jobs}", *self.targets_to_build()]
        while True:
            result = subprocess.run(command, capture_output=True, text=True)
            if result.returncode == 0:
                return
            self.drop(result.stdout)

    def drop(self, output):
        """Takes out the mutants in whose lines the compiler saw an error, or from which it came to one."""
        place_of = {(mutant.file, mutant.line): number for number, mutant in self.mutants().items()}
        dropped = set(self.load("dropped", []))
        guilty = set()
        for block in re.split(r"^FAILED: ", output, flags=re.M)[1:]:
            errors = re.findall(r"^(\S+?):(\d+):\d+: (?:fatal )?(error|\s*required from|note)", block, re.M)
            at = lambda kinds: {place_of[key] for path, line, kind in errors
                                if kind.strip() in kinds and (key := (os.path.relpath(path, self.copy), int(line))) in place_of}
            guilty |= (at({"error"}) or at({"required from"}) or at({"note"})) - dropped
        if not guilty:
            sys.exit(output[-6000:] + "\nno mutant is guilty of this")
        print("no compiler takes", *sorted(guilty), flush=True)
        self.save("dropped", sorted(dropped | guilty))
        self.instrument()

    # run

    def execute(self, test, cases, timeout, **environment):
        """Whether the cases pass, and the seconds that they took."""
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        begin = time.monotonic()
        try:
            code = subprocess.run([self.binaries / "tests" / test, f"--gtest_filter={':'.join(cases)}", "--gtest_fail_fast"],
                                  cwd=self.scratch, env={**os.environ, **environment}, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL, timeout=timeout, preexec_fn=limit).returncode
        except subprocess.TimeoutExpired:
            code = "timeout"
        return code == 0, time.monotonic() - begin

    def cases(self, test):
        listed = subprocess.run([self.binaries / "tests" / test, "--gtest_list_tests"], capture_output=True, text=True, check=True)
        suite, found = "", []
        for line in listed.stdout.splitlines():
            name = line.split("#")[0].strip()
            if not line.startswith(" "):
                suite = name
            elif suite.endswith(".") and "DISABLED_" not in name:
                found.append(suite + name)
        return found

    def find_reached(self, tests):
        """{test: {case: {seconds, mutants}}}; fails if the original does not pass its tests."""
        known = self.load("reached", {})
        for test in tests:
            stamp = (self.binaries / "tests" / test).stat().st_mtime
            if known.get(test, {}).get("stamp") == stamp:
                continue
            def look(case):
                file = self.scratch / f"reached-{test}-{abs(hash(case))}"
                file.unlink(missing_ok=True)
                passed, seconds = self.execute(test, [case], 900, PSEUDORIGID_MUTANTS_REACHED=str(file))
                reached = sorted({int(n) for n in file.read_text().split()}) if file.exists() else []
                file.unlink(missing_ok=True)
                return case, {"seconds": seconds, "mutants": reached, "passed": passed}
            with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
                known[test] = {"stamp": stamp, "cases": dict(pool.map(look, self.cases(test)))}
            for case, found in known[test]["cases"].items():
                if not found["passed"]:
                    print(f"{test} {case} fails without a mutant and is left out", flush=True)
            self.save("reached", known)
        return {test: {case: found for case, found in known[test]["cases"].items() if found["passed"]} for test in tests}

    def verdict(self, number, reached):
        """{killed_by: test, or None} and how many cases reach the mutant."""
        meeting = [(found["seconds"], test, case) for test, cases in reached.items() for case, found in cases.items()
                   if number in found["mutants"]]
        batches = []
        for chosen in ([m for m in meeting if m[0] < QUICK], [m for m in meeting if m[0] >= QUICK]):
            of_test = collections.defaultdict(list)
            for seconds, test, case in chosen:
                of_test[test].append((seconds, case))
            batches += sorted((sum(s for s, _ in group), test, [case for _, case in group]) for test, group in of_test.items())
        for seconds, test, cases in batches:
            if not self.execute(test, cases, 20 + 10 * seconds, PSEUDORIGID_MUTANT=str(number))[0]:
                return {"killed_by": test, "cases": len(meeting)}
        return {"killed_by": None, "cases": len(meeting)}

    def run(self):
        self.scratch.mkdir(exist_ok=True)
        results, dropped = self.load("results", {}), set(self.load("dropped", []))
        for layer in self.layers():
            built = [test for test in self.tests_of(layer, self.options.further) if (self.binaries / "tests" / test).exists()]
            reached = self.find_reached(built)
            waiting = [number for number, mutant in self.mutants().items()
                       if number not in dropped and mutant.file.startswith(f"src/{layer}/")
                       and (str(number) not in results or self.options.survivors and not results[str(number)]["killed_by"])]
            with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
                for number, verdict in zip(waiting, pool.map(lambda n: self.verdict(n, reached), waiting)):
                    before = results.get(str(number), {})
                    first = before.get("killed_first", bool(verdict["killed_by"]))
                    results[str(number)] = {**verdict, "killed_first": first}
                    self.save("results", results)
                    if not verdict["killed_by"]:
                        print(self.describe(number, verdict), flush=True)
        self.report()

    # report

    def describe(self, number, verdict):
        mutant = self.mutants()[number]
        return (f"{number}: {mutant.file}:{mutant.line}, {mutant.kind}, reached by {verdict['cases']} cases\n"
                f"    {mutant.original}\n    {mutant.mutated}")

    def report(self):
        results = self.load("results", {})
        print("| layer | mutants | killed at first | killed now |\n|---|---|---|---|")
        mutants = self.mutants()
        for layer in LAYERS:
            of_layer = [results[str(n)] for n, m in mutants.items() if m.file.startswith(f"src/{layer}/") and str(n) in results]
            print(f"| {layer} | {len(of_layer)} | {sum(r['killed_first'] for r in of_layer)} | "
                  f"{sum(bool(r['killed_by']) for r in of_layer)} |")
        for number, verdict in results.items():
            if not verdict["killed_by"]:
                print(self.describe(int(number), verdict))


def main(workplace, text):
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("make", "build", "run", "report"))
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build" / workplace.name, help="where all is kept")
    parser.add_argument("--layers", default=",".join(LAYERS), help="those to build and run")
    parser.add_argument("--further", action="store_true", help="the tests of neighbouring layers as well")
    parser.add_argument("--survivors", action="store_true", help="try them again, with the tests as they are now")
    parser.add_argument("--no-continuum", dest="continuum", action="store_false", help="a copy without deal.II")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scale", type=float, default=1, help="factor to the number of mutants")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    options.build = options.build.resolve()
    getattr(workplace(options), options.command)()


if __name__ == "__main__":
    main(Workplace, __doc__)
