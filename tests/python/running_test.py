"""The Python package runs scenes: entries, exit codes as exceptions, sweeps, the examples that need no continuum."""
import os
import signal
import stat
import subprocess
import sys
import unittest.mock

import numpy as np

import pseudorigid
from pseudorigid.errors import exit_code_of
from pseudorigid.program import entry_text
from program_test import ProgramTest, SOURCE, STOPPED, main

FREE = {"Models": "reduced", "Time/End": 1, "Output/Samples": 5}
INVERTED = {"Models": "reduced", "Body/Incompressible": False, "Material/Law": "saint-venant-kirchhoff", "Time/End": 10,
            "Initial state/Velocity": np.diag([-20, 0, 0])}
# Ctrl-C reaches Python alone, as in a notebook.
LONG_RUN = """
import pseudorigid
try:
    pseudorigid.run({"Models": "reduced", "Time/End": 1e6, "Time/Step": 1e-4, "Time/Method": "rattle"}, output="long", quiet=False)
except pseudorigid.Stopped as stopped:
    print(stopped, stopped.directory)
"""


class Running(ProgramTest):
    def setUp(self):
        super().setUp()
        environment = unittest.mock.patch.dict(os.environ, {"PSEUDORIGID": str(self.program)})
        environment.start()
        self.addCleanup(environment.stop)

    def fake_program(self, script):
        path = self.scratch / "fake"
        path.write_text("#!/bin/sh\n" + script)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def test_values_of_entries(self):
        for value, text in ((True, "true"), (3, "3"), (1e-9, "1e-09"), ("auto", "auto"), ([1, 0.5], "1, 0.5"), (["reduced", "continuum"], "reduced, continuum"),
                            ([[1, 2], [3, 4]], "1, 2; 3, 4"), (np.eye(2), "1.0, 0.0; 0.0, 1.0"), (np.float64(0.1), "0.1"),
                            ([np.array([1, 2]), np.array([3, 4])], "1, 2; 3, 4")):
            self.assertEqual(entry_text(value), text)

    def test_errors_are_rounded_up_as_the_program_does_it(self):
        """The values of tests/analysis/comparison_report_test.cpp."""
        for error, text in ((0, "0"), (0.0804, "0.09"), (0.08, "0.08"), (9.3e-7, "1e-06"), (31, "4e+01"), (0.0031, "0.004")):
            self.assertEqual(pseudorigid.printed_error(error), text)

    def test_a_file_and_entries_alone(self):
        Q = np.diag([0.8, 1, 1.25])
        alone = pseudorigid.run(FREE, {"Initial state/Deformation": Q}, output=self.scratch / "alone", launcher=["nice", "-n", "1"])
        self.scene(FREE)
        of_file = pseudorigid.run(self.scratch / "scene.prm", {"Initial state/Deformation": Q, "Output/Directory": str(self.scratch)})
        self.assertEqual(of_file.directory, self.scratch / "scene")
        for run in alone, of_file:
            np.testing.assert_array_equal(run.matrices("reduced", "Q")[0], Q)
        np.testing.assert_array_equal(alone.records("reduced"), of_file.records("reduced"))

    def test_what_is_printed(self):
        self.assertIn("pseudo-rigid", pseudorigid.check(FREE))
        self.assertIn("Time/End", [entry["entry"] for entry in pseudorigid.parameters()])

    def test_exit_codes_are_exceptions(self):
        for ask in pseudorigid.run, pseudorigid.check:
            with self.assertRaises(pseudorigid.WrongInput) as wrong:
                ask({**FREE, "Time/Ende": 1})
            self.assertRegex(str(wrong.exception), r'\A[^\n]*"Time/Ende"[^\n]*"Time/End"[^\n]*\Z')
        with self.assertRaises(pseudorigid.Stopped) as stopped:
            pseudorigid.run(INVERTED, output=self.scratch / "stopped")
        self.assertEqual(stopped.exception.directory, self.scratch / "stopped")
        self.assertEqual(pseudorigid.Run(stopped.exception.directory).manifest["exit_code"], STOPPED)
        for script, sentence in (("echo 'error: it broke' >&2; exit 1", "it broke"), ("kill -9 $$", "code -9")):
            with self.assertRaisesRegex(pseudorigid.Defect, sentence):
                pseudorigid.run(FREE, program=self.fake_program(script))

    def test_a_command_that_cannot_be_started(self):
        (self.scratch / "text").write_text("no program")
        for ask in (lambda: pseudorigid.run(FREE, launcher=["nowhere"]), lambda: pseudorigid.run(FREE, program=self.scratch / "text"),
                    lambda: pseudorigid.check(FREE, program=self.scratch / "text"), lambda: pseudorigid.run(FREE, program=self.scratch)):
            with self.assertRaises(pseudorigid.WrongInput):
                ask()

    def test_the_program_is_found_or_missed(self):
        self.assertEqual(pseudorigid.find_program(), self.program)
        os.environ["PSEUDORIGID"] = str(self.scratch / "nowhere")
        with self.assertRaisesRegex(pseudorigid.WrongInput, "nowhere does not exist"):
            pseudorigid.run(FREE)

        def fails():
            raise pseudorigid.Stopped("full")

        self.assertEqual(exit_code_of(fails), STOPPED)

    def test_an_interrupted_run_goes_on(self):
        started = subprocess.Popen([sys.executable, "-c", LONG_RUN], cwd=self.scratch, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end_process, started)
        # The first line that Python shows: it waits for the program now, and no longer starts it.
        started.stderr.readline()
        started.send_signal(signal.SIGINT)
        printed, _ = started.communicate()
        self.assertRegex(printed, "interrupted at t = .* long\n")
        with self.assertRaises(pseudorigid.WrongInput):
            pseudorigid.run(FREE, output=self.scratch / "none", resume=True)

    def test_a_sweep(self):
        run = pseudorigid.run({**FREE, "Sweep/Parameters": "l: 1.1, 1.2", "Sweep/Trajectories": True,
                               "Initial state/Deformation": "$(l), 0, 0; 0, 1, 0; 0, 0, $(1/l)"}, output=self.scratch / "sweep")
        sweep, all_samples = run.sweep(), run.table("trajectories")
        self.assertEqual((sweep.index.name, sweep.index.tolist()), ("run", [1, 2]))
        self.assertEqual(sweep["l"].tolist(), [1.1, 1.2])
        self.assertEqual([sweep.attrs["units"][name] for name in ("l", "a1_end", "energy_drift", "frequency", "Q11_max")],
                         ["", "length", "mass*length^2/time^2", "1/time", ""])
        self.assertEqual(all_samples.loc[2, "Q11"].index.tolist(), [0, 0.2, 0.4, 0.6, 0.8, 1])
        self.assertEqual(all_samples.loc[(2, 1), "a1"], sweep.loc[2, "a1_end"])
        with unittest.mock.patch.dict(sys.modules, {"pandas": None}):
            records = run.sweep()
        self.assertEqual(records["a1_end"].tolist(), sweep["a1_end"].tolist())

    def test_damaged_files_are_refused(self):
        run = pseudorigid.run(FREE, output=self.scratch / "run")
        with open(run.directory / "reduced.csv", "a") as file:
            file.write("1,2\n")
        with self.assertRaisesRegex(pseudorigid.WrongInput, "damaged row"):
            run.columns("reduced")
        (run.directory / "manifest.json").write_text("{")
        with self.assertRaisesRegex(pseudorigid.WrongInput, "manifest.json is damaged"):
            pseudorigid.Run(run.directory)

    # Examples.

    def run_example(self, name):
        return subprocess.run([sys.executable, SOURCE / "python/examples" / name, self.scratch / "out"], check=True, capture_output=True,
                              text=True, cwd=self.scratch).stdout

    def test_example_of_a_sweep(self):
        """ω/ω₀ = 1 + cA² + dA⁴ with c = −5/48 (docs/polynomial.md); the next power, left out of the fit, changes c by some 1e-4."""
        self.assertAlmostEqual(float(self.run_example("sweep.py").split("c = ")[1]), -5 / 48, delta=5e-4)
        self.assertTrue((self.scratch / "out/frequency.svg").is_file())

    def test_example_of_equilibria(self):
        printed = self.run_example("spheroids.py")
        self.assertLess(float(printed.split("largest error of Omega^2: ")[1].split()[0]), 1e-12)
        self.assertIn('"maclaurins"', printed)


if __name__ == "__main__":
    main()
