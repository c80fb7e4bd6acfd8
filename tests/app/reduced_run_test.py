"""What a run of the reduced model alone leaves behind, says, loads and takes; and the other commands."""
import json
import os
import pathlib
import re
import unittest

from program_test import BODY_COLUMNS, ProgramTest, SOURCE, largest_difference, overrides, without_free_space

SCENE = {
    "Title": "A tumbling ball", "Models": "reduced",
    "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8",
    "Initial state/Velocity": "0.25, -1, 0.125; 0.6, -0.3, 0.2; 0, -0.08, 0.08",
    "Time/End": 5, "Output/Samples": 50,
}
SLOW = {**SCENE, "Time/Step": 1e-5, "Time/Method": "rattle-4"}
FOREIGN = ("deal_II", "libmpi", "libpetsc", "libslepc", "libp4est", "libsc-", "libtrilinos", "libcholmod", "libumfpack")


class ReducedRun(ProgramTest):
    def test_files_and_columns(self):
        self.scene(SCENE)
        self.run_done("run", "scene.prm")
        self.assertEqual(self.files("output/scene"), ["checkpoint-reduced.bin", "log.txt", "manifest.json", "reduced.csv",
                                                      "used.prm"])
        table = self.table("output/scene/reduced.csv")
        self.assertEqual(table.header, BODY_COLUMNS)
        self.assertEqual(len(table), 51)
        self.assertTrue(table.is_finite())
        self.assertEqual(table.column("time"), [5 * (k / 50) for k in range(51)])
        self.assertEqual(table.rows[0][1:10], [1.25, 0, 0, 0, 1, 0, 0, 0, 0.8])
        for q11 in (row.split(",")[1] for row in self.bytes("output/scene/reduced.csv").decode().splitlines()[1:]):
            self.assertEqual(f"{float(q11):.17g}", q11)

    def test_chosen_quantities(self):
        self.scene({**SCENE, "Output/Quantities": "momenta, energies"})
        self.run_done("run", "scene.prm")
        energies = ["kinetic", "elastic", "gravitational", "external", "dissipated", "energy"]
        self.assertEqual(self.table("output/scene/reduced.csv").header, ["time", *energies, "J1", "J2", "J3", "Z1", "Z2", "Z3"])

    def test_skipping_changes_no_result(self):
        self.scene(SCENE)
        self.run_done("run", "scene.prm", "--output", "all", "--set", "Output/Graphics=vtu", "--set", "Output/Frames=3")
        self.run_done("run", "scene.prm", "--output", "few", "--set", "Output/Quantities=state")
        everything, few = self.table("all/reduced.csv"), self.table("few/reduced.csv")
        for name in few.header:
            self.assertEqual(few.column(name), everything.column(name), name)

    def test_manifest(self):
        self.scene(SCENE)
        self.run_done("run", "scene.prm")
        manifest = self.json("output/scene/manifest.json")
        version = self.run_done("--version").stdout
        self.assertEqual(version, f"pseudorigid {manifest['version']} ({manifest['git_hash']})\n")
        self.assertRegex(manifest["git_hash"], r"^([0-9a-f]{40}(-dirty)?|unknown)$")
        self.assertEqual((manifest["program"], manifest["state"], manifest["exit_code"]), ("pseudorigid", "done", 0))
        self.assertEqual((manifest["title"], manifest["command"][1:]), ("A tumbling ball", ["run", "scene.prm"]))
        for key in ("compiler", "flags", "build_type", "cpu", "libraries"):
            self.assertTrue(manifest[key], key)
        self.assertGreater(manifest["wall_seconds"], 0)
        for key in ("start", "end"):
            self.assertRegex(manifest[key], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        reduced = manifest["models"]["reduced"]
        for counter in ("steps", "substeps", "forces", "step", "order"):
            self.assertGreater(reduced["counters"][counter], 0, counter)
        self.assertLess(reduced["counters"]["max_scaled_constraint"], 1e-12)
        self.assertLess(reduced["counters"]["max_scaled_constraint_rate"], 1e-12)
        self.assertGreater(reduced["timers"]["run"], 0)

    def test_log_lists_what_was_needed_and_skipped(self):
        self.scene(SCENE)
        self.run_done("run", "scene.prm")
        log = (self.scratch / "output/scene/log.txt").read_text()
        described = self.run_done("check", "scene.prm").stdout
        self.assertIn(without_free_space(described), without_free_space(log))
        needed, skipped = described.split("Needed:\n")[1].split("Skipped:\n")
        for word in ("reduced model", "constraint", "quantities: state, energies, momenta, multiplier, axes"):
            self.assertIn(word, needed)
        for word in ("no mesh, no deal.II, MPI or PETSc", "comparison", "tangent", "nonaffine", "graphics"):
            self.assertIn(word, skipped)

    def test_used_prm_repeats_the_run(self):
        self.scene(SCENE)
        changes = {"Time/Tolerance": 1e-9, "Body/Radius": 3, "Title": "Changed"}
        self.run_done("run", "scene.prm", *overrides(changes))
        used = (self.scratch / "output/scene/used.prm").read_text()
        for line in ("set Tolerance = 1e-09  # from --set", "set Radius = 3  # from --set", "set Title = Changed  # from --set"):
            self.assertIn(line, used)
        self.assertEqual(used.count("# from --set"), 3)
        self.scene(used, "again.prm")
        self.run_done("run", "again.prm")
        self.assertEqual(self.bytes("output/again/reduced.csv"), self.bytes("output/scene/reduced.csv"))
        self.assertEqual((self.scratch / "output/again/used.prm").read_text(), used.replace("  # from --set", ""))

    def test_the_manifest_has_the_values_used(self):
        self.scene({**SCENE, "Body/Radius": "$(3/2)"})
        self.run_done("run", "scene.prm", *overrides({"Time/Tolerance": "0.10e-8", "Title": "ends with \\"}))
        entries = self.json("output/scene/manifest.json")["entries"]
        used = (self.scratch / "output/scene/used.prm").read_text()
        self.assertEqual([path.split("/")[-1] for path in entries], re.findall(r"^ *set ([^=]*?) =", used, re.M))
        for path, value in (("Body/Radius", "1.5"), ("Time/Tolerance", "1e-09"), ("Title", "ends with \\"), ("Body/Inertia", "auto"),
                            ("Body/Semi-axes", "1, 1, 1")):
            self.assertEqual(entries[path], value)
        # As options they make the same run.
        self.run_done("run", self.scene("", "defaults.prm"), *overrides(entries), "--output", "again")
        self.assertEqual(self.bytes("again/reduced.csv"), self.bytes("output/scene/reduced.csv"))

    def test_a_new_run_clears_the_old_one_and_nothing_else(self):
        self.scene(SCENE)
        self.run_done("run", "scene.prm", "--set", "Output/Graphics=vtu", "--set", "Output/Frames=3")
        (self.scratch / "output/scene/notes.txt").write_text("mine")
        (self.scratch / "output/scene/graphics/mine.vtu").write_text("mine")
        self.run_done("run", "scene.prm")
        self.assertEqual(self.files("output/scene"), ["checkpoint-reduced.bin", "graphics", "graphics/mine.vtu", "log.txt",
                                                      "manifest.json", "notes.txt", "reduced.csv", "used.prm"])

    def test_output_option_and_directory_entry(self):
        self.scene(SCENE, "name.of.scene.prm")
        self.run_done("run", "name.of.scene.prm", "--set", "Output/Directory=a/b")
        self.run_done("run", "name.of.scene.prm", "--output", "c/d", "--set", "Output/Directory=a/b")
        self.assertTrue((self.scratch / "a/b/name.of.scene/reduced.csv").exists())
        self.assertTrue((self.scratch / "c/d/reduced.csv").exists())

    # What it says.

    def test_quiet_says_nothing(self):
        self.scene(SCENE)
        result = self.run_done("run", "scene.prm", "--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))

    def test_a_pipe_gets_lines_only(self):
        self.scene(SLOW)
        result = self.run_done("run", "scene.prm")
        self.assertRegex(result.stdout, r"\A\d+ samples, t = 0 to \S+ +reduced\nfrequency of C\d\d ")
        for label in ("amplitude of C", "(drift of the )?energy", "semi-axis a1", "kinetic energy"):
            self.assertRegex(result.stdout, "\n" + label)
        self.assertNotRegex(result.stderr, r"[\r\x1b]")
        self.assertRegex(result.stderr, r"\Ascene: A tumbling ball\nreduced: \d+ steps, \S+ s\nresults are in output/scene\n\Z")
        verbose = self.run_done("run", "scene.prm", "--verbose", *overrides({"Time/Step": "auto"}))
        self.assertIn("Skipped:\n", verbose.stderr)

    def test_a_terminal_gets_the_progress(self):
        self.scene(SLOW)
        text = self.terminal_output("run", "scene.prm")
        self.assertRegex(text, r"\rreduced  +\d+ %  \S+ steps/s  \d+ s left\x1b\[K")
        self.assertIn("results are in output/scene", text)
        self.assertEqual(self.terminal_output("run", "scene.prm", "--quiet"), "")

    # What it loads and takes.

    def test_no_library_of_the_continuum_is_loaded(self):
        self.scene(SLOW)
        process = self.start_program("run", "scene.prm")
        self.wait_until(lambda: (self.scratch / "output/scene/reduced.csv").exists(), "the motion begins")
        maps = pathlib.Path(f"/proc/{process.pid}/maps").read_text()
        self.assertIsNone(process.poll())
        libraries = sorted(set(re.findall(r"\S+\.so\S*", maps)))
        self.assertIn("libc.so", maps)
        self.assertEqual([path for path in libraries for name in FOREIGN if name in path], [])
        print(len(libraries), "libraries:", *(os.path.basename(path) for path in libraries))

    def test_memory_and_time_of_1000_steps(self):
        self.scene({**SCENE, "Time/End": 50, "Output/Samples": 1000, "Time/Method": "rattle-8", "Time/Tolerance": 1e-7})
        self.run_done("run", "scene.prm")
        manifest = self.json("output/scene/manifest.json")
        megabytes = manifest["peak_memory_bytes"] / 1e6
        self.assertEqual(manifest["exit_code"], 0)
        steps = manifest["models"]["reduced"]["counters"]["steps"]
        print(f"{steps} steps: at most {megabytes:.1f} MB, {1e3 * manifest['wall_seconds']:.1f} ms")
        self.assertGreaterEqual(steps, 1000)
        self.skip_if_sanitized()
        self.assertLess(megabytes, 15)

    # The other commands.

    def test_parameters_as_prm_is_a_scene(self):
        text = self.run_done("parameters", "--format", "prm").stdout
        self.scene(text)
        self.run_done("check", "scene.prm")
        self.run_done("run", "scene.prm", "--set", "Models=reduced")
        self.assertEqual(self.table("output/scene/reduced.csv").column("Q11"), [1.0] * 201)

    def test_parameters_in_three_formats_agree(self):
        entries = json.loads(self.run_done("parameters", "--format", "json").stdout)
        markdown = self.run_done("parameters", "--format", "markdown").stdout
        prm = self.run_done("parameters", "--format", "prm").stdout
        self.assertEqual(markdown, self.run_done("parameters").stdout)
        self.assertGreater(len(entries), 20)
        for entry in entries:
            self.assertEqual(sorted(entry), ["default", "documentation", "entry", "expected", "type", "unit", "words"])
            self.assertTrue(entry["documentation"].endswith("."), entry)
            name = entry["entry"].split("/")[-1]
            self.assertIn(f"| `{name}` | ", markdown)
            self.assertIn(f"set {name} = {entry['default']}".rstrip(), prm)
        of_entries = markdown[:markdown.index("\n## Models\n")]  # after it: models, methods and columns
        self.assertEqual(of_entries.count("\n| `"), len(entries))
        self.assertIn(markdown.strip(), (SOURCE / "docs/parameters.md").read_text(), "docs/parameters.md is out of date")

    def test_help(self):
        text = self.run_done("--help").stdout
        for word in ("run", "check", "parameters", "--version", "Exit codes"):
            self.assertIn(word, text)
        self.assertEqual(self.run_done().stdout, text)
        for word in ("--set", "--output", "--resume", "--quiet", "--verbose", "SCENE"):
            self.assertIn(word, self.run_done("run", "--help").stdout)
        self.assertIn("--format", self.run_done("parameters", "--help").stdout)

    def test_check_writes_nothing(self):
        self.scene({**SCENE, "Models": "reduced, continuum", "Continuum/Degree": 3})
        result = self.run_done("check", "scene.prm")
        self.assertIn("degree 3", result.stdout)
        self.assertEqual(result.stderr, "")
        self.assertEqual(self.files(), ["scene.prm"])

    # Scaling a scene scales its results.

    def scaled_run(self, name, radius, density, modulus):
        """The scene in other units: times are scaled by r/c, c² = modulus/density."""
        time = radius * (density / modulus) ** 0.5
        velocity = "; ".join(", ".join(repr(float(x) / time) for x in row.split(","))
                             for row in SCENE["Initial state/Velocity"].split(";"))
        self.scene({**SCENE, "Body/Radius": repr(radius), "Body/Density": repr(density), "Material/Shear modulus": repr(modulus),
                    "Initial state/Velocity": velocity, "Time/End": repr(SCENE["Time/End"] * time)}, f"{name}.prm")
        self.run_done("run", f"{name}.prm")
        table = self.table(f"output/{name}/reduced.csv")
        mass = density * radius**3
        energy = mass * (radius / time) ** 2
        units = {"time": time, "Qdot": 1 / time, "x": radius, "v": radius / time, "J": energy * time, "Z": energy * time,
                 "multiplier": 1 / time**2, "a": radius, "Q": 1, "volume_ratio": 1}
        scale = [units.get(name.rstrip("123"), energy) for name in table.header]
        table.rows = [[x / s for x, s in zip(row, scale)] for row in table.rows]
        return table

    def test_powers_of_two_change_no_digit(self):
        reference = self.scaled_run("reference", 1.0, 1.0, 1.0)
        for factors in ((8.0, 1.0, 1.0), (0.25, 4.0, 64.0), (2.0**-10, 2.0**7, 2.0**-3)):
            self.assertEqual(self.scaled_run("scaled", *factors).rows, reference.rows, factors)

    def test_any_units_give_the_same_motion(self):
        reference = self.scaled_run("reference", 1.0, 1.0, 1.0)
        for factors in ((1e12, 1.0, 1.0), (1e-12, 1.0, 1.0), (1.0, 1e12, 1.0), (1.0, 1.0, 1e-12), (6.4e6, 5500.0, 7e10)):
            difference = largest_difference(reference, self.scaled_run("scaled", *factors))
            print(factors, f"{difference:.1e}")
            self.assertLess(difference, 1e-10, factors)


if __name__ == "__main__":
    unittest.main()
