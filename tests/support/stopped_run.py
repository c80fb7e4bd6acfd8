"""The base of tests of runs that end before their time: Ctrl-C, SIGTERM, SIGKILL, and how they go on with --resume."""
import random
import signal
import time

from program_test import DONE, ProgramTest, STOPPED, largest_difference


class StoppedRunTest(ProgramTest):
    def csv(self, folder, model):
        return self.scratch / folder / f"{model}.csv"

    def has_rows(self, folder, model, n=1):
        path = self.csv(folder, model)
        return path.exists() and path.read_bytes().count(b"\n") > n

    def resume(self, *arguments, folder):
        """Goes on, or begins anew where the first run did not live to write a checkpoint."""
        has_checkpoint = any(name.startswith("checkpoint") and name.endswith(".bin") for name in self.files(folder))
        return self.run_program("run", "scene.prm", "--output", folder, *(["--resume"] if has_checkpoint else []), *arguments)

    def assert_finished_like(self, folder, expected, tolerance=0.0):
        """The CSV files, pictures and collections of the folder are those of the uninterrupted run."""
        results = [name for name in self.files(expected) if name.endswith((".csv", ".pvd", ".vtu"))]
        self.assertTrue(results)
        self.assertEqual(self.files(folder), self.files(expected))
        for name in results:
            with self.subTest(name):
                if tolerance == 0.0 or name.endswith(".pvd"):
                    self.assertEqual(self.bytes(folder, name), self.bytes(expected, name))
                elif name.endswith(".csv"):
                    difference = largest_difference(self.table(expected, name), self.table(folder, name))
                    print(f"{name}: largest difference {difference:.1e}")
                    # The comparison divides differences by amplitudes, or by each other.
                    self.assertLess(difference, 100 * tolerance if name == "comparison.csv" else tolerance)
        self.assertEqual(self.json(folder, "manifest.json")["state"], "done")

    def start(self, folder, *arguments, **options):
        """A process that has opened its log, and so listens to signals."""
        log = self.scratch / folder / "log.txt"
        size_before = log.stat().st_size if log.exists() else 0
        process = self.start_program("run", "scene.prm", "--output", folder, *arguments, **options)
        self.wait_until(lambda: process.poll() is not None or (log.exists() and log.stat().st_size not in (0, size_before)),
                        "the log grows")
        return process

    def interrupt(self, model, folder, *arguments, after_rows=0):
        process = self.start(folder, *arguments)
        self.wait_until(lambda: self.has_rows(folder, model, after_rows) or process.poll() is not None, "the motion goes on")
        process.send_signal(signal.SIGINT)
        return process.wait()

    def check_interrupted(self, folder):
        manifest = self.json(folder, "manifest.json")
        self.assertEqual((manifest["state"], manifest["exit_code"]), ("interrupted", STOPPED))
        self.assertRegex(manifest["message"], r"interrupted at t = [0-9.e-]+")

    def check_control_c(self, scene, model, tolerance=0.0, after_rows=0):
        """Interrupted in its midst and resumed, a run ends like an uninterrupted one."""
        self.scene(scene)
        self.run_done("run", "scene.prm", "--output", "whole")
        self.assertEqual(self.interrupt(model, "parts", after_rows=after_rows), STOPPED)
        self.check_interrupted("parts")
        self.assertLess(len(self.table(f"parts/{model}.csv")), len(self.table(f"whole/{model}.csv")))
        self.assert_exit(self.resume(folder="parts"), DONE)
        self.assert_finished_like("parts", "whole", tolerance)

    def kill(self, folder, seconds, *arguments, stand_still=False):
        """Kills a run after a while; standing still for more than five seconds makes the next step write a checkpoint."""
        process = self.start_program("run", "scene.prm", "--output", folder, *arguments)
        time.sleep(seconds)
        if stand_still:
            process.send_signal(signal.SIGSTOP)
            time.sleep(5.1)
            process.send_signal(signal.SIGCONT)
            time.sleep(0.15)
        process.kill()
        return process.wait()

    def check_kills(self, scene, model, tolerance, n_kills):
        """Ends by SIGKILL at random moments; a SIGTERM in between leaves checkpoints in the middle of the motion."""
        seed = random.randrange(10**6)
        print(f"seed {seed}")
        moments = random.Random(seed)
        self.scene(scene)
        start = time.monotonic()
        self.run_done("run", "scene.prm", "--output", "whole")
        duration = time.monotonic() - start
        for i in range(n_kills):
            arguments = ["--resume"] if (self.scratch / f"parts/checkpoint-{model}.bin").exists() else []
            if i % 3 == 1:
                process = self.start("parts", *arguments)
                time.sleep(moments.uniform(0, 0.2) * duration)
                process.terminate()
                self.assertIn(process.wait(), (STOPPED, DONE))
            else:
                self.kill("parts", moments.uniform(0, 0.6) * duration, *arguments)
        self.assert_exit(self.resume(folder="parts"), DONE)
        self.assert_finished_like("parts", "whole", tolerance)
