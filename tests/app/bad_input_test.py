"""Bad input of every kind: exit code 2, one helpful sentence that says where and what was expected, nothing written."""
import os
import re
import shutil
import unittest

from program_test import SOURCE, WRONG_INPUT, overrides, words
from refused_input import BASE, RefusedInputTest

DIAGONAL = "Initial state/Deformation"
VELOCITY = "Initial state/Velocity"

# One entry a line, so that the tests know the numbers of the lines.
LINES = """set Models = reduced
subsection Body
  set Radius = 1
end
subsection Time
  set End = 1
end
"""


class BadInput(RefusedInputTest):
    def refused_lines(self, old, new, *fragments):
        """The scene LINES with one line replaced."""
        self.assertIn(old, LINES)
        self.scene(LINES.replace(old, new))
        return self.refused("run", "scene.prm", fragments=fragments)

    # What is not in the language.

    def test_typo_in_entry(self):
        self.refused_lines("set Radius", "set Raduis", "scene.prm:3:", '"Body/Raduis"', 'did you mean "Body/Radius"?')
        self.scene(BASE)
        self.refused("run", "scene.prm", "--set", "Body/Raduis=1",
                     fragments=("error: --set: ", 'did you mean "Body/Radius"?'))

    def test_typo_in_section(self):
        self.refused_lines("subsection Body", "subsection Boddy", "scene.prm:2:", '"Boddy"', 'did you mean "Body"?')

    def test_entry_in_the_wrong_section(self):
        self.refused_lines("set Radius", "set End", "scene.prm:3:", '"Body/End"', 'did you mean "Time/End"?')

    def test_no_statement(self):
        self.refused_lines("set Radius = 1", "Radius: 1", "scene.prm:3:", '"set Name = value"')

    def test_missing_equals_sign(self):
        self.refused_lines("set Radius = 1", "set Radius 1", "scene.prm:3:", 'no "="')

    def test_missing_end(self):
        self.scene(LINES.rsplit("end", 1)[0])
        self.refused("run", "scene.prm", fragments=("scene.prm:5:", '"Time"', 'not closed by an "end"'))

    def test_surplus_end(self):
        self.scene(LINES + "end\n")
        self.refused("run", "scene.prm", fragments=("scene.prm:8:", "closes no subsection"))

    def test_unknown_word_of_a_choice(self):
        self.refused_entries({"Time/Method": "ratle-4"}, "Time/Method", "one of " + ", ".join(words("Time/Method")),
                             'did you mean "rattle-4"?')
        self.refused_entries({"Material/Law": "rubber"}, "Material/Law", "one of " + ", ".join(words("Material/Law")),
                             '"rubber"')

    def test_unknown_model(self):
        self.refused_entries({"Models": "reduced, continum"}, "Models", 'did you mean "continuum"?')

    def test_no_model(self):
        self.refused_entries({"Models": ""}, "Models", "at least one of " + ", ".join(words("Models")))

    def test_what_the_design_names_but_is_not_offered(self):
        self.refused_entries({"Analysis": "mode"}, "Analysis", 'did you mean "modes"?')
        self.refused_entries({"Analysis": "modes", "Models": "reduced"}, "Analysis", "set Models = polynomial, continuum")
        self.refused_entries({"Analysis": "modes", "Models": "continuum", "Continuum/Symmetry": "none"},
                             "Continuum/Symmetry", "set Symmetry = auto")
        self.refused_entries({"Analysis": "modes", "Models": "continuum",
                              "Initial state/Velocity": "0, 1, 0; 0, 0, 0; 0, 0, 0"}, "Initial state/Velocity", "from rest")

    # Values.

    def test_entries_of_another_system(self):
        self.refused_entries({"Double pendulum/Gravity": "1"}, "Double pendulum/Gravity: it belongs to System = double")
        self.scene("set System = double pendulum\nsubsection Body\n  set Radius = 2\nend\n")
        self.refused("run", "scene.prm", fragments=("scene.prm:3:", "Body/Radius: it belongs to System = ball"))

    def test_fluid_in_the_continuum(self):
        self.refused_entries({"Models": "continuum", "Material/Law": "none"}, "Material/Law: a fluid with neither", "Models = reduced")

    def test_methods_that_do_not_fit(self):
        self.refused_entries({"Models": "continuum", "Time/Method": "explicit-8"}, "Time/Method",
                             "explicit-8 is offered for", "Method = rattle or rattle-4")
        self.scene("set System = double pendulum\nsubsection Double pendulum\n  set Form = lagrange\nend\n"
                   "subsection Time\n  set Method = rattle-4\nend\n")
        self.refused("run", "scene.prm", fragments=("scene.prm:6: Time/Method: rattle-4 cannot integrate", "explicit-8"))

    def test_not_a_number(self):
        self.refused_lines("Radius = 1", "Radius = one", "scene.prm:3:", "Body/Radius: expected a number > 0", '"one"')
        self.refused_entries({"Body/Radius": "1,5"}, "Body/Radius: expected a number > 0", '"1,5"')

    def test_nan_and_infinity(self):
        for value in ("nan", "inf", "-inf", "1e999"):
            with self.subTest(value):
                self.refused_entries({"Body/Radius": value}, "Body/Radius: expected a number > 0", f'"{value}"')
        self.refused_entries({VELOCITY: "0,nan,0;0,0,0;0,0,0"}, VELOCITY, "finite", "(1,2)")

    def test_empty_value(self):
        self.refused_entries({"Body/Radius": ""}, "Body/Radius: expected a number > 0", "got nothing")

    def test_value_out_of_range(self):
        self.refused_entries({"Time/Tolerance": "0.5"}, "Time/Tolerance", "a number from 1e-13 to", '"0.5"')
        self.refused_entries({"Continuum/Degree": "9"}, "Continuum/Degree", "a whole number from 1 to 8", '"9"')
        self.refused_entries({"Continuum/Degree": "2.5"}, "Continuum/Degree", "a whole number from 1 to 8", '"2.5"')
        self.refused_entries({"Output/Samples": "0"}, "Output/Samples", '"0"')
        self.refused_entries({"Time/Step": "-1"}, "Time/Step", "auto or a number > 0", '"-1"')
        self.refused_entries({"Time/End": "0"}, "Time/End", "a number > 0", '"0"')

    def test_negative_density(self):
        self.refused_entries({"Body/Density": "-1"}, "Body/Density: expected a number > 0", '"-1"')

    def test_units_out_of_range(self):
        self.refused_entries({"Body/Radius": "1e-200"}, "Body/Radius", "nearer to the size of the body")

    def test_matrix_of_wrong_shape(self):
        self.refused_entries({DIAGONAL: "1, 0; 0, 1"}, DIAGONAL, "3x3 matrix", "2 rows")
        self.refused_entries({DIAGONAL: "1, 0, 0; 0, 1; 0, 0, 1"}, DIAGONAL, "row 2 has 2 entries")

    def test_step_longer_than_the_run(self):
        self.refused_entries({"Time/Step": "2"}, "Time/Step", "not longer than Time/End = 1", "got 2")

    def test_more_frames_than_samples(self):
        self.refused_entries({"Output/Graphics": "vtu", "Output/Frames": "11"},
                             "Output/Frames", "at most", "Output/Samples = 10", "got 11")

    # The initial state.

    def test_negative_determinant(self):
        self.refused_entries({DIAGONAL: "1,0,0;0,1,0;0,0,-1"}, DIAGONAL, "positive determinant", "determinant -1")

    def test_zero_determinant(self):
        self.refused_entries({DIAGONAL: "1,0,0;0,1,0;0,0,0"}, DIAGONAL, "positive determinant", "determinant 0")
        self.refused_entries({DIAGONAL: "0,0,0;0,0,0;0,0,0"}, DIAGONAL, "positive determinant")
        self.refused_entries({DIAGONAL: "1,2,3;4,5,6;7,8,9", "Body/Incompressible": "false"}, DIAGONAL)

    def check_proposal_works(self, path, message):
        proposal = re.search(r'the nearest choice is "set [A-Z][a-z]+ = ([^"]*)"', message)
        self.assertIsNotNone(proposal, message)
        return proposal[1]

    def test_determinant_not_one(self):
        message = self.refused_entries({DIAGONAL: "1.1,0.2,0;0,1,0;0.1,0,0.8"}, DIAGONAL, "expected det = 1 within 1e-08",
                                       "got det = 0.88")
        proposal = self.check_proposal_works(DIAGONAL, message)
        self.scene({**BASE, DIAGONAL: proposal})
        self.run_done("run", "scene.prm", "--quiet")
        self.assertAlmostEqual(self.table("output/scene/reduced.csv").column("volume_ratio")[0], 1, delta=1e-14)

    def test_velocity_not_tangent(self):
        stretched = {DIAGONAL: "2,0,0;0,1,0;0,0,0.5"}
        entries = {**stretched, VELOCITY: "0.3,0,0.1;0,0.1,0;0,0.2,0"}
        message = self.refused_entries(entries, VELOCITY, "expected |tr(Q0^-1 Qdot0)| r/c <= 1e-08", "got 0.25")
        proposal = self.check_proposal_works(VELOCITY, message)
        self.scene({**BASE, **stretched, VELOCITY: proposal})
        self.run_done("run", "scene.prm", "--quiet")

    def test_compressible_bodies_take_the_same_states(self):
        self.scene({**BASE, "Body/Incompressible": "false", DIAGONAL: "1.1,0.2,0;0,1,0;0.1,0,0.8",
                    VELOCITY: "0.3,0,0.1;0,0.1,0;0,0.2,0"})
        self.run_done("run", "scene.prm", "--quiet")

    def test_sector_not_admitted(self):
        self.refused_entries({"Models": "continuum", VELOCITY: "0,0.1,0;-0.1,0,0;0,0,0", "Continuum/Symmetry": "octant"},
                             "Continuum/Symmetry", "plane with normal x", "entry (1,2)", "0.1", "Symmetry = auto")

    # Files.

    def test_missing_file(self):
        self.refused("run", "nowhere.prm", fragments=('"nowhere.prm"', "cannot open"))
        self.scene({}, "quickstart.prm")
        self.refused("run", "quikstart.prm", fragments=('"quikstart.prm"', "cannot open", 'did you mean "quickstart.prm"?'))

    def test_directory_in_place_of_a_file(self):
        (self.scratch / "folder").mkdir()
        self.refused("run", "folder", fragments=("folder: expected a parameter file", "is a directory"))

    def test_binary_file(self):
        (self.scratch / "scene.prm").write_bytes(self.program.read_bytes()[:4096])
        self.refused("run", "scene.prm", fragments=("scene.prm:1:", "not a parameter file"))

    def test_endless_file(self):
        self.refused("run", "/dev/zero", fragments=("/dev/zero",))

    def test_include_of_a_missing_file_and_of_itself(self):
        self.scene("set Models = reduced\ninclude nowhere.prm\n")
        self.refused("run", "scene.prm", fragments=("scene.prm:2:", '"nowhere.prm"'))
        self.scene("include scene.prm\n")
        self.refused("run", "scene.prm", fragments=("scene.prm:1:", "includes itself"))

    def test_meshes(self):
        whole = (SOURCE / "meshes/rough_ball.msh").read_text()
        def refused(text, *fragments):
            (self.scratch / "body.msh").write_text(text)
            self.refused_entries({"Models": "continuum", "Continuum/Mesh": "body.msh"}, "body.msh", *fragments)
        self.refused_entries({"Models": "continuum", "Continuum/Mesh": "nowhere.msh"}, "nowhere.msh")
        refused(whole[:len(whole) // 2])
        refused(whole[:-20])
        refused("")
        refused(whole.replace("2.2 0 8", "4.1 0 8"), "2.2")
        first_node = whole.index("$Nodes") + len("$Nodes\n")
        lines = whole[first_node:].split("\n")
        number, *_ = lines[1].split()
        lines[1] = f"{number} nan 0 0"
        refused(whole[:first_node] + "\n".join(lines))
        # A node of the first cell on the other side of the body turns the cell inside out.
        coordinates = whole[first_node:].split("\n")[1].split()
        lines[1] = f"{number} {' '.join(str(-3 * float(x) + 0.1) for x in coordinates[1:])}"
        refused(whole[:first_node] + "\n".join(lines))

    def test_output_below_a_file(self):
        self.scene(BASE)
        (self.scratch / "file").write_text("")
        self.refused("run", "scene.prm", "--output", "file/results", fragments=("--output: ", "'file/results'"))
        self.refused("run", "scene.prm", "--set", "Output/Directory=file",
                     fragments=("error: --set: Output/Directory: ", "'file/scene'", "Not a directory"))
        self.scene(LINES + "subsection Output\n  set Directory = file\nend\n")
        self.refused("run", "scene.prm", fragments=("error: scene.prm:9: Output/Directory: ", "'file/scene'"))

    def test_output_where_nobody_may_write(self):
        self.scene(BASE)
        self.refused("run", "scene.prm", "--output", "/proc/results", fragments=("--output: ", "'/proc/results'"))
        self.refused("run", "scene.prm", "--output", "scene.prm", fragments=("--output: ", "'scene.prm'"))
        self.refused("run", "scene.prm", "--output", "", fragments=("--output: ",))

    # The command line.

    def test_wrong_option(self):
        self.scene(BASE)
        self.refused("run", "scene.prm", "--fast", fragments=("--fast", "--help"))
        self.refused("--fast", fragments=("--fast", "--help"))

    def test_wrong_command(self):
        self.refused("walk", "scene.prm", fragments=('unknown command "walk"', "run, check, parameters, report", "--help"))
        self.refused("rum", "scene.prm", fragments=('"rum"; did you mean "run"?',))
        for arguments, name, help_of in ((("run", "scene.prm", "--sett", "A=1"), '"--sett"; did you mean "--set"?', "run"),
                                         (("report", "run", "--ouput", "page"), '"--ouput"; did you mean "--output"?', "report"),
                                         (("check", "scene.prm", "--frobnicate"), '"--frobnicate"; ', "check")):
            self.refused(*arguments, fragments=(f"unknown option {name}", f"see pseudorigid {help_of} --help"))
        self.refused("run", "scene.prm", "other.prm", fragments=('expected no further argument, got "other.prm"',))
        self.refused("chek", fragments=('"chek"; did you mean "check"?',))
        self.refused("scene.prm", fragments=("expected a command", "pseudorigid run scene.prm"))

    def test_missing_scene(self):
        self.refused("run", fragments=("SCENE", "--help"))
        self.refused("check", fragments=("SCENE", "--help"))
        self.refused("run", "", fragments=("SCENE",))

    def test_two_scenes(self):
        self.scene(BASE)
        self.refused("run", "scene.prm", "scene.prm", fragments=("scene.prm", "--help"))

    def test_quiet_and_verbose(self):
        self.scene(BASE)
        self.refused("run", "scene.prm", "--quiet", "--verbose", fragments=("--quiet", "--verbose"))

    def test_malformed_set(self):
        self.scene(BASE)
        for text in ("Time/End", "", "=", "=1", "Time/End==1", "/=1", "Time/End=1\nset Models = x"):
            with self.subTest(text):
                self.refused("run", "scene.prm", "--set", text, fragments=("error: --set: ",))
        self.refused("run", "scene.prm", "--set", fragments=("--set",))

    def test_unknown_format(self):
        message = self.refused("parameters", "--format", "yaml", fragments=("--format", "prm, markdown or json", '"yaml"'))
        self.assertNotIn("FAILED", message)
        self.refused("parameters", "--format", "0", fragments=("--format",))

    # Resuming.

    def finished_run(self):
        self.scene(BASE)
        self.run_done("run", "scene.prm", "--quiet")

    def test_resume_without_a_checkpoint(self):
        self.scene(BASE)
        self.refused("run", "scene.prm", "--resume", fragments=("--resume: ", "'output/scene'", "no checkpoint"))
        (self.scratch / "output/scene").mkdir(parents=True)
        self.refused("run", "scene.prm", "--resume", fragments=("--resume: ", "'output/scene'", "no checkpoint"))

    def test_resume_with_another_scene(self):
        self.finished_run()
        for entries, difference in (
                ({"Body/Radius": 2}, 'Body/Radius = "2", which was "1";'),
                ({"Output/Quantities": "state"}, 'Output/Quantities = "state", which was "all";'),
                ({"Material/Law": "gent", "Body/Density": 2},
                 'Body/Density = "2", which was "1"; Material/Law = "gent", which was "neo-hookean";')):
            with self.subTest(entries):
                self.refused("run", "scene.prm", "--resume", *overrides(entries),
                             fragments=("--resume: ", "another scene: " + difference, "Time/Step"))
        many = {"Body/Radius": 2, "Body/Density": 3, "Material/Law": "gent", "Material/Shear modulus": 4,
                "Material/Gent limit": 5, "Output/Quantities": "axes", "Initial state/Center": "1, 2, 3"}
        self.refused("run", "scene.prm", "--resume", *overrides(many), fragments=("another scene", "; and 2 more;"))

    def test_resume_with_an_end_that_does_not_fit(self):
        """BASE has samples at every 0.1 until 1."""
        self.finished_run()
        for entries, fragment in (
                ({"Time/End": 0.5}, "Time/End = 0.5 is before the end of the run, 1"),
                ({"Time/End": 1.25}, "the next multiple is 1.3")):
            with self.subTest(entries):
                self.refused("run", "scene.prm", "--resume", *overrides(entries), fragments=("--resume: ", fragment))

    def test_resume_with_a_damaged_checkpoint(self):
        self.finished_run()
        checkpoint = self.scratch / "output/scene/checkpoint-reduced.bin"
        good = checkpoint.read_bytes()
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 1
        for damaged in (b"", good[:20], good[:-1], good + b"x", bytes(flipped), b"x" + good[1:], os.urandom(500)):
            with self.subTest(damaged[:40]):
                checkpoint.write_bytes(damaged)
                self.refused("run", "scene.prm", "--resume", fragments=("checkpoint-reduced.bin", "cannot be used"))

    def test_resume_with_missing_or_foreign_results(self):
        """Seen only once the run has begun: a line of the log comes first, and the log and the manifest tell of it."""
        self.finished_run()
        csv = self.scratch / "output/scene/reduced.csv"
        good = csv.read_text()
        for other in (None, "", "time,apples\n0,1\n", good.replace("Q11", "P11"), good[:len(good) // 2]):
            with self.subTest(other and other[:40]):
                csv.unlink() if other is None else csv.write_text(other)
                result = self.run_program("run", "scene.prm", "--resume", "--quiet")
                self.assert_one_sentence(result, "reduced.csv")
                self.assertEqual(csv.read_text() if csv.exists() else None, other)
        csv.write_text(good)
        self.run_done("run", "scene.prm", "--resume")
        self.assertEqual(csv.read_text(), good)

    # Processes.

    def test_missing_continuum_library(self):
        alone = self.scratch / "bin"
        alone.mkdir()
        shutil.copy(self.program, alone)
        self.program = alone / self.program.name
        self.scene({**BASE, "Models": "continuum"})
        self.refused("run", "scene.prm", fragments=("libpseudorigid-continuum", "Models = reduced"))
        self.scene(BASE)
        self.run_done("run", "scene.prm", "--quiet")


if __name__ == "__main__":
    unittest.main()
