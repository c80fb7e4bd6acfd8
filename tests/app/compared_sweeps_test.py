"""Sweeps of several models: each row is the comparison of a single run; processes, interruptions, parts, refusals."""
import signal
import unittest

from program_test import STOPPED, overrides
from reduced_test import ReducedTest

RELEASE = {"Models": "reduced, polynomial, continuum", "Polynomial/Degree": 3, "Continuum/Degree": 2,
           "Initial state/Deformation": "$(1/sqrt(l)), 0, 0; 0, $(1/sqrt(l)), 0; 0, 0, $(l)",
           "Time/End": 6, "Time/Tolerance": 1e-4, "Output/Samples": 60,
           "Output/Quantities": "state, energies, momenta, axes, multiplier, nonaffine, stretches"}
STRETCHES = "l: 1.02 .. 1.1 in 4"


class ComparedSweeps(ReducedTest):
    def test_rows_are_comparisons_of_single_runs(self):
        self.run_scene({**RELEASE, "Sweep/Parameters": "l: 1.02, 1.1"})
        table = self.table("output/scene/sweep.csv")
        for row, l in enumerate((1.02, 1.1)):
            self.run_scene({key: str(value).replace("(l)", f"({l})") for key, value in RELEASE.items()}, name="single")
            self.assertEqual(table.column("compared")[row], 1)
            for model in ("reduced", "polynomial"):
                single = self.json(f"output/single/comparison-{model}.json")
                found = {"frequency_ratio": single["frequency"]["ratio"],
                         "frequency_ratio_error": single["frequency"]["ratio_uncertainty"],
                         "frequency": single["frequency"][model]["omega"],
                         "amplitude": single[model]["strain_amplitude"],
                         "phase_difference_error": single["differences"]["phase_difference"]["uncertainty"]}
                self.assertEqual(single["differences"]["q_difference"]["uncertainty"], single["model_difference"]["uncertainty"])
                for name in ("q_difference", "strain_difference", "a3_difference", "elastic_difference",
                             "max_stretch_difference", "circulation_difference", "multiplier_difference"):
                    found[f"{name}_max"] = single["differences"][name]["max"]
                    found[f"{name}_rms"] = single["differences"][name]["rms"]
                    found[f"{name}_error"] = single["differences"][name]["uncertainty"]
                for name, value in found.items():
                    self.assertEqual(table.column(f"{model}_{name}")[row], value, f"{model}_{name}")
            for column, key in (("nonaffine_kinetic_fraction", "mean_nonaffine_kinetic_fraction"),
                                ("nonaffine_kinetic_fraction_error", "mean_nonaffine_kinetic_fraction_uncertainty")):
                self.assertEqual(table.column(column)[row], single[key])
            self.assertEqual(table.column("nonaffine_displacement_error")[row],
                             single["differences"]["nonaffine_displacement"]["uncertainty"])
            counters = self.json("output/single/manifest.json")["models"]["continuum"]["counters"]
            self.assertEqual(table.column("continuum_steps")[row], counters["steps"])
            self.assertEqual(table.column("continuum_time_error")[row], counters["estimated_time_error"])
            self.assertEqual(table.column("continuum_space_error")[row], counters["relative_space_error"])
            ratio = table.column("reduced_frequency_ratio")[row]
            after = table.column("reduced_tenth_of_period_after")[row]
            omega = table.column("reduced_frequency")[row]
            self.assertAlmostEqual(after * omega * (1 - 1 / ratio), 0.2 * 3.141592653589793, delta=1e-6)

    def test_the_ratio_of_small_pulsations(self):
        """PHYSICS.md 3: the pseudo-rigid ball is faster than the elastic one by sqrt(10)/2.665622. Both bars are looked at."""
        self.run_scene({**RELEASE, "Models": "reduced, polynomial", "Polynomial/Degree": 7, "Time/End": 24, "Output/Samples": 240,
                        "Time/Tolerance": 1e-6, "Sweep/Parameters": "l: 1.0001, 1.0002"})
        table = self.table("output/scene/sweep.csv")
        for ratio, error in zip(table.column("reduced_frequency_ratio"), table.column("reduced_frequency_ratio_error")):
            self.assertGreater(error, 0)
            self.assertLess(error, 1e-3)
            self.assertLess(abs(ratio - 10**0.5 / 2.665622189236), error)

    def test_rows_do_not_depend_on_processes(self):
        sweep = {**RELEASE, "Models": "reduced, continuum", "Sweep/Parameters": STRETCHES}
        self.run_scene(sweep, *overrides({"Sweep/Threads": 1}), "--output", "one")
        self.run_scene(sweep, *overrides({"Sweep/Threads": 3}), "--output", "three")
        self.assertEqual(self.bytes("one/sweep.csv"), self.bytes("three/sweep.csv"))
        for part in (1, 2, 3):
            self.run_scene(sweep, *overrides({"Sweep/Part": f"{part} of 3"}), "--output", f"part{part}")
        rows = [row for part in (1, 2, 3) for row in self.table(f"part{part}/sweep.csv").rows]
        self.assertEqual(rows, self.table("one/sweep.csv").rows)
        self.run_scene(sweep, *overrides({"Sweep/Part": "1 of 9"}), "--output", "empty")  # more parts than runs
        self.assertEqual(len(self.table("empty/sweep.csv")), 0)

    def test_an_interrupted_sweep_goes_on(self):
        sweep = {**RELEASE, "Models": "reduced, continuum", "Sweep/Parameters": "l: 1.02 .. 1.1 in 24", "Output/Samples": 200,
                 "Time/End": 12}
        self.run_scene(sweep, "--output", "whole")
        self.scene(sweep)
        self.assertEqual(self.interrupt("sweep", "parts"), STOPPED)
        self.assertLess(len(self.table("parts/sweep.csv")), 24)
        self.run_done("run", "scene.prm", "--output", "parts", "--resume")
        self.assertEqual(self.bytes("parts/sweep.csv"), self.bytes("whole/sweep.csv"))

    def test_a_killed_sweep_leaves_no_process(self):
        self.scene({**RELEASE, "Models": "reduced, continuum", "Sweep/Parameters": "l: 1.02 .. 1.1 in 400", "Time/End": 200})
        process = self.start_program("run", "scene.prm")
        children = f"/proc/{process.pid}/task/{process.pid}/children"
        self.wait_until(lambda: len(open(children).read().split()) > 0, "the processes of the sweep")
        found = open(children).read().split()
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.wait_until(lambda: not any(self.runs(pid) for pid in found), "the processes to end")

    @staticmethod
    def runs(pid):
        try:
            return open(f"/proc/{pid}/stat").read().split(")")[1].split()[0] != "Z"
        except (FileNotFoundError, ProcessLookupError):
            return False

    def test_a_run_that_breaks_off_is_a_row(self):
        self.run_scene({**RELEASE, "Models": "reduced, continuum", "Time/Step": 0.2, "Time/Method": "rattle", "Time/End": 2,
                        "Sweep/Parameters": "l: 1.001, 1.5", "Output/Samples": 10})
        table = self.table("output/scene/sweep.csv")
        self.assertEqual(table.column("continuum_finished"), [0, 0])
        self.assertEqual(table.column("reduced_finished"), [1, 1])
        self.assertTrue(table.is_finite())

    def test_finite_elements_alone(self):
        self.run_scene({**RELEASE, "Models": "continuum", "Sweep/Parameters": STRETCHES, "Sweep/Trajectories": "true"})
        table = self.table("output/scene/sweep.csv")
        self.assertEqual(table.column("finished"), [1, 1, 1, 1])
        self.assertGreater(min(table.column("frequency")), 2)
        self.assertEqual(len(self.table("output/scene/trajectories.csv")), 4 * 61)

    def test_what_is_refused(self):
        self.refuse({**RELEASE, "Sweep/Parameters": STRETCHES, "Sweep/Trajectories": "true"}, "Sweep/Trajectories", "one model")
        self.refuse({**RELEASE, "Sweep/Parameters": STRETCHES, "Sweep/Part": "3 of 2"}, "Sweep/Part", "2 of 8")
        self.refuse({**RELEASE, "Sweep/Parameters": "l: -1 .. 2 in 3 logarithmic"}, "Sweep/Parameters", "logarithmic")
        self.refuse({**RELEASE, "Sweep/Parameters": "l: 1 .. 2 in 3 latin"}, "Sweep/Parameters", "latin")
        self.refuse({**RELEASE, "Sweep/Parameters": f"{STRETCHES}; compared: 0, 1", "Time/End": "$(6+compared)"},
                    "Sweep/Parameters", "compared")

    def test_check_says_the_error_to_expect(self):
        """10 + 4/5 gamma is the square of the pseudo-rigid frequency, PHYSICS.md 11; of the exact ball 3.2731 with gamma = 5."""
        release = {**RELEASE, "Initial state/Deformation": "1.1, 0, 0; 0, 1, 0; 0, 0, $(1/1.1)"}
        gravity = {"Gravity/Constant": "$(15/(4*pi))"}
        for entries, expected in (({}, 10**0.5 / 2.665622), (gravity, 14**0.5 / 3.2731)):
            line = self.run_done("check", self.scene({**release, **entries})).stdout.split("Expected:")[1]
            self.assertRegex(line, r"N = 5 \+0\.0")
            found = float(line.split("pseudo-rigid +")[1].split(" %")[0])
            self.assertAlmostEqual(found, 100 * (expected - 1), delta=0.51)  # two digits
        for beyond in ({"Initial state/Deformation": "1.4, 0, 0; 0, 1, 0; 0, 0, $(1/1.4)"}, {"Loads/Tidal matrix": "0.1, 0, 0; 0, 0, 0; 0, 0, -0.1"},
                       {"Initial state/Velocity": "0, -0.5, 0; 0.5, 0, 0; 0, 0, 0", "Initial state/Deformation": "1, 0, 0; 0, 1, 0; 0, 0, 1"},
                       {"Body/Semi-axes": "1.1, 1, 1", "Models": "reduced"}):
            self.assertNotIn("Expected:", self.run_done("check", self.scene({**release, **beyond})).stdout)

    def test_check_says_the_effort(self):
        scene = self.scene({**RELEASE, "Sweep/Parameters": STRETCHES})
        self.assertRegex(self.run_done("check", scene).stdout, r"effort of the sweep: roughly \S+ s .* 4 runs")


if __name__ == "__main__":
    unittest.main()
