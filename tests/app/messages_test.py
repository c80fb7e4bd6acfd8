"""Input that looks right and is not: what was typed, the exit code, the line and the entry that are named, and a keyword."""
import os
import resource
import subprocess
import unittest

from program_test import DONE, SOURCE, STOPPED, overrides
from refused_input import BASE, RefusedInputTest

MINUS, EN_DASH, NO_BREAK_SPACE = "\u2212", "\u2013", "\u00a0"
SWEEP = {"Models": "reduced", "Time/End": 1, "Output/Samples": 10, "Material/Shear modulus": "$(l)"}


class Messages(RefusedInputTest):
    def refused_text(self, text, *fragments):
        self.scene(text)
        return self.refused("run", "scene.prm", fragments=fragments)

    # What a shell would have replaced.

    def test_directories_as_a_shell_knows_them(self):
        text = "set Models = reduced\nsubsection Output\n  set Directory = {}\nend\n"
        home = os.environ.get("HOME", "")
        for typed, meant in (("~/results", f"{home}/results"), ("$HOME/results", f"{home}/results"),
                             ("a/${HOME}", f"a/{home}"), ("~", home), ("~nobody/x", ""), ("$PSEUDORIGID_NOTHING/x", "")):
            with self.subTest(typed):
                message = self.refused_text(text.format(typed), f'scene.prm:3: Output/Directory: expected the name of a directory, '
                                            f'got "{typed}"', "is not replaced")
                if home and meant:
                    self.assertIn(f'write "{meant}"', message)
                self.scene(BASE)
                self.refused("run", "scene.prm", f"--output={typed}", fragments=("--output: ", "is not replaced"))
        for typed in ("./~", "a~b", "results$", "1$2"):
            self.scene(text.format(typed))
            self.run_done("check", "scene.prm")

    def test_a_backslash_before_a_statement(self):
        text = "set Models = reduced\nsubsection Output\n  set Directory = C:\\results\\\n  set Samples = 7\nend\n"
        self.refused_text(text, "scene.prm:3: the backslash", '"set Samples = 7"', "remove the backslash")
        self.scene(text.replace("results\\", "results"))
        self.run_done("run", "scene.prm", "--quiet")
        self.assertEqual(len(self.table("C:\\results/scene/reduced.csv")), 8)

    # Characters.

    def test_characters_that_look_like_others(self):
        for entries, *fragments in (
                ({"Time/End": f"{MINUS}0.2"}, "Time/End: ", "the minus sign U+2212", '"-"'),
                ({"Initial state/Velocity": f"{EN_DASH}1, 0, 0; 0, 0, 0; 0, 0, 0"}, "Initial state/Velocity: ", "(1,1)",
                 "the en dash U+2013"),
                ({"Models": f"reduced,{NO_BREAK_SPACE}polynomial"}, "Models: ", "the no-break space U+00A0"),
                ({"Output/Samples": f"{NO_BREAK_SPACE}7"}, "Output/Samples: ", "the no-break space U+00A0"),
                ({"Time/End": f"$(2{MINUS}1)"}, "Time/End: ", "the minus sign U+2212"),
                ({"Material/Law": f"neo{EN_DASH}hookean"}, "Material/Law: ", "the en dash U+2013", 'did you mean "neo-hookean"')):
            with self.subTest(entries):
                self.refused_entries(entries, *fragments)
        self.refused_text(f"set{NO_BREAK_SPACE}Models = reduced\n", "scene.prm:1: ", "the no-break space U+00A0")
        self.refused_text(f"set Models{NO_BREAK_SPACE}= reduced\n", "scene.prm:1: ", "U+00A0", 'did you mean "Models"?')

    # Numbers.

    def test_numbers_of_an_expression(self):
        self.refused_entries({"Time/End": "$(2,5)"}, "Time/End: ", "a list of 2 numbers", 'decimal point')
        self.refused_entries({"Time/End": "$(1,5*2)"}, "Time/End: ", "a list of 2 numbers")
        self.scene({**BASE, "Output/Samples": "$(100*1.1)", "Polynomial/Degree": "$(1+1.0), $(10*0.3)"})
        self.run_done("run", "scene.prm", "--quiet")
        self.assertEqual(len(self.table("output/scene/reduced.csv")), 111)
        self.refused_entries({"Output/Samples": "$(100*1.101)"}, "Output/Samples: ", '"110.1"')

    def test_numbers_that_no_run_could_begin_with(self):
        """They stopped at t = 0 with exit code 3."""
        entry = "{0}, 0, 0; 0, {0}, 0; 0, 0, {0}"
        spin = {"Initial state/Velocity": "0, 1e-3, 0; -1e-3, 0, 0; 0, 0, 0"}
        for entries, path, keyword in (
                ({"Body/Density": 1e160}, "Body/Density", "units nearer"), ({"Body/Density": 1e-160}, "Body/Density", "units"),
                ({"Body/Radius": 1e160}, "Body/Radius", "units"), ({"Material/Shear modulus": 1e160}, "Material/Shear modulus", "units"),
                ({"Material/Lame lambda": 1e160, "Body/Incompressible": "false"}, "Material/Lame lambda", "at most 1e+12"),
                ({"Material/Lame lambda": 1e90, "Material/Law": "saint-venant-kirchhoff"}, "Material/Lame lambda", "at most"),
                ({"Material/Gent limit": 1e-160, "Material/Law": "gent"}, "Material/Gent limit", "at least 1e-12"),
                ({"Body/Inertia": entry.format(1e-160)}, "Body/Inertia", "between 1e-12 and 1e+12"),
                ({"Body/Inertia": entry.format(1e160)}, "Body/Inertia", "between"),
                ({"Body/Inertia": entry.format(1e-50)}, "Body/Inertia", "between")):
            with self.subTest(entries):
                self.refused_entries(entries, f"{path}: ", keyword)
        # What is just allowed runs.
        for entries in ({"Body/Density": 1e99, "Time/End": 1e50}, {"Body/Inertia": entry.format("1e-6"), **spin},
                        {"Body/Inertia": entry.format("1e12"), **spin},
                        {"Material/Lame lambda": 1e160}, {"Material/Lame lambda": 1e12, "Body/Incompressible": "false"},
                        {"Material/Gent limit": 1e-12, "Material/Law": "gent"}):
            with self.subTest(entries):
                self.scene({**BASE, **entries})
                self.run_done("run", "scene.prm", "--quiet")

    def test_systems_that_no_run_could_begin_with(self):
        for system, path, value in (("spherical pendulum", "Spherical pendulum/Gravity", 1e-160), ("torus", "Torus/Radius", 1e90),
                                    ("mass points", "Mass points/Drag", 1e90), ("double pendulum", "Double pendulum/First mass", 1e-90)):
            with self.subTest(path):
                self.refused_entries({path: value}, f"{path}: ", "between 1e-70 and 1e+70",
                                     base={"System": system, "Time/End": 1, "Output/Samples": 10})

    # Sweeps.

    def test_names_that_a_parameter_cannot_have(self):
        for name, keyword in (
                *((name, "columns of sweep.csv") for name in ("time", "run", "finished", "steps", "forces", "estimated_time_error",
                                                              "frequency", "amplitude", "Q11_end", "Qdot33_max", "a1_min",
                                                              "energy", "energy_drift", "volume_ratio", "J1", "Z3_drift")),
                *((name, "a function of expressions") for name in ("sin", "sqrt", "ln", "min", "sum")),
                *((name, "a constant of expressions") for name in ("pi", "e"))):
            with self.subTest(name):
                self.refused_entries({"Sweep/Parameters": f"{name}: 1, 2", "Material/Shear modulus": f"$({name})"},
                                     "Sweep/Parameters: ", f'"{name}"', keyword, base={**SWEEP, "Material/Shear modulus": 1})
        pendulum = {"System": "double pendulum", "Time/End": 1, "Output/Samples": 10}
        for name in ("time", "theta_end", "frequency"):
            self.refused_entries({"Sweep/Parameters": f"{name}: 1, 2", "Double pendulum/Angles": f"$({name}), 0"},
                                 "Sweep/Parameters: ", f'"{name}"', "columns of sweep.csv", base=pendulum)
        for base, name in (({**SWEEP, "Material/Shear modulus": 1}, "Q11"), (pendulum, "theta"), (pendulum, "energy")):
            entry = "Double pendulum/Angles" if base is pendulum else "Initial state/Center"
            self.scene({**base, "Sweep/Parameters": f"{name}: 1, 2", entry: f"$({name}), 0" + (", 0" if base is not pendulum else "")})
            self.run_done("run", "scene.prm", "--quiet")
            header = self.table("output/scene/sweep.csv").header
            self.assertEqual(len(header), len(set(header)))

    def test_parameters_without_use(self):
        self.refused_entries({"Sweep/Parameters": "l: 1, 2", "Material/Shear modulus": 1}, "Sweep/Parameters: ", '"l"', "$(l)", base=SWEEP)
        two = {**SWEEP, "Sweep/Parameters": "l: 1, 2; k5: 1, 2", "Body/Density": "$(1e5)"}
        self.scene(two)
        self.refused("run", "scene.prm", fragments=("Sweep/Parameters: ", '"k5"', "$(k5)"))

    def test_sentences_about_parameters(self):
        for value, keyword in (("l: 1 .. 2 in 1", "where the number of values is not a whole number from 2"),
                               ("l: 1; l: 2", 'where "l" occurs twice'), ("l: 1 .. 2 in 9999999; k: 1, 2", "more than 10000000 runs"),
                               ("l 1, 2", "got "), ("2l: 1, 2", "got "), ("l: 1, x", '"x" as entry 2')):
            message = self.refused_entries({"Sweep/Parameters": value}, "Sweep/Parameters: expected nothing, or parameters ", ", got ",
                                           keyword, base={"Models": "reduced", "Time/End": 1})
            self.assertEqual(message.count("expected"), 1)

    # Systems.

    def test_rotations_and_moments(self):
        base = {"System": "rigid body", "Time/End": 1, "Output/Samples": 10}
        self.refused_entries({"Rigid body/Rotation": "0.866, -0.5, 0; 0.5, 0.866, 0; 0, 0, 1"}, "Rigid body/Rotation: ",
                             'the nearest rotation is "0.866', base=base)
        self.refused_entries({"Rigid body/Rotation": "1, 0.5, 0; 0, 1, 0; 0, 0, 1"}, "Rigid body/Rotation: ", "off by 0.5", base=base)
        self.refused_entries({"Rigid body/Inertia": "1, 0, 0; 0, 1, 0; 0, 0, 2.0000000001", "Rigid body/Form": "euler"},
                             "Rigid body/Inertia: ", "2.0000000001", base=base)

    # Files.

    def test_meshes_of_other_kinds(self):
        mesh = (SOURCE / "meshes/ellipsoid.msh").read_text()
        base = {"Models": "continuum", "Continuum/Degree": 2, "Body/Semi-axes": "1.3, 0.8, 1", "Time/End": 1}
        lines = mesh.split("\n")
        begin, end = lines.index("$Nodes") + 2, lines.index("$EndNodes")
        def moved(change):
            nodes = [line.split() for line in lines[begin:end]]
            return "\n".join([*lines[:begin], *(" ".join([n, *(repr(change(float(x))) for x in X)]) for n, *X in nodes), *lines[end:]])
        for name, content, keyword in (
                ("UTF-16", mesh.encode("utf-16"), "UTF-16"), ("binary", mesh.replace("2.2 0 8", "2.2 1 8"), ":2: expected an ASCII"),
                ("parametric", mesh.replace("$Nodes", "$ParametricNodes"), "-parametric"),
                ("scaled", moved(lambda x: x * 1e150), "Body/Radius = 1"), ("scaled down", moved(lambda x: x * 1e-150), "Body/Radius = 1")):
            with self.subTest(name):
                path = self.scratch / "body.msh"
                path.write_bytes(content) if isinstance(content, bytes) else path.write_text(content)
                self.refused_entries({"Continuum/Mesh": "body.msh"}, "Continuum/Mesh: ", "body.msh", keyword, base=base)
        for name, content in (("mark", "\ufeff" + mesh), ("old line ends", mesh.replace("\n", "\r")), ("moved", moved(lambda x: x + 1e9))):
            with self.subTest(name):
                (self.scratch / "body.msh").write_text(content, newline="")
                self.scene({**base, "Continuum/Mesh": "body.msh"})
                self.run_done("check", "scene.prm")

    def test_damaged_scene_of_a_run_that_is_resumed(self):
        self.scene(BASE)
        self.run_done("run", "scene.prm", "--quiet")
        (self.scratch / "output/scene/used.prm").write_text("set Models = reduced\nfoo\n")
        self.refused("run", "scene.prm", "--resume", fragments=("--resume: ", "output/scene/used.prm:2: expected",))

    def test_a_later_end_with_more_samples_than_there_may_be(self):
        """Samples overflowed, and used.prm was one that the program refused."""
        many = {**BASE, "Time/End": 1, "Output/Samples": 10000, "Output/Quantities": ""}
        self.scene(many)
        self.run_done("run", "scene.prm", "--quiet")
        for end in (2000, 300000, 1e300):
            with self.subTest(end):
                self.refused("run", "scene.prm", "--resume", *overrides({"Time/End": end}),
                             fragments=("--resume: Time/End", "at most 10000000", "until 1000"))
        self.scene({**BASE, "Output/Samples": 10})
        self.run_done("run", "scene.prm", "--quiet")
        self.run_done("run", "scene.prm", "--quiet", "--resume", *overrides({"Time/End": 3}))
        self.run_done("check", "output/scene/used.prm")

    def test_report_in_a_loop_of_links(self):
        self.scene(BASE)
        self.run_done("run", "scene.prm", "--quiet")
        link = self.scratch / "output/scene/reduced.csv"
        link.unlink()
        link.symlink_to("reduced.csv")
        self.refused("report", "output/scene", fragments=("reduced.csv", "links"))

    # Processes.

    def test_scenes_from_pipes(self):
        """The program reads them once: used.prm has what they say."""
        for models in ("reduced", "continuum"):
            text = (f"set Models = {models}\nsubsection Continuum\n set Degree = 2\nend\nsubsection Time\n set End = 0.125\n"
                    "set Step = 0.0625\nset Method = rattle\nend\nsubsection Output\nset Samples = 2\nend\n")
            (self.scratch / "c.prm").write_text(text)
            program = self.command(["run"])
            piped = subprocess.run([*program, "/dev/stdin", "--output", "stdin"], input=text, text=True, capture_output=True,
                                   cwd=self.scratch)
            self.assert_exit(piped, DONE)
            substituted = subprocess.run(["bash", "-c", f"'{self.program}' run <(cat c.prm) --output substituted"],
                                         text=True, capture_output=True, cwd=self.scratch)
            self.assert_exit(substituted, DONE)
            for folder in ("stdin", "substituted"):
                table = self.table(f"{folder}/{models}.csv")
                self.assertEqual(table.column("time"), [0, 0.0625, 0.125])
                self.assertIn("= 0.125", (self.scratch / folder / "used.prm").read_text())

    def test_addresses_that_the_finite_elements_do_not_get(self):
        self.skip_if_sanitized()
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (400 << 20, 400 << 20))
        self.scene({"Models": "continuum", "Time/End": 1})
        result = self.run_program("run", "scene.prm", preexec_fn=limit)
        self.assert_exit(result, STOPPED)
        self.assertIn("ulimit -v", result.stderr)
        self.assertEqual(self.files(), ["scene.prm"])


if __name__ == "__main__":
    unittest.main()
