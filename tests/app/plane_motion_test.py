"""Friction on rigid planes, and planes that move: Coulomb's impulse, energy balances, Galilean invariance, repeated runs,
units, pictures, ranks, and refused entries."""
import math
import shutil
import unittest

from pseudorigid import Run
from program_test import largest_difference, main, overrides
from ranks import RanksTest
from refused_input import RefusedInputTest

FLOOR = {"Loads/Plane normals": "0, 0, 2", "Loads/Plane points": "0, 0, -1"}
MODELS = {"Models": "reduced, polynomial, continuum", "Polynomial/Degree": 3, "Continuum/Degree": 2,
          "Continuum/Error estimate": "none"}
FIXED = {"Time/Step": 0.005, "Time/Method": "rattle", "Output/Samples": 10}
OBLIQUE = {**FLOOR, "Loads/Plane friction": 0.3, "Loads/Plane stiffness": 100,
           "Initial state/Center velocity": "0.2, 0, -0.3", "Time/End": 3}
NAMES = "reduced", "polynomial", "continuum"


class PlaneFriction(RefusedInputTest):
    def test_a_sliding_impact_has_coulombs_impulse(self):
        """If all points slide in one direction, the impulse of the friction is f times the normal impulse."""
        self.scene({**OBLIQUE, **MODELS, "Loads/Plane slip speed": 1e-6, "Loads/Plane friction": 0.1,
                    "Initial state/Center velocity": "0.6, 0, -0.1", "Time/End": 6, "Time/Tolerance": 1e-4,
                    "Output/Samples": 20})
        self.run_done("run", "scene.prm", "--output", "out")
        for name in NAMES:
            table = self.table(f"out/{name}.csv")
            sliding, normal = (table.column(v)[-1] - table.column(v)[0] for v in ("v1", "v3"))
            self.assertGreater(normal, 0.15, name)
            self.assertLess(abs(sliding / (-0.1 * normal) - 1), 1e-3, name)
            self.assertLess(abs(table.column("v2")[-1]), 1e-6, name)
            self.assertGreater(table.column("J2")[-1], 0, name)
            dissipated = table.column("dissipated")
            self.assertTrue(all(b >= a - 1e-9 for a, b in zip(dissipated, dissipated[1:])), name)

    def test_the_energy_balance_of_a_ball_that_slides_and_sticks(self):
        """Backspin, and an impact within which the ball sticks. The errors are those of the steps: 2e-4 was seen."""
        self.scene({**OBLIQUE, **MODELS, "Loads/Plane friction": 0.8, "Time/Tolerance": 1e-4, "Output/Samples": 30,
                    "Initial state/Velocity": "0, 0, -0.1; 0, 0, 0; 0.1, 0, 0"})
        self.run_done("run", "scene.prm", "--output", "out")
        for name in NAMES:
            table = self.table(f"out/{name}.csv")
            energy = table.column("energy")
            self.assertGreater(table.column("dissipated")[-1], 1e-2 * energy[0], name)
            self.assertLess(max(energy) - min(energy), 1e-3 * energy[0], name)

    def test_the_affine_polynomial_body_is_the_pseudo_rigid_body(self):
        self.scene({**OBLIQUE, **FIXED, "Models": "reduced, polynomial", "Polynomial/Degree": 1,
                    "Loads/Plane speeds": 0.05, "Loads/Plane damping": 0.5})
        self.run_done("run", "scene.prm", "--output", "out")
        reduced, affine = self.table("out/reduced.csv"), self.table("out/polynomial.csv")
        self.assertGreater(reduced.column("dissipated")[-1], 1e-2)
        for column in "x1", "x3", "v1", "Q33", "J2", "contact_force", "dissipated", "external", "restitution":
            difference = max(abs(a - b) for a, b in zip(reduced.column(column), affine.column(column)))
            self.assertLess(difference, 1e-10, column)

    def test_a_scene_in_other_units_has_the_same_impact(self):
        scene = {**OBLIQUE, **FIXED, "Models": "reduced", "Loads/Plane slip speed": 0.01, "Loads/Plane speeds": 0.1,
                 "Loads/Plane amplitudes": 0.05, "Loads/Plane frequency": 2}
        self.scene(scene)
        self.run_done("run", "scene.prm", "--output", "one")
        length, density, modulus = 2.0, 3.0, 0.7
        speed = math.sqrt(modulus / density)
        time = length / speed
        self.run_done("run", "scene.prm", "--output", "other", *overrides({
            "Body/Radius": length, "Body/Density": density, "Material/Shear modulus": modulus,
            "Loads/Plane points": f"0, 0, {-length}", "Loads/Plane stiffness": repr(100 * modulus / length),
            "Initial state/Center velocity": f"{0.2 * speed!r}, 0, {-0.3 * speed!r}", "Time/End": repr(3 * time),
            "Time/Step": repr(0.005 * time), "Loads/Plane slip speed": repr(0.01 * speed), "Loads/Plane speeds": repr(0.1 * speed),
            "Loads/Plane amplitudes": repr(0.05 * length), "Loads/Plane frequency": repr(2 / time)}))
        one, other = self.table("one/reduced.csv"), self.table("other/reduced.csv")
        energy = modulus * length**3
        for column, unit in (("v1", speed), ("v3", speed), ("contact_force", modulus * length**2), ("dissipated", energy),
                             ("external", energy), ("restitution", 1)):
            for a, b in zip(one.column(column), other.column(column)):
                self.assertAlmostEqual(a * unit, b, delta=1e-10 * unit, msg=column)

    def test_the_usual_slip_speed_is_a_thousandth_of_the_speed_of_shear_waves(self):
        self.scene({**OBLIQUE, "Models": "reduced", "Material/Shear modulus": 4, "Body/Density": 0.25})
        self.run_done("run", "scene.prm", "--output", "auto")
        self.run_done("run", "scene.prm", "--output", "given", "--set", "Loads/Plane slip speed=0.004")
        self.assertEqual(self.bytes("auto", "reduced.csv"), self.bytes("given", "reduced.csv"))

    def test_no_friction_is_no_entry(self):
        self.scene({key: value for key, value in OBLIQUE.items() if key != "Loads/Plane friction"} | {"Models": "reduced"})
        self.run_done("run", "scene.prm", "--output", "none")
        self.run_done("run", "scene.prm", "--output", "zero", "--set", "Loads/Plane friction=0", "--set",
                      "Loads/Plane slip speed=7", "--set", "Loads/Plane speeds=0", "--set", "Loads/Plane frequency=3")
        self.assertEqual(self.bytes("none", "reduced.csv"), self.bytes("zero", "reduced.csv"))

    def test_a_sweep_of_the_friction(self):
        self.scene({**OBLIQUE, "Models": "reduced", "Loads/Plane friction": "$(f)", "Sweep/Parameters": "f: 0 .. 0.4 in 3"})
        self.run_done("run", "scene.prm", "--output", "sweep")
        speeds = self.table("sweep/sweep.csv").column("v1_end")
        self.assertAlmostEqual(speeds[0], 0.2, places=12)
        self.run_done("run", "scene.prm", "--output", "single", "--set", "Sweep/Parameters=f: 0.2")
        self.assertAlmostEqual(speeds[1], self.table("single/sweep.csv").column("v1_end")[0], places=9)
        self.assertLess(max(speeds[1:]), 0.17)

    def test_compositions_refuse_friction(self):
        self.scene({**OBLIQUE, "Models": "reduced", "Time/Method": "rattle-4"})
        self.refused("run", "scene.prm", fragments=("Time/Method", "dissipation"))

    def test_the_lines_of_check(self):
        self.scene({**OBLIQUE, "Models": "reduced", "Loads/Plane speeds": 0.1})
        printed = self.run_done("check", "scene.prm").stdout
        self.assertIn("contact with rigid planes: 1, with friction, in motion", printed)
        self.assertIn("dissipation, and the energy that it takes", printed)

    def test_bad_entries(self):
        self.refused_entries({"Loads/Plane friction": -0.1}, "Loads/Plane friction", base=OBLIQUE)
        self.refused_entries({"Loads/Plane slip speed": 0}, "Loads/Plane slip speed", base=OBLIQUE)
        self.refused_entries({"Loads/Plane speeds": "0.1, 0.2"}, "Loads/Plane speeds", "2 for 1", base=OBLIQUE)
        self.refused_entries({"Loads/Plane amplitudes": "1, 1, 1"}, "Loads/Plane amplitudes", "3 for 1", base=OBLIQUE)
        self.refused_entries({"Loads/Plane speeds": "fast"}, "Loads/Plane speeds", base=OBLIQUE)
        self.refused_entries({"Loads/Plane frequency": "inf"}, "Loads/Plane frequency", base=OBLIQUE)


class PlaneMotion(RefusedInputTest):
    def test_another_observer_sees_the_same_impact(self):
        """A plane that hits a ball, and a ball that flies against a plane at rest, at equal steps."""
        base = {**OBLIQUE, **MODELS, **FIXED, "Time/End": 2, "Loads/Plane damping": 0.5}
        self.scene(base)
        self.run_done("run", "scene.prm", "--output", "rest")
        self.run_done("run", "scene.prm", "--output", "hit", "--set", "Loads/Plane speeds=0.4",
                      "--set", "Initial state/Center velocity=0.2, 0, 0.1")
        for name in NAMES:
            rest, hit = self.table(f"rest/{name}.csv"), self.table(f"hit/{name}.csv")
            self.assertGreater(hit.column("v3")[-1], 0.3, name)
            for column in "Q11", "Q33", "v1", "J2", "contact_force", "dissipated", "contact", "restitution", "last_contact":
                difference = max(abs(a - b) for a, b in zip(rest.column(column), hit.column(column)))
                self.assertLess(difference, 1e-9, (name, column))
            for time, a, b in zip(rest.column("time"), rest.column("x3"), hit.column("x3")):
                self.assertAlmostEqual(a + 0.4 * time, b, delta=1e-10, msg=name)
            energy = hit.column("energy")
            self.assertLess(max(energy) - min(energy), 1e-3 * energy[0], name)

    def test_two_planes_that_approach_compress_the_ball(self):
        """The work of the planes, −external, is the energy of the ball and of the contact. The motion has the symmetry of an
        octant, which the whole ball confirms."""
        self.scene({**MODELS, "Loads/Plane normals": "0, 0, 1; 0, 0, -1", "Loads/Plane points": "0, 0, -1; 0, 0, 1",
                    "Loads/Plane speeds": "0.02, 0.02", "Loads/Plane friction": 0.3, "Loads/Plane stiffness": 50, "Time/End": 6,
                    "Time/Step": 0.01, "Time/Method": "rattle", "Output/Samples": 12})
        self.run_done("run", "scene.prm", "--output", "out")
        self.assertIn("octant", (self.scratch / "out/log.txt").read_text())
        for name in NAMES:
            table = self.table(f"out/{name}.csv")
            given = -table.column("external")[-1]
            self.assertGreater(given, 1e-2, name)
            kept = sum(table.column(column)[-1] for column in ("kinetic", "elastic", "contact", "dissipated"))
            self.assertAlmostEqual(given, kept, delta=1e-3 * given, msg=name)
        self.run_done("run", "scene.prm", "--output", "whole", "--set", "Continuum/Symmetry=none", "--set", "Models=continuum")
        octant, whole = self.table("out/continuum.csv"), self.table("whole/continuum.csv")
        for column in "Q11", "Q33", "kinetic", "elastic", "contact", "contact_force", "dissipated", "external":
            difference = max(abs(a - b) for a, b in zip(octant.column(column), whole.column(column)))
            self.assertLess(difference, 1e-9, column)
        self.run_done("run", "scene.prm", "--output", "one", "--set", "Loads/Plane speeds=0.02, 0", "--set", "Models=continuum",
                      "--set", "Time/End=0.1", "--set", "Output/Samples=1")
        self.assertIn("quarter (planes x, y)", (self.scratch / "one/log.txt").read_text())

    def test_a_plate_carries_a_ball(self):
        """Slow oscillations, small compared with the weight: the centre follows the plate. The program chooses the step."""
        self.scene({**FLOOR, "Models": "reduced", "Loads/Plane amplitudes": 0.05, "Loads/Plane frequency": 0.1,
                    "Loads/Plane damping": 5, "Loads/Plane stiffness": 100, "Loads/Acceleration": "0, 0, -0.02",
                    "Material/Viscosity": 0.3, "Initial state/Center velocity": "0, 0, 0.005", "Time/End": 126,
                    "Time/Tolerance": 1e-4, "Output/Samples": 126})
        self.run_done("run", "scene.prm", "--output", "out")
        table = self.table("out/reduced.csv")
        above = [x - 0.05 * math.sin(0.1 * t) for t, x in zip(table.column("time"), table.column("x3"))][63:]
        self.assertLess(max(above) - min(above), 2e-3)
        energy = table.column("energy")
        self.assertLess(max(energy) - min(energy), 1e-4)

    def test_a_resumed_run_is_the_uninterrupted_one(self):
        """Times are binary fractions, so that they do not depend on the end."""
        self.scene({**OBLIQUE, "Models": "reduced, polynomial", "Polynomial/Degree": 2, "Time/Step": 0.015625,
                    "Loads/Plane speeds": 0.1, "Loads/Plane amplitudes": 0.05, "Loads/Plane frequency": 2,
                    "Time/Method": "rattle", "Output/Samples": 24})
        self.run_done("run", "scene.prm", "--output", "whole")
        self.run_done("run", "scene.prm", "--output", "part", *overrides({"Time/End": 0.5, "Output/Samples": 4}))
        self.run_done("run", "scene.prm", "--output", "part", "--resume", *overrides({"Time/End": 3}))
        for name in "reduced.csv", "polynomial.csv":
            self.assertEqual(self.bytes("whole", name), self.bytes("part", name))

    def test_the_entries_that_a_run_prints_repeat_it(self):
        self.scene({**OBLIQUE, "Models": "reduced", "Loads/Plane speeds": 0.1, "Loads/Plane amplitudes": 0.05,
                    "Loads/Plane frequency": 2})
        self.run_done("run", "scene.prm", "--output", "one")
        self.run_done("run", "one/used.prm", "--output", "two")
        self.assertEqual(self.bytes("one", "reduced.csv"), self.bytes("two", "reduced.csv"))

    def test_pictures_have_the_pressure_of_the_planes_at_their_time(self):
        """k d at the points of the surface, with the position of the plane at the time of the picture."""
        self.scene({**OBLIQUE, **MODELS, "Initial state/Center velocity": "0, 0, 0", "Loads/Plane stiffness": 40,
                    "Loads/Plane speeds": 0.2, "Loads/Plane amplitudes": 0.05, "Loads/Plane frequency": 2, "Time/End": 0.5,
                    "Time/Step": 0.005, "Time/Method": "rattle", "Output/Samples": 10, "Output/Graphics": "vtu",
                    "Output/Frames": 6})
        self.run_done("run", "scene.prm", "--output", "out")
        for model in NAMES:
            for frame in Run(self.scratch / "out").frames(model):
                picture = frame.read()
                pressures = picture.fields["contact_pressure"]
                radii = (picture.fields["reference_coordinates"] ** 2).sum(axis=1) ** 0.5
                plane = -1 + 0.2 * frame.time + 0.05 * math.sin(2 * frame.time)
                expected = [40 * max(0, plane - z) if radius > 0.999 else 0 for z, radius in zip(picture.points[:, 2], radii)]
                self.assertLess(max(abs(pressures - expected)), 1e-12, model)
            self.assertGreater(max(pressures), 0.02, model)  # the elastic surface gives way

    def test_only_the_start_must_be_in_front_of_the_plane(self):
        self.scene({**FLOOR, "Models": "reduced", "Loads/Plane speeds": 0.3, "Time/End": 1, "Output/Samples": 2})
        self.run_done("run", "scene.prm", "--output", "out")
        self.assertGreater(self.table("out/reduced.csv").column("penetration")[-1], 0)
        self.refused_entries({"Loads/Plane points": "0, 0, -0.5"}, "Loads/Plane points", "plane 1 cuts the body at the start",
                             base={**OBLIQUE, "Loads/Plane speeds": -1})


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
class PlaneMotionOnRanks(RanksTest):
    def test_two_ranks_are_one(self):
        self.scene({**OBLIQUE, "Models": "continuum", "Continuum/Degree": 2, "Loads/Plane damping": 1,
                    "Loads/Plane slip speed": 0.01, "Loads/Plane speeds": 0.1, "Loads/Plane amplitudes": 0.02,
                    "Loads/Plane frequency": 3, "Time/End": 1, "Time/Step": 0.005, "Time/Method": "rattle", "Output/Samples": 10})
        self.run_done("run", "scene.prm", "--output", "alone")
        self.run_on(2, "run", "scene.prm", "--output", "on2")
        alone, on2 = self.table("alone/continuum.csv"), self.table("on2/continuum.csv")
        self.assertGreater(max(alone.column("dissipated")), 1e-3)
        self.assertLess(min(alone.column("external")), -1e-3)
        self.assertLess(largest_difference(alone, on2), 1e-10)


if __name__ == "__main__":
    main()
