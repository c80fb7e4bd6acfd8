"""Runs of the model polynomial: several degrees in one scene, a degree from a tolerance, modes, pictures, sweeps, resumed
runs, and what is refused. No finite elements."""
import math
import re
import unittest

from program_test import SOURCE, STOPPED, WRONG_INPUT, ProgramTest, overrides

RELEASE = {"Models": "polynomial", "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6", "Time/End": 2,
           "Time/Tolerance": 1e-4, "Output/Samples": 20}
FLUID = {"Material/Law": "none", "Gravity/Constant": 1}
# A refused entry is named before others of the release are.
EQUILIBRIA = {"Analysis": "equilibrium", "Initial state/Velocity": "0, 0, 0; 0, 0, 0; 0, 0, 0", **FLUID}


class PolynomialRun(ProgramTest):
    def run_release(self, entries=(), *options):
        self.scene({**RELEASE, **dict(entries)})
        return self.run_done("run", "scene.prm", *options)

    def test_degree_one_is_the_pseudo_rigid_body(self):
        self.run_release({"Models": "reduced, polynomial", "Polynomial/Degree": 1, "Time/Method": "rattle-4",
                          "Time/Step": 0.02})
        reduced, polynomial = (self.table(f"output/scene/{name}.csv") for name in ("reduced", "polynomial"))
        for name in reduced.header:
            for a, b in zip(reduced.column(name), polynomial.column(name)):
                self.assertAlmostEqual(a, b, delta=1e-12, msg=name)

    def test_impact_sweep(self):
        """Of its eleven speeds two."""
        self.scene((SOURCE / "params/impact_sweep.prm").read_text(), "impact_sweep.prm")
        self.run_done("run", "impact_sweep.prm", *overrides({"Sweep/Parameters": "p: -0.5, 0", "Output/Samples": 100}))
        table = self.table("output/impact_sweep/sweep.csv")
        self.assertEqual(table.column("finished"), [1, 1])
        for e, force, penetration in zip(*(table.column(name) for name in (
                "restitution_end", "largest_force_end", "penetration_max"))):
            self.assertTrue(0.3 < e <= 1, e)
            self.assertGreater(force, 0)
            self.assertGreater(penetration, 0)

    def test_several_degrees_are_compared_with_the_last(self):
        result = self.run_release({"Polynomial/Degree": "1, 3, 5"})
        overview = self.json("output/scene/comparison.json")
        self.assertEqual(overview["reference"], "polynomial")
        self.assertEqual(list(overview["models"]), ["polynomial-1", "polynomial-3"])
        apart = [overview["models"][name]["model_difference"]["value"] for name in overview["models"]]
        self.assertGreater(apart[0], 5 * apart[1])
        self.assertIn("polynomial-3", result.stdout)
        for name in ("polynomial-1", "polynomial-3", "polynomial"):
            self.assertTrue(self.table(f"output/scene/{name}.csv").is_finite())

    def test_degree_from_a_tolerance(self):
        result = self.run_release({"Polynomial/Degree": "auto", "Polynomial/Tolerance": 1e-2})
        counters = self.json("output/scene/manifest.json")["models"]["polynomial"]["counters"]
        self.assertLess(counters["estimated_space_error"], 1e-2)
        self.assertIn("estimated error of Q", result.stderr)
        got = self.table("output/scene/polynomial.csv").column("Q33")
        self.run_release({"Polynomial/Degree": 11}, "--output", "finer")
        finer = self.table("finer/polynomial.csv").column("Q33")
        self.assertLess(max(abs(a - b) for a, b in zip(got, finer)), 1e-2)

    def test_companion_of_a_run_with_an_adaptive_method(self):
        """It has the local tolerance of the run."""
        self.scene({"Models": "reduced, polynomial", "Polynomial/Degree": 3, "Body/Incompressible": "false", "Material/Lame lambda": 3,
                    "Initial state/Deformation": "1.1, 0, 0; 0, 0.95, 0; 0, 0, 1", "Time/End": 5, "Time/Method": "explicit-8"})
        result = self.run_done("run", "scene.prm")
        self.assertIn("discretisation error of Q", result.stderr)
        self.assertNotIn("warning", result.stderr)

    def test_the_octant_is_the_whole_ball(self):
        self.run_release({"Polynomial/Degree": 3, "Time/Step": 0.02, "Time/Method": "rattle"})
        self.run_release({"Polynomial/Degree": 3, "Time/Step": 0.02, "Time/Method": "rattle", "Continuum/Symmetry": "none"},
                         "--output", "whole")
        octant, whole = self.table("output/scene/polynomial.csv"), self.table("whole/polynomial.csv")
        for name in ("Q11", "Q33", "elastic", "multiplier", "nonaffine_displacement", "volume_ratio"):
            for a, b in zip(octant.column(name), whole.column(name)):
                self.assertAlmostEqual(a, b, delta=1e-11, msg=name)

    def test_energy_and_momenta_of_a_sheared_spinning_body(self):
        self.run_release({"Polynomial/Degree": 3, "Gravity/Constant": 1, "Time/Tolerance": 1e-6, "Time/Method": "rattle-4",
                          "Initial state/Velocity": "0.1, -0.6, 0.1; 0.5, -0.2, 0.2; 0, -0.1, 0.1"})
        table = self.table("output/scene/polynomial.csv")
        energy = table.column("energy")
        self.assertLess(max(abs(x - energy[0]) for x in energy), 1e-4 * abs(energy[0]))
        for name in ("J1", "J2", "J3"):
            column = table.column(name)
            self.assertLess(max(abs(x - column[0]) for x in column), 1e-13)

    def test_modes_are_those_of_the_sphere(self):
        self.scene({"Models": "polynomial", "Analysis": "modes", "Polynomial/Degree": 7, "Modes/Number": 3})
        self.run_done("run", "scene.prm")
        table = self.table("output/scene/modes.csv")
        self.assertEqual(table.column("multiplicity"), [5, 5, 7])
        for omega, exact in zip(table.column("omega"), table.column("exact")):
            self.assertAlmostEqual(omega / exact, 1, delta=1e-5)
        self.assertAlmostEqual(table.column("omega")[1], 2.665622189236, delta=1e-7)

    def test_modes_of_a_law_that_is_stressed_at_rest(self):
        """Its shear modulus at rest is 2 mu, and so the sphere's frequencies and the pseudo-rigid ball's are those times
        sqrt 2 (the continuum's table: tests/continuum/modes_test.cpp)."""
        self.scene({"Models": "polynomial", "Analysis": "modes", "Polynomial/Degree": 3, "Modes/Number": 2,
                    "Material/Law": "saint-venant-kirchhoff (as printed)"})
        self.run_done("run", "scene.prm")
        table = self.table("output/scene/modes.csv")
        self.assertAlmostEqual(table.column("exact")[1], math.sqrt(2) * 2.665622189236, delta=1e-11)
        self.assertAlmostEqual(table.column("reduced")[1], math.sqrt(20), delta=1e-12)
        self.assertAlmostEqual(table.column("omega")[1] / table.column("exact")[1], 1, delta=3e-3)

    def test_modes_under_strong_gravity(self):
        """gamma = 4.2e3: every mode is there with its copies, and the table ends with exit 0."""
        self.scene({"Models": "polynomial", "Analysis": "modes", "Polynomial/Degree": 8, "Modes/Number": 8,
                    "Material/Shear modulus": 1e-3, "Gravity/Constant": 1})
        self.run_done("run", "scene.prm")
        table = self.table("output/scene/modes.csv")
        self.assertLess(max(table.column("spread")), 1e-9)
        for omega, exact in zip(table.column("omega"), table.column("exact")):
            self.assertAlmostEqual(omega / exact, 1, delta=5e-3)

    def test_a_resumed_run_is_the_whole_one(self):
        entries = {**RELEASE, "Polynomial/Degree": 3, "Time/Method": "rattle-4", "Time/Step": 0.02}
        self.scene(entries)
        self.run_done("run", "scene.prm", "--output", "whole")
        self.run_done("run", "scene.prm", "--output", "half", *overrides({"Time/End": 1, "Output/Samples": 10}))
        self.run_done("run", "scene.prm", "--output", "half", "--resume")
        self.assertEqual((self.scratch / "whole/polynomial.csv").read_bytes(),
                         (self.scratch / "half/polynomial.csv").read_bytes())

    def test_a_sweep_over_the_degree(self):
        self.scene({**RELEASE, "Polynomial/Degree": "$(N)", "Sweep/Parameters": "N: 1, 3, 5"})
        self.run_done("run", "scene.prm")
        self.assertEqual(len(self.table("output/scene/sweep.csv")), 3)

    def test_amplitude(self):
        """params/amplitude.prm, shorter: N = 1 has c = −5/48 (PHYSICS section 5), N = 3 that of its wrong resonances."""
        self.scene((SOURCE / "params/amplitude.prm").read_text(), "amplitude.prm")
        self.run_done("run", "amplitude.prm", *overrides({"Sweep/Parameters": "N: 1, 3; l: 1.03, 1.12", "Time/End": 60,
                                                          "Output/Samples": 600}))
        table = self.table("output/amplitude/sweep.csv")
        omega, square = table.column("frequency"), [a * a / 6 for a in table.column("amplitude")]
        slopes = [(omega[k + 1] / omega[k] - 1) / (square[k + 1] - square[k]) for k in (0, 2)]
        # A fit over 60 r/c has frequencies to about 2e-6 of them, so slopes to 2e-4; terms of order A⁴ are 1 % of c.
        self.assertAlmostEqual(slopes[0], -5 / 48, delta=2e-3)
        self.assertAlmostEqual(slopes[1], 0.022, delta=4e-3)

    def test_equilibria_of_several_degrees(self):
        self.scene({"Models": "reduced, polynomial", "Analysis": "equilibrium", "Polynomial/Degree": "1, 3",
                    "Equilibrium/Family": "maclaurin", "Equilibrium/First": 0.78, "Equilibrium/Last": 0.84,
                    "Equilibrium/Number": 2, **FLUID})
        result = self.run_done("run", "scene.prm")
        self.assertRegex(result.stdout, r"degree 3: 2 equilibria.*\n  index at e = 0\.81267\d* \(even in z, m = 2\)")
        reduced, bodies = self.table("output/scene/equilibria.csv"), self.table("output/scene/equilibria-polynomial.csv")
        self.assertEqual(set(bodies.column("degree")), {1.0, 3.0})
        of_degree = [k for k, N in enumerate(bodies.column("degree")) if N == 1]
        spins = sorted(bodies.column("omega3")[k] for k in of_degree if bodies.column("kind")[k] == 0)
        for mine, other in zip(spins, sorted(s for s, kind in zip(reduced.column("omega3"), reduced.column("kind")) if kind == 0)):
            self.assertAlmostEqual(mine, other, delta=1e-12)
        bifurcations = [e for e, kind in zip(bodies.column("parameter"), bodies.column("kind")) if kind != 0]
        self.assertEqual(len(bifurcations), 2)
        for e in bifurcations:  # where Jacobi's ellipsoids leave (Chandrasekhar 1969, 32)
            self.assertAlmostEqual(e, 0.81267, delta=1e-5)
        self.assertNotIn("quadrature of gravity", result.stderr)
        ball = overrides({"Models": "polynomial", "Polynomial/Degree": 3, "Equilibrium/First": 0, "Equilibrium/Number": 1})
        self.run_done("run", "scene.prm", "--output", "ball", *ball)
        self.assertEqual(self.table("ball", "equilibria-polynomial.csv").column("omega3"), [0])
        nearly_round = overrides({"Models": "polynomial", "Equilibrium/First": 0.02, "Equilibrium/Number": 1})
        self.assertIn("quadrature of gravity", self.run_done("run", "scene.prm", "--output", "nearly_round", *nearly_round).stderr)

    def test_pictures_show_the_body(self):
        self.run_release({"Polynomial/Degree": 3, "Output/Graphics": "vtu", "Output/Frames": 2})
        folder = self.scratch / "output/scene"
        self.assertEqual(self.pvd(folder / "polynomial.pvd"),
                         [(0, "graphics/polynomial-000000.vtu"), (2, "graphics/polynomial-000001.vtu")])

    def test_a_violent_motion_stops_with_a_sentence(self):
        self.scene({**RELEASE, "Polynomial/Degree": 3, "Initial state/Velocity": "40, 0, 0; 0, 40, 0; 0, 0, -80",
                    "Time/Method": "rattle", "Time/Step": 0.02})
        result = self.run_program("run", "scene.prm")
        self.assertEqual(result.returncode, STOPPED)
        self.assertIn("polynomial stopped at t = ", result.stderr)

    def test_the_estimate_of_a_multistep_method_looks_beyond_its_start(self):
        """An estimate over the start of symmetric-8 alone, which is made by small steps of another method, took this
        violent motion for exact to 6e-15 with steps of 0.0175."""
        self.scene({"Models": "polynomial", "Polynomial/Degree": 5, "Material/Law": "mooney-rivlin",
                    "Material/Mooney fraction": 0.77, "Gravity/Constant": 4.8, "Time/End": 3.3, "Time/Method": "symmetric-8",
                    "Initial state/Deformation": "0.98, 0, 0; 0, 1.19, 0; 0, 0, $(1/(0.98*1.19))",
                    "Initial state/Velocity": "$(-1.82), 0, 0; 0, 2.97, 0; 0, 0, $((1.82/0.98 - 2.97/1.19)/(0.98*1.19))",
                    "Time/Tolerance": 5e-8, "Output/Samples": 12, "Output/Quantities": "state, energies"})
        self.run_done("run", "scene.prm")
        log = (self.scratch / "output/scene/log.txt").read_text()  # the manifest drops the estimate when an interval is repeated
        estimate = float(re.search(r"estimated time error ([0-9.e-]+)", log)[1])
        self.assertGreater(estimate, 1e-10)
        self.assertLess(estimate, 5e-8)

    def test_a_step_far_too_long_for_a_multistep_method_stops_with_a_sentence(self):
        """Its first steps, by small ones of another method, did not end and could not be interrupted."""
        self.scene({"Models": "polynomial", "Polynomial/Degree": 3, "Material/Law": "gent", "Material/Gent limit": 4.16165836575061,
                    "Initial state/Deformation": "1.0636191781466777, -0.5471677117414776, 1.071569546922301; "
                    "-0.8575766621875578, -0.6066590616336801, -0.6851100664953423; "
                    "0.63318329639514, -1.1001433461522396, -0.1271525761272486",
                    "Initial state/Velocity": "1.7735652440998373, 2.3757391864257515, 0.17531691760620383; "
                    "0.863463957787348, 1.015096512744471, 1.3751550178433865; "
                    "4.869248480629993, 3.609884113432417, 1.1446581193513536",
                    "Time/End": 1.3244146370455958, "Time/Method": "symmetric-8", "Time/Step": 0.34338858156955665,
                    "Output/Samples": 4})
        result = self.run_program("run", "scene.prm")
        self.assertEqual(result.returncode, STOPPED)
        self.assertIn("more than 2000 small ones each; use a smaller step", result.stderr)

    def test_what_is_refused(self):
        for entries, words in (({"Polynomial/Degree": 0}, "from 1 to 13"), ({"Polynomial/Degree": 14}, "from 1 to 13"),
                               ({"Polynomial/Degree": "3, 1"}, "rising whole numbers"),
                               ({"Body/Inertia": "1, 0, 0; 0, 1, 0; 0, 0, 1"}, "Body/Inertia"),
                               ({"Body/Incompressible": "false", "Gravity/Constant": 1}, "Gravity/Constant"),
                               ({"Continuum/Mesh": "bar.msh"}, "Continuum/Mesh"),
                               ({**EQUILIBRIA, "Equilibrium/Family": "dedekind"}, "offered for the reduced model"),
                               ({**EQUILIBRIA, "Polynomial/Degree": "auto"}, "named degrees"),
                               ({"Polynomial/Tolerance": 0}, "Polynomial/Tolerance")):
            with self.subTest(entries):
                self.scene({**RELEASE, **entries})
                result = self.run_program("run", "scene.prm")
                self.assertEqual(result.returncode, WRONG_INPUT, result.stderr)
                self.assertIn(words, result.stderr)
                self.assertFalse((self.scratch / "output").exists())

    def test_a_section_of_the_ball_is_refused_for_other_systems(self):
        self.scene({"System": "torus", "Polynomial/Degree": 3})
        result = self.run_program("run", "scene.prm")
        self.assertEqual(result.returncode, WRONG_INPUT)
        self.assertIn("Polynomial/Degree", result.stderr)


if __name__ == "__main__":
    unittest.main()
