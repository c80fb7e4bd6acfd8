"""Runs that end before their time: inverted elements, Ctrl-C, a full disk, SIGKILL; and how they go on with --resume."""
import math
import pathlib
import resource
import signal
import subprocess
import time
import unittest

import checkpoint_file
from program_test import CONTINUUM_COLUMNS, DONE, STOPPED, TIME_LIMIT, largest_difference, overrides
from stopped_run import StoppedRunTest

# About a second each; a step that is given needs no pilot runs.
LONG_REDUCED = {
    "Models": "reduced",
    "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8",
    "Initial state/Velocity": "0.25, -1, 0.125; 0.6, -0.3, 0.2; 0, -0.08, 0.08",
    "Time/End": 200, "Time/Step": 1e-3, "Time/Method": "rattle-4", "Output/Samples": 2000,
}
LONG_CONTINUUM = {
    "Models": "continuum", "Continuum/Degree": 3,
    "Initial state/Deformation": "0.95, 0, 0; 0, 0.95, 0; 0, 0, 1.1080332409972299",
    "Time/End": 8, "Time/Step": 2e-3, "Time/Method": "rattle", "Output/Samples": 400,
}
PICTURES = {"Output/Graphics": "vtu", "Output/Frames": 21}


class StoppedRun(StoppedRunTest):
    # Elements that invert.

    def check_stopped_by_inversion(self, result):
        self.assert_exit(result, STOPPED)
        self.assertRegex(result.stderr, r"error: continuum stopped at t = [0-9.e-]+: an element is turned inside out: "
                                        r"det F = -[0-9.e-]+ at X/r = \([^)]*\); the state at t = [0-9.e-]+, the last sample, is saved, "
                                        r"least det F = [0-9.e-]+ at X/r = \([^)]*\)")
        self.assertIn("--resume", result.stderr)
        self.assertTrue((self.scratch / "output/scene/checkpoint-continuum.bin").exists())
        table = self.table("output/scene/continuum.csv")
        self.assertTrue(table.is_finite())
        self.assertEqual(table.header, CONTINUUM_COLUMNS + ["volumetric"])  # the starts are violent
        manifest = self.json("output/scene/manifest.json")
        self.assertEqual((manifest["state"], manifest["exit_code"]), ("failed", STOPPED))
        self.assertIn("turned inside out", manifest["message"])
        self.assertIn("turned inside out", (self.scratch / "output/scene/log.txt").read_text())
        return table

    def test_far_too_large_step(self):
        self.scene({"Models": "continuum", "Continuum/Degree": 2,
                    "Initial state/Deformation": "0.8, 0, 0; 0, 1.25, 0; 0, 0, 1",
                    "Time/End": 2, "Time/Step": 0.2, "Time/Method": "rattle", "Output/Samples": 10})
        stopped = self.check_stopped_by_inversion(self.run_program("run", "scene.prm"))
        self.assertLess(len(stopped), 11)
        self.assert_exit(self.run_program("run", "scene.prm", "--resume", "--set", "Time/Step=0.02"), DONE)
        resumed = self.table("output/scene/continuum.csv")
        self.assertEqual(len(resumed), 11)
        self.assertTrue(resumed.is_finite())
        self.assertEqual(resumed.rows[:len(stopped)], stopped.rows)

    VIOLENT = {"Models": "continuum", "Continuum/Degree": 3, "Initial state/Velocity": "8, 0, 0; 0, 8, 0; 0, 0, -16",
               "Time/End": 4, "Output/Samples": 200}

    def test_velocity_that_no_mesh_stands(self):
        self.scene({**self.VIOLENT, "Time/Step": 2e-3, "Time/Method": "rattle"})
        stopped = self.check_stopped_by_inversion(self.run_program("run", "scene.prm", "--quiet"))
        self.assertGreater(len(stopped), 1)
        smaller = self.run_program("run", "scene.prm", "--quiet", "--resume", "--set", "Time/Step=1e-4")
        self.assert_exit(smaller, STOPPED)
        self.assertGreater(len(self.table("output/scene/continuum.csv")), len(stopped))

    def test_velocity_that_no_mesh_stands_with_a_chosen_step(self):
        self.scene({**self.VIOLENT, "Initial state/Velocity": "40, 0, 0; 0, 40, 0; 0, 0, -80"})
        stopped = self.run_program("run", "scene.prm", "--quiet", timeout=15)
        self.assert_exit(stopped, STOPPED)
        self.assertRegex(stopped.stderr, r"error: continuum stopped at t = [0-9.e-]+: .*; the state at t = [0-9.e-]+, the last sample, is saved, least det F")
        counters = self.json("output/scene/manifest.json")["models"]["continuum"]["counters"]
        self.assertTrue(0 < counters["failed_intervals"] <= counters["repeated_intervals"])

    def test_surface_that_passes_through_itself(self):
        """A violent release with strong self-gravity. Without the end, the discrete gravity attracts the folds without a bound."""
        side = 1 / math.sqrt(3)
        self.scene({"Models": "continuum", "Continuum/Degree": 3, "Gravity/Constant": 12,
                    "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, 3",
                    "Time/End": 4, "Output/Samples": 40, "Time/Tolerance": 1e-3})
        result = self.run_program("run", "scene.prm")
        self.assert_exit(result, STOPPED)
        self.assertIn("passes through itself", result.stderr)
        of_ball = -0.6 * 12 * (4 * math.pi / 3)**2
        self.assertGreater(min(self.table("output/scene/continuum.csv").column("gravitational")), 1.05 * of_ball)

    def test_control_c_within_intervals_that_are_integrated_again(self):
        """The checkpoint also has the last sample: if shorter steps are asked for, the whole interval is repeated. Interrupted again
        and again, such a run ends like an undisturbed one."""
        side = 1 / math.sqrt(1.5)
        self.scene({"Models": "continuum", "Continuum/Degree": 3,
                    "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, 1.5",
                    "Time/End": 40, "Output/Samples": 40, "Time/Tolerance": 1e-4})
        self.run_done("run", "scene.prm", "--output", "whole")
        code, has_last_sample = self.interrupt("continuum", "parts"), False
        while code == STOPPED:
            self.check_interrupted("parts")
            has_last_sample |= "last sample: q" in checkpoint_file.read(self.scratch / "parts/checkpoint-continuum.bin")
            process = self.start("parts", "--resume")
            time.sleep(0.15)
            process.send_signal(signal.SIGINT)
            code = process.wait()
        self.assertEqual(code, DONE)
        self.assertTrue(has_last_sample)
        self.assert_finished_like("parts", "whole")
        for counter in "repeated_intervals", "steps":
            part, whole = (self.json(folder, "manifest.json")["models"]["continuum"]["counters"][counter] for folder in ("parts", "whole"))
            self.assertEqual(part, whole, counter)
            self.assertGreater(whole, 0)

    def test_comparison_of_what_both_models_reached(self):
        self.scene({"Models": "reduced, continuum", "Continuum/Degree": 2,
                    "Initial state/Deformation": "0.8, 0, 0; 0, 1.25, 0; 0, 0, 1",
                    "Time/End": 2, "Time/Step": 0.2, "Time/Method": "rattle", "Output/Samples": 10})
        self.check_stopped_by_inversion(self.run_program("run", "scene.prm"))
        self.assertEqual(len(self.table("output/scene/reduced.csv")), 11)
        self.run_done("run", "scene.prm", "--resume", "--set", "Time/Step=0.02")
        self.assertEqual(len(self.table("output/scene/comparison.csv")), 11)
        self.assertEqual(self.json("output/scene/comparison.json")["samples"], 11)

    # Ctrl-C.

    def test_control_c_reduced(self):
        self.check_control_c(LONG_REDUCED, "reduced")

    def test_control_c_continuum(self):
        self.check_control_c({**LONG_CONTINUUM, **PICTURES}, "continuum", 1e-11)

    def test_control_c_compressible(self):
        self.check_control_c({**LONG_CONTINUUM, "Body/Incompressible": "false"}, "continuum", 1e-11)

    def test_control_c_while_the_finite_element_library_is_opened(self):
        self.scene({"Models": "continuum", "Continuum/Degree": 3, "Time/End": 50, "Output/Samples": 500})
        process = self.start_program("run", "scene.prm")
        maps = pathlib.Path(f"/proc/{process.pid}/maps")
        self.wait_until(lambda: process.poll() is not None or "libpseudorigid-continuum" in maps.read_text(), "the library is mapped")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), STOPPED)
        self.assertEqual(self.json("output/scene/manifest.json")["state"], "interrupted")
        self.assert_exit(self.run_program("run", "scene.prm", "--resume"), DONE)

    def test_control_c_in_the_first_of_two_models(self):
        self.scene({**LONG_REDUCED, "Models": "reduced, continuum", "Continuum/Degree": 2, "Time/End": 2,
                    "Output/Samples": 10, "Time/Step": 2e-6})
        self.assertEqual(self.interrupt("reduced", "output/scene"), STOPPED)
        self.assertNotIn("continuum.csv", self.files("output/scene"))
        self.assertNotIn("comparison.json", self.files("output/scene"))
        self.run_done("run", "scene.prm", "--resume", "--set", "Time/Step=0.01")
        self.assertEqual(len(self.table("output/scene/comparison.csv")), 11)

    def check_control_c_of_an_analysis(self, entries, message):
        self.scene(entries)
        process = self.start_program("run", "scene.prm", stderr=subprocess.PIPE, text=True)
        self.wait_until((self.scratch / "output/scene/manifest.json").exists, "the run to begin")
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=TIME_LIMIT)
        self.assertEqual(process.returncode, STOPPED, errors)
        self.assertIn(message, errors)
        manifest = self.json("output/scene/manifest.json")
        self.assertEqual((manifest["state"], manifest["exit_code"]), ("interrupted", STOPPED))

    def test_control_c_while_modes_are_looked_for(self):
        self.check_control_c_of_an_analysis(
            {"Analysis": "modes", "Models": "continuum", "Continuum/Degree": 5, "Continuum/Refinements": 1,
             "Modes/Number": 30},
            "interrupted while looking for the modes")

    def test_control_c_along_a_family_of_equilibria(self):
        self.check_control_c_of_an_analysis(
            {"Analysis": "equilibrium", "Models": "reduced", "Material/Law": "none", "Gravity/Constant": 1,
             "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.01, "Equilibrium/Last": 0.99,
             "Equilibrium/Number": 1000000},
            "equilibria interrupted after ")
        self.assertGreater(len(self.table("output/scene/equilibria.csv")), 0)

    def test_another_method_after_an_interruption_within_an_interval(self):
        self.scene({**LONG_REDUCED, "Output/Samples": 4, "Time/End": 8, "Time/Step": 1e-6, "Time/Method": "rattle"})
        self.run_done("run", "scene.prm", "--output", "exact", *overrides(
            {"Time/Method": "rattle-8", "Time/Step": "auto", "Time/Tolerance": 1e-11}))
        self.assertEqual(self.interrupt("reduced", "parts"), STOPPED)
        other = overrides({"Time/Method": "rattle-8", "Time/Step": "auto", "Time/Tolerance": 1e-9})
        self.assertEqual(self.interrupt("reduced", "parts", "--resume", *other), STOPPED)  # still in that interval
        self.run_done("run", "scene.prm", "--output", "parts", "--resume", *other)
        difference = largest_difference(self.table("exact/reduced.csv"), self.table("parts/reduced.csv"))
        print(f"largest difference {difference:.1e}")
        self.assertLess(difference, 1e-7)
        self.assertEqual(self.json("parts/manifest.json")["models"]["reduced"]["counters"]["order"], 8)

    def test_resuming_a_finished_run_changes_nothing(self):
        self.scene({**LONG_REDUCED, "Time/End": 2, **PICTURES})
        self.run_done("run", "scene.prm")
        before = {name: self.bytes("output/scene", name) for name in self.files("output/scene") if name.endswith(
            (".csv", ".pvd", ".vtu"))}
        for step in ("1e-3", "1e-4"):
            again = self.run_done("run", "scene.prm", "--resume", "--set", f"Time/Step={step}")
            self.assertNotIn("warning", again.stderr)
            for name, content in before.items():
                self.assertEqual(self.bytes("output/scene", name), content, name)

    # A later end.

    def check_a_later_end(self, scene, model, tolerance, end):
        """A run that is resumed to a later end, even twice, is the run to that end: samples keep their distance. Powers of two
        keep the last digits of the times."""
        n = scene["Output/Samples"]
        self.scene({**scene, **PICTURES, "Output/Frames": n // 2 + 1})
        pictures = lambda factor: {"Output/Frames": factor * (n // 2) + 1}
        self.run_done("run", "scene.prm", "--output", "whole",
                      *overrides({"Time/End": 4 * end, "Output/Samples": 4 * n, **pictures(4)}))
        self.run_done("run", "scene.prm", "--output", "parts", *overrides({"Time/End": end}))
        for factor in (2, 4):
            resumed = self.run_done("run", "scene.prm", "--output", "parts", "--resume",
                                    *overrides({"Time/End": factor * end, **pictures(factor)}))
            self.assertIn(f"Output/Samples = {factor * n}", resumed.stderr)
        self.assert_finished_like("parts", "whole", tolerance)
        self.assertIn(f"set Samples = {4 * n}", (self.scratch / "parts/used.prm").read_text())

    def test_a_later_end_reduced(self):
        self.check_a_later_end({**LONG_REDUCED, "Output/Samples": 20}, "reduced", 0.0, 1)

    def test_a_later_end_continuum(self):
        self.check_a_later_end({**LONG_CONTINUUM, "Output/Samples": 10}, "continuum", 1e-11, 0.2)

    def test_a_later_end_with_chosen_steps_and_other_pictures(self):
        """Steps are found anew for the rest, and old pictures stay beside the new ones."""
        self.scene({**LONG_REDUCED, "Time/Method": "auto", "Time/Step": "auto", "Time/Tolerance": 1e-8, "Time/End": 2,
                    "Output/Samples": 40, "Output/Graphics": "vtu", "Output/Frames": 5})
        self.run_done("run", "scene.prm", "--output", "parts")
        self.run_done("run", "scene.prm", "--output", "parts", "--resume", *overrides({"Time/End": 6}))
        self.run_done("run", "scene.prm", "--output", "whole", *overrides({"Time/End": 6, "Output/Samples": 120}))
        difference = largest_difference(self.table("whole/reduced.csv"), self.table("parts/reduced.csv"))
        self.assertLess(difference, 1e-5)  # energies and momenta beside Q, of which 1e-8 is promised
        self.assertEqual([time for time, _ in self.pvd("parts/reduced.pvd")], [0, 0.5, 1, 1.5, 2, 3, 4.5, 6])
        self.assertEqual([name for _, name in self.pvd("parts/reduced.pvd")],
                         [f"graphics/reduced-{j:06}.vtu" for j in range(8)])

    def test_a_later_end_of_a_system(self):
        self.scene({"System": "double pendulum", "Double pendulum/Angles": "0.3, 0.1", "Time/End": 2, "Output/Samples": 20})
        self.run_done("run", "scene.prm", "--output", "parts")
        self.run_done("run", "scene.prm", "--output", "parts", "--resume", *overrides({"Time/End": 3}))
        self.assertEqual(self.table("parts/double_pendulum.csv").column("time")[-1], 3)

    # A warning that has been given.

    def test_the_limit_of_the_surface_is_reported_once(self):
        """A ball squeezed to a third of its height is below Biot's ratio 0.2956 of its stretches from the start."""
        self.scene({"Models": "continuum", "Continuum/Degree": 2, "Time/Method": "rattle", "Time/Step": 1e-3,
                    "Initial state/Deformation": "2, 0, 0; 0, 2, 0; 0, 0, 0.25", "Time/End": 0.05, "Output/Samples": 5})
        self.run_program("run", "scene.prm", "--output", "parts")
        first = self.json("parts/manifest.json")["models"]["continuum"]["counters"]["surface_limit_time"]
        self.run_program("run", "scene.prm", "--output", "parts", "--resume", *overrides({"Time/End": 0.1}))
        self.assertEqual((self.scratch / "parts/log.txt").read_text().count("reaches Biot's limit"), 1)
        self.assertEqual(self.json("parts/manifest.json")["models"]["continuum"]["counters"]["surface_limit_time"], first)

    # A full disk.

    @staticmethod
    def limit_files_to(size):
        return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    def check_full_disk(self, scene, model, size, file, tolerance):
        self.scene(scene)
        self.run_done("run", "scene.prm", "--output", "whole")
        full = self.run_program("run", "scene.prm", "--output", "parts", preexec_fn=self.limit_files_to(size))
        self.assert_exit(full, STOPPED)
        self.assertRegex(full.stderr, rf"error: cannot write '[^']*{file}': File too large; .*--resume")
        self.assertNotIn("defect", full.stderr)
        cut = self.csv("parts", model).read_bytes()
        self.assertTrue(cut.endswith(b"\n") and len(cut) <= size)
        self.assertLessEqual(set(self.files("parts")), set(self.files("whole")), "no partial file is left")
        self.assert_exit(self.resume(folder="parts"), DONE)
        self.assert_finished_like("parts", "whole", tolerance)

    def test_full_disk_reduced(self):
        self.check_full_disk({**LONG_REDUCED, "Time/End": 20}, "reduced", 300_000, "reduced.csv", 0.0)

    def test_full_disk_at_a_picture(self):
        self.check_full_disk({**LONG_REDUCED, **PICTURES, "Time/End": 2, "Output/Samples": 40}, "reduced", 20_000,
                             "reduced-000000.vtu", 0.0)

    def test_full_disk_continuum(self):
        self.check_full_disk({**LONG_CONTINUUM, "Time/End": 1}, "continuum", 100_000, "continuum.csv", 1e-11)

    def test_full_disk_before_the_step_is_reduced(self):
        self.check_full_disk({"Models": "continuum", "Continuum/Degree": 3, "Time/End": 3, "Output/Samples": 60,
                              "Initial state/Velocity": "-1.2, 0, 0; 0, -1.2, 0; 0, 0, 2.4", "Time/Method": "rattle",
                              "Time/Tolerance": 0.1}, "continuum", 24_000, "continuum.csv", 1e-11)
        self.assertIn("step reduced", (self.scratch / "parts/log.txt").read_text())
        steps = {name: self.json(f"{name}/manifest.json")["models"]["continuum"]["counters"]["step"]
                 for name in ("whole", "parts")}
        self.assertEqual(steps["whole"], steps["parts"])

    def test_full_disk_from_the_beginning(self):
        self.scene({**LONG_REDUCED, "Time/End": 2})
        full = self.run_program("run", "scene.prm", preexec_fn=self.limit_files_to(0))
        self.assert_exit(full, STOPPED)
        self.assertIn("error: cannot write", full.stderr)
        self.run_done("run", "scene.prm")

    def test_results_that_are_directories(self):
        for name in ("log.txt", "used.prm", "manifest.json", "reduced.csv", "reduced.pvd"):
            with self.subTest(name):
                (self.scratch / name / name).mkdir(parents=True)
                self.scene({**LONG_REDUCED, **PICTURES, "Time/End": 2, "Output/Samples": 40})
                refused = self.run_program("run", "scene.prm", "--output", name)
                self.assert_exit(refused, STOPPED)
                self.assertIn(f"error: cannot write '{name}/{name}': Is a directory", refused.stderr)

    # SIGKILL.

    def test_kills_reduced(self):
        self.check_kills({**LONG_REDUCED, **PICTURES}, "reduced", 0.0, 7)

    def test_kills_continuum(self):
        self.check_kills({**LONG_CONTINUUM, **PICTURES}, "continuum", 1e-11, 5)

    def test_kills_polynomial(self):
        self.check_kills({**LONG_REDUCED, "Models": "polynomial", "Polynomial/Degree": 3, "Time/End": 10,
                          "Time/Step": 1e-2, "Output/Samples": 200, **PICTURES}, "polynomial", 0.0, 5)

    def test_kills_of_a_stiff_body(self):
        """The guess of the solution for the damping is part of the state."""
        self.check_kills({**LONG_CONTINUUM, "Material/Viscosity": 3, "Time/End": 2, "Output/Samples": 100}, "continuum", 1e-11, 3)

    def test_kills_full_ball_with_a_chosen_step(self):
        self.check_kills({"Models": "continuum", "Continuum/Degree": 2, "Time/End": 3, "Time/Tolerance": 1e-4,
                          "Initial state/Velocity": "0, -0.5, 0.25; 0.5, 0.05, -0.275; -0.2, 0.28, -0.05",
                          "Output/Samples": 100}, "continuum", 1e-11, 4)

    def test_kills_with_two_models(self):
        self.check_kills({**LONG_CONTINUUM, "Models": "reduced, continuum", "Continuum/Degree": 2, **PICTURES},
                         "continuum", 1e-11, 4)

    def test_kill_after_a_periodic_checkpoint(self):
        self.scene({**LONG_REDUCED, **PICTURES})
        self.run_done("run", "scene.prm", "--output", "whole")
        self.kill("parts", 0.3, stand_still=True)
        resumed = self.resume(folder="parts")
        self.assert_exit(resumed, DONE)
        self.assertRegex(resumed.stderr, r"resumed at t = (?!0\b)[0-9.]+")
        self.assert_finished_like("parts", "whole")


if __name__ == "__main__":
    unittest.main()
