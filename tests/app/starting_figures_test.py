"""Motions that start from the figure of their own model, with a small motion about it."""
import cmath
import math
import shutil
import unittest

import numpy

from program_test import STOPPED, ProgramTest, largest_difference
from ranks import RanksTest
from refused_input import RefusedInputTest

SPIN = 1.2
# The motion of a polynomial body may have fewer points of quadrature than its figure; a number is for both.
BODIES = {"Models": "reduced, polynomial, continuum", "Polynomial/Degree": 3, "Polynomial/Quadrature points": 6, "Continuum/Degree": 3}
OWN = {**BODIES, "Initial state/Equilibrium": "spinning", "Initial state/Equilibrium parameter": SPIN, "Initial state/Figure": "own",
       "Time/End": 5, "Output/Samples": 100}
TABLES = {"reduced": "equilibria", "polynomial": "equilibria-polynomial", "continuum": "equilibria-continuum"}
# A ball with mu = 0.01 pi G rho^2 r^2, whose spheroid of this eccentricity is unstable in every model.
SOFT = {"Gravity/Constant": 100 / math.pi, "Initial state/Equilibrium": "maclaurin", "Initial state/Equilibrium parameter": 0.98}


def in_turning_frame(table, spin):
    """The matrices Q of the samples, turned back by the spin about axis 3."""
    t = numpy.array(table.column("time"))
    Q = numpy.array([[table.column(f"Q{i}{j}") for j in (1, 2, 3)] for i in (1, 2, 3)]).transpose(2, 0, 1)
    turned = Q.copy()
    c, s = numpy.cos(spin * t)[:, None], numpy.sin(spin * t)[:, None]
    turned[:, 0], turned[:, 1] = c * Q[:, 0] + s * Q[:, 1], c * Q[:, 1] - s * Q[:, 0]
    return t, turned.reshape(len(t), 9)


def fitted_frequency(t, values, near):
    """The frequency w of values = a cos(wt) + b sin(wt) + c by least squares, within 0.1 % of `near`, and the amplitude."""
    def misfit(w):
        basis = numpy.column_stack([numpy.cos(w * t), numpy.sin(w * t), numpy.ones_like(t)])
        coefficients = numpy.linalg.lstsq(basis, values, rcond=None)[0]
        return ((values - basis @ coefficients) ** 2).sum(), numpy.abs(coefficients[:2]).max()
    low, high = 0.999 * near, 1.001 * near
    for _ in range(100):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if misfit(a)[0] < misfit(b)[0] else (a, high)
    return (low + high) / 2, misfit(low)[1]


class StartingFigures(ProgramTest):
    def motion(self, entries, model, output="motion"):
        self.scene(entries)
        self.run_done("run", "scene.prm", "--output", output)
        return self.table(output, f"{model}.csv")

    def figure(self, entries, model):
        """The row of the figure in the table of equilibria of this model, by column."""
        start = {path: value for path, value in entries.items() if not path.startswith(("Initial state", "Time", "Output"))}
        parameter = entries["Initial state/Equilibrium parameter"]
        self.scene({**start, "Models": model, "Analysis": "equilibrium", "Equilibrium/Family": entries["Initial state/Equilibrium"],
                    "Equilibrium/First": parameter, "Equilibrium/Last": parameter, "Equilibrium/Number": 1}, "figure.prm")
        self.run_done("run", "figure.prm", "--output", f"figure-{model}")
        table = self.table(f"figure-{model}", f"{TABLES[model]}.csv")
        return dict(zip(table.header, table.rows[0]))

    def test_own_figures_do_not_change(self):
        """Elements that start from the ellipsoid of the pseudo-rigid body oscillate instead."""
        moving = self.motion({**OWN, "Models": "continuum", "Initial state/Figure": "affine"}, "continuum", "moving").column("Q33")
        self.assertGreater(max(moving) - min(moving), 0.02)
        self.motion({**OWN, "Time/Tolerance": 1e-8}, "continuum")
        for model in TABLES:
            table, figure = self.table("motion", f"{model}.csv"), self.figure(OWN, model)
            _, Q = in_turning_frame(table, figure["omega3"])
            still = numpy.array([[figure[f"a{i + 1}"] if i == j else 0 for j in range(3)] for i in range(3)]).reshape(9)
            # The tolerance of the time step; the error of the elements' Newton iteration is 1e-10.
            self.assertLess(numpy.abs(Q - still).max(), 2e-8, model)
            self.assertAlmostEqual(table.column("J3")[0], figure["J3"], delta=1e-9 * figure["J3"], msg=model)

    def test_own_ellipsoid_does_not_change(self):
        start = {**OWN, "Models": "continuum", "Gravity/Constant": 10 / math.pi, "Initial state/Equilibrium": "jacobi",
                 "Initial state/Equilibrium parameter": 0.7, "Time/End": 2, "Output/Samples": 20, "Time/Tolerance": 1e-8}
        figure = self.figure(start, "continuum")
        table = self.motion(start, "continuum")
        _, Q = in_turning_frame(table, figure["omega3"])
        self.assertAlmostEqual(figure["a2"] / figure["a1"], 0.7, delta=1e-10)
        self.assertLess(numpy.abs(Q - numpy.diag([figure[f"a{i}"] for i in (1, 2, 3)]).reshape(9)).max(), 1e-7)

    def frequency_of_mode(self, model, number, amplitude, tolerance):
        figure = self.figure(OWN, model)
        entries = {**OWN, "Models": model, "Initial state/Mode": number, "Initial state/Mode amplitude": amplitude,
                   "Time/End": 20, "Output/Samples": 400, "Time/Tolerance": tolerance}
        t, Q = in_turning_frame(self.motion(entries, model), SPIN)
        expected = figure[f"rate_{number}_im"]
        found, size = fitted_frequency(t, Q, expected)
        self.assertGreater(size, amplitude / 10)  # the motion is seen in Q
        self.assertAlmostEqual(found / expected, 1, delta=1e-6)

    def test_frequency_of_a_pseudo_rigid_motion(self):
        for number in 1, 3, 5, 7, 9:
            with self.subTest(number=number):
                self.frequency_of_mode("reduced", number, 1e-5, 1e-10)

    def test_frequency_of_a_polynomial_motion(self):
        self.frequency_of_mode("polynomial", 1, 1e-4, 1e-8)

    def test_frequency_of_a_motion_of_elements(self):
        """Its affine part is the exchange of the axes 1 and 2 that Coriolis' force couples to a torsion."""
        self.frequency_of_mode("continuum", 1, 1e-4, 1e-7)

    def test_all_models_of_a_scene_start_with_the_motion_that_grows(self):
        """The part of the motion with the azimuthal number 2 grows at the rate of the table."""
        scene = {**BODIES, **SOFT, "Initial state/Figure": "own", "Initial state/Mode": "auto", "Initial state/Mode amplitude": 1e-5,
                 "Time/End": 2, "Output/Samples": 100, "Time/Tolerance": 1e-5, "Continuum/Error estimate": "none"}
        self.motion(scene, "continuum")
        for model in TABLES:
            figure = self.figure(scene, model)
            t, Q = in_turning_frame(self.table("motion", f"{model}.csv"), figure["omega3"])
            size = numpy.log(numpy.hypot(Q[:, 0] - Q[:, 4], Q[:, 1] + Q[:, 3]))
            self.assertGreater(size[-1] - size[0], 1, model)
            self.assertAlmostEqual(numpy.polyfit(t, size, 1)[0] / figure["growth_rate"], 1, delta=0.01, msg=model)

    def test_elements_without_a_figure_and_a_body_that_has_one(self):
        """At this spin the family of the elements has ended. The pseudo-rigid run is complete, and the reason is said."""
        self.scene({**OWN, "Models": "reduced, continuum", "Initial state/Equilibrium parameter": 2.1, "Time/End": 0.1})
        result = self.run_program("run", "scene.prm", "--output", "motion")
        self.assertEqual(result.returncode, STOPPED, result.stderr)
        self.assertIn("Initial state/Figure", result.stderr)
        self.assertEqual(len(self.table("motion", "reduced.csv")), OWN["Output/Samples"] + 1)

    def test_amplitude_is_the_mean_displacement(self):
        """Of the motion of degree 2 at rest, whose mass moment has nearly the whole displacement: exact for the ellipsoid."""
        for model, number in (("reduced", 1), ("polynomial", 10), ("continuum", 10)):
            with self.subTest(model=model):
                entries = {**OWN, "Models": model, "Initial state/Equilibrium parameter": 0, "Initial state/Mode": number,
                           "Initial state/Mode amplitude": 1e-6, "Time/End": 0.1, "Output/Samples": 1, "Time/Step": 0.01}
                table = self.motion(entries, model)
                Q = numpy.array([[table.column(f"Q{i}{j}")[0] for j in (1, 2, 3)] for i in (1, 2, 3)])
                whole = table.column("nonaffine_displacement")[0] if model != "reduced" else 0
                # |x - X|^2/M = |Q - 1|^2/5 + |x - Q X|^2/M, and |x|^2/M = 3/5.
                found = math.sqrt(numpy.linalg.norm(Q - numpy.eye(3)) ** 2 / 5 + whole**2 * 3 / 5)
                self.assertAlmostEqual(found / 1e-6, 1, delta=1e-4)

    def disturbed(self, velocity):
        """The energy of the first two samples of all models, with a velocity added to the figure."""
        scene = {**OWN, "Initial state/Equilibrium": "maclaurin", "Initial state/Equilibrium parameter": 0.7, "Continuum/Degree": 2,
                 "Initial state/Velocity": velocity, "Time/End": 1e-3, "Time/Step": 1e-4, "Output/Samples": 10, "Continuum/Error estimate": "none"}
        self.motion(scene, "continuum")
        return [self.table("motion", f"{model}.csv").column("energy")[:2] for model in TABLES]

    def test_velocity_keeps_the_volume_of_every_figure(self):
        for first, second in self.disturbed("0.2, 0, 0; 0, -0.2, 0; 0, 0, 0"):
            self.assertAlmostEqual(first, second, delta=1e-9 * first)

    def test_velocity_along_the_axis(self):
        """It keeps the volume of the pseudo-rigid spheroid with a3/a1 = sqrt(1 - e^2)."""
        self.disturbed(f"0.1, 0, 0; 0, 0.1, 0; 0, 0, {-0.2 * math.sqrt(1 - 0.49)!r}")

    def test_a_spinning_figure_has_a_symmetry_plane(self):
        self.scene({**OWN, "Models": "continuum"})
        self.assertIn("half (plane z)", self.run_done("check", "scene.prm").stdout)

    def test_a_motion_without_the_planes_of_the_sector_stops(self):
        """Without spin, the motions of number 9 of both bodies are torsions, which the octant does not hold."""
        for model in "polynomial", "continuum":
            for amplitude in 1e-3, 1e-12:
                self.scene({**OWN, "Models": model, "Initial state/Equilibrium parameter": 0, "Initial state/Mode": 9, "Continuum/Degree": 2,
                            "Initial state/Mode amplitude": amplitude, "Continuum/Symmetry": "octant"})
                result = self.run_program("run", "scene.prm")
                self.assert_exit(result, STOPPED)
                self.assertIn("Continuum/Symmetry", result.stderr)

    def test_other_analyses_do_not_need_the_motion(self):
        self.scene({**OWN, "Models": "reduced, polynomial", "Initial state/Mode": 1, "Analysis": "equilibrium", "Equilibrium/Family": "spinning",
                    "Equilibrium/First": 0.5, "Equilibrium/Last": 1, "Equilibrium/Number": 2})
        self.run_done("run", "scene.prm")

    def test_deformation_and_velocity_disturb_the_figure(self):
        """A rotation of the figure about the axis, and a uniform stretching velocity, in all models alike."""
        angle, rate = 0.3, 0.01
        c, s = math.cos(angle), math.sin(angle)
        disturbed = {**OWN, "Time/End": 0.1, "Output/Samples": 1, "Initial state/Deformation": f"{c!r}, {-s!r}, 0; {s!r}, {c!r}, 0; 0, 0, 1"}
        self.motion(disturbed, "continuum")
        for model in TABLES:
            table, figure = self.table("motion", f"{model}.csv"), self.figure(OWN, model)
            Q = [[table.column(f"Q{i}{j}")[0] for j in (1, 2)] for i in (1, 2)]
            self.assertAlmostEqual(cmath.phase(complex(Q[0][0], Q[1][0])), angle, delta=1e-9, msg=model)
            self.assertAlmostEqual(math.hypot(Q[0][0], Q[1][0]), figure["a1"], delta=1e-9, msg=model)
        pushed = {**OWN, "Time/End": 0.1, "Output/Samples": 1, "Body/Incompressible": "false", "Material/Lame lambda": 5,
                  "Initial state/Velocity": f"{rate}, 0, 0; 0, {rate}, 0; 0, 0, {rate}"}
        self.motion(pushed, "continuum", "pushed")
        for model in TABLES:
            self.assertAlmostEqual(self.table("pushed", f"{model}.csv").column("Qdot33")[0], rate, delta=1e-12, msg=model)

    def test_units_of_the_scene_do_not_matter(self):
        length, mass, time = 1000, 1e9, 7
        short = {**OWN, "Models": "polynomial, continuum", "Continuum/Degree": 2, "Time/End": 1, "Output/Samples": 4, "Time/Step": 0.05,
                 "Continuum/Error estimate": "none"}
        own = self.motion(short, "continuum", "own")
        scaled = self.motion({**short, "Body/Radius": length, "Body/Density": mass / length**3,
                              "Material/Shear modulus": mass / length / time**2, "Time/End": time, "Time/Step": 0.05 * time,
                              "Initial state/Equilibrium parameter": SPIN / time}, "continuum", "scaled")
        for name in "Q11", "Q21", "Q33":
            for x, y in zip(own.column(name), scaled.column(name)):
                self.assertAlmostEqual(x, y, delta=1e-9, msg=name)

    def test_resumed_run_is_the_run_without_a_stop(self):
        fixed = {**OWN, "Models": "continuum", "Continuum/Degree": 2, "Time/Step": 0.05, "Time/End": 1, "Output/Samples": 4,
                 "Continuum/Error estimate": "none", "Initial state/Mode": 1}
        whole = self.motion(fixed, "continuum", "whole")
        self.motion({**fixed, "Time/End": 0.5, "Output/Samples": 2}, "continuum", "part")
        self.run_done("run", "scene.prm", "--output", "part", "--resume", "--set", "Time/End=1", "--set", "Output/Samples=4")
        self.assertEqual(self.table("part", "continuum.csv").rows, whole.rows)


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
class StartingFiguresOnRanks(RanksTest):
    def test_two_ranks(self):
        self.scene({**OWN, "Models": "continuum", "Continuum/Degree": 2, "Continuum/Refinements": 1, "Time/Step": 0.02, "Time/End": 0.2,
                    "Output/Samples": 2, "Continuum/Error estimate": "none", "Initial state/Mode": 1, "Time/Constraint tolerance": 1e-13})
        self.run_done("run", "scene.prm", "--output", "alone")
        self.run_on(2, "run", "scene.prm", "--output", "on2")
        self.assertLess(largest_difference(self.table("alone/continuum.csv"), self.table("on2/continuum.csv")), 1e-12)


class RefusedStartingFigures(RefusedInputTest):
    def test_refused(self):
        other = {**OWN, "Initial state/Figure": "affine"}
        for entries, entry, word in (
                ({**OWN, "Initial state/Equilibrium": "none"}, "Initial state/Figure", "Equilibrium"),
                ({**OWN, "Initial state/Equilibrium": "none", "Initial state/Mode": 1}, "Initial state/Mode", "Equilibrium"),
                ({**OWN, "Initial state/Mode": 1}, "Initial state/Mode", "one model"),
                ({**other, "Models": "continuum", "Initial state/Mode": 1}, "Initial state/Mode", "Figure = own"),
                ({**OWN, "Models": "polynomial", "Polynomial/Degree": "3, 5", "Initial state/Mode": 1}, "Initial state/Mode", "degree"),
                ({**OWN, "Models": "continuum", "Continuum/Degree": "auto", "Initial state/Mode": 1}, "Initial state/Mode", "mesh"),
                ({**OWN, "Models": "continuum", "Continuum/Grading": 0.5}, "Continuum/Grading", "even mesh"),
                ({**OWN, "Models": "continuum", "Initial state/Equilibrium": "riemann-s"}, "Initial state/Equilibrium", "riemann-s"),
                ({**OWN, "Models": "polynomial", "Initial state/Equilibrium": "dedekind"}, "Initial state/Equilibrium", "dedekind"),
                ({**OWN, "Models": "reduced", "Initial state/Mode": 11}, "Initial state/Mode", "10"),
                ({**OWN, "Models": "reduced", "Initial state/Mode": "auto"}, "Initial state/Mode", "grows")):
            with self.subTest(entry=entry, word=word):
                self.refused_entries(entries, entry, word)

    def test_figure_that_only_another_model_has(self):
        """Beyond the largest spin of the elements, the pseudo-rigid body still has a figure."""
        self.scene({**OWN, "Models": "continuum", "Initial state/Equilibrium parameter": 2.2})
        result = self.run_program("run", "scene.prm")
        self.assert_exit(result, STOPPED)
        self.assertIn("Initial state/Figure", result.stderr)


if __name__ == "__main__":
    unittest.main()
