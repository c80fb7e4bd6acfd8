"""Equilibria of finite elements: families of figures that turn, a ball at rest under loads, their errors, and refusals."""
import math
import signal
import subprocess
import unittest

from program_test import SOURCE, STOPPED, ProgramTest, largest_difference, matrix, overrides
from refused_input import RefusedInputTest

FIGURES = {"Analysis": "equilibrium", "Models": "continuum", "Continuum/Degree": 3, "Equilibrium/Family": "spinning",
           "Equilibrium/First": 0.5, "Equilibrium/Last": 1, "Equilibrium/Number": 2}
AT_REST = {"Analysis": "equilibrium", "Models": "reduced, continuum", "Continuum/Degree": 3, "Equilibrium/Family": "static"}


class ContinuumEquilibria(ProgramTest):
    def figures(self, folder="output/scene"):
        return self.table(folder, "equilibria-continuum.csv")

    def test_spinning_figures(self):
        output = self.scratch / "out"
        self.run_done("run", str(SOURCE / "params/spinning_figures.prm"), "--output", str(output))
        elements, bodies = (self.table(output, f"equilibria-{name}.csv") for name in ("continuum", "polynomial"))
        of_7 = [k for k, N in enumerate(bodies.column("degree")) if N == 7]
        self.assertEqual(len(elements), len(of_7))
        # Both the elements and the polynomial body have an error; the bar is that of the elements.
        self.assertLess(max(elements.column("rates_error")), 0.01)
        self.assertLess(max(elements.column("axes_error")), 1e-4)
        self.assertLess(max(elements.column("surface_error")), 2e-3)
        for bar, names in (("axes_error", ("a1", "a2", "a3")), ("surface_error", ("surface1", "surface2", "surface3")),
                           ("rates_error", ("rate_1_im", "rate_3_im", "rate_5_im"))):
            for name in names:
                for mine, k, error in zip(elements.column(name), of_7, elements.column(bar)):
                    self.assertAlmostEqual(mine, bodies.column(name)[k], delta=error + 1e-9, msg=(name, k))
        first = {name: elements.column(name)[0] for name in elements.header}
        self.assertAlmostEqual((first["surface1"] - first["surface3"]) / first["omega3"] ** 2, 5 / 38, delta=0.02)
        for J, Z, energy, spin in zip(*map(elements.column, ("J3", "Z3", "kinetic", "omega3"))):
            self.assertAlmostEqual(J / Z, 1, delta=1e-5)  # equal on a spheroid that turns rigidly
            self.assertAlmostEqual(energy, J * spin / 2, delta=1e-12)
        self.assertEqual(elements.column("parameter_error"), [0] * len(elements))

    def test_a_terminal_gets_the_progress(self):
        self.scene({**FIGURES, "Equilibrium/Number": 12})
        text = self.terminal_output("run", "scene.prm")
        self.assertRegex(text, r"\requilibria-continuum  +\d+ %  \S+ figures/s  \d+ s left\x1b\[K")

    def test_an_interrupted_family_is_resumed(self):
        family = {**FIGURES, "Equilibrium/Number": 14}
        self.scene(family)
        self.run_done("run", "scene.prm", "--output", "whole")
        process = self.start_program("run", "scene.prm", "--output", "begun", stderr=subprocess.PIPE, text=True)
        log = self.scratch / "begun/log.txt"
        self.wait_until(lambda: log.exists() and log.read_text().count("step 0") > 6, "some figures are known")
        process.send_signal(signal.SIGINT)
        _, error = process.communicate()
        self.assertEqual(process.returncode, STOPPED, error)
        self.assertIn("--resume", error)
        n_begun = len(self.figures("begun"))
        self.assertGreater(n_begun, 0)
        self.assertLess(n_begun, 14)
        self.run_done("run", "scene.prm", "--output", "begun", "--resume")
        difference = largest_difference(self.figures("whole"), self.figures("begun"))
        print(f"largest difference {difference:.1e}")
        self.assertLess(difference, 1e-9)
        # Nothing is left to compute, and another family is refused.
        self.run_done("run", "scene.prm", "--output", "begun", "--resume")
        counters = self.json("begun/manifest.json")["models"]["continuum"]["counters"]
        self.assertEqual((counters["equilibria"], counters["newton_steps"]), (14, 0))
        other = self.run_program("run", "scene.prm", "--output", "begun", "--resume", *overrides({"Equilibrium/Last": 2}))
        self.assert_one_sentence(other, "Equilibrium/Last")

    def test_traction_is_that_of_the_pseudo_rigid_body(self):
        self.scene({**AT_REST, "Loads/Nominal traction": matrix(0.3, 0.3, 0.9)})
        self.run_done("run", "scene.prm")
        elements, body = self.figures(), self.table("output/scene/equilibria.csv")
        self.assertEqual(elements.column("parameter"), [1])
        a = sorted((elements.column(f"a{i}")[0] for i in (1, 2, 3)), reverse=True)
        distances = [max(abs(a[i] - body.column(f"a{i + 1}")[k]) for i in range(3)) for k in range(len(body))]
        self.assertLess(min(distances), 1e-11)
        self.assertLess(elements.column("nonaffine_displacement")[0], 1e-12)

    def test_trap_is_that_of_the_other_models_to_their_difference(self):
        """A bead in a denser fluid: a trap across the axis. The pseudo-rigid body is close, the elements are not affine."""
        stretches = {}
        for k in 0.01, 1:
            self.scene({**AT_REST, "Loads/Tidal matrix": matrix(k, k, 0), "Continuum/Volumetric stiffness": 1})
            self.run_done("run", "scene.prm")
            stretches[k] = (self.figures().column("surface3")[0] - 1, self.table("output/scene/equilibria.csv").column("a1")[0] - 1)
        # Small loads: 25/19 of the pseudo-rigid strain on the axis of the surface (PHYSICS 4).
        self.assertAlmostEqual(stretches[0.01][0] / stretches[0.01][1], 25 / 19, delta=0.02)
        self.assertGreater(stretches[1][0], stretches[1][1])

    def test_nearly_incompressible_figure(self):
        """Its difference from the incompressible figure is of the order of mu/lambda."""
        common = {**AT_REST, "Models": "continuum", "Continuum/Degree": 4, "Loads/Tidal matrix": matrix(0.3, 0.3, 0),
                  "Equilibrium/Small motions": "false", "Continuum/Error estimate": "none"}

        def long_axis(entries):
            self.scene({**common, **entries})
            self.run_done("run", "scene.prm")
            self.assertGreater((self.scratch / "output/scene/log.txt").read_text().count("GMRES"), 2)
            return self.figures().column("a3")[0]

        limit = long_axis({"Continuum/Volumetric stiffness": 0})
        compressible = {"Body/Incompressible": "false", "Material/Law": "ciarlet-geymonat"}
        products = [Lame * (limit - long_axis({**compressible, "Material/Lame lambda": Lame})) for Lame in (100, 1000, 10000)]
        self.assertAlmostEqual(products[1] / products[0], 1, delta=0.03)
        self.assertAlmostEqual(products[2] / products[1], 1, delta=0.05)

    def test_elastic_ellipsoids_of_jacobi(self):
        """They bifurcate from the spheroids at another spin in each model; of degree 1 they are those of the pseudo-rigid body."""
        self.scene({**FIGURES, "Models": "reduced, polynomial, continuum", "Polynomial/Degree": "1, 3, 5", "Gravity/Constant": 10 / math.pi,
                    "Equilibrium/Family": "jacobi", "Equilibrium/First": 0.6, "Equilibrium/Last": 0.99})
        self.run_done("run", "scene.prm")
        elements, body = self.figures(), self.table("output/scene/equilibria.csv")
        bodies = self.table("output/scene/equilibria-polynomial.csv")
        of_degree = {N: [k for k, n in enumerate(bodies.column("degree")) if n == N] for N in (1, 3, 5)}
        self.assertEqual(elements.column("parameter"), [0.6, 0.99])
        self.assertEqual(elements.column("stable"), [1, 1])
        for name in ("omega3", "a1", "a2", "a3"):
            polynomial = {N: [bodies.column(name)[k] for k in of_degree[N]] for N in of_degree}
            for k, mine in enumerate(elements.column(name)):
                first, third, fifth = (polynomial[N][k] for N in (1, 3, 5))
                self.assertAlmostEqual(first, body.column(name)[k], delta=1e-10)
                bar = elements.column("omega3_error" if name == "omega3" else "axes_error")[k]
                self.assertAlmostEqual(mine, fifth, delta=bar + abs(fifth - third), msg=name)
        for spin, affine in zip(elements.column("omega3"), body.column("omega3")):
            self.assertLess(spin, 0.96 * affine)

    def test_loads_without_an_equilibrium(self):
        """The last figure is kept."""
        self.scene({**AT_REST, "Models": "continuum", "Loads/Tidal matrix": matrix(-6, -6, 12), "Continuum/Volumetric stiffness": 3})
        result = self.run_program("run", "scene.prm")
        self.assert_exit(result, STOPPED)
        self.assertIn("of the loads", result.stderr)
        (part,) = self.figures().column("parameter")
        self.assertGreater(part, 0.05)
        self.assertLess(part, 1)

    def test_fold_of_a_gravitating_family(self):
        """Beyond the bifurcation to ellipsoids, which takes two negative directions, the spin has its largest value."""
        self.scene({**FIGURES, "Gravity/Gamma": 40 / 3, "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.953,
                    "Equilibrium/Last": 0.958, "Continuum/Degree": 2})
        result = self.run_done("run", "scene.prm")
        self.assertRegex(result.stdout, r"fold at e = 0\.954\d* \(even in z, even under the half turn\)")
        table = self.figures()
        self.assertEqual(table.column("kind"), [0, 1, 0])
        self.assertEqual(table.column("n_negative"), [2, 2, 2])
        self.assertEqual(max(table.column("omega3")), table.column("omega3")[1])
        error = table.column("parameter_error")[1]
        self.assertTrue(0 < error < 0.01, error)

    def test_units_of_the_scene_do_not_matter(self):
        self.scene(FIGURES)
        self.run_done("run", "scene.prm", "--output", "own")
        length, mass, time = 1000, 1e9, 7
        units = {"Body/Radius": length, "Body/Density": mass / length**3, "Material/Shear modulus": mass / length / time**2,
                 "Equilibrium/First": 0.5 / time, "Equilibrium/Last": 1 / time}
        self.run_done("run", "scene.prm", "--output", "scaled", *overrides(units))
        own, scaled = (self.figures(folder) for folder in ("own", "scaled"))
        for name, unit in ("a3", length), ("omega3", 1 / time), ("energy", mass * length**2 / time**2), ("rate_1_im", 1 / time), ("J3", mass * length**2 / time):
            for x, y in zip(own.column(name), scaled.column(name)):
                self.assertAlmostEqual(y / unit / x, 1, delta=1e-10, msg=name)

    def test_pressure_on_a_compressible_ball(self):
        """A ball that does not turn has the rates of the ball at rest."""
        body = {"Body/Incompressible": "false", "Material/Lame lambda": 3, "Loads/Pressure": 0.3}
        self.scene({**FIGURES, **body, "Equilibrium/First": 0, "Equilibrium/Number": 1})
        self.run_done("run", "scene.prm", "--output", "turning")
        self.scene({**AT_REST, **body, "Models": "continuum"})
        self.run_done("run", "scene.prm", "--output", "resting")
        turning, resting = self.figures("turning"), self.figures("resting")
        self.assertEqual(turning.column("multiplier"), [0])
        for name in ("a1", "a3", "rate_1_im", "rate_3_im", "rate_9_im"):
            self.assertAlmostEqual(turning.column(name)[0], resting.column(name)[0], delta=1e-9, msg=name)
        self.assertLess(turning.column("a1")[0], 1)

    def test_loads_that_keep_the_shape(self):
        """The loads change the pressure alone, so predictions do not move the ball."""
        # The mesh does not have the pressure that balances the trap. The error is 0.0013; the bound was set afterwards.
        for entry, load, error in ("Loads/Nominal traction", 1.95, 1e-9), ("Loads/Tidal matrix", 40, 0.01):
            self.scene({**AT_REST, entry: matrix(load, load, load), "Models": "continuum", "Continuum/Error estimate": "none"})
            self.run_done("run", "scene.prm")
            for i in 1, 2, 3:
                self.assertAlmostEqual(self.figures().column(f"surface{i}")[0], 1, delta=error, msg=(entry, i))

    def test_double_index_point_of_a_fine_mesh(self):
        """A spheroid has it twice, up to the error of the mesh. The basis has the rotation about its axis once."""
        self.scene({**FIGURES, "Continuum/Degree": 6, "Continuum/Error estimate": "none", "Gravity/Gamma": 47.46,
                    "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.83582, "Equilibrium/Last": 0.87017})
        self.assertIn("index at e = 0.83991", self.run_done("run", "scene.prm").stdout)

    def test_copies_of_a_special_point_have_the_error_of_the_farthest(self):
        self.scene({**FIGURES, "Material/Law": "gent", "Continuum/Degree": 4, "Gravity/Gamma": 22.34,
                    "Equilibrium/Family": "spheroids", "Equilibrium/First": 0.6, "Equilibrium/Last": 0.66})
        self.run_done("run", "scene.prm")
        table = self.figures()
        special = [k for k, kind in enumerate(table.column("kind")) if kind == 3]
        self.assertEqual(len(special), 2)
        for k in special:  # degree 6 has 0.63160469
            self.assertLess(abs(table.column("parameter")[k] - 0.63160469), table.column("parameter_error")[k])

    def test_isotropic_and_compressive_tractions(self):
        """The undeformed ball is the solution of the first; the second is unstable against rotations alone."""
        self.scene({**AT_REST, "Models": "continuum", "Loads/Nominal traction": matrix(0.5, 0.5, 0.5)})
        self.run_done("run", "scene.prm")
        table = self.figures()
        self.assertAlmostEqual(table.column("a1")[0], 1, delta=1e-10)
        self.assertEqual(table.column("stable"), [1])
        self.scene({**AT_REST, "Models": "continuum", "Loads/Nominal traction": matrix(0, 0, -0.45)})
        self.run_done("run", "scene.prm")
        table = self.figures()
        a1, a3, growth = (table.column(name)[0] for name in ("a1", "a3", "growth_rate"))
        rigid = math.sqrt(5 * 0.45 * a3 / (a1**2 + a3**2))  # of a rigid body; deformation makes it faster
        self.assertTrue(rigid < growth < 1.2 * rigid, (rigid, growth))
        self.assertEqual(table.column("n_negative"), [2])

    def test_gravity_at_rest_has_the_rates_of_the_modes(self):
        gravity = {"Gravity/Gamma": 5, "Continuum/Degree": 4, "Models": "continuum"}
        self.scene({**FIGURES, **gravity, "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0, "Equilibrium/Number": 1})
        self.run_done("run", "scene.prm", "--output", "figure")
        self.scene({"Analysis": "modes", **gravity, "Modes/Number": 2})
        self.run_done("run", "scene.prm", "--output", "modes")
        table = self.figures("figure")
        lowest = self.table("modes/modes.csv").column("omega")[0]
        self.assertEqual(table.column("omega3"), [0])
        # The gravity of a figure is that of quadrature points, that of modes is exact.
        self.assertAlmostEqual(table.column("rate_1_im")[0], lowest, delta=2e-3)
        self.assertLess(table.column("rates_error")[0], 0.02)

    def test_figures_without_small_motions_and_errors(self):
        """The figures are the same; rates, stability and special points but folds are left out."""
        entries = {**FIGURES, "Models": "reduced, polynomial, continuum", "Polynomial/Degree": 3, "Gravity/Gamma": 40 / 3,
                   "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.8, "Equilibrium/Last": 0.93}
        tables = {}
        for name, other in (("all", {}), ("figures", {"Equilibrium/Small motions": "false", "Continuum/Error estimate": "none"})):
            self.scene({**entries, **other})
            tables[name] = {}
            self.run_done("run", "scene.prm", "--output", name)
            for model in ("polynomial", "continuum"):
                tables[name][model] = self.table(name, f"equilibria-{model}.csv")
        for model in ("polynomial", "continuum"):
            whole, part = tables["all"][model], tables["figures"][model]
            missing = [column for column in whole.header if column not in part.header]
            self.assertEqual(missing[:5], ["growth_rate", "stable", "n_negative", "odd_in_z", "m"])
            self.assertEqual([c for c in missing[5:] if not c.startswith("rate")],
                             ["parameter_error", "omega3_error", "axes_error", "surface_error"] if model == "continuum" else [])
            of_kind = [i for i, kind in enumerate(whole.column("kind")) if kind == 0]
            self.assertGreater(len(whole), len(of_kind))  # special points that need the small motions
            for column in part.header[1:]:
                if column != "residual":
                    for a, i in zip(part.column(column), of_kind):
                        self.assertAlmostEqual(a, whole.column(column)[i], delta=1e-8, msg=(model, column))
        self.assertIn("growth_rate", self.table("figures", "equilibria.csv").header)
        self.assertIn("Small motions", self.run_done("check", "scene.prm").stdout)

    def test_sweep_without_small_motions(self):
        self.scene({**AT_REST, "Models": "continuum", "Loads/Tidal matrix": "$(k), 0, 0; 0, $(k), 0; 0, 0, 0",
                    "Sweep/Parameters": "k: 0.1, 0.2",
                    "Continuum/Volumetric stiffness": 1, "Equilibrium/Small motions": "false"})
        self.run_done("run", "scene.prm", "--output", "swept")
        table = self.table("swept", "sweep.csv")
        self.assertNotIn("growth_rate", " ".join(table.header))
        a3 = table.column("continuum_a3")
        self.assertTrue(1 < a3[0] < a3[1], a3)


class RefusedContinuumEquilibria(RefusedInputTest):
    def test_refused(self):
        for entries, words in (
                ({"Equilibrium/Family": "dedekind"}, ("Equilibrium/Family", "dedekind")),
                ({"Continuum/Symmetry": "none"}, ("Continuum/Symmetry",)),
                ({"Continuum/Degree": "auto"}, ("Continuum/Degree", "auto")),
                ({"Continuum/Grading": 0.5}, ("Continuum/Grading",)),
                ({"Material/Law": "none", "Gravity/Constant": 1}, ("Material/Law", "fluid")),
                ({"Material/Viscosity": 1}, ("Material/Viscosity",)),
                ({"Loads/Nominal traction": matrix(0, 0, 1)}, ("Loads/Nominal traction",)),
                ({"Equilibrium/Family": "static", "Loads/Acceleration": "1, 0, 0"}, ("Equilibrium/Family", "Loads/Acceleration")),
                ({"Equilibrium/Family": "static", "Loads/Rise time": 1, "Loads/Acceleration": "0, 0, 0"}, ("Loads/Rise time",))):
            with self.subTest(entries):
                self.refused_entries({**FIGURES, **entries}, *words)


if __name__ == "__main__":
    unittest.main(verbosity=2)
