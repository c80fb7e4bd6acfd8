"""The time error of violent runs is estimated by a run with twice the steps (src/app/search/time_error.h). References are runs
with rattle-8 and small fixed steps.

Error and estimate of all violent releases of the grid as CSV (two minutes):
    PSEUDORIGID=build/release/bin/pseudorigid python3 tests/app/time_error_test.py grid
"""
import math
import signal
import sys

from program_test import STOPPED, ProgramTest, main

TENSOR = [f"Q{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
# model, degree, γ = ρgr/μ, stretch along z
GRID = [("continuum", 2, 0, 2), ("continuum", 3, 20, 1.5), *(("continuum", 4, gamma, stretch) for gamma in (0, 5) for stretch in (1.35, 1.5)),
        ("continuum", 5, 5, 1.35), ("polynomial", 3, 0, 1.5), ("polynomial", 3, 5, 2), ("polynomial", 5, 5, 1.5), ("polynomial", 5, 0, 2)]


class TimeErrors(ProgramTest):
    def release(self, model, degree, gamma, stretch, end=5, **entries):
        side = 1 / math.sqrt(stretch)
        self.scene({"Models": f"reduced, {model}", f"{model.title()}/Degree": degree, "Gravity/Gamma": gamma,
                    "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, {stretch!r}",
                    "Initial state/Velocity": "0, 0, 0; 0, 0, 0; 0, 0, 0", "Time/End": end, "Output/Samples": 10 * end,
                    "Output/Quantities": "state", **entries})
        self.model = model

    def motion(self, *options, output="own"):
        self.run_done("run", "scene.prm", "--output", output, *options)
        table = self.table(output, f"{self.model}.csv")
        return [table.column(name) for name in TENSOR], self.json(output, "manifest.json")["models"][self.model]

    def error_and_estimate(self, tolerance, step):
        """The largest error of an entry of Q, its estimate, and the statistics of the run in the manifest."""
        own, statistics = self.motion("--set", f"Time/Tolerance={tolerance}")
        exact, _ = self.motion("--set", "Time/Method=rattle-8", "--set", f"Time/Step={step}", "--set", "Continuum/Error estimate=none", output="fine")
        error = max(abs(x - y) for a, b in zip(own, exact) for x, y in zip(a, b))
        return error, statistics["counters"].get("estimated_time_error"), statistics

    def test_estimates_are_bounds(self):
        for model, degree in ("continuum", 2), ("polynomial", 3):
            with self.subTest(model):
                self.release(model, degree, 5, 2, end=3)
                error, estimate, statistics = self.error_and_estimate(1e-4, 0.005)
                self.assertLessEqual(error, estimate)
                self.assertLess(estimate, 3 * error)  # 4/3 of the sum of both errors, and the finer run has the smaller one
                comparison = self.json("own", "comparison.json")
                self.assertGreater(comparison["model_difference"]["time_error"], 0)
                self.assertIn("time error", self.log("own"))

    def test_a_gentle_run_has_the_estimate_of_its_pilot_runs(self):
        self.release("continuum", 2, 0, 1.05, end=3)
        _, statistics = self.motion()
        self.assertGreater(statistics["counters"]["estimated_time_error"], 0)
        self.assertNotIn("twice the steps", self.log("own"))

    def test_a_run_without_comparison_has_no_estimate(self):
        self.release("continuum", 2, 5, 2, end=3, Models="continuum")
        _, statistics = self.motion()
        self.assertNotIn("estimated_time_error", statistics["counters"])

    def test_a_resumed_run_has_the_same_estimate(self):
        for model, degree in ("continuum", 3), ("polynomial", 3):
            with self.subTest(model):
                self.release(model, degree, 5, 2, end=5)
                _, whole = self.motion(output=f"{model}-whole")
                self.assertGreater(whole["counters"]["estimated_time_error"], 0)
                part = f"{model}-part"
                process = self.start_program("run", "scene.prm", "--output", part)
                self.wait_until((self.scratch / part / f"checkpoint-{model}.bin").exists, "the run has begun")
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.wait(), STOPPED)
                _, resumed = self.motion("--resume", output=part)
                self.assertEqual(resumed["counters"]["estimated_time_error"], whole["counters"]["estimated_time_error"])

    def test_a_run_that_goes_on_with_other_steps_has_their_error(self):
        """It is interrupted between two samples, finishes this interval with its old steps, and then takes longer ones."""
        self.release("continuum", 2, 0, 1.05, end=60, **{"Output/Samples": 3, "Time/Tolerance": 1e-8})
        process = self.start_program("run", "scene.prm", "--output", "own")
        self.wait_until((self.scratch / "own/checkpoint-continuum.bin").exists, "the run has begun")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), STOPPED)
        old = self.json("own", "manifest.json")["models"]["continuum"]["counters"]["estimated_time_error"]
        _, statistics = self.motion("--resume", "--set", "Time/Tolerance=1e-3")
        self.assertGreater(statistics["counters"]["estimated_time_error"], 100 * old)

    def log(self, folder):
        return (self.scratch / folder / "log.txt").read_text()


def print_grid():
    test = TimeErrors()
    test.setUp()
    print("model,degree,gamma,stretch,tolerance,method,repeated_intervals,error,estimate,run_s,companion_s")
    for of_release in GRID:
        for tolerance in 1e-3, 1e-6:
            test.release(*of_release)
            error, estimate, statistics = test.error_and_estimate(tolerance, 0.002)
            timers = statistics["timers"]
            print(*of_release, f"{tolerance:g}", statistics["method"], statistics["counters"]["repeated_intervals"], f"{error:.2e}",
                  f"{estimate:.2e}", f"{timers['run']:.2f}", f"{timers['companion']:.2f}", sep=",", flush=True)
    test.doCleanups()


if __name__ == "__main__":
    if sys.argv[1:2] == ["grid"]:
        print_grid()
    else:
        main()
