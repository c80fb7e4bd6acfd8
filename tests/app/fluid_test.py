"""A fluid in the continuum: Dirichlet's theorem, that it stays an ellipsoid, seen by finite elements; and how a run ends when
the mesh can no longer follow."""
import math

from program_test import SOURCE, STOPPED, ProgramTest, main, overrides


class Fluid(ProgramTest):
    def run_models(self, name, entries):
        self.run_done("run", "scene.prm", "--output", name, "--quiet", *overrides(entries))
        return [self.table(name, f"{model}.csv") for model in ("reduced", "continuum")]

    def difference(self, tables, columns):
        reduced, continuum = tables
        return max(abs(a - b) for column in columns for a, b in zip(reduced.column(column), continuum.column(column)))

    def dirichlet(self, stretch, name, entries=()):
        """Released from rest with one axis of this length."""
        self.scene((SOURCE / "params/dirichlet.prm").read_text())
        narrow = stretch**-0.5
        start = f"{narrow!r}, 0, 0; 0, {narrow!r}, 0; 0, 0, {stretch!r}"
        return self.run_models(name, {"Initial state/Deformation": start, "Continuum/Error estimate": "none", **dict(entries)})

    def test_ellipsoids_pulsate_as_the_theorem_says(self):
        # Measured: 5e-7, 8e-6, 7e-5. The mesh's error grows with the amplitude.
        for stretch, bound in (1.1, 2e-5), (1.3, 1e-4), (1.5, 1e-4):
            tables = self.dirichlet(stretch, f"from {stretch}")
            self.assertLess(self.difference(tables, ["Q33"]), bound)
            self.assertLess(max(tables[1].column("nonaffine_displacement")), 0.02)
            energy, volumetric = tables[1].column("energy"), tables[1].column("volumetric")
            self.assertLess(max(abs(e - energy[0]) for e in energy), 1e-5 * abs(energy[0]))
            self.assertEqual(tables[1].column("elastic"), volumetric)  # a fluid stores nothing else
            self.assertLess(max(volumetric), 1e-5 * abs(energy[0]))

    def test_finer_elements_err_less(self):
        coarse, fine = (self.difference(self.dirichlet(1.3, f"degree {k}", {"Continuum/Degree": k, "Time/End": 4}), ["Q33"])
                        for k in (3, 5))
        self.assertLess(fine, coarse / 20)

    def test_jacobi_ellipsoid_keeps_its_axes(self):
        self.scene({"Material/Law": "none", "Gravity/Constant": 1, "Initial state/Equilibrium": "jacobi",
                    "Initial state/Equilibrium parameter": 0.8, "Time/End": 6 / math.sqrt(math.pi),
                    "Continuum/Error estimate": "none"})
        tables = self.run_models("jacobi", {})
        self.assertLess(self.difference(tables, ["a1", "a2", "a3"]), 1e-4)
        self.assertAlmostEqual(tables[1].column("a2")[-1] / tables[1].column("a1")[-1], 0.8, delta=1e-4)
        self.assertEqual(self.json("jacobi/manifest.json")["models"]["continuum"]["counters"]["images"], 2)

    def test_fluid_in_a_trap(self):
        """Without gravity, held by a quadratic potential. Its whole pressure is the multiplier's, and errors grow faster."""
        self.scene({"Material/Law": "none", "Loads/Tidal matrix": "3, 0, 0; 0, 3, 0; 0, 0, 3", "Time/End": 2,
                    "Initial state/Deformation": "0.95, 0, 0; 0, 0.95, 0; 0, 0, 1.1080332409972299"})
        tables = self.run_models("trap", {})
        self.assertLess(self.difference(tables, ["Q33"]), 1e-4)

    def test_tension_is_said_of_both_models(self):
        """A fluid sphere that spins fast is pulled apart: lambda < 0 from the start (PHYSICS.md 2, 13)."""
        self.scene({"Material/Law": "none", "Gravity/Constant": 0.1, "Time/End": 0.05, "Output/Samples": 5,
                    "Initial state/Velocity": "0, -3, 0; 3, 0, 0; 0, 0, 0", "Continuum/Degree": 2,
                    "Continuum/Error estimate": "none"})
        result = self.run_done("run", "scene.prm", "--output", "tension")
        for model in "reduced", "continuum":
            self.assertIn(f"{model}: tension at t = 0", result.stdout + result.stderr)
            self.assertIn("first_tension_time", self.json("tension/manifest.json")["models"][model]["counters"])

    def test_a_tangled_mesh_is_said(self):
        """With too few points for gravity the shortest waves grow."""
        self.scene((SOURCE / "params/dirichlet.prm").read_text())
        result = self.run_program("run", "scene.prm", "--output", "tangled", *overrides(
            {"Continuum/Gravity points": 5, "Continuum/Error estimate": "none", "Time/Step": 0.0125}))
        self.assertEqual(result.returncode, STOPPED)
        self.assertIn("the mesh of the fluid has tangled", result.stderr)
        self.assertRegex(result.stderr + result.stdout, r"the non-affine displacement is 1\.\d* % of the size of the body")
        counters = self.json("tangled/manifest.json")["models"]["continuum"]["counters"]
        self.assertGreater(counters["nonaffine_displacement_at_most"], 0.01)


if __name__ == "__main__":
    main()
