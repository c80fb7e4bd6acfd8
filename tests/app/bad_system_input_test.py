"""Bad input of the systems beside the ball: exit code 2, one sentence that names line and entry, nothing written."""
import unittest

from refused_input import RefusedInputTest


class BadSystemInput(RefusedInputTest):
    @staticmethod
    def small_scene(system):
        return {"System": system, "Time/End": 1, "Output/Samples": 10}

    def refused_by_system(self, system, *cases):
        """Cases (path, value, fragments), each by its line and by --set."""
        for path, value, *fragments in cases:
            with self.subTest(f"{path} = {value}"):
                message = self.refused_entries({path: value}, f"{path}: ", *fragments, base=self.small_scene(system))
                self.assertTrue(message.startswith(f"error: --set: {path}: "), message)
                self.scene({**self.small_scene(system), path: value})
                lines = (self.scratch / "scene.prm").read_text().splitlines()
                line = lines.index(f"set {path.split('/')[-1]} = {value}") + 1
                self.refused("run", "scene.prm", fragments=(f"error: scene.prm:{line}: {path}: ",))

    def test_mass_points(self):
        masses, places, springs = "Mass points/Masses", "Mass points/Positions", "Mass points/Springs"
        self.refused_by_system(
            "mass points",
            (masses, "1, -1", "a number > 0", '"-1" as entry 2'), (masses, "1, 0", '"0" as entry 2'),
            (masses, "", "one or more numbers", "got nothing"), (masses, "1; 1", '"1; 1" as entry 1'),
            (places, "1, 0, 0", "as many rows as there are masses, 2, got 1"),
            (places, "1, 0, 0; 0, 1", "rows of 3 finite numbers", "row 2 has 2 entries"),
            (places, "1, 2, 3; 1, 2, 3", "points 1 and 2 at one place"),
            (places, "nan, 0, 0; 0, 0, 0", '"nan" as entry (1,1)'),
            ("Mass points/Velocities", "1, 0, 0", "as many rows as there are masses, 2, got 1"),
            ("Mass points/Gravitational constant", "-1", "a number >= 0", '"-1"'),
            (springs, "1, 3, 1, 1", "two points, 1 to 2, got 3 in row 1"),
            (springs, "1, 2, 1, 1; 0, 1, 1, 1", "got 0 in row 2"),
            (springs, "1.5, 2, 1, 1", "got 1.5 in row 1"), (springs, "1, 1, 1, 1", "point 1 twice in row 1"),
            (springs, "1, 2, -1, 1", "numbers >= 0", "got -1 in row 1"),
            (springs, "1, 2, 1", "rows of 4", "row 1 has 3 entries"),
            ("Mass points/Dashpots", "1, 9, 1", "got 9 in row 1"), ("Mass points/Dashpots", "1, 2, -1", "got -1 in row 1"),
            ("Mass points/Field", "0, -9.81", "3 numbers", "2 entries"), ("Mass points/Confinement", "-1", ">= 0", '"-1"'),
            ("Mass points/Drag", "-0.1", ">= 0", '"-0.1"'))
        self.refused_entries({masses: "1, 1, 1", places: "1, 0, 0; 2, 0, 0"}, f"{places}: ", "3, got 2",
                             base=self.small_scene("mass points"))
        self.refused_entries({"Mass points/Central attraction": 1, places: "1, 0, 0; 0, 0, 0"}, f"{places}: ",
                             "at the attracting center, got point 2", base=self.small_scene("mass points"))

    def test_double_pendulum(self):
        self.refused_by_system(
            "double pendulum",
            ("Double pendulum/Form", "lagrangian", "multiplier or lagrange", 'did you mean "lagrange"?'),
            ("Double pendulum/Second mass", "0", "a number > 0", '"0"'),
            ("Double pendulum/First length", "-1", "a number > 0", '"-1"'), ("Double pendulum/Gravity", "-9.81", ">= 0"),
            ("Double pendulum/Angles", "1", "2 numbers", "1 entry"), ("Double pendulum/Rates", "1, x", '"x" as entry 2'))

    def test_rigid_body(self):
        rotation, inertia = "Rigid body/Rotation", "Rigid body/Inertia"
        self.refused_by_system(
            "rigid body",
            (rotation, "1, 0, 0; 0, 1, 0; 0, 0, 2", "R^T R = identity", "off by 3"),
            (rotation, "1, 0, 0; 0, 1, 0; 0, 0, -1", "reflection, det R = -1"),
            (rotation, "1, 0, 0; 0, 1, 1e-7; 0, 0, 1", "to 1e-8"),
            (inertia, "1, 0, 0; 0, 1, 0; 0, 0, 3", "none exceeds the sum of the two others", "1, 1, 3"),
            (inertia, "1, 0, 0; 0, 1, 0; 0, 0, 2", "flat", "Euler"), (inertia, "1, 0, 0; 0, 1, 0; 0, 0, -1", "positive"),
            (inertia, "1, 0.1, 0; 0, 1, 0; 0, 0, 1", "symmetric"), (inertia, "1, 0; 0, 1", "3x3 matrix", "2 rows"),
            ("Rigid body/Mass", "0", "a number > 0"), ("Rigid body/Form", "quaternion", "one of constrained, euler, lagrange"),
            ("Rigid body/Fixed point", "maybe", "true or false", '"maybe"'),
            ("Rigid body/Position", "1, 0, 0", "where Fixed point = true"),
            ("Rigid body/Velocity", "0, 0, 1", "where Fixed point = true"),
            ("Rigid body/Springs", "0, 0, 0, 0, 0, 0, 1, 1", "one place in row 1"),
            ("Rigid body/Springs", "1, 0, 0, 2, 0, 0, -1, 1", ">= 0", "-1 and 1 in row 1"),
            ("Rigid body/Springs", "1, 0, 0, 2, 0, 0, 1", "rows of 8", "7 entries"))
        free = {**self.small_scene("rigid body"), "Rigid body/Fixed point": "false"}
        self.refused_entries({"Rigid body/Center": "0, 0, 0.1"}, "Rigid body/Center: ", "0, 0, 0", base=free)
        self.refused_entries({inertia: "0.1, 0, 0; 0, 0.1, 0; 0, 0, 0.1"}, f"{inertia}: ", "at Center",
                             base={**self.small_scene("rigid body"), "Rigid body/Center": "0, 0, 1"})
        tilted = {rotation: "1, 0, 0; 0, 0.8, -0.6; 0, 0.6, 0.8"}
        for form in ("euler", "lagrange"):
            self.refused_entries({"Rigid body/Springs": "1, 0, 0, 2, 0, 0, 1, 0"}, "Rigid body/Springs: ", f"Form = {form}",
                                 base={**free, **tilted, "Rigid body/Form": form})
        self.refused_entries({rotation: "0.8, -0.6, 0; 0.6, 0.8, 0; 0, 0, 1"}, f"{rotation}: ", "not vertical", "Form = euler",
                             base={**free, **tilted, "Rigid body/Form": "lagrange"})

    def test_bodies_of_points(self):
        self.refused_by_system(
            "rigid body", ("Rigid body/Points", "1, 0, 0", "rows of 4"),
            ("Rigid body/Points", "1, 0, 0, 1; 0, 1, 0, 0; 0, 0, 1, 1", "masses > 0", "in row 2"),
            ("Rigid body/Points", "1, 0, 0, 1; -1, 0, 0, 1", "Rigid body/Points", "positive"))

    def test_fixed_axis(self):
        self.refused_by_system(
            "fixed axis", ("Fixed axis/Axis", "0, 0, 0", "a direction, got zero"),
            ("Fixed axis/Bearings", "1, 1", "two different places"), ("Fixed axis/Bearings", "1", "2 numbers"),
            ("Fixed axis/Weights", "1, 0, 0, -1", "masses > 0", "in row 1"), ("Fixed axis/Mass", "0", "a number > 0"),
            ("Fixed axis/Inertia", "1, 0, 0; 0, 1, 0; 0, 0, 3", "triangle inequality"),
            ("Fixed axis/Inertia", "1, 0.1, 0; 0, 1, 0; 0, 0, 1", "symmetric"), ("Fixed axis/Friction", "-1", "a number >= 0"))

    def test_spherical_pendulum(self):
        self.refused_by_system(
            "spherical pendulum", ("Spherical pendulum/Mass", "0", "a number > 0"), ("Spherical pendulum/Angles", "1", "2 numbers"),
            ("Spherical pendulum/Drag", "-1", "a number >= 0"))
        self.refused_entries({"Spherical pendulum/Rates": "0, 1"}, "Spherical pendulum/Rates: ", "no rate of phi",
                             base={**self.small_scene("spherical pendulum"), "Spherical pendulum/Angles": "0, 0"})

    def test_moving_frame(self):
        self.refused_by_system(
            "moving frame", ("Moving frame/Spin axis", "0, 0, 0", "a direction, got zero"),
            ("Moving frame/Form", "rotating", "moving or inertial"), ("Moving frame/Spin rate", "fast", '"fast"'),
            ("Moving frame/Position", "1", "3 numbers"), ("Analysis", "equilibrium", "System = moving frame"))
        self.refused_entries({"Moving frame/Position": "0, 0, 0"}, "Moving frame/Position: ", "Moving frame/Centre",
                             base={**self.small_scene("moving frame"), "Moving frame/Attraction": 1})

    def test_surfaces(self):
        self.refused_by_system("torus", ("Torus/Tube radius", "3", "thinner than Torus/Radius"),
                               ("Torus/Damping", "-1", "a number >= 0"), ("Torus/Tilt", "inf", "finite"),
                               ("Torus/Angles", "0", "2 numbers"))
        self.refused_by_system("geodesic", ("Geodesic/Surface", "cube", "ellipsoid", '"cube"'),
                               ("Geodesic/Point", "0, 0", "poles"), ("Geodesic/Point", "4, 0", "between 0 and pi"),
                               ("Geodesic/Semi-axes", "1, 1, 0", '"0" as entry 3'), ("Geodesic/Curvature", "0", "> 0"))
        self.refused_entries({"Geodesic/Point": "0, 0"}, "Geodesic/Point: ", "y > 0",
                             base={**self.small_scene("geodesic"), "Geodesic/Surface": "hyperbolic plane"})

    def test_jacobi_geodesic(self):
        energy = "Jacobi geodesic/Energy"
        self.refused_by_system("jacobi geodesic", (energy, "-1", "above the potential at Position, which is -1"),
                               (energy, "-2", "U < h"), ("Jacobi geodesic/Position", "0, 0", "other than the centre"),
                               ("Jacobi geodesic/Direction", "0, 0", "a direction, got zero"),
                               ("Jacobi geodesic/Attraction", "-1", "> 0"),
                               ("Jacobi geodesic/Potential", "morse", "one of harmonic, kepler, torus, double pendulum"))
        for potential, least in (("torus", 4), ("double pendulum", -7)):
            self.refused_entries({energy: least}, f"{energy}: ", f"which is {least}",
                                 base={**self.small_scene("jacobi geodesic"), "Jacobi geodesic/Potential": potential,
                                       "Jacobi geodesic/Position": "0, 0"})
        self.refused_entries({"Jacobi geodesic/Tube radius": 3}, "Jacobi geodesic/Tube radius: ", "thinner",
                             base={**self.small_scene("jacobi geodesic"), "Jacobi geodesic/Potential": "torus"})

    def test_unknown_system(self):
        self.refused_by_system("torus", ("Time/Method", "rk4", "explicit-8"), ("Analysis", "modes", "offered for the ball"))
        for system in ("pendulum", "", "ball, torus", "Torus"):
            self.scene({"System": system, "Time/End": 1})
            self.refused("run", "scene.prm", fragments=("scene.prm:1: System: expected one of ball, mass points", system))

    def test_entries_of_the_ball_and_of_other_systems(self):
        for system in ("mass points", "rigid body", "geodesic"):
            self.refused_by_system(
                system, *((path, value, "belongs to System = ", f"of this scene is {system}") for path, value in (
                    ("Body/Radius", "1"), ("Models", "reduced"), ("Initial state/Velocity", "0, 0, 0; 0, 0, 0; 0, 0, 0"),
                    ("Continuum/Degree", "3"), ("Output/Graphics", "vtu"), ("Output/Quantities", "state"),
                    ("Torus/Damping", "1"))))

    def test_sizes_out_of_range_of_systems(self):
        """Units of the scene that leave the range of numbers: nothing that a run could begin with."""
        for system, path, value in (
                ("mass points", "Mass points/Masses", "1e300, 1e300"), ("mass points", "Mass points/Masses", "1e-320, 1"),
                ("mass points", "Mass points/Positions", "1e200, 0, 0; 0, 0, 0"),
                ("mass points", "Mass points/Positions", "1e-200, 0, 0; 0, 0, 0"),
                ("double pendulum", "Double pendulum/First length", "1e200"),
                ("double pendulum", "Double pendulum/Rates", "1e200, 0"),
                ("rigid body", "Rigid body/Angular velocity", "1e200, 0, 0"),
                ("moving frame", "Moving frame/Spin rate", "1e200")):
            self.refused_by_system(system, (path, value))


if __name__ == "__main__":
    unittest.main()
