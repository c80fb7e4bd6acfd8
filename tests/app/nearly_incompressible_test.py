#!/usr/bin/python3
"""Nearly incompressible bodies: a projected bulk term in both models with non-affine motions."""
import unittest

import meshio

from program_test import ProgramTest, main
from refused_input import RefusedInputTest

RELEASE = {"Body/Incompressible": "false", "Material/Lame lambda": 1e5, "Material/Bulk": "projected", "Continuum/Degree": 3,
           "Continuum/Error estimate": "none", "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6", "Time/End": 1,
           "Output/Samples": 10, "Time/Tolerance": 1e-4}


class NearlyIncompressible(ProgramTest):
    def run_of(self, name, entries):
        self.scene({**RELEASE, **entries})
        self.run_done("run", "scene.prm", "--output", name)
        return self.json(name, "manifest.json")["models"]

    def test_is_between_the_pointwise_law_and_the_incompressible_body(self):
        """At lambda = 1e5 mu the pointwise form takes far more steps, and the motion is incompressible to 1e-4."""
        models = "reduced, polynomial, continuum"
        projected = self.run_of("projected", {"Models": models, "Polynomial/Degree": "1, 3"})
        pointwise = self.run_of("pointwise", {"Models": models, "Polynomial/Degree": "1, 3", "Material/Bulk": "pointwise"})
        self.run_of("incompressible", {"Models": models, "Polynomial/Degree": "1, 3", "Body/Incompressible": "true", "Material/Bulk": "pointwise"})
        for model in "polynomial", "continuum":
            self.assertIn(projected[model]["method"], ("rattle", "symmetric-4"))
            self.assertLess(10 * projected[model]["counters"]["forces"], pointwise[model]["counters"]["forces"])
            self.assertNotIn("max_scaled_constraint", projected[model]["counters"])
        def distance(a, b, model):
            tables = (self.table(name, f"{model}.csv").column("Q33") for name in (a, b))
            return max(abs(x - y) for x, y in zip(*tables))

        for model in "polynomial-1", "polynomial", "continuum":
            self.assertLess(distance("projected", "incompressible", model), 3e-4)
        # A body of degree 1 has a uniform det F, so both forms are the same. Bodies of degree 3 lock, and elements hardly do.
        self.assertLess(distance("projected", "pointwise", "polynomial-1"), 3e-4)
        self.assertGreater(distance("projected", "pointwise", "polynomial"), 0.05)
        self.assertLess(distance("projected", "pointwise", "continuum"), 2e-3)
        energy = self.table("projected", "continuum.csv").column("energy")
        self.assertLess(max(abs(e - energy[0]) for e in energy), 1e-3 * energy[0])

    def test_the_error_contains_the_unresolved_oscillation(self):
        """A start that changes the volume by 1 % makes the volume oscillate. The steps do not resolve this."""
        dilated = 1.01 ** (1 / 3)
        self.scene({**RELEASE, "Models": "polynomial", "Polynomial/Degree": 3,
                    "Initial state/Deformation": f"{dilated}, 0, 0; 0, {dilated}, 0; 0, 0, {dilated}"})
        result = self.run_done("run", "scene.prm", "--output", "dilated")
        self.assertIn("Material/Bulk", result.stderr)
        error = self.json("dilated", "manifest.json")["models"]["polynomial"]["counters"]["estimated_time_error"]
        self.assertTrue(0.006 < error < 0.02, error)
        self.assertIn("implicit in time", self.run_done("check", "scene.prm").stdout)

    def test_resumes(self):
        for method in "rattle", "symmetric-4":
            entries = {"Models": "polynomial, continuum", "Loads/Pressure": 0.2, "Time/Step": 0.01, "Time/Method": method,
                       **({"Material/Viscosity": 0.01} if method == "rattle" else {})}
            self.run_of(f"whole-{method}", entries)
            self.run_of(f"part-{method}", {**entries, "Time/End": 0.5, "Output/Samples": 5})
            self.scene({**RELEASE, **entries})
            self.run_done("run", "scene.prm", "--output", f"part-{method}", "--resume")
            for model in "polynomial", "continuum":
                self.assertEqual(self.table(f"part-{method}", f"{model}.csv").rows,
                                 self.table(f"whole-{method}", f"{model}.csv").rows, (model, method))

    def test_draws_the_pressure_of_the_incompressible_body(self):
        """The pressure of the slow motion, without the fast oscillation of the volume."""
        largest = {}
        for name, entries in (("projected", {}), ("incompressible", {"Body/Incompressible": "true", "Material/Bulk": "pointwise"})):
            self.run_of(name, {"Models": "continuum", "Output/Graphics": "vtu", "Output/Frames": 2, **entries})
            picture = meshio.read(sorted((self.scratch / name).rglob("*.vtu"))[-1])
            largest[name] = abs(picture.point_data["cauchy_stress"][:, [0, 4, 8]].sum(axis=1)).max()
        self.assertGreater(largest["incompressible"], 0.1)
        self.assertAlmostEqual(largest["projected"] / largest["incompressible"], 1, delta=0.02)


class RefusedBulk(RefusedInputTest):
    def test_refused(self):
        for entries, words in (
                ({"Body/Incompressible": "true"}, ("Material/Bulk", "incompressible")),
                ({"Material/Law": "saint-venant-kirchhoff"}, ("Material/Bulk", "law")),
                ({"Time/Method": "energy-momentum"}, ("Material/Bulk", "rattle")),
                ({"Time/Method": "rattle-4"}, ("Material/Bulk", "rattle")),
                ({"Loads/Plane normals": "0, 0, 1", "Loads/Plane points": "0, 0, -2", "Loads/Plane stiffness": 100}, ("Material/Bulk", "contact")),
                ({"Material/Lame lambda": 99}, ("Material/Bulk", "lambda")),
                ({"Continuum/Degree": 1}, ("Material/Bulk", "degree"))):
            with self.subTest(entries):
                self.refused_entries({**RELEASE, "Models": "continuum", **entries}, *words)


if __name__ == "__main__":
    main()
