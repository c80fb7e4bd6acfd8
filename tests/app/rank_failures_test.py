"""Runs under mpirun that fail on one rank: all ranks end, with the exit code and the sentence of the one that failed."""
import os
import pathlib
import resource
import shutil
import unittest

from program_test import DONE, PATIENCE, STOPPED, TIME_LIMIT, WRONG_INPUT
from ranks import MPIRUN, RanksTest

SCENE = {
    "Models": "continuum", "Continuum/Degree": 2, "Continuum/Refinements": 1, "Continuum/Symmetry": "octant",
    "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6",
    "Time/End": 0.2, "Time/Step": 0.01, "Time/Method": "rattle", "Output/Samples": 10, "Output/Graphics": "vtu",
    "Output/Frames": 10, "Output/Report": "true",
}
LONG = {**SCENE, "Time/End": 200, "Output/Samples": 10000, "Output/Frames": 10000}
SEARCH = {**SCENE, "Continuum/Degree": "auto", "Continuum/Refinements": "auto", "Continuum/Tolerance": 1e-4,
          "Time/End": 0.5}
# Each of these runs takes a second or two.
ENOUGH = min(TIME_LIMIT, 40 * PATIENCE)


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
class RankFailures(RanksTest):
    def check_end(self, result, code, *fragments, folder="out"):
        """One sentence, once; nothing still says that the run is at work."""
        self.assertNotIn("defect", result.stderr)
        sentences = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
        self.assertEqual(len(sentences), 1, result.stderr)
        for fragment in fragments:
            self.assertIn(fragment, sentences[0])
        self.assertNotIn("run.lock", self.files(folder))
        manifest = self.scratch / folder / "manifest.json"
        if manifest.is_file():
            content = self.json(manifest)
            self.assertNotEqual(content["state"], "running")
            if content["state"] != "done":
                self.assertEqual(content["exit_code"], code)

    def check(self, code, *fragments, arguments=()):
        result = self.run_on(2, "run", "scene.prm", "--output", "out", *arguments, code=code, seconds=ENOUGH)
        self.check_end(result, code, *fragments)

    def block(self, name):
        """Puts a folder where a file should be: root may write anything, but not this."""
        path = self.scratch / "out" / name
        if path.is_file():
            path.unlink()
        (path / "in the way").mkdir(parents=True)

    def start_until(self, name, scene):
        """mpirun, when a file of that name is there."""
        self.scene(scene)
        shutil.rmtree(self.scratch / "out", ignore_errors=True)
        process = self.start_ranks(self.command_on(2, "run", "scene.prm", "--output", "out"))
        self.wait_until(lambda: process.poll() is not None or (self.scratch / "out" / name).exists(), f"{name} is there")
        return process

    # At start.

    def test_results_that_cannot_be_written(self):
        for name in ("log.txt", "used.prm", "manifest.json", "continuum.csv", "continuum.pvd", "shapes.csv",
                     "report.html", "checkpoint-continuum.bin", "graphics/continuum-000000.pvtu",
                     "graphics/continuum-000000-0000.vtu", "graphics/continuum-000003-0001.vtu"):
            with self.subTest(name):
                self.scene(SCENE)
                self.block(name)
                self.check(STOPPED, f"cannot write 'out/{name}': Is a directory")
                shutil.rmtree(self.scratch / "out")

    def test_sweep_of_finite_elements(self):
        self.scene({**SCENE, "Output/Graphics": "none", "Sweep/Parameters": "h: 0.01, 0.02", "Time/Step": "$(h)"})
        result = self.run_on(2, "run", "scene.prm", "--output", "out", code=WRONG_INPUT, seconds=ENOUGH)
        sentences = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
        self.assertEqual(len(sentences), 1, result.stderr)
        self.assertIn("Sweep/Parameters", sentences[0])

    def test_directory_that_cannot_be_made(self):
        self.scene(SCENE)
        (self.scratch / "out").write_text("a file")
        result = self.run_on(2, "run", "scene.prm", "--output", "out", code=WRONG_INPUT, seconds=ENOUGH)
        self.assertEqual(result.stderr.count("error: "), 1, result.stderr)
        self.assertEqual((self.scratch / "out").read_text(), "a file")

    def test_scene_that_one_rank_does_not_find(self):
        self.scene(SCENE)
        self.scene({**SCENE, "Continuum/Degree": 99}, "other.prm")
        program = str(self.program)
        for scenes in ("scene.prm", "other.prm"), ("other.prm", "scene.prm"):
            command = [*MPIRUN, "-np", "1", program, "run", scenes[0], "--output", "out", ":",
                       "-np", "1", program, "run", scenes[1], "--output", "out"]
            result = self.finish_ranks(self.start_ranks(command), WRONG_INPUT, ENOUGH)
            sentences = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
            self.assertEqual(len(sentences), 1, result.stderr)
            self.assertIn("other.prm:", sentences[0])
            self.assertFalse((self.scratch / "out").exists())

    # While a discretisation is looked for.

    def test_search_that_cannot_be_noted_at_the_start(self):
        self.scene(SEARCH)
        self.block("checkpoint-discretization.bin")
        self.check(STOPPED, "cannot write 'out/checkpoint-discretization.bin': Is a directory")

    def test_search_that_cannot_be_noted_on_the_way(self):
        process = self.start_until("checkpoint-discretization.bin", SEARCH)
        self.block("checkpoint-discretization.bin")
        self.check_end(self.finish_ranks(process, STOPPED, ENOUGH), STOPPED,
                       "cannot write 'out/checkpoint-discretization.bin': Is a directory")

    def test_discarded_results_that_cannot_be_removed(self):
        process = self.start_until("checkpoint-discretization.bin", SEARCH)
        self.block("checkpoint-continuum.bin")
        self.check_end(self.finish_ranks(process, STOPPED), STOPPED, "checkpoint-continuum.bin")

    # At --resume.

    def stop_half_way(self, scene):
        """Results of a run that an inverted element has stopped."""
        self.scene({**scene, "Initial state/Velocity": "8, 0, 0; 0, 8, 0; 0, 0, -16"})
        self.run_on(2, "run", "scene.prm", "--output", "out", code=STOPPED)
        self.assertIn("checkpoint-continuum.bin", self.files("out"))

    def test_resume_without_the_rows(self):
        self.stop_half_way(SCENE)
        # The rows of samples are counted before anything changes: the manifest still tells of the run before.
        for name, told in ("continuum.csv", STOPPED), ("shapes.csv", WRONG_INPUT):
            with self.subTest(name):
                path = self.scratch / "out" / name
                whole = path.read_text()
                path.write_text(whole[:whole.index("\n") + 1])
                self.check_resume_refused(told, f"'out/{name}' has 0 rows")
                path.unlink()
                self.check_resume_refused(told, f"cannot read 'out/{name}': No such file")
                path.write_text(whole)

    def check_resume_refused(self, told, *fragments):
        result = self.run_on(2, "run", "scene.prm", "--output", "out", "--resume", code=WRONG_INPUT, seconds=ENOUGH)
        self.check_end(result, told, *fragments)

    def test_resume_of_a_search_from_a_checkpoint_of_another_kind(self):
        self.stop_half_way(SEARCH)
        shutil.copy(self.scratch / "out/checkpoint-continuum.bin", self.scratch / "out/checkpoint-discretization.bin")
        self.check(WRONG_INPUT, "it has no entry", arguments=["--resume"])

    def test_resume_where_one_rank_does_not_see_the_checkpoint(self):
        self.stop_half_way(SCENE)
        program = self.command([])
        resume = ["run", "scene.prm", "--resume", "--set", "Time/Step=0.001", "--output", "out"]
        elsewhere = self.scratch / "elsewhere"
        (elsewhere / "out").mkdir(parents=True)
        shutil.copy(self.scratch / "scene.prm", elsewhere)
        command = [*MPIRUN, "-np", "1", *program, *resume, ":", "-np", "1", "-wdir", str(elsewhere), *program, *resume]
        self.check_end(self.finish_ranks(self.start_ranks(command), WRONG_INPUT, ENOUGH), WRONG_INPUT,
                       "'out/checkpoint-continuum.bin' cannot be used")

    # In the midst of the motion.

    def ranks_under_way(self, scene):
        """mpirun and the processes of its ranks."""
        process = self.start_until("continuum.pvd", scene)
        ranks = {}
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                variables = (folder / "environ").read_bytes().split(b"\0")
                if f"PPid:\t{process.pid}\n" in (folder / "status").read_text():
                    ranks.update({int(v.split(b"=")[1]): int(folder.name) for v in variables
                                  if v.startswith(b"OMPI_COMM_WORLD_RANK=")})
            except OSError:
                pass
        self.assertEqual(sorted(ranks), [0, 1])
        return process, ranks

    def test_full_disk_of_either_rank(self):
        for rank in 0, 1:
            with self.subTest(rank):
                process, ranks = self.ranks_under_way(LONG)
                resource.prlimit(ranks[rank], resource.RLIMIT_FSIZE, (20000, resource.RLIM_INFINITY))
                self.check_end(self.finish_ranks(process, STOPPED, ENOUGH), STOPPED, "cannot write 'out/",
                               "File too large", "--resume")

    def test_memory_of_one_rank(self):
        """It cannot tell the others, which are within the step: it ends them."""
        self.skip_if_sanitized()
        for rank in 0, 1:
            with self.subTest(rank):
                process, ranks = self.ranks_under_way(LONG)
                resource.prlimit(ranks[rank], resource.RLIMIT_AS, (1 << 20, resource.RLIM_INFINITY))
                self.check_end(self.finish_ranks(process, STOPPED, ENOUGH), STOPPED, "the memory does not suffice")
                manifest = self.json("out/manifest.json")
                self.assertEqual((manifest["state"], manifest["exit_code"]), ("failed", STOPPED))
                self.assertIn("memory", manifest["message"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
