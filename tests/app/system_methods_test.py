"""Numbers of the systems beside the ball: two forms of a system agree, every method runs or is refused, tolerances are met,
units change nothing."""
import math
import unittest

from program_test import DONE, WRONG_INPUT, overrides, words
from system_test import (ARC_FOR_TIME, BODY, BODY_OF_POINTS, DAMPED_POINTS, ELLIPSOID, EULER, FRAME, INERTIAL, JACOBI, LAGRANGE,
                         PARABOLOID, PENDULUM, POINTS, ROTATION, ROTOR, SPHERICAL_PENDULUM, SystemTest, TOP, TORUS,
                         UNITS_ON_THE_PARABOLOID, distance)

METHODS = words("Time/Method")  # auto and all others


class SystemMethods(SystemTest):
    # Two forms of a system are the same motion.

    def check_forms(self, scene, form, columns=None, bound=1e-9):
        tight = {"Time/Tolerance": 1e-12}
        difference = distance(self.motion(scene, tight), self.motion(scene, {**tight, **form}), columns)
        print(f"{form}: {difference:.1e}")
        self.assertLess(difference, bound)

    def test_forms_of_the_double_pendulum(self):
        self.check_forms(PENDULUM, LAGRANGE)

    def test_forms_of_the_rigid_body(self):
        for scene in (TOP, BODY, "heavy_top"):
            self.check_forms(scene, EULER)

    def test_forms_of_the_moving_frame(self):
        self.check_forms(FRAME, INERTIAL)

    # Columns of angles know of no earlier sample.

    def check_turns(self, scene, angles, changes={}):
        """The last sample is the same after few and after many, and all angles are between -pi and pi."""
        few, many = (self.motion(scene, {**changes, "Output/Samples": n}) for n in (16, 1600))
        for name in angles:
            self.assertAlmostEqual(few.column(name)[-1], many.column(name)[-1], delta=1e-3, msg=name)
            self.assertLessEqual(max(map(abs, many.column(name))), math.pi, name)

    def test_turns_of_a_top_do_not_depend_on_the_samples(self):
        for form in ({}, EULER):
            self.check_turns("heavy_top", ("phi", "theta", "psi"), form)

    def test_turns_of_a_double_pendulum_do_not_depend_on_the_samples(self):
        for form in ({}, LAGRANGE):
            self.check_turns(PENDULUM, ("theta", "phi"), {**form, "Double pendulum/Rates": "20, 20", "Time/End": 5})

    # Methods.

    FIELD_METHODS = {"auto", "gauss-16", "explicit-8"}
    FORMS = (  # a scene, and the methods that fit it
        (POINTS, set(METHODS)), (DAMPED_POINTS, {"auto", "rattle", "gauss-16", "explicit-8"}),
        (PENDULUM, set(METHODS)), ({**PENDULUM, **LAGRANGE}, FIELD_METHODS),
        (TOP, set(METHODS)), ({**TOP, **EULER}, FIELD_METHODS), (BODY, set(METHODS)), ({**BODY, **EULER}, FIELD_METHODS),
        (FRAME, FIELD_METHODS), ({**FRAME, **INERTIAL}, FIELD_METHODS), (TORUS, FIELD_METHODS),
        ({**TORUS, "Torus/Damping": 0}, FIELD_METHODS), (ELLIPSOID, FIELD_METHODS), (PARABOLOID, FIELD_METHODS),
        (JACOBI, FIELD_METHODS),
    )

    def test_every_method_runs_or_is_refused(self):
        for scene, fitting in self.FORMS:
            self.scene({**scene, "Time/End": 0.2, "Output/Samples": 4, "Time/Tolerance": 1e-4})
            outcomes = {}
            for method in METHODS:
                with self.subTest(scene["System"], method=method):
                    choice = overrides({"Time/Method": method})
                    result = self.run_program("run", "scene.prm", "--quiet", "--output", "run", *choice)
                    outcomes[method] = result.returncode
                    if method in fitting:
                        self.assertEqual((result.returncode, result.stderr), (DONE, ""))
                    else:
                        self.assert_one_sentence(result, "error: --set: Time/Method: ", "explicit-8")
                        self.assertEqual(self.run_program("check", "scene.prm", *choice).returncode, WRONG_INPUT)
            form = next((value for path, value in scene.items() if path.endswith("/Form")), "")
            print(f"{scene['System']:16}{form:9}", *outcomes.values())

    # Tolerances.

    def check_tolerance(self, scene, columns, methods, changes, tolerances=(1e-4, 1e-6, 1e-8)):
        """Of all samples, against the tightest run of another method where there is one."""
        for method in methods:
            exact = self.motion(scene, {**changes, "Time/Method": "explicit-8" if method != "explicit-8" else "auto",
                                        "Time/Tolerance": 1e-12})
            for tolerance in tolerances:
                if method in ("rattle", "energy-momentum") and tolerance < 1e-6:
                    continue  # of order 2: slow
                with self.subTest(method, tolerance=tolerance):
                    table = self.motion(scene, {**changes, "Time/Method": method, "Time/Tolerance": tolerance})
                    error = distance(exact, table, columns)
                    print(f"{table.file:16}{method:16} tolerance {tolerance:.0e}: error {error / tolerance:.3f} times that")
                    self.assertLessEqual(error, tolerance)

    def test_tolerance_of_mass_points(self):
        # The unit of length of the scene is the farthest point's distance from the centre of mass, about 1.
        self.check_tolerance("three_bodies", [f"{axis}{i}" for i in (1, 2, 3) for axis in "xyz"], METHODS, {"Time/End": 6.3})

    def test_tolerance_of_the_double_pendulum(self):
        self.check_tolerance("double_pendulum", ["x1", "y1", "x2", "y2"], METHODS, {"Time/End": 3})

    def test_tolerance_of_the_double_pendulum_over_the_whole_scene(self):
        # Chaos: round-off alone becomes 2e-8 (rattle-8 with half the step).
        self.check_tolerance("double_pendulum", ["x1", "y1", "x2", "y2"], ["auto", "explicit-8"], {}, (1e-4, 1e-6))

    def test_tolerance_of_the_rigid_body(self):
        self.check_tolerance("heavy_top", ROTATION, METHODS, {"Time/End": 0.4})

    def test_tolerance_where_fixed_steps_are_hopeless(self):
        """Kepler's ellipse of eccentricity 0.999, three revolutions from the apocentre, where the points have to return."""
        v, period = 0.5 * math.sqrt(1 - 0.999), 2 * math.pi * (1 / 1.999)**1.5
        for method in ("auto", "explicit-8"):
            with self.subTest(method):
                table = self.motion({"System": "mass points", "Mass points/Velocities": f"0, {v!r}, 0; 0, {-v!r}, 0",
                                     "Time/End": repr(3 * period), "Output/Samples": 3, "Time/Method": method})
                for row in table.rows:
                    self.assertLess(max(abs(x - y) for x, y in zip(row[1:7], table.rows[0][1:7])), 0.5e-6)

    def test_tolerance_beyond_the_horizon_of_chaos(self):
        """What no number of digits can keep is said: the two forms tell how far the motion is known."""
        tables = [self.motion("double_pendulum", {**form, "Time/End": 100, "Time/Method": "explicit-8"})
                  for form in ({}, LAGRANGE)]
        if distance(*tables, ["x1", "y1", "x2", "y2"]) > 2e-6:
            for table in tables:
                self.assertIn("warning", self.log(table))

    def test_tolerance_of_jacobi_geodesics(self):
        """The column deviation is the error. The scene's length is the distance of its start, the pericentre. Where
        round-off, which the metric magnifies as it degenerates, is greater than the tolerance, a warning says so."""
        for pericentre in (0.4, 0.1, 0.01, 0.001):
            with self.subTest(pericentre=pericentre):
                table = self.motion({"System": "jacobi geodesic", "Jacobi geodesic/Position": f"{pericentre}, 0",
                                     "Time/End": 2 * math.pi, "Time/Tolerance": 1e-7})
                error = max(table.column("deviation")) / pericentre
                print(f"pericentre {pericentre}: error {error:.1e}")
                if error > 1e-7:
                    self.assertIn("below the accuracy of double precision", self.log(table))
                    self.assertLess(pericentre, 0.01)

    def test_tolerance_of_a_geodesic(self):
        self.check_tolerance(ELLIPSOID, ["q1", "q2"], ["explicit-8"], {})

    def log(self, table):
        return self.scratch.joinpath(table.folder, "log.txt").read_text()

    # Units.

    def check_units(self, scene, units={}, n_points=2, tolerance=1e-11):
        """The scene in other units is the same motion, written in these units."""
        all_factors = ((1e6, 1, 1), (1, 1e6, 1), (1, 1, 1e6), (1e-9, 1e-9, 1e-9), (1e6, 1e-9, 1e6))
        for factors, difference in self.differences_in_units(scene, all_factors, units, n_points, tolerance):
            print(f"{factors}: {difference:.1e}")
            # Stages that are iterated agree to a part of the tolerance.
            self.assertLess(difference, max(1e-10, 1e-3 * tolerance), factors)

    def test_units_of_mass_points(self):
        for scene in (POINTS, DAMPED_POINTS):
            self.check_units(scene, n_points=3)

    def test_units_of_the_double_pendulum(self):
        for scene in (PENDULUM, {**PENDULUM, **LAGRANGE}):
            self.check_units(scene)

    def test_units_of_the_rigid_body(self):
        for scene in (TOP, BODY, {**BODY, **EULER}):
            self.check_units(scene)

    def test_units_of_the_moving_frame(self):
        self.check_units(FRAME)

    def test_units_of_a_start_in_the_origin_of_the_frame(self):
        # The tolerance is relative to the scene's length, whatever sets that; so even its errors are the same.
        for center in ("Moving frame/Centre", "Moving frame/Origin"):
            self.check_units({"System": "moving frame", "Moving frame/Position": "0, 0, 0", "Moving frame/Stiffness": 1,
                              center: "1, 0, 0", "Moving frame/Spin rate": 0.3, "Time/End": 3, "Output/Samples": 10},
                             tolerance=1e-6)

    def test_units_of_a_pendulum_that_outruns_gravity(self):
        """Turning so fast that gravity does not matter, or, in other units of time, almost without gravity."""
        fast = {**PENDULUM, "Double pendulum/Rates": "1e4, -2e4", "Time/End": 1e-3, "Time/Tolerance": 1e-9}
        weightless = {**fast, "Double pendulum/Gravity": 0}
        for form in ({}, LAGRANGE):
            difference = distance(self.motion(fast, form), self.motion(weightless, form), ["x1", "y1", "x2", "y2"])
            self.assertLess(difference, 1e-5)  # g t²/2

    def test_units_of_the_torus(self):
        self.check_units(TORUS)

    def test_units_of_geodesics(self):
        self.check_units(ELLIPSOID)
        self.check_units(PARABOLOID, UNITS_ON_THE_PARABOLOID)

    def test_units_of_jacobi_geodesics(self):
        self.check_units(JACOBI, ARC_FOR_TIME)

    def test_units_of_bodies_of_points_and_of_the_rotor(self):
        for scene in (BODY_OF_POINTS, ROTOR, SPHERICAL_PENDULUM):
            self.check_units(scene)


if __name__ == "__main__":
    unittest.main()
