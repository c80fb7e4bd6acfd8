#!/usr/bin/env python3
"""Which rows of docs/data/statements.md notice a defect of the program: mutants of the headers behind the statements, each against
the tests of the rows, until every row has been red three times or no mutant is left. docs/testing.md says what was found.

    tools/mutation/statements.py make | build | run | report        as those of mutate.py
"""
import collections
import concurrent.futures
import os
import random
import re
import subprocess

import mutate

ENOUGH = 3  # mutants that have turned a row red; it is not asked any more


def rows():
    """[(number, test case, its file)] of the table, those without a test left out."""
    found = []
    for line in (mutate.SOURCE / "docs/data/statements.md").read_text().splitlines():
        if match := re.match(r"\| (.+?) \| .* \| `(\w+)` `(\w+)` `([\w/.]+)` \|$", line):
            found.append((match[1], f"{match[2]}.{match[3]}", match[4]))
    return found


class Statements(mutate.Workplace):
    name = "statement-mutation"
    shares = {"mechanics/core": 90, "mechanics/equilibria": 40, "mechanics/methods": 20, "systems": 180, "reduced": 120,
              "materials": 25, "gravity": 25}

    def targets_to_build(self):
        """The targets of the files in the table."""
        target_of = {f"{folder}/{source}": target for folder in {file.split("/")[0] for _, _, file in rows()}
                     for target, sources in mutate.sources_of_tests(folder).items() for source in sources}
        return sorted({target_of[file] for _, _, file in rows()})

    def cases(self, test):
        asked = {case for _, case, _ in rows()}
        return [case for case in super().cases(test) if case in asked]

    def red_cases(self, number, test, cases, timeout):
        """Those of the cases of one test that the mutant turns red; where it ends the process, the one that was running."""
        self.scratch.mkdir(exist_ok=True)
        try:
            output = subprocess.run([self.binaries / "tests" / test, f"--gtest_filter={':'.join(cases)}"], cwd=self.scratch,
                                    env={**os.environ, "PSEUDORIGID_MUTANT": str(number)}, capture_output=True, text=True,
                                    timeout=timeout).stdout
        except subprocess.TimeoutExpired as expired:
            output = (expired.stdout or b"").decode()
        verdicts = dict.fromkeys(re.findall(r"^\[ RUN      \] (\S+)", output, re.M), "ended")
        verdicts |= {case: word for word, case in re.findall(r"^\[ +(OK|FAILED) +\] (\S+?)(?:,| \()", output, re.M)}
        return [case for case, word in verdicts.items() if word != "OK"]

    def run(self):
        self.scratch.mkdir(exist_ok=True)
        dropped = set(self.load("dropped", []))
        results = self.load("results", {})  # {mutant: red cases}
        reached = self.find_reached(self.targets_to_build())
        red = collections.Counter(case for cases in results.values() for case in cases)
        waiting = [number for number in self.mutants() if number not in dropped and str(number) not in results]
        random.Random(self.options.seed).shuffle(waiting)

        def look(number):
            found = []
            for test, cases in reached.items():
                meeting = {case: record["seconds"] for case, record in cases.items()
                           if number in record["mutants"] and red[case] < ENOUGH}
                if meeting:
                    found += self.red_cases(number, test, meeting, 20 + 10 * sum(meeting.values()))
            red.update(found)
            return number, found

        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            for number, found in pool.map(look, waiting):
                results[str(number)] = found
                self.save("results", results)
        self.report()

    def report(self):
        mutants = self.mutants()
        of_case = collections.defaultdict(list)
        for number, cases in self.load("results").items():
            for case in cases:
                of_case[case].append(mutants[int(number)])
        print("| row | test | mutants | one of them |\n|---|---|---|---|")
        for number, case, _ in rows():
            guilty = of_case[case]
            example = f"`{guilty[0].file.removeprefix('src/')}:{guilty[0].line}`, {guilty[0].kind}" if guilty else ""
            print(f"| {number} | `{case}` | {len(guilty)} | {example} |")
        n_red = sum(bool(of_case[case]) for _, case, _ in rows())
        print(f"\n{n_red} of {len(rows())} rows were red under at least one of {len(self.load('results'))} mutants")


if __name__ == "__main__":
    mutate.main(Statements, __doc__)
