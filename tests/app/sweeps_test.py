"""Sweeps of the reduced body and of another system: rows, threads, lanes, interruptions, and what they refuse."""
import json
import resource
import unittest

from program_test import BODY_COLUMNS, STOPPED, overrides, words
from reduced_test import BALL, ReducedTest
from system_test import distance

BODY_COLUMNS_AT_END = [f"{name}_end" for name in BODY_COLUMNS if name.startswith("Q")]


class Sweeps(ReducedTest):
    def test_rows_of_a_sweep_are_those_of_single_runs(self):
        sweep = {**BALL, "Initial state/Velocity": "$(w*0.25), -1, 0.125; 0.6, $(-w*0.3), 0.2; 0, -0.08, $(w*0.08)",
                 "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8"}
        # tr(Q^-1 Qdot) = w (0.2 − 0.3 + 0.1) = 0
        self.run_scene({**sweep, "Sweep/Parameters": "w: 0.5, 1"})
        table = self.table("output/scene/sweep.csv")
        for row, w in zip(table.rows, (0.5, 1)):
            entries = {path: str(value).replace("$(w*", f"$({w}*").replace("$(-w*", f"$(-{w}*") for path, value in sweep.items()}
            self.run_scene(entries, name="single")
            single = self.table("output/single/reduced.csv")
            for name in single.header[1:]:
                column = single.column(name)
                found = {f"{name}_end": column[-1], f"{name}_min": min(column), f"{name}_max": max(column)}
                if name in ("energy", "J1", "J2", "J3", "Z1", "Z2", "Z3", "volume_ratio"):  # what a free ball keeps
                    found = {name: column[0], f"{name}_drift": max(column) - min(column)}
                for key, value in found.items():
                    self.assertEqual(row[table.header.index(key)], value, key)

    def test_loads_conserve_no_momenta(self):
        self.run_scene({**BALL, "Loads/Tidal matrix": "$(k), 0, 0; 0, 0, 0; 0, 0, $(-k)", "Sweep/Parameters": "k: 0, 0.1"})
        header = self.table("output/scene/sweep.csv").header
        self.assertLessEqual({"energy", "energy_drift", "J1_end", "J1_min", "Z3_max"}, set(header))
        self.assertFalse({"J1", "J1_drift", "Z1"} & set(header))

    def test_a_sweep_does_not_depend_on_threads(self):
        sweep = {**BALL, "Sweep/Parameters": "mu: 0.5 .. 2 in 12", "Material/Shear modulus": "$(mu)"}
        self.run_scene(sweep, *overrides({"Sweep/Threads": 1}), "--output", "one")
        self.run_scene(sweep, *overrides({"Sweep/Threads": 3}), "--output", "three")
        self.assertEqual(self.bytes("one/sweep.csv"), self.bytes("three/sweep.csv"))

    def test_a_sweep_goes_on_with_the_threads_that_there_are(self):
        self.skip_if_sanitized()
        self.scene({**BALL, "Sweep/Parameters": "mu: 0.5 .. 2 in 1000", "Material/Shear modulus": "$(mu)", "Sweep/Threads": 600})
        addresses = 1500 * 2**20  # room for some ten threads
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (addresses, addresses))
        result = self.run_done("run", "scene.prm", "--output", "some", preexec_fn=limit)
        self.assertRegex(result.stderr, r"warning: .*thread")
        self.run_done("run", "scene.prm", "--output", "one", *overrides({"Sweep/Threads": 1}))
        self.assertEqual(self.bytes("some/sweep.csv"), self.bytes("one/sweep.csv"))

    def test_an_interrupted_sweep_goes_on(self):
        sweep = {**BALL, "Sweep/Parameters": "mu: 0.5 .. 2 in 300", "Material/Shear modulus": "$(mu)", "Time/End": 100,
                 "Output/Samples": 500}
        self.run_scene(sweep, "--output", "whole")
        self.scene(sweep)
        self.assertEqual(self.interrupt("sweep", "parts"), STOPPED)
        self.assertLess(len(self.table("parts/sweep.csv")), 300)
        self.run_done("run", "scene.prm", "--output", "parts", "--resume")
        self.assertEqual(self.bytes("parts/sweep.csv"), self.bytes("whole/sweep.csv"))

    def lanes(self, entries, *options, name="lanes"):
        """A sweep in lanes and one of single runs, and how many runs of the first went in lanes."""
        self.scene(entries)
        for lanes in ("true", "false"):
            self.run_done("run", "scene.prm", *options, *overrides({"Sweep/Lanes": lanes}), "--output", f"{name}-{lanes}")
        n_in_lanes = [self.json(f"{name}-{lanes}/manifest.json")["models"]["sweep"]["counters"]["runs_in_lanes"]
                      for lanes in ("true", "false")]
        self.assertEqual(n_in_lanes[1], 0)
        return self.table(f"{name}-true/sweep.csv"), self.table(f"{name}-false/sweep.csv"), n_in_lanes[0]

    #: 19 releases: two groups of eight and three runs alone.
    RELEASES = {"Models": "reduced", "Sweep/Parameters": "l: 1.02 .. 1.4 in 19", "Time/End": 10, "Output/Samples": 50,
                "Initial state/Deformation": "$(1/sqrt(l)), 0, 0; 0, $(1/sqrt(l)), 0; 0, 0, $(l)",
                "Initial state/Velocity": "0, $(-0.3*l), 0; $(0.2*l), 0, 0; 0, 0, 0"}

    def test_runs_in_lanes_with_a_given_step(self):
        """They differ from single runs by round-off."""
        for law in ("neo-hookean", "mooney-rivlin"):
            together, alone, n_in_lanes = self.lanes(
                {**self.RELEASES, "Material/Law": law, "Time/Method": "symmetric-8", "Time/Step": 0.02}, name=law)
            self.assertEqual(n_in_lanes, 16)
            # Measured: 4e-13. Frequency and amplitude are fits to a short record, and no better than it.
            names = [name for name in alone.header if name not in ("frequency", "amplitude")]
            self.assertLess(max(abs(a - b) for name in names for a, b in zip(together.column(name), alone.column(name))), 1e-11)

    def test_runs_in_lanes_within_the_tolerance(self):
        for tolerance in (1e-5, 1e-9):
            together, alone, n_in_lanes = self.lanes({**self.RELEASES, "Time/Tolerance": tolerance}, name=str(tolerance))
            self.assertEqual(n_in_lanes, 16)
            for column in BODY_COLUMNS[1:10]:
                for what in ("end", "min", "max"):
                    for x, y in zip(together.column(f"{column}_{what}"), alone.column(f"{column}_{what}")):
                        self.assertLess(abs(x - y), 2 * tolerance)
            self.assertLess(max(together.column("estimated_time_error")), tolerance)

    def test_lanes_are_for_runs_that_are_alike(self):
        for other in ({"Material/Shear modulus": "$(l)"},  # another unit of time
                      {"Gravity/Constant": 0.1}, {"Time/Method": "rattle-8"}, {"Time/Method": "gauss-16"}, {"Body/Incompressible": "false"},
                      {"Time/Tolerance": "$(1e-6*l)"}):
            _, _, n_in_lanes = self.lanes({**self.RELEASES, **other}, name=next(iter(other)).replace("/", "-"))
            self.assertEqual(n_in_lanes, 0, other)

    def test_every_entry_of_the_material_is_swept_in_lanes_as_alone(self):
        """Whatever an entry does to whatever law: eight runs together have the rows of eight single runs, and move
        together only if their rows are equal."""
        release = {"Models": "reduced", "Time/End": 2, "Output/Samples": 4, "Time/Method": "symmetric-8", "Time/Step": 0.02,
                   "Output/Quantities": "state", "Initial state/Deformation": "1.2, 0, 0; 0, 1, 0; 0, 0, $(5/6)"}
        page = json.loads(self.run_done("parameters", "--format", "json").stdout)
        entries = {about["entry"]: float(about["default"]) for about in page
                   if about["entry"].startswith("Material/") and about["type"] == "number"}
        self.assertGreater(len(entries), 4)
        moved, unmoved = set(), set()
        for law in words("Material/Law"):
            for entry, default in entries.items():
                values = f"{0.7 * default} .. {1.3 * default}" if default else "0 .. 0.2"
                scene = {**release, "Material/Law": law, entry: "$(x)", "Sweep/Parameters": f"x: {values} in 8"}
                if default == 0:  # what dissipates
                    scene["Time/Method"] = "rattle"
                together, alone, n_in_lanes = self.lanes(scene, "--quiet")
                with self.subTest(law=law, entry=entry):
                    self.assertLess(distance(together, alone, BODY_COLUMNS_AT_END), 1e-11)
                    same = all(column == [column[0]] * 8 for column in map(alone.column, BODY_COLUMNS_AT_END))
                    (unmoved if same else moved).add(entry)
                    if not same:
                        self.assertEqual(n_in_lanes, 0)
        self.assertEqual(moved, set(entries))
        self.assertTrue(unmoved)

    def test_lanes_do_not_depend_on_threads_or_interruptions(self):
        sweep = {**self.RELEASES, "Sweep/Parameters": "l: 1.02 .. 1.4 in 4003", "Time/End": 100}
        self.run_scene(sweep, *overrides({"Sweep/Threads": 1}), "--output", "one")
        self.run_scene(sweep, *overrides({"Sweep/Threads": 3}), "--output", "three")
        self.assertEqual(self.bytes("one/sweep.csv"), self.bytes("three/sweep.csv"))
        self.scene(sweep)
        self.assertEqual(self.interrupt("sweep", "parts"), STOPPED)
        self.assertLess(len(self.table("parts/sweep.csv")), 4003)
        self.run_done("run", "scene.prm", "--output", "parts", "--resume")
        self.assertEqual(self.bytes("parts/sweep.csv"), self.bytes("one/sweep.csv"))

    def test_a_sweep_of_another_system(self):
        self.run_scene({"System": "double pendulum", "Double pendulum/Angles": "$(a), 0.1", "Sweep/Parameters": "a: 0.1, 0.2",
                        "Time/End": 2, "Output/Samples": 20})
        table = self.table("output/scene/sweep.csv")
        self.assertEqual(table.column("a"), [0.1, 0.2])
        self.assertIn("theta_max", table.header)

    def test_frequencies_of_a_sweep(self):
        """Small pulsations have sqrt(10) c/r, PHYSICS.md 3; the amplitude of C = Q^T Q of a release is that of its stretch."""
        self.run_scene({"Models": "reduced", "Sweep/Parameters": "l: 1.001, 1.3", "Time/End": 20, "Output/Samples": 200,
                        "Initial state/Deformation": "$(1/sqrt(l)), 0, 0; 0, $(1/sqrt(l)), 0; 0, 0, $(l)"})
        table = self.table("output/scene/sweep.csv")
        self.assertEqual(table.header[7:9], ["frequency", "amplitude"])
        small, large = table.column("frequency")
        self.assertAlmostEqual(small, 10**0.5, delta=1e-4)
        self.assertNotAlmostEqual(large, 10**0.5, delta=1e-3)
        self.assertAlmostEqual(table.column("amplitude")[0], 2e-3 * 1.5**0.5, delta=1e-4)  # C - Id = 2 (l - 1) diag(-1/2, -1/2, 1)

    def test_what_a_sweep_refuses(self):
        sweep = {**BALL, "Sweep/Parameters": "l: 1 .. 2 in 3"}
        self.refuse({**sweep, "Sweep/Parameters": "l: 1 .. 2"}, "Sweep/Parameters", "expected")
        self.refuse({**sweep, "Sweep/Parameters": "l: 1; l: 2"}, "occurs twice")
        self.refuse({**sweep, "Sweep/Parameters": "2l: 1, 2"}, "Sweep/Parameters")
        self.refuse({**sweep, "Material/Shear modulus": "$(m)"}, "Material/Shear modulus", "cannot be evaluated",
                    'nothing is called "m"', "the parameters of the sweep are l")
        self.refuse({**sweep, "Material/Shear modulus": "$(1/(l-1))"}, "not a finite number")
        self.refuse({**sweep, "Material/Shear modulus": "$(1.5-l)"}, "number > 0", "run 3 of the sweep", "l = 2")
        self.refuse({**sweep, "Material/Shear modulus": "$(l"}, "no closing parenthesis")
        self.refuse({**sweep, "Initial state/Velocity": "0, 0, 0; 0, 0, 0; 0, 0, 0",
                     "Initial state/Deformation": "$(l), 0, 0; 0, 1, 0; 0, 0, 1"}, "det", "run 3 of the sweep")

    def test_expressions_without_a_sweep(self):
        self.run_scene({**BALL, "Initial state/Deformation": "$(5/4), 0, 0; 0, 1, 0; 0, 0, $(4/5)"}, name="expressed")
        self.run_scene(BALL)
        self.assertEqual(self.bytes("output/expressed/reduced.csv"), self.bytes("output/scene/reduced.csv"))
        self.run_done("run", "output/expressed/used.prm", "--output", "again")
        self.assertEqual(self.bytes("again/reduced.csv"), self.bytes("output/scene/reduced.csv"))


if __name__ == "__main__":
    unittest.main()
