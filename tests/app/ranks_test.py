"""Runs under mpirun: the same results on any number of ranks, checkpoints that any number of ranks reads."""
import math
import shutil
import signal
import subprocess
import time
import unittest

from program_test import DONE, PATIENCE, SOURCE, STOPPED, TIME_LIMIT, WRONG_INPUT, largest_difference
from ranks import ENVIRONMENT, MPIRUN, RanksTest

# What is asked for; the constraint is met to 1e-13 on every number of ranks, and sums round differently.
SAME = 1e-12
# For runs of a second or two that would otherwise wait for a rank that has gone.
ENOUGH = min(TIME_LIMIT, 40 * PATIENCE)

SCENE = {
    "Models": "continuum", "Continuum/Degree": 3, "Continuum/Symmetry": "octant", "Continuum/Refinements": 1,
    "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6",
    "Time/End": 0.5, "Time/Step": 0.01, "Time/Method": "rattle-4", "Output/Samples": 10,
}


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
class Ranks(RanksTest):
    def assert_same(self, a, b, bound=SAME):
        difference = largest_difference(self.table(a), self.table(b))
        print(f"{a} and {b}: largest difference {difference:.1e}")
        self.assertLess(difference, bound)

    def check_same_on_all(self, scene, bound=SAME):
        self.scene(scene)
        self.run_done("run", "scene.prm", "--output", "alone")
        for n_ranks in 2, 4:
            self.run_on(n_ranks, "run", "scene.prm", "--output", f"on{n_ranks}")
            self.assert_same("alone/continuum.csv", f"on{n_ranks}/continuum.csv", bound)

    def test_incompressible_octant(self):
        self.check_same_on_all(SCENE)

    def test_nearly_incompressible_octant(self):
        self.check_same_on_all({**SCENE, "Body/Incompressible": "false", "Material/Lame lambda": 1e4, "Material/Bulk": "projected",
                                "Time/Method": "rattle",
                                "Loads/Pressure": 0.3})

    def test_step_and_method_chosen_by_the_program(self):
        scene = {key: value for key, value in SCENE.items() if key not in ("Time/Step", "Time/Method")}
        self.check_same_on_all({**scene, "Continuum/Degree": 2, "Time/Constraint tolerance": 1e-13})

    def test_constraint_met_to_what_the_tolerance_asks_for(self):
        """What is left of the constraint depends on the solver, and so on the ranks: 1e-10 here."""
        scene = {key: value for key, value in SCENE.items() if key not in ("Time/Step", "Time/Method")}
        self.check_same_on_all({**scene, "Continuum/Degree": 2, "Time/Tolerance": 1e-6, "Output/Quantities": "state"}, 1e-8)

    def test_multistep_method(self):
        self.check_same_on_all({**SCENE, "Time/Method": "symmetric-4"})

    def test_conserving_method(self):
        self.check_same_on_all({**SCENE, "Time/Method": "energy-momentum", "Time/End": 0.1})

    def test_compressible_ball_with_loads_and_dissipation(self):
        self.check_same_on_all({
            "Models": "continuum", "Body/Incompressible": "false", "Material/Law": "ciarlet-geymonat",
            "Material/Lame lambda": 2, "Material/Viscosity": 0.01, "Material/Drag": 0.1, "Continuum/Degree": 2,
            "Continuum/Refinements": 0, "Loads/Tidal matrix": "0.1, 0.02, 0; 0.02, 0, 0; 0, 0, -0.2",
            "Loads/Pressure": 0.2, "Loads/Tidal amplitude": "0.2, 0, 0; 0, 0.1, 0; 0, 0, 0", "Loads/Tidal frequency": 3,
            "Loads/Acceleration": "0, 0, 0.1", "Initial state/Velocity": "0.1, 0.2, 0; -0.2, 0, 0; 0, 0, -0.1",
            "Time/End": 0.5, "Time/Step": 0.01, "Time/Method": "rattle", "Output/Samples": 10})

    def test_stiff_dissipation(self):
        """The multiplier has the damping times the velocity's round-off, which no bound of ours can name beforehand."""
        self.check_same_on_all({**SCENE, "Material/Viscosity": 3, "Time/Method": "rattle", "Continuum/Refinements": 0, "Time/End": 0.1,
                                "Output/Quantities": "state, energies"})

    def test_self_gravity(self):
        self.check_same_on_all({
            **SCENE, "Continuum/Symmetry": "auto", "Continuum/Refinements": 0, "Gravity/Constant": 2,
            "Initial state/Velocity": "0.1, 0.2, 0; -0.4, 0, 0; 0, 0.1, -0.1"})

    def test_fluid(self):
        self.check_same_on_all({
            **SCENE, "Continuum/Symmetry": "auto", "Continuum/Refinements": 0, "Gravity/Constant": 2, "Material/Law": "none",
            "Initial state/Velocity": "0.1, 0.2, 0; -0.4, 0, 0; 0, 0.1, -0.1"})

    def test_mesh_from_a_file(self):
        self.check_same_on_all({
            "Models": "continuum", "Continuum/Mesh": SOURCE / "meshes/rough_ball.msh", "Continuum/Degree": 2,
            "Body/Semi-axes": "0.98, 0.98, 0.98", "Initial state/Velocity": "0.1, -0.5, 0; 0.5, 0.1, 0; 0, 0, -0.2",
            "Time/End": 0.1, "Time/Step": 0.01, "Time/Method": "rattle", "Output/Samples": 2})

    def test_comparison(self):
        self.scene({**SCENE, "Models": "reduced, continuum", "Continuum/Degree": 2})
        self.run_done("run", "scene.prm", "--output", "alone")
        self.run_on(2, "run", "scene.prm", "--output", "on2")
        self.assert_same("alone/reduced.csv", "on2/reduced.csv")
        self.assert_same("alone/continuum.csv", "on2/continuum.csv")
        self.assertIn("comparison.json", self.files("on2"))

    def test_checkpoint_of_two_ranks_goes_on_on_one_and_on_four(self):
        # Interrupted in the first of many intervals, and within it: however fast the machine, most of the run is left.
        self.scene({**SCENE, "Time/End": 2, "Time/Step": 0.005, "Output/Samples": 10})
        self.run_on(1, "run", "scene.prm", "--output", "whole")
        process = subprocess.Popen(self.command_on(2, "run", "scene.prm", "--output", "part"), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.scratch,
                                   env=ENVIRONMENT)
        self.addCleanup(self.end_process, process)
        rows = self.scratch / "part/continuum.csv"
        self.wait_until(lambda: process.poll() is not None or (rows.exists() and rows.read_bytes().count(b"\n") > 1),
                        "the run is under way")
        process.send_signal(signal.SIGINT)
        self.assertNotEqual(process.wait(timeout=TIME_LIMIT), DONE)
        self.assertEqual(self.json("part/manifest.json")["state"], "interrupted")
        for n_ranks in 1, 4:
            shutil.copytree(self.scratch / "part", self.scratch / f"on{n_ranks}")
            self.run_on(n_ranks, "run", "scene.prm", "--output", f"on{n_ranks}", "--resume")
            self.assert_same("whole/continuum.csv", f"on{n_ranks}/continuum.csv")

    def test_interval_that_is_integrated_again_after_a_checkpoint_within_it(self):
        """Two ranks, interrupted several times within intervals that need shorter steps."""
        side = 1 / math.sqrt(1.5)
        self.scene({"Models": "continuum", "Continuum/Degree": 3, "Time/End": 10, "Output/Samples": 10,
                    "Initial state/Deformation": f"{side!r}, 0, 0; 0, {side!r}, 0; 0, 0, 1.5", "Time/Tolerance": 1e-4,
                    "Time/Constraint tolerance": 1e-13, "Continuum/Error estimate": "none"})
        self.run_on(2, "run", "scene.prm", "--output", "whole")
        header, log, code, n_interruptions = self.scratch / "part/continuum.csv", self.scratch / "part/log.txt", None, 0
        while code != DONE:
            size = log.stat().st_size if log.exists() else 0
            process = subprocess.Popen(self.command_on(2, "run", "scene.prm", "--output", "part", *["--resume"] * (code is not None)),
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.scratch,
                                       env=ENVIRONMENT)
            self.addCleanup(self.end_process, process)
            self.wait_until(lambda: process.poll() is not None or header.exists() and log.stat().st_size > size, "the run is under way")
            time.sleep(0.2)
            if n_interruptions < 3:
                process.send_signal(signal.SIGINT)
            code = process.wait(timeout=TIME_LIMIT)
            n_interruptions += code != DONE
        self.assertGreater(n_interruptions, 0)
        whole, part = (self.json(folder, "manifest.json")["models"]["continuum"]["counters"]["repeated_intervals"] for folder in ("whole", "part"))
        self.assertEqual(whole, part)
        self.assertGreater(whole, 0)
        # The solver makes its factors anew, and the remainder of the constraint depends on them.
        self.assert_same("whole/continuum.csv", "part/continuum.csv", 1e-9)

    def test_pictures_are_pieces_and_a_list_of_them(self):
        self.scene({**SCENE, "Time/End": 0.05, "Output/Samples": 2, "Output/Graphics": "vtu", "Output/Frames": 2})
        self.run_on(2, "run", "scene.prm", "--output", "on2")
        self.run_done("run", "scene.prm", "--output", "alone")
        self.assertEqual([file for _, file in self.pvd("on2/continuum.pvd")],
                         ["graphics/continuum-000000.pvtu", "graphics/continuum-000001.pvtu"])
        self.assertIn("graphics/continuum-000001-0000.vtu", self.files("on2"))
        self.assertIn("graphics/continuum-000001-0001.vtu", self.files("on2"))
        import vtk
        def volume(reader_class, path):
            reader = reader_class()
            reader.SetFileName(str(self.scratch / path))
            reader.Update()
            sizes = vtk.vtkCellSizeFilter()
            sizes.SetInputConnection(reader.GetOutputPort())
            sizes.Update()
            grid = sizes.GetOutput()
            values = grid.GetCellData().GetArray("Volume")
            return grid.GetNumberOfCells(), sum(values.GetValue(i) for i in range(values.GetNumberOfTuples()))
        n_pieces, in_pieces = volume(vtk.vtkXMLPUnstructuredGridReader, "on2/graphics/continuum-000001.pvtu")
        n_whole, in_one = volume(vtk.vtkXMLUnstructuredGridReader, "alone/graphics/continuum-000001.vtu")
        self.assertEqual(n_pieces, n_whole)
        self.assertAlmostEqual(in_pieces, in_one, delta=1e-12)
        self.check_readers()

    def check_readers(self):
        """The Python package reads the pieces as one picture: of the same points, in another order."""
        from pseudorigid import Run
        from pseudorigid.frames import read_grid
        for whole, joined in zip(Run(self.scratch / "alone").frames("continuum"),
                                 Run(self.scratch / "on2").frames("continuum")):
            self.assertEqual(joined.path.suffix, ".pvtu")
            self.assertEqual(read_grid(joined.path).GetNumberOfPoints(), read_grid(whole.path).GetNumberOfPoints())
            one, two = whole.read(), joined.read()
            self.assertEqual(sorted(two.fields), sorted(one.fields))
            corner = lambda picture: {tuple(point) for block in picture.cells
                                      for point in picture.points[block.data[:, 0]].round(9)}
            self.assertEqual(corner(two), corner(one))
            size = lambda picture: (picture.fields["displacement"] ** 2).sum()
            self.assertAlmostEqual(size(two), size(one), delta=1e-9)

    def test_inverted_elements_stop_all_ranks(self):
        self.scene({"Models": "continuum", "Continuum/Degree": 2, "Continuum/Symmetry": "octant",
                    "Initial state/Deformation": "0.8, 0, 0; 0, 1.25, 0; 0, 0, 1", "Time/End": 2, "Time/Step": 0.2,
                    "Time/Method": "rattle", "Output/Samples": 10})
        said = {}
        for n_ranks in 1, 2, 4:
            result = self.run_on(n_ranks, "run", "scene.prm", "--output", f"on{n_ranks}", code=STOPPED)
            said[n_ranks] = [line for line in result.stderr.splitlines() if "stopped at t = " in line]
            self.assertEqual(self.json(f"on{n_ranks}/manifest.json")["state"], "failed")
        # Time, place and least det F do not depend on how the cells are shared out.
        self.assertRegex(said[1][0], r"least det F = \S+ at X/r = \(.*\)")
        self.assertEqual(said[2], said[1])
        self.assertEqual(said[4], said[1])

    def test_wrong_input_is_said_once(self):
        self.scene({**SCENE, "Continuum/Degree": 99})
        result = self.run_on(2, "run", "scene.prm", code=WRONG_INPUT)
        self.assertEqual(result.stderr.count("error:"), 1)
        self.assertEqual(self.files(), ["scene.prm"])
        self.assertEqual(self.run_on(2, "run", "nowhere.prm", code=WRONG_INPUT).stderr.count("error: "), 1)

    def test_a_scene_without_continuum_runs_on_one_rank(self):
        self.scene({"Models": "reduced", "Time/End": 1})
        result = self.run_on(2, "run", "scene.prm")
        self.assertIn("reduced.csv", self.files("output/scene"))
        self.assertEqual(result.stderr.count("results are in"), 1)

    def test_ranks_with_different_scenes_are_refused(self):
        """Of a scene without finite elements the others were lost; with them the ranks waited for each other."""
        reduced = {"Models": "reduced", "Time/End": 1, "Output/Samples": 10}
        self.scene(reduced)
        self.scene({**reduced, "Time/End": 2}, "later.prm")
        self.scene({**SCENE, "Continuum/Degree": 2}, "continuum.prm")
        self.scene("include scene.prm\n", "included.prm")
        run = lambda scene, *options: ["run", scene, "--output", "out", *options]
        stiffer = "Material/Shear modulus=2"
        cases = (
            (run("scene.prm"), run("later.prm"), "rank 1 was started with \"Time/End = 2\" and rank 0 with \"Time/End = 1\""),
            (run("later.prm"), run("scene.prm"), "\"Time/End = 1\""), (run("scene.prm"), run("scene.prm", "--set", "Time/End=3"), "\"Time/End = 3\""),
            (run("scene.prm"), run("continuum.prm"), "rank 1 was started with"), (run("continuum.prm"), run("scene.prm"), "rank 1 was"),
            (run("continuum.prm"), run("continuum.prm", "--set", "Continuum/Degree=3"), "\"Continuum/Degree = 3\""),
            (run("continuum.prm"), run("continuum.prm", "--set", stiffer), "\"Material/Shear modulus = 2\""),
            (run("continuum.prm"), run("continuum.prm", "--set", "Time/End=9"), "\"Time/End = 9\""),
            (["run", "scene.prm"], ["run", "scene.prm", "--output", "elsewhere"], "\"results in elsewhere\""),
            (run("scene.prm"), run("nowhere.prm"), "\"nowhere.prm\""), (run("nowhere.prm"), run("scene.prm"), "\"nowhere.prm\""),
            (run("scene.prm"), run("scene.prm", "--fast"), "unknown option \"--fast\""))
        before = self.files()
        for first, second, said in cases:
            with self.subTest(first=first, second=second):
                command = [*MPIRUN, "-np", "1", *self.command(first), ":", "-np", "1", *self.command(second)]
                result = self.finish_ranks(self.start_ranks(command), WRONG_INPUT, ENOUGH)
                sentences = [line for line in result.stderr.splitlines() if line.startswith("error: ")]
                self.assertEqual(len(sentences), 1, result.stderr)
                self.assertIn(said, sentences[0])
                self.assertEqual(self.files(), before)

    def test_ranks_in_different_environments_are_refused(self):
        self.scene(SCENE)
        (name, *_) = self.run_program("run", "scene.prm", env={**ENVIRONMENT, "PSEUDORIGID_INSTRUCTIONS": "abacus"}
                                      ).stderr.strip().split(" was built for ")[1].split(", ")
        command = [*MPIRUN, "-np", "1", *self.command(["run", "scene.prm"]), ":", "-np", "1", "-x", f"PSEUDORIGID_INSTRUCTIONS={name}",
                   *self.command(["run", "scene.prm"])]
        result = self.finish_ranks(self.start_ranks(command), WRONG_INPUT, ENOUGH)
        self.assertIn(f"the instructions '{name}'", result.stderr)

    def test_ranks_with_the_same_scene_in_other_words(self):
        reduced = {"Models": "reduced", "Time/End": 1, "Output/Samples": 10}
        self.scene(reduced, "scene.prm")
        folder = self.scratch / "other"
        folder.mkdir()
        (folder / "scene.prm").write_text("# The same\ninclude ../scene.prm\n")
        command = [*MPIRUN, "-np", "1", *self.command(["run", "scene.prm"]), ":", "-np", "1", "-wdir", str(folder),
                   *self.command(["run", "scene.prm"])]
        self.finish_ranks(self.start_ranks(command), DONE, ENOUGH)
        self.assertEqual(len(self.table("output/scene/reduced.csv")), 11)
        self.assertEqual(self.files("other"), ["scene.prm"])

    def check_equal_on_all(self, scene, files, ranks=(2, 5)):
        """An analysis, whose parts the ranks share: the files of one rank, byte by byte."""
        self.scene(scene)
        self.run_done("run", "scene.prm", "--output", "alone")
        for n_ranks in ranks:
            self.run_on(n_ranks, "run", "scene.prm", "--output", f"on{n_ranks}")
            for file in files:
                self.assertEqual(self.bytes("alone", file), self.bytes(f"on{n_ranks}", file), f"{file} on {n_ranks}")

    def test_modes(self):
        self.check_equal_on_all({"Analysis": "modes", "Models": "polynomial, continuum", "Polynomial/Degree": 3,
                                 "Continuum/Degree": 3, "Modes/Number": 3},
                                ["modes.csv", "modes-polynomial.csv"])

    def test_love_numbers(self):
        self.check_equal_on_all({"Analysis": "love numbers", "Models": "continuum", "Continuum/Degree": 3,
                                 "Gravity/Gamma": 1, "Love numbers/Degrees": "2, 3"}, ["love-continuum.csv"], ranks=(2,))

    def test_families_of_figures(self):
        self.check_equal_on_all({"Analysis": "equilibrium", "Models": "continuum", "Continuum/Degree": 2,
                                 "Gravity/Gamma": 20, "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.84,
                                 "Equilibrium/Last": 0.88, "Equilibrium/Number": 2}, ["equilibria-continuum.csv"])

    def check_large_figure(self, scene, ranks=(2,)):
        """A figure whose cells the ranks share: the same numbers to round-off, with the same V-cycles. Round-off decides if Newton's
        iteration makes a last step, so the iterations are counted for one step."""
        self.scene({"Analysis": "equilibrium", "Models": "continuum", "Equilibrium/Small motions": "false",
                    "Continuum/Error estimate": "none", **scene})
        self.run_done("run", "scene.prm", "--output", "alone")
        alone = self.table("alone/equilibria-continuum.csv")
        iterations = {}
        for n_ranks in 1, *ranks:
            folder = "alone" if n_ranks == 1 else f"on{n_ranks}"
            if n_ranks > 1:
                self.run_on(n_ranks, "run", "scene.prm", "--output", folder)
            counters = self.json(f"{folder}/manifest.json")["models"]["continuum"]["counters"]
            iterations[n_ranks] = counters["gmres_iterations"] / counters["newton_steps"]
            table = self.table(f"{folder}/equilibria-continuum.csv")
            for column in set(table.header) - {"residual"}:  # of round-off alone
                for value, of_one in zip(table.column(column), alone.column(column)):
                    self.assertAlmostEqual(value, of_one, delta=SAME * max(1, abs(of_one)), msg=f"{column} on {n_ranks}")
        self.assertLess(max(iterations.values()) - min(iterations.values()), 0.1 * iterations[1], iterations)

    def test_large_figure_at_rest(self):
        self.check_large_figure({"Continuum/Degree": 4, "Continuum/Refinements": 2, "Equilibrium/Family": "static",
                                 "Loads/Tidal matrix": "0.6, 0, 0; 0, 0.4, 0; 0, 0, 0.1"}, ranks=(2, 3))

    def test_large_rotating_figures(self):
        """Under gravity, whose springs couple the levels of the V-cycles, and for a body whose axes are prescribed."""
        self.check_large_figure({"Continuum/Degree": 7, "Continuum/Refinements": 1, "Gravity/Gamma": 4,
                                 "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.5, "Equilibrium/Last": 0.5,
                                 "Equilibrium/Number": 1})
        self.check_large_figure({"Continuum/Degree": 2, "Continuum/Refinements": 3, "Body/Incompressible": "false",
                                 "Material/Law": "ciarlet-geymonat", "Material/Lame lambda": 2, "Loads/Pressure": 0.1,
                                 "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.3, "Equilibrium/Last": 0.3,
                                 "Equilibrium/Number": 1})

    def test_a_load_without_equilibrium(self):
        """The first rank writes the last figure, and all ranks end."""
        self.scene({"Analysis": "equilibrium", "Models": "continuum", "Continuum/Degree": 2,
                    "Equilibrium/Family": "static", "Loads/Tidal matrix": "-6, 0, 0; 0, -6, 0; 0, 0, 12",
                    "Continuum/Volumetric stiffness": 3})
        self.run_on(2, "run", "scene.prm", code=STOPPED)


if __name__ == "__main__":
    unittest.main(verbosity=2)
