"""Sweeps of modes and Love numbers: rows are those of single runs, whatever stops or divides them; and what is refused."""
import unittest

from program_test import SOURCE, ProgramTest, overrides
from refused_input import RefusedInputTest

LOVE = {"Analysis": "love numbers", "Models": "reduced, polynomial, continuum", "Polynomial/Degree": "3, 5", "Continuum/Degree": 3,
        "Love numbers/Degrees": "2, 3", "Gravity/Gamma": "$(g)", "Sweep/Parameters": "g: 0.1, 1, 10"}
MODES = {"Analysis": "modes", "Models": "polynomial, continuum", "Polynomial/Degree": 3, "Continuum/Degree": 2, "Modes/Number": 3,
         "Material/Shear modulus": "$(mu)", "Sweep/Parameters": "mu: 1, 4"}


class LinearSweeps(ProgramTest):
    def sweep(self, entries, *options, output="sweep"):
        self.scene(entries)
        self.run_done("run", "scene.prm", "--output", output, *options)
        return self.table(output, "sweep.csv")

    def rows_are_single_runs(self, entries, parameter, tables):
        sweep = self.sweep(entries)
        self.assertEqual(sweep.column("finished"), [1] * len(sweep))
        for i, value in enumerate(sweep.column(parameter)):
            # The value as an expression, so that both runs evaluate the same text.
            single = {**entries, **{path: text.replace(f"$({parameter})", f"$({value!r})") for path, text in entries.items() if isinstance(text, str)},
                      "Sweep/Parameters": ""}
            self.scene(single, "single.prm")
            self.run_done("run", "single.prm", "--output", "single")
            for prefix, name in tables.items():
                table = self.table(f"single/{name}.csv")
                index, *columns = table.header
                for row, number in enumerate(table.column(index)):
                    for column in columns:
                        self.assertEqual(table.column(column)[row], sweep.column(f"{prefix}_{column}_{number:.0f}")[i], (name, column, value))

    def test_rows_of_love_numbers_are_those_of_single_runs(self):
        self.rows_are_single_runs(LOVE, "g", {"reduced": "love-reduced", "polynomial_3": "love-polynomial-3",
                                              "polynomial": "love-polynomial", "continuum": "love-continuum"})

    def test_rows_of_modes_are_those_of_single_runs(self):
        self.rows_are_single_runs(MODES, "mu", {"polynomial": "modes-polynomial", "continuum": "modes"})

    def test_frequencies_scale_with_the_root_of_the_modulus(self):
        sweep = self.sweep(MODES)
        for model in ("polynomial", "continuum"):
            for i in (1, 2, 3):
                one, four = sweep.column(f"{model}_omega_{i}")
                self.assertAlmostEqual(four / one, 2, delta=1e-8)

    def test_rows_do_not_depend_on_threads_or_parts(self):
        whole = self.sweep(LOVE)
        self.sweep(LOVE, "--set", "Sweep/Threads=1", output="one")
        self.assertEqual(self.bytes("sweep/sweep.csv"), self.bytes("one/sweep.csv"))
        rows = []
        for part in (1, 2):
            rows += self.sweep(LOVE, "--set", f"Sweep/Part={part} of 2", output=f"part{part}").rows
        self.assertEqual(rows, whole.rows)

    def test_a_run_that_fails_is_a_row(self):
        """Elements of degree 1 are too coarse for eight modes."""
        self.scene({"Analysis": "modes", "Models": "continuum", "Body/Incompressible": "false", "Material/Lame lambda": 1,
                    "Continuum/Degree": "$(k)", "Modes/Number": 8, "Sweep/Parameters": "k: 1, 4"})
        result = self.run_done("run", "scene.prm", "--output", "sweep")
        sweep = self.table("sweep/sweep.csv")
        self.assertEqual(sweep.column("finished"), [0, 1])
        self.assertEqual(sweep.column("continuum_omega_1")[0], 0)
        self.assertGreater(sweep.column("continuum_omega_1")[1], 2)
        self.assertIn("1 of them stopped early", result.stderr)

    def test_modes_over_gravity(self):
        self.scene((SOURCE / "params/modes_over_gravity.prm").read_text(), "modes_over_gravity.prm")
        self.run_done("run", "modes_over_gravity.prm", *overrides({"Output/Report": "true"}))
        sweep = self.table("output/modes_over_gravity/sweep.csv")
        self.assertEqual(len(sweep), 10)
        for model, accuracy in (("continuum", 2e-3), ("polynomial", 2e-2)):
            for i in range(1, 5):
                for omega, exact in zip(sweep.column(f"{model}_omega_{i}"), sweep.column(f"{model}_exact_{i}")):
                    self.assertAlmostEqual(omega / exact, 1, delta=accuracy, msg=(model, i))
        self.assertIn("continuum_omega_1", self.scratch.joinpath("output/modes_over_gravity/report.html").read_text())


class RefusedLinearSweeps(RefusedInputTest):
    def test_refused(self):
        self.refused_entries({**LOVE, "Sweep/Trajectories": "true", "Models": "reduced"}, "Sweep/Trajectories", "no samples")
        self.refused_entries({**LOVE, "Analysis": "equilibrium", "Models": "reduced", "Polynomial/Degree": 3}, "Analysis", "sweep")
        self.refused_entries({**LOVE, "Sweep/Parameters": "reduced_h_2: 1, 2", "Gravity/Gamma": "$(reduced_h_2)"}, "Sweep/Parameters", "names")
        self.refused_entries({**MODES, "Material/Shear modulus": 1, "Modes/Number": "$(n)", "Sweep/Parameters": "n: 3, 4"}, "Sweep/Parameters", "columns")
        self.refused_entries({**LOVE, "Gravity/Gamma": 1, "Continuum/Degree": 4, "Love numbers/Degrees": "2, $(n)", "Sweep/Parameters": "n: 3, 4"},
                             "Sweep/Parameters", "columns")


if __name__ == "__main__":
    unittest.main()
