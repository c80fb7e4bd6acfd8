#!/usr/bin/python3
"""Every method has its declared order on every system that it accepts, through the program itself: all columns of a run
against those of a run by another method at its round-off, over falling steps. A method that refuses says so in one
sentence and with exit code 2."""
import math

from program_test import DONE, STOPPED, ProgramTest, Table, largest_difference, main, methods, overrides

N_SAMPLES = 4
FLOOR = 5e-13  # errors below have round-off in them

BALL = {"Models": "reduced", "Initial state/Deformation": "1.25, 0, 0; 0, 0.8, 0; 0, 0, 1",
        "Initial state/Velocity": "0, 0.5, 0.2; -0.3, 0, 0.1; 0, 0.4, 0"}
PENDULUM = {"System": "double pendulum", "Double pendulum/Gravity": 1, "Double pendulum/Angles": "1.1, -0.4",
            "Double pendulum/Second mass": 0.6, "Double pendulum/Rates": "0.2, 0.5"}
POINTS = {"System": "mass points", "Mass points/Masses": "1, 0.7, 0.4", "Mass points/Springs": "1, 2, 2, 1; 2, 3, 1, 1",
          "Mass points/Positions": "1, 0, 0; -0.5, 0.8, 0.1; -0.5, -0.9, 0.2", "Mass points/Confinement": 1,
          "Mass points/Gravitational constant": 0.1, "Mass points/Velocities": "0, 0.5, 0.1; -0.45, -0.25, 0; 0.45, -0.3, 0"}
TOP = {"System": "rigid body", "Rigid body/Inertia": "1, 0.1, 0; 0.1, 1.4, 0; 0, 0, 0.9", "Rigid body/Center": "0, 0, 0.4",
       "Rigid body/Gravity": "0.3, 0, -1", "Rigid body/Angular velocity": "0.3, 0.4, 1"}
FREE = {**TOP, "Rigid body/Fixed point": "false", "Rigid body/Center": "0, 0, 0",
        "Rigid body/Springs": "0.5, 0, 0, 1, 0, 1, 1, 0.3", "Rigid body/Velocity": "0.1, 0, 0.2"}
FRAME = {"System": "moving frame", "Moving frame/Spin rate": 0.6, "Moving frame/Spin axis": "0.2, 0.1, 1",
         "Moving frame/Precession": "0.2, 0, 0", "Moving frame/Stiffness": 1, "Moving frame/Velocity": "0, 0.3, 0.2",
         "Moving frame/Origin acceleration": "0.05, 0, 0"}
TORUS = {"System": "torus", "Torus/Damping": 0.1, "Torus/Rates": "0.5, 0.2"}
GEODESIC = {"System": "geodesic", "Geodesic/Surface": "ellipsoid", "Geodesic/Semi-axes": "1, 1.3, 0.7",
            "Geodesic/Velocity": "0.4, 0.9"}
JACOBI = {"System": "jacobi geodesic", "Jacobi geodesic/Position": "0.6, 0"}

# Methods that a system of each kind is known to accept; others are measured as well if it accepts them.
BODY = methods()
DISSIPATIVE = ("rattle", "gauss-16", "explicit-8")
FIELD = ("gauss-16", "explicit-8")


def largest_asymptotic(order):
    """Errors above are not asymptotic."""
    return 1e-3 if order <= 2 else 1e-5 if order <= 4 else 1e-6 if order <= 8 else 1e-8


def fitted_slope(sizes, errors):
    """Of ln(error) over ln(size) by least squares."""
    x, y = [math.log(s) for s in sizes], [math.log(e) for e in errors]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


class DeclaredOrders(ProgramTest):
    END = 6

    def run_method(self, entries, **time):
        """The table of a run and its counters; nothing if the run could not go on."""
        entries = {**entries, "Time/End": self.END, "Output/Samples": N_SAMPLES,
                   **{f"Time/{key.capitalize()}": value for key, value in time.items()}}
        result = self.run_program("run", self.scene({}), "--quiet", *overrides(entries))
        if result.returncode != DONE:
            self.assertEqual(result.returncode, STOPPED, result.stderr)
            return None, None
        models = self.json("output", "scene", "manifest.json")["models"]
        (model,) = models
        return Table(self.scratch / "output" / "scene" / f"{model}.csv"), models[model]["counters"]

    def declared_order(self, entries, method):
        _, counters = self.run_method(entries, method=method, tolerance=1e-4, step=self.END / 400)
        return counters["order"]

    def order_by_steps(self, entries, method, order, reference):
        """From errors in the asymptotic range. Multistep methods need steps beyond those that start them."""
        n_steps, found = max(4, order), []
        while len(found) < 3:
            n_steps = math.ceil((1.3 if order < 8 else 1.15) * n_steps)  # in each interval between samples
            table, _ = self.run_method(entries, method=method, step=self.END / N_SAMPLES / n_steps * 1.000001)
            error = largest_difference(table, reference) if table else math.inf
            self.assertGreater(error, FLOOR, f"{method} meets round-off before it shows an order, {found}")
            if error < largest_asymptotic(order):
                found.append((1 / n_steps, error))
            self.assertLess(n_steps, 20000, f"{method} has no errors in the asymptotic range")
        return fitted_slope(*zip(*found))

    def order_by_tolerances(self, entries, method, reference):
        """The tolerance makes the steps: error over the number of forces."""
        found = []
        for k in range(2, 13):
            table, counters = self.run_method(entries, method=method, tolerance=10.0 ** -k)
            error = largest_difference(table, reference)
            if 10 * FLOOR < error < 1e-4 and (not found or counters["forces"] > found[-1][0]):
                found.append((counters["forces"], error))
        self.assertGreaterEqual(len(found), 3, f"{method}: {found}")
        return -fitted_slope(*zip(*found))

    def check(self, entries, known):
        """Of every method that the system accepts, at least of those that it is known to accept. Each method's reference is a run by another one at the edge of round-off; where there is none of high order,
        a run by the method itself."""
        by_explicit, _ = self.run_method(entries, method="explicit-8", tolerance=1e-13)
        by_rattle = by_explicit
        if "rattle-8" in known:
            by_rattle, _ = self.run_method(entries, method="rattle-8", step=0.01)
        for method in methods():
            with self.subTest(method=method):
                checked = self.run_program("check", self.scene({}), *overrides({**entries, "Time/Method": method}))
                if method not in known and checked.returncode != DONE:
                    self.assert_one_sentence(checked, "Time/Method", method.split("-")[0])
                    continue
                order = self.declared_order(entries, method)
                if method == "gauss-16":
                    # Between its coarsest step and round-off there is no room for a slope; the suites of C++ fit one.
                    table, _ = self.run_method(entries, method=method, step=self.END / 200)
                    self.assertLess(largest_difference(table, by_explicit), 1e-10)
                elif method == "explicit-8":
                    self.assertGreater(self.order_by_tolerances(entries, method, by_rattle), order - 0.5)
                else:
                    self.assertGreater(self.order_by_steps(entries, method, order, by_explicit), order - 0.25)

    def test_sl3(self):
        self.check(BALL, BODY)

    def test_gl3(self):
        self.check({**BALL, "Body/Incompressible": "false"}, BODY)

    def test_mass_points(self):
        self.check(POINTS, BODY)

    def test_mass_points_with_drag(self):
        self.check({**POINTS, "Mass points/Drag": 0.2, "Mass points/Dashpots": "1, 3, 0.3",
                    "Mass points/Gravitational constant": 0}, DISSIPATIVE)

    def test_double_pendulum(self):
        self.check(PENDULUM, BODY)

    def test_double_pendulum_in_angles(self):
        self.check({**PENDULUM, "Double pendulum/Form": "lagrange"}, FIELD)

    def test_heavy_top(self):
        self.check(TOP, BODY)

    def test_heavy_top_by_eulers_equation(self):
        self.check({**TOP, "Rigid body/Form": "euler"}, FIELD)

    def test_heavy_top_in_euler_angles(self):
        self.check({**TOP, "Rigid body/Form": "lagrange", "Rigid body/Rotation": "1, 0, 0; 0, 0.6, -0.8; 0, 0.8, 0.6"}, FIELD)

    def test_free_body(self):
        self.check(FREE, BODY)

    def test_moving_frame(self):
        self.check(FRAME, FIELD)

    def test_inertial_frame(self):
        self.check({**FRAME, "Moving frame/Form": "inertial"}, FIELD)

    def test_torus(self):
        self.check(TORUS, FIELD)

    def test_geodesic(self):
        self.check(GEODESIC, FIELD)

    def test_jacobi_geodesic(self):
        self.check(JACOBI, FIELD)


if __name__ == "__main__":
    main()
