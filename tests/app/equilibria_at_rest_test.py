"""Equilibria at rest (Equilibrium/Family = static) of polynomial bodies, compared with those of the other models."""
import math
import signal
import subprocess
import unittest

from program_test import STOPPED, ProgramTest, matrix
from refused_input import RefusedInputTest


AT_REST = {"Analysis": "equilibrium", "Models": "polynomial", "Polynomial/Degree": "1, 3", "Equilibrium/Family": "static"}
TRAP = {"Loads/Tidal matrix": matrix(1, 1, 0)}


class EquilibriaAtRest(ProgramTest):
    def at_rest(self, entries, folder="output/scene"):
        """The table of the polynomial bodies after a run of the scene."""
        self.scene({**AT_REST, **entries})
        self.run_done("run", "scene.prm", "--output", folder)
        return self.table(folder, "equilibria-polynomial.csv")

    def test_traction_gives_the_exact_homogeneous_state(self):
        """Dead tractions s_i along the axes: mu (a_i - p / a_i) = s_i with a_1 a_2 a_3 = 1 (neo-Hookean)."""
        s = (0.3, 0.3, 0.9)
        bodies = self.at_rest({"Loads/Nominal traction": matrix(*s), "Polynomial/Degree": "1, 2, 3, 5"})
        for row in range(4):
            a = [bodies.column(f"a{i}")[row] for i in (1, 2, 3)]
            self.assertAlmostEqual(math.prod(a), 1, delta=1e-12)
            pressures = [a_i**2 - s_i * a_i for a_i, s_i in zip(a, s)]
            self.assertLess(max(pressures) - min(pressures), 1e-11)
        self.assertLess(max(bodies.column("nonaffine_displacement")), 1e-11)

    def test_degree_1_is_the_pseudo_rigid_body(self):
        """Figure, energies, multiplier and rates of a search at rest are among those of the pseudo-rigid body."""
        loads = {"Loads/Tidal matrix": matrix(0.4, 0.1, -0.2), "Loads/Nominal traction": matrix(0.1, 0.3, -0.2), "Gravity/Gamma": 2}
        for law in {"Material/Law": "neo-hookean"}, {"Material/Law": "mooney-rivlin"}:
            bodies = self.at_rest({**loads, **law, "Models": "reduced, polynomial", "Polynomial/Degree": 1,
                                   "Polynomial/Gravity points": 24})
            found = self.table("output/scene", "equilibria.csv")
            a = sorted((bodies.column(f"a{i}")[0] for i in (1, 2, 3)), reverse=True)
            row = min(range(len(found)), key=lambda k: sum(abs(found.column(f"a{i}")[k] - a[i - 1]) for i in (1, 2, 3)))
            for i in 1, 2, 3:
                self.assertAlmostEqual(found.column(f"a{i}")[row], a[i - 1], delta=1e-9)
            for name in "potential", "multiplier":
                self.assertAlmostEqual(found.column(name)[row], bodies.column(name)[0], delta=1e-8, msg=name)
            mine = sorted(abs(bodies.column(f"rate_{k}_im")[0]) for k in range(1, 11))
            others = sorted(abs(found.column(f"rate_{k}_im")[row]) for k in range(1, 17))
            for rate in filter(None, mine):
                self.assertLess(min(abs(rate - other) for other in others), 1e-6, (mine, others))

    def test_degrees_converge_to_the_elements(self):
        self.scene({**AT_REST, **TRAP, "Models": "polynomial, continuum", "Polynomial/Degree": "1, 3, 5, 7",
                    "Continuum/Degree": 4, "Continuum/Volumetric stiffness": 1})
        self.run_done("run", "scene.prm")
        bodies, elements = (self.table("output/scene", f"equilibria-{name}.csv") for name in ("polynomial", "continuum"))
        for name, error in ("a3", "axes_error"), ("rate_1_im", "rates_error"), ("rate_3_im", "rates_error"):
            (exact,), (bar,) = elements.column(name), elements.column(error)
            differences = [abs(value - exact) for value in bodies.column(name)]
            self.assertGreater(differences[0], 5 * differences[1], name)
            self.assertGreater(differences[1], 5 * differences[2], name)
            self.assertLess(differences[3], bar + 0.2 * differences[2] + 1e-9, name)

    def test_without_loads_the_rates_are_the_modes(self):
        rest = {"Polynomial/Degree": 3, "Loads/Tidal matrix": matrix(1e-13, 0, 0)}
        bodies = self.at_rest(rest)
        self.scene({"Analysis": "modes", "Models": "polynomial", "Polynomial/Degree": 3, "Modes/Number": 10})
        self.run_done("run", "scene.prm", "--output", "modes")
        modes = self.table("modes", "modes.csv").column("omega")
        for k in range(1, 11):
            self.assertLess(min(abs(abs(bodies.column(f"rate_{k}_im")[0]) - omega) for omega in modes), 1e-10)

    def test_fluid_under_its_gravity_and_a_tide(self):
        """A fluid ellipsoid is exact in every degree; the difference is the quadrature of gravity."""
        bodies = self.at_rest({"Material/Law": "none", "Gravity/Constant": 1,
                               "Loads/Tidal matrix": matrix(0.3, 0.1, -0.2), "Models": "reduced, polynomial"})
        found = self.table("output/scene", "equilibria.csv")
        for row in range(len(bodies)):
            a = sorted((bodies.column(f"a{i}")[row] for i in (1, 2, 3)), reverse=True)
            difference = min(max(abs(found.column(f"a{i}")[k] - a[i - 1]) for i in (1, 2, 3)) for k in range(len(found)))
            self.assertLess(difference, 1e-5)

    def test_compressible_ball_under_a_pressure(self):
        bodies = self.at_rest({"Body/Incompressible": "false", "Material/Lame lambda": 3, "Loads/Pressure": 0.3,
                               "Models": "reduced, polynomial"})
        found = self.table("output/scene", "equilibria.csv")
        for row in range(2):
            self.assertLess(min(abs(a - bodies.column("a1")[row]) for a in found.column("a1")), 1e-10)
        self.assertEqual(bodies.column("multiplier"), [0, 0])

    def test_loads_without_an_equilibrium(self):
        """The last figure is kept, with its share of the loads."""
        self.scene({**AT_REST, "Loads/Tidal matrix": matrix(-6, -6, 12)})
        result = self.run_program("run", "scene.prm")
        self.assert_exit(result, STOPPED)
        self.assertIn("of the loads", result.stderr)
        parts = self.table("output/scene", "equilibria-polynomial.csv").column("parameter")
        self.assertTrue(all(0.05 < part < 1 for part in parts), parts)

    def test_an_interrupted_run_names_the_degree_that_it_did_not_reach(self):
        self.scene({**AT_REST, **TRAP, "Polynomial/Degree": "9, 11"})
        process = self.start_program("run", "scene.prm", stderr=subprocess.PIPE, text=True)
        self.wait_until((self.scratch / "output/scene/manifest.json").exists, "the run is under way")
        process.send_signal(signal.SIGINT)
        _, error = process.communicate()
        self.assertEqual(process.returncode, STOPPED, error)
        # Which degree is under way at the interrupt depends on the machine.
        rows = {"degree 9": [], "degree 11": [9]}
        (named,) = (degree for degree in rows if degree in error)
        self.assertEqual(self.table("output/scene", "equilibria-polynomial.csv").column("degree"), rows[named])

    def test_units_of_the_scene_do_not_matter(self):
        own = self.at_rest({**TRAP, "Loads/Nominal traction": matrix(0.1, 0.2, 0)}, "own")
        length, mass, time = 1000, 1e9, 7
        pressure = mass / length / time**2
        scaled = self.at_rest({"Loads/Tidal matrix": matrix(1 / time**2, 1 / time**2, 0), "Body/Radius": length,
                               "Body/Density": mass / length**3, "Material/Shear modulus": pressure,
                               "Loads/Nominal traction": matrix(0.1 * pressure, 0.2 * pressure, 0)}, "scaled")
        for name, unit in ("a3", length), ("potential", mass * length**2 / time**2), ("rate_1_im", 1 / time), ("multiplier", 1 / time**2):
            for x, y in zip(own.column(name), scaled.column(name)):
                self.assertAlmostEqual(y / unit / x, 1, delta=1e-10, msg=name)

    def test_rows_of_a_sweep_are_single_runs(self):
        scene = {**AT_REST, "Models": "polynomial, continuum", "Continuum/Degree": 2, "Loads/Tidal matrix": "$(k), 0, 0; 0, $(k), 0; 0, 0, 0"}
        self.scene({**scene, "Sweep/Parameters": "k: 0.1, 1"})
        self.run_done("run", "scene.prm", "--output", "sweep")
        sweep = self.table("sweep", "sweep.csv")
        self.assertEqual(sweep.column("finished"), [1, 1])
        for row, k in enumerate((0.1, 1)):
            self.scene({**scene, "Loads/Tidal matrix": scene["Loads/Tidal matrix"].replace("$(k)", f"$({k!r})")}, "single.prm")
            self.run_done("run", "single.prm", "--output", "single")
            for prefix, name, of_table in ("polynomial_1", "polynomial", 0), ("polynomial", "polynomial", 1), ("continuum", "continuum", 0):
                single = self.table("single", f"equilibria-{name}.csv")
                for column in single.header[single.header.index("kind") + 1:]:
                    self.assertEqual(sweep.column(f"{prefix}_{column}")[row], single.column(column)[of_table], column)

    def test_a_run_of_a_sweep_without_an_equilibrium_is_a_failed_row(self):
        self.scene({**AT_REST, "Loads/Tidal matrix": "$(-k), 0, 0; 0, $(-k), 0; 0, 0, $(2*k)", "Sweep/Parameters": "k: 0.1, 6"})
        self.run_done("run", "scene.prm", "--output", "sweep")
        sweep = self.table("sweep", "sweep.csv")
        self.assertEqual(sweep.column("finished"), [1, 0])
        self.assertEqual([sweep.column(f"{name}_finished") for name in ("polynomial_1", "polynomial")], [[1, 0], [1, 0]])


class PredictedBulges(ProgramTest):
    def predicted(self, entries):
        self.scene(entries)
        return [line for line in self.run_done("check", "scene.prm").stdout.splitlines() if "bulge" in line]

    def test_check_predicts_the_bulge_of_weak_loads(self):
        """3 / (12.5 + gamma), the ratio of the Love numbers of ellipsoid and sphere, up to the strength 0.1 and gamma = 1000. The
        isotropic part K of the potential counts as 2.5 K in gamma."""
        spinning = {"Analysis": "equilibrium", "Models": "reduced", "Equilibrium/Family": "spinning", "Equilibrium/Last": 1, "Equilibrium/Number": 2}
        weak = {**AT_REST, "Loads/Tidal matrix": matrix(0.45, 0.45, -0.9)}
        for entries, error in ((weak, "-24 %"), ({**weak, "Gravity/Gamma": 7.5}, "-15 %"), (spinning, "-28 %"),
                               ({**weak, "Loads/Tidal matrix": matrix(20.45, 20.45, 19.1)}, "-4.8 %"),
                               ({**spinning, "Equilibrium/First": 0.01, "Equilibrium/Last": 9, "Equilibrium/Number": 1}, "-24 %")):
            (line,) = self.predicted(entries)
            self.assertIn(error, line)
        for entries in ({**weak, "Loads/Tidal matrix": matrix(0.55, 0.55, -1.1)}, {**weak, "Loads/Tidal matrix": matrix(1, 1, 1)},
                        {**weak, "Gravity/Gamma": 1001}, {**weak, "Loads/Nominal traction": matrix(0, 0, 0.1)}, {**weak, "Models": "reduced", "Body/Semi-axes": "1, 1, 1.1"},
                        {**weak, "Body/Incompressible": "false", "Material/Lame lambda": 3}, {**spinning, "Equilibrium/Last": 1.4},
                        {**weak, "Loads/Tidal matrix": matrix(-0.9, -0.9, -1.2)},
                        {**weak, "Gravity/Gamma": "$(g)", "Sweep/Parameters": "g: 1, 2"}):
            self.assertEqual(self.predicted(entries), [], entries)


class RefusedEquilibriaAtRest(RefusedInputTest):
    def test_refused(self):
        for entries, words in (
                ({"Loads/Acceleration": "1, 0, 0"}, ("Equilibrium/Family", "Loads/Acceleration")),
                ({"Polynomial/Degree": "auto"}, ("Polynomial/Degree",)),
                ({"Material/Viscosity": 1}, ("Viscosity",)),
                ({"Material/Law": "none", **TRAP}, ("Equilibrium/Family", "gravity")),
                ({"Body/Semi-axes": "1, 1, 1.3", **TRAP}, ("Body/Semi-axes",)),
                ({"Material/Law": "none", "Gravity/Constant": 1, "Loads/Nominal traction": matrix(0.1, 0, 0)}, ("Loads/Nominal traction",)),
                ({"Models": "reduced, polynomial", "Gravity/Gamma": "$(g)", "Sweep/Parameters": "g: 1, 2"}, ("Models", "Polynomial/Degree"))):
            with self.subTest(entries):
                self.refused_entries({**AT_REST, **entries}, *words)


if __name__ == "__main__":
    unittest.main()
