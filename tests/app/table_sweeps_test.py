"""Sweeps of modes, Love numbers and equilibria: rows are those of single runs, and some scenes are refused."""
import unittest

from program_test import SOURCE, ProgramTest, overrides
from refused_input import RefusedInputTest

LOVE = {"Analysis": "love numbers", "Models": "reduced, polynomial, continuum", "Polynomial/Degree": "3, 5", "Continuum/Degree": 3,
        "Love numbers/Degrees": "2, 3", "Gravity/Gamma": "$(g)", "Sweep/Parameters": "g: 0.1, 1, 10"}
MODES = {"Analysis": "modes", "Models": "polynomial, continuum", "Polynomial/Degree": 3, "Continuum/Degree": 2, "Modes/Number": 3,
         "Material/Shear modulus": "$(mu)", "Sweep/Parameters": "mu: 1, 4"}
FIGURES = {"Analysis": "equilibrium", "Models": "reduced, polynomial, continuum", "Polynomial/Degree": "3, 5", "Continuum/Degree": 2,
           "Equilibrium/Family": "spinning", "Equilibrium/First": "$(w)", "Equilibrium/Number": 1, "Sweep/Parameters": "w: 0.05, 1"}


class TableSweeps(ProgramTest):
    def sweep(self, entries, *options, output="sweep"):
        self.scene(entries)
        self.run_done("run", "scene.prm", "--output", output, *options)
        return self.table(output, "sweep.csv")

    def single_runs(self, entries, parameter):
        """Runs the sweep, and then each of its runs alone. Yields the number of the run, and the table of the sweep."""
        sweep = self.sweep(entries)
        self.assertEqual(sweep.column("finished"), [1] * len(sweep))
        for i, value in enumerate(sweep.column(parameter)):
            # The value as an expression, so that both runs evaluate the same text.
            single = {**entries, **{path: text.replace(f"$({parameter})", f"$({value!r})") for path, text in entries.items() if isinstance(text, str)},
                      "Sweep/Parameters": ""}
            self.scene(single, "single.prm")
            self.run_done("run", "single.prm", "--output", "single")
            yield i, sweep

    def rows_are_single_runs(self, entries, parameter, tables):
        for i, sweep in self.single_runs(entries, parameter):
            for prefix, name in tables.items():
                table = self.table(f"single/{name}.csv")
                index, *columns = table.header
                for row, number in enumerate(table.column(index)):
                    for column in columns:
                        self.assertEqual(table.column(column)[row], sweep.column(f"{prefix}_{column}_{number:.0f}")[i], (name, column, i))

    def test_rows_of_love_numbers_are_those_of_single_runs(self):
        self.rows_are_single_runs(LOVE, "g", {"reduced": "love-reduced", "polynomial_3": "love-polynomial-3",
                                              "polynomial": "love-polynomial", "continuum": "love-continuum"})

    def test_rows_of_modes_are_those_of_single_runs(self):
        self.rows_are_single_runs(MODES, "mu", {"polynomial": "modes-polynomial", "continuum": "modes"})

    def test_rows_of_equilibria_are_those_of_single_runs(self):
        tables = {"reduced": ("equilibria", 0), "polynomial_3": ("equilibria-polynomial", 0), "polynomial": ("equilibria-polynomial", 1),
                  "continuum": ("equilibria-continuum", 0)}
        for i, sweep in self.single_runs(FIGURES, "w"):
            for prefix, (name, row) in tables.items():
                table = self.table(f"single/{name}.csv")
                for column in table.header[table.header.index("kind") + 1:]:
                    self.assertEqual(table.column(column)[row], sweep.column(f"{prefix}_{column}")[i], (name, column, i))

    def test_ellipticity_of_a_slowly_spinning_ball(self):
        """It is 1/10 of the square of the spin for the ellipsoid, and 5/38 for the elastic ball (PHYSICS: Thomson)."""
        sweep = self.sweep({**FIGURES, "Sweep/Parameters": "w: 0.02"})
        for axes, exact, accuracy in (("reduced_a", 1 / 10, 1e-3), ("polynomial_surface", 5 / 38, 1e-3), ("continuum_surface", 5 / 38, 1e-2)):
            ellipticity = sweep.column(f"{axes}1")[0] - sweep.column(f"{axes}3")[0]
            self.assertAlmostEqual(ellipticity / 0.02 ** 2, exact, delta=accuracy * exact, msg=axes)

    def test_bulge_of_a_slowly_spinning_gravitating_ball(self):
        """Love numbers h2 of the ellipsoid, 5/2/(1 + 12.5/gamma), and of the sphere, 5/2/(1 + 9.5/gamma), have this ratio."""
        sweep = self.sweep({**FIGURES, "Models": "reduced, polynomial", "Gravity/Gamma": "$(g)", "Equilibrium/First": "$(0.1 + 0.01*g)",
                            "Sweep/Parameters": "g: 1, 10"})
        for i, gamma in enumerate(sweep.column("g")):
            bulge, right = (sweep.column(f"{axes}1")[i] - sweep.column(f"{axes}3")[i] for axes in ("reduced_a", "polynomial_surface"))
            self.assertAlmostEqual(bulge / right, (gamma + 9.5) / (gamma + 12.5), delta=1e-3)

    def test_a_spin_without_an_equilibrium_is_a_row(self):
        sweep = self.sweep({**FIGURES, "Models": "reduced, polynomial", "Sweep/Parameters": "w: 1, 3"})
        self.assertEqual(sweep.column("finished"), [1, 0])
        self.assertGreater(sweep.column("reduced_a1")[0], 1)
        self.assertEqual(sweep.column("reduced_a1")[1], 0)

    def test_a_single_degree_without_a_figure_fails_the_run(self):
        """At 2.15 c/r the bodies of degree 1 and 2 have a spheroid, and that of degree 9 does not."""
        sweep = self.sweep({**FIGURES, "Models": "reduced, polynomial", "Polynomial/Degree": "2, 9", "Sweep/Parameters": "w: 2, 2.15"})
        self.assertEqual(sweep.column("finished"), [1, 0])
        for prefix, finished in (("reduced", [1, 1]), ("polynomial_2", [1, 1]), ("polynomial", [1, 0])):
            self.assertEqual(sweep.column(f"{prefix}_finished"), finished, prefix)
            self.assertEqual([float(a1 > 0) for a1 in sweep.column(f"{prefix}_a1")], finished, prefix)

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

    def test_parts_of_equilibria(self):
        entries = {**FIGURES, "Models": "reduced, polynomial", "Sweep/Parameters": "w: 0.1 .. 1.4 in 12"}
        whole = self.sweep(entries)
        rows = [row for part in (1, 2) for row in self.sweep(entries, "--set", f"Sweep/Part={part} of 2", output=f"part{part}").rows]
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


class RefusedTableSweeps(RefusedInputTest):
    def test_refused(self):
        self.refused_entries({**LOVE, "Sweep/Trajectories": "true", "Models": "reduced"}, "Sweep/Trajectories", "no samples")
        self.refused_entries({**FIGURES, "Equilibrium/Number": 2}, "Equilibrium/Number", "one figure")
        self.refused_entries({**FIGURES, "Models": "reduced", "Equilibrium/Family": "static"}, "Models", "Polynomial/Degree")
        self.refused_entries({**FIGURES, "Models": "reduced", "Sweep/Trajectories": "true"}, "Sweep/Trajectories", "no samples")
        self.scene({"System": "double pendulum", "Analysis": "equilibrium", "Sweep/Parameters": "w: 1, 2"})
        self.refused("run", "scene.prm", fragments=("scene.prm:", "Analysis", "sweep"))
        self.refused_entries({**LOVE, "Sweep/Parameters": "reduced_h_2: 1, 2", "Gravity/Gamma": "$(reduced_h_2)"}, "Sweep/Parameters", "names")
        self.refused_entries({**MODES, "Material/Shear modulus": 1, "Modes/Number": "$(n)", "Sweep/Parameters": "n: 3, 4"}, "Sweep/Parameters", "columns")
        self.refused_entries({**LOVE, "Gravity/Gamma": 1, "Continuum/Degree": 4, "Love numbers/Degrees": "2, $(n)", "Sweep/Parameters": "n: 3, 4"},
                             "Sweep/Parameters", "columns")


if __name__ == "__main__":
    unittest.main()
