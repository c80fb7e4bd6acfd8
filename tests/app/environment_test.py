"""What a run meets outside itself: another run in its directory, terminals and pipes that are gone, signals, little
memory."""
import fcntl
import os
import pathlib
import re
import resource
import shutil
import signal
import socket
import subprocess
import termios
import unittest

from program_test import CONTINUUM_COLUMNS, DONE, STOPPED, WRONG_INPUT, largest_difference, overrides
from stopped_run import StoppedRunTest

SHORT = {"Models": "reduced", "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6", "Time/End": 1}
# Minutes.
LONG = {**SHORT, "Time/End": 1e5, "Time/Step": 1e-3, "Time/Method": "rattle-4", "Output/Samples": 100000}
BOTH = {**SHORT, "Models": "reduced, continuum", "Continuum/Degree": 2, "Time/Step": 0.02, "Time/Method": "rattle"}


class Environment(StoppedRunTest):
    def lock(self, folder="out"):
        return self.scratch / folder / "run.lock"

    def contents(self, folder="out"):
        return {name: self.bytes(folder, name) for name in self.files(folder)}

    def finish(self, process, code):
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), code)

    # One run in a directory.

    def test_a_second_run_in_the_directory_is_refused(self):
        for model, scene in ("reduced", LONG), ("continuum", {**BOTH, "Models": "continuum", "Time/End": 1e5}):
            with self.subTest(model):
                self.scene(scene)
                self.scene({**SHORT, "Title": "another"}, "other.prm")
                process = self.start("out")
                self.wait_until(lambda: self.has_rows("out", model), "the motion goes on")
                process.send_signal(signal.SIGSTOP)
                before = self.contents()
                for arguments in (["other.prm"], ["scene.prm"], ["scene.prm", "--resume"]):
                    refused = self.run_program("run", *arguments, "--output", "out")
                    self.assert_one_sentence(refused, "another run is at work in the output directory 'out' "
                                                      f"(process {process.pid}, since ")
                    self.assertEqual(self.contents(), before)
                process.send_signal(signal.SIGCONT)
                self.finish(process, STOPPED)
                self.check_interrupted("out")
                self.assertFalse(self.lock().exists())
                shutil.rmtree(self.scratch / "out")

    def test_the_lock_is_gone_after_every_end(self):
        self.scene(SHORT)
        self.scene({**SHORT, "Body/Density": 2}, "other.prm")
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (10000, 10000))
        for code, arguments, options in ((DONE, ["scene.prm"], {}), (DONE, ["scene.prm", "--resume"], {}),
                                         (WRONG_INPUT, ["other.prm", "--resume"], {}),
                                         (STOPPED, ["scene.prm"], {"preexec_fn": limit})):
            self.assert_exit(self.run_program("run", *arguments, "--output", "out", **options), code)
            self.assertEqual([name for name in self.files("out") if "lock" in name], [])

    def test_lock_of_a_killed_run_is_taken_over(self):
        self.scene(LONG)
        process = self.start("out")
        process.kill()
        process.wait()
        left = self.lock().read_text()
        self.assertIn(f"process: {process.pid}\n", left)
        self.scene(SHORT, "other.prm")
        self.run_done("run", "other.prm", "--output", "out")
        self.assertFalse(self.lock().exists())
        # The number has passed to another process; the machine, if it has an identity, has been started anew.
        edits = [(f"process: {process.pid}", f"process: {os.getpid()}")]
        if re.search(r"machine: \S", left):
            edits.append((r"boot: \S+", "boot: 00000000-0000-0000-0000-000000000000"))
        for found, instead in edits:
            other = re.sub(found, instead, left)
            self.assertNotEqual(other, left)
            self.lock().write_text(other)
            self.run_done("run", "other.prm", "--output", "out")
            self.assertFalse(self.lock().exists())

    def test_lock_that_cannot_be_judged(self):
        self.scene(LONG)
        process = self.start("out")
        process.kill()
        process.wait()
        left = self.lock().read_text()
        self.scene(SHORT, "other.prm")
        for text, who in ((left.replace(f"host: {socket.gethostname()}\n", "host: elsewhere\n"),
                           f"process {process.pid} on host elsewhere, since "),
                          (re.sub(r"numbering: \S+", "numbering: pid:[1]", left), f"process {process.pid} on host "),
                          # Another machine of the same name.
                          (re.sub(r"machine: .*", "machine: other", re.sub(r"boot: \S+", "boot: 1", left)), f"process {process.pid} on host "),
                          ("", "by whom cannot be read")):
            self.assertNotEqual(text, left)
            self.lock().write_text(text)
            before = self.contents()
            refused = self.run_program("run", "other.prm", "--output", "out")
            self.assert_one_sentence(refused, "'out' is locked by another run", who, "remove 'out/run.lock'")
            self.assertEqual(self.contents(), before)
        self.lock().unlink()
        self.run_done("run", "other.prm", "--output", "out")

    def check_one_of_many(self, **options):
        """All at once, one gets the directory."""
        processes = [self.start_program("run", "scene.prm", "--output", "out", **options) for _ in range(8)]
        ended = lambda: [process for process in processes if process.poll() is not None]
        self.wait_until(lambda: len(ended()) == 7, "all but one have ended")
        self.assertEqual([process.returncode for process in ended()], 7 * [WRONG_INPUT])
        winner, = set(processes) - set(ended())
        self.wait_until(lambda: self.has_rows("out", "reduced"), "the motion goes on")
        self.finish(winner, STOPPED)
        self.check_interrupted("out")
        self.assertEqual([name for name in self.files("out") if "lock" in name], [])

    def test_one_of_many_at_once(self):
        self.scene(LONG)
        self.check_one_of_many()

    def test_one_of_many_takes_a_stale_lock_over(self):
        self.scene(LONG)
        for _ in range(5):
            process = self.start("out")
            process.kill()
            process.wait()
            self.assertTrue(self.lock().exists())
            self.check_one_of_many()

    def test_processes_of_srun_without_mpi_are_runs_of_their_own(self):
        self.scene(LONG)
        self.check_one_of_many(env={**os.environ, "SLURM_PROCID": "1", "SLURM_STEP_NUM_TASKS": "8"})

    # Standard input, output and error.

    def with_shell(self, redirection, *arguments):
        command = ["sh", "-c", f'exec "$@" {redirection}', "sh", *self.command(arguments)]
        return subprocess.run(command, capture_output=True, text=True, cwd=self.scratch)

    def test_closed_streams(self):
        self.scene(BOTH)
        self.assertIn("frequency of C33", self.run_done("run", "scene.prm", "--output", "whole").stdout)
        for redirection in ">&-", "2>&-", "<&-", "<&- >&- 2>&-":
            with self.subTest(redirection):
                self.assert_exit(self.with_shell(redirection, "run", "scene.prm", "--output", "out"), DONE)
                for name in "reduced.csv", "continuum.csv", "comparison.csv":
                    self.assertEqual(self.bytes("out", name), self.bytes("whole", name))
                self.assertNotIn("frequency of C33", (self.scratch / "out/log.txt").read_text())

    def test_full_standard_output(self):
        self.scene({**BOTH, "Output/Report": "true"})
        result = self.with_shell(">/dev/full", "run", "scene.prm", "--output", "out")
        self.assert_exit(result, STOPPED)
        self.assertIn("error: cannot write 'standard output': No space left on device; the results are complete\n",
                      result.stderr)
        self.assertEqual(self.json("out/manifest.json")["exit_code"], STOPPED)
        self.assertLessEqual({"comparison.csv", "comparison.json", "report.html"}, set(self.files("out")))
        for arguments in (["check", "scene.prm"], ["parameters"], ["--version"], ["--help"], ["run", "--help"]):
            result = self.with_shell(">/dev/full", *arguments)
            self.assert_exit(result, STOPPED)
            self.assertEqual(result.stderr, "error: cannot write 'standard output': No space left on device\n")

    def test_reader_that_goes_away(self):
        self.scene(BOTH)
        reader, writer = os.pipe()
        os.close(reader)
        self.addCleanup(os.close, writer)
        both = {"capture_output": False, "stdout": writer, "stderr": writer}
        self.assert_exit(self.run_program("run", "scene.prm", "--output", "out", **both), DONE)
        self.assertEqual(self.json("out/manifest.json")["state"], "done")
        self.assertIn("comparison.json", self.files("out"))

    # Signals.

    def test_hangup_and_limit_of_time_are_interruptions(self):
        self.scene(LONG)
        for number in signal.SIGHUP, signal.SIGXCPU:
            with self.subTest(number):
                process = self.start("out")
                self.wait_until(lambda: self.has_rows("out", "reduced"), "the motion goes on")
                process.send_signal(signal.SIGSTOP)
                for _ in range(2):  # the kernel tells the processes of a terminal, and so does the shell
                    process.send_signal(number)
                    process.send_signal(signal.SIGCONT)
                self.assertEqual(process.wait(), STOPPED)
                self.check_interrupted("out")
                self.assertIn("checkpoint-reduced.bin", self.files("out"))

    def start_in_terminal(self, ignores_hangup):
        """A run that draws its progress line, and the side of the terminal that a user looks at."""
        user, terminal = os.openpty()
        def enter():
            os.setsid()
            fcntl.ioctl(terminal, termios.TIOCSCTTY, 0)
            if ignores_hangup:
                signal.signal(signal.SIGHUP, signal.SIG_IGN)
        process = self.start("out", stdout=terminal, stderr=terminal, preexec_fn=enter)
        os.close(terminal)
        self.wait_until(lambda: b" steps/s " in os.read(user, 1000), "the progress line is drawn")
        return process, user

    def test_terminal_that_is_closed(self):
        self.scene(LONG)
        process, user = self.start_in_terminal(ignores_hangup=False)
        os.close(user)
        self.assertEqual(process.wait(), STOPPED)
        self.check_interrupted("out")
        self.assertIn("checkpoint-reduced.bin", self.files("out"))

    def test_terminal_that_is_closed_under_nohup(self):
        self.scene({**LONG, "Time/End": 3000, "Output/Samples": 3000})
        process, user = self.start_in_terminal(ignores_hangup=True)
        os.close(user)
        self.assertEqual(process.wait(), STOPPED)  # the table of the run has no terminal to be printed on
        self.assertIn("; the results are complete", (self.scratch / "out/log.txt").read_text())
        self.assertEqual(len(self.table("out/reduced.csv")), 3001)

    def test_nohup(self):
        self.scene(LONG)
        process = self.start("out", preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.wait_until(lambda: self.has_rows("out", "reduced"), "the motion goes on")
        process.send_signal(signal.SIGHUP)
        n_rows = self.csv("out", "reduced").read_bytes().count(b"\n")
        self.wait_until(lambda: self.has_rows("out", "reduced", n_rows + 1) or process.poll() is not None, "it goes on")
        self.assertIsNone(process.poll())
        self.finish(process, STOPPED)

    def test_interruption_while_the_step_is_chosen(self):
        step = {"Time/Step": 0.01, "Time/Method": "rattle", "Time/Tolerance": 1e-3}
        self.scene({**SHORT, "Models": "continuum", "Continuum/Degree": 4, "Continuum/Refinements": 1,
                    "Time/Tolerance": 1e-9, "Output/Samples": 10})
        self.run_done("run", "scene.prm", "--output", "whole", *overrides(step))
        process = self.start("out")
        self.finish(process, STOPPED)
        self.assertNotIn("estimated time error", (self.scratch / "out/log.txt").read_text())
        manifest = self.json("out/manifest.json")
        self.assertEqual((manifest["state"], manifest["exit_code"]), ("interrupted", STOPPED))
        self.assertEqual(manifest["message"], "continuum interrupted while looking for the step")
        self.assertIn("(--resume goes on from there)", (self.scratch / "out/log.txt").read_text())
        self.assertIn("checkpoint-continuum.bin", self.files("out"))
        self.assertEqual(self.table("out/continuum.csv").header, CONTINUUM_COLUMNS)
        self.run_done("run", "scene.prm", "--output", "out", "--resume", *overrides(step))
        self.assertEqual(self.bytes("out/continuum.csv"), self.bytes("whole/continuum.csv"))

    # Memory.

    def test_memory_that_does_not_suffice(self):
        limited = lambda size: lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size))
        self.scene({**SHORT, "Models": "continuum", "Continuum/Degree": 6, "Continuum/Refinements": 2,
                    "Continuum/Symmetry": "none", "Time/Step": 0.01, "Time/Method": "rattle"})
        self.scene({**BOTH, "Models": "continuum"}, "small.prm")
        size = 700 << 20
        if self.run_program("run", "small.prm", "--output", "small", preexec_fn=limited(size)).returncode != DONE:
            self.skipTest("a sanitizer wants more address space than that for itself")
        result = self.run_program("run", "scene.prm", "--output", "out", preexec_fn=limited(size))
        self.assert_exit(result, STOPPED)
        self.assertIn("error: the memory does not suffice for this scene\n", result.stderr)
        self.assertNotIn("defect", result.stderr)
        manifest = self.json("out/manifest.json")
        self.assertEqual((manifest["state"], manifest["exit_code"]), ("failed", STOPPED))
        self.assertFalse(self.lock().exists())

    # The processor.

    def test_kernels_of_every_build_compute_the_same(self):
        """Whatever PSEUDORIGID_NATIVE says: "native" alone, or each level of x86-64 that this processor has."""
        self.scene(BOTH)
        env = {**os.environ, "PSEUDORIGID_INSTRUCTIONS": "abacus"}
        refused = self.run_program("run", "scene.prm", env=env)
        self.assert_one_sentence(refused, 'PSEUDORIGID_INSTRUCTIONS is "abacus"; pseudorigid was built for ')
        self.assertEqual(self.files(), ["scene.prm"])
        names = refused.stderr.strip().split(" was built for ")[1].split(", ")
        ran = []
        for name in names:
            run = self.run_program("run", "scene.prm", "--output", name, env={**env, "PSEUDORIGID_INSTRUCTIONS": name})
            if run.returncode == WRONG_INPUT:
                self.assert_one_sentence(run, f"this processor does not have the instructions {name} ")
                continue
            self.assert_exit(run, DONE)
            self.assertEqual(self.json(name, "manifest.json")["instructions"], name)
            ran.append(self.table(name, "continuum.csv"))
        self.assertGreater(len(ran), 0)
        for table in ran[1:]:
            self.assertLess(largest_difference(table, ran[0]), 1e-10, "round-off of 50 steps, constraints to 1e-13")
        self.run_done("run", "scene.prm", "--output", "chosen")
        chosen = self.json("chosen", "manifest.json")["instructions"]
        self.assertEqual(self.bytes("chosen", "continuum.csv"), self.bytes(chosen, "continuum.csv"))

    def test_kernels_of_openblas_fit_the_processor(self):
        """A model of processor that OpenBLAS does not know would get kernels without AVX."""
        self.scene({**BOTH, "Models": "continuum"})
        env = {name: value for name, value in os.environ.items() if name != "OPENBLAS_CORETYPE"}

        def kernels(name, **more):
            run = self.run_program("run", "scene.prm", "--output", name, env={**env, "OPENBLAS_VERBOSE": "2", **more})
            self.assert_exit(run, DONE)
            return re.findall(r"^Core: (\w+)$", run.stderr, re.MULTILINE)

        (asked_for,) = kernels("asked", OPENBLAS_CORETYPE="NEHALEM") or [None]
        if asked_for is None:
            self.skipTest("the library of BLAS is not OpenBLAS")
        self.assertEqual(asked_for, "Nehalem")
        flags = set(pathlib.Path("/proc/cpuinfo").read_text().split())
        if "avx2" in flags:
            self.assertEqual(kernels("chosen"), ["SkylakeX" if "avx512vl" in flags else "Haswell"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
