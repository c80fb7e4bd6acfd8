"""Every scene of params/ runs, and its pictures are read by meshio and VTK; what the comparison says; scaling."""
import json
import math
import re
import subprocess
import sys
import unittest

from program_test import BODY_COLUMNS, CONTINUUM_COLUMNS, ProgramTest, SOURCE, largest_difference, overrides

FRAMES = 3
SAMPLES = 24
PICTURE = {"displacement": [3], "displacement_without_rotation": [3], "reference_coordinates": [3], "velocity": [3],
           "cauchy_stress": [9], "pressure": [1], "von_mises": [1], "deformation_gradient": [9], "jacobian": [1],
           "principal_stretches": [3], "energy_density": [1]}


class Scenes(ProgramTest):
    def shortened(self, name):
        """Options that make a scene short."""
        self.scene((SOURCE / "params" / f"{name}.prm").read_text(), f"{name}.prm")
        end = float(re.search(r"set End\s*=\s*(\S+)", (self.scratch / f"{name}.prm").read_text())[1])
        return overrides({"Time/End": min(end, 2), "Output/Samples": SAMPLES, "Output/Graphics": "vtu",
                          "Output/Frames": FRAMES})

    def check_scene(self, name, models, gravitates=False):
        self.run_done("run", f"{name}.prm", *self.shortened(name))
        folder = self.scratch / "output" / name
        manifest = self.json(folder / "manifest.json")
        discretization = [manifest["entries"][f"Continuum/{name}"] for name in ("Degree", "Refinements")]
        if "auto" in discretization:
            found = manifest["models"]["continuum"]["counters"]
            discretization = found["degree"], found["refinements"]
        is_stabilized = gravitates or manifest["entries"]["Continuum/Volumetric stiffness"] not in ("auto", "0")
        for model, columns in (("reduced", BODY_COLUMNS), ("continuum", CONTINUUM_COLUMNS + ["volumetric"] * is_stabilized)):
            self.assertEqual((folder / f"{model}.csv").exists(), model in models)
            if model not in models:
                continue
            table = self.table(folder / f"{model}.csv")
            self.assertEqual(table.header, columns)
            self.assertEqual(len(table), SAMPLES + 1)
            self.assertTrue(table.is_finite())
            end = table.column("time")[-1]
            expected = [(end * sample / SAMPLES, f"graphics/{model}-{j:06}.vtu")
                        for j, sample in enumerate((0, SAMPLES // 2, SAMPLES))]
            self.assertEqual(self.pvd(folder / f"{model}.pvd"), expected)
            fields = PICTURE | ({"gravity_potential": [1]} if gravitates and model == "continuum" else {})
            self.check_pictures(folder, [file for _, file in expected], self.expected_grid(model, *map(int, discretization)),
                                fields)
        self.assertEqual(len(list((folder / "graphics").iterdir())), FRAMES * len(models))
        self.assertEqual((folder / "comparison.json").exists(), len(models) == 2)
        self.assertEqual(sorted(manifest["models"]), sorted(models))
        if "continuum" in models:
            self.assertIn("deal.II", manifest["libraries"])
        log = (folder / "log.txt").read_text()
        self.assertIn("Needed:\n", log)
        self.assertIn("Skipped:\n", log)

    @staticmethod
    def expected_grid(model, k, refinements):
        """Points, cells and VTK's cell type. The whole ball has 8·4 coarse cells, each node and sub-cell of its own; the
        ellipsoid is a cube of 8³ sub-cells and around it 4 layers of the 8² on each of its sides."""
        if model == "reduced":
            return 9**3 + 4 * (6 * 8**2 + 2), 8**3 + 4 * 6 * 8**2, 12
        n_cells = 8 * 4 * 8**refinements
        return n_cells * (k + 1) ** 3, n_cells * k**3, 12

    def check_pictures(self, folder, files, grid, fields=PICTURE):
        reader = SOURCE / "tests/support/check_vtu.py"
        result = subprocess.run([sys.executable, reader, "--expect-fields", ",".join(fields), *files],
                                cwd=folder, capture_output=True, text=True, timeout=100)
        self.assertEqual(result.returncode, 0, result.stderr)
        read = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual(len(read), len(files))
        for picture in read:
            self.assertEqual((picture["points"], picture["cells"], *picture["cell_types"]), grid, picture["file"])
            self.assertEqual(picture["fields"], fields)
            low, high = picture["bounds"]
            for a, b in zip(low, high):  # the whole body, seen from its centre
                self.assertAlmostEqual(a, -b, delta=1e-9 * b)

    def test_quickstart(self):
        self.check_scene("quickstart", ["reduced", "continuum"])

    def test_gravitating_ball(self):
        self.check_scene("gravitating_ball", ["reduced", "continuum"], gravitates=True)

    def test_dirichlet(self):
        """Until t = 2; the whole of it in fluid_test.py."""
        self.check_scene("dirichlet", ["reduced", "continuum"], gravitates=True)

    def test_spinning_elastic_spheroid(self):
        self.check_scene("spinning_elastic_spheroid", ["reduced", "continuum"], gravitates=True)
        reduced, continuum = (self.table(f"output/spinning_elastic_spheroid/{model}.csv") for model in ("reduced", "continuum"))
        for axis in "a1", "a2", "a3":  # steady for the one, nearly so for the other
            self.assertAlmostEqual(reduced.column(axis)[-1], reduced.column(axis)[0], delta=1e-6)
            self.assertAlmostEqual(continuum.column(axis)[-1], continuum.column(axis)[0], delta=0.05)
        self.assertAlmostEqual(reduced.column("a3")[0] / reduced.column("a1")[0], 0.8, delta=1e-8)
        self.assertAlmostEqual(continuum.column("J3")[-1] / reduced.column("J3")[0], 1, delta=1e-6)

    def test_tidal_passage(self):
        self.check_scene("tidal_passage", ["reduced", "continuum"], gravitates=True)

    def test_lamb(self):
        self.check_scene("lamb", ["reduced", "continuum"])

    def test_compressible(self):
        self.check_scene("compressible", ["reduced", "continuum"])

    def test_damped(self):
        self.check_scene("damped", ["reduced", "continuum"])

    def test_traction(self):
        self.check_scene("traction", ["reduced", "continuum"])

    def test_auto_degree(self):
        self.check_scene("auto_degree", ["reduced", "continuum"])

    def test_rough_ball(self):
        """A mesh from a file, found beside the parameter file; one and two ranks are compared in ranks_test.py."""
        self.run_done("run", SOURCE / "params/rough_ball.prm", "--output", "rough",
                      *overrides({"Time/End": 0.5, "Output/Samples": 10, "Time/Method": "rattle"}))
        table = self.table("rough/continuum.csv")
        self.assertTrue(table.is_finite())
        self.assertEqual(len(table), 11)
        counters = self.json("rough/manifest.json")["models"]["continuum"]["counters"]
        self.assertEqual((counters["cells"], counters["images"]), (256, 1))
        for name in "J1", "J2", "J3":  # no load has a torque, and RATTLE keeps what is left to round-off
            column = table.column(name)
            self.assertLess(max(abs(x - column[0]) for x in column), 1e-11)
        # Both bodies start with the same motion. The inertia of the reduced one is that of the mesh by exact integrals, that
        # of the elements is lumped: at degree 2 they differ by 1e-4.
        reduced = self.table("rough/reduced.csv")
        self.assertAlmostEqual(table.column("J3")[0], reduced.column("J3")[0], delta=3e-4)
        self.assertAlmostEqual(table.column("kinetic")[0], reduced.column("kinetic")[0], delta=3e-4)

    def test_spin_and_stretch(self):
        self.check_scene("spin_and_stretch", ["reduced", "continuum"])

    def test_reduced_only(self):
        self.check_scene("reduced_only", ["reduced"])

    def test_compressible_reduced(self):
        self.check_scene("compressible_reduced", ["reduced"])

    def test_ladder(self):
        """PHYSICS.md 10: of degree 1 the frequency is 18.6 % too high, of degree 3 0.29 %; here half the time, k = 4."""
        self.scene((SOURCE / "params/ladder.prm").read_text(), "ladder.prm")
        result = self.run_done("run", "ladder.prm", *overrides({"Time/End": 20, "Output/Samples": 200,
                                                                "Continuum/Error estimate": "none"}))
        models = self.json("output/ladder/comparison.json")["models"]
        self.assertEqual(list(models), ["polynomial-1", "polynomial-3", "polynomial-5", "polynomial"])
        self.assertAlmostEqual(models["polynomial-1"]["ratio"], 1.1863, delta=5e-3)
        self.assertAlmostEqual(models["polynomial-3"]["ratio"], 1.0029, delta=2e-3)
        self.assertAlmostEqual(models["polynomial"]["ratio"], 1, delta=5e-4)
        self.assertIn("polynomial-3", result.stdout)
        self.assertIn("polynomial-3", (self.scratch / "output/ladder/report.html").read_text())

    def test_love_numbers(self):
        """The moon of ice; with elements of degree 3 for 8, and one polynomial body that has Kelvin's solution."""
        self.scene((SOURCE / "params/love_numbers.prm").read_text(), "love_numbers.prm")
        self.run_done("run", "love_numbers.prm", *overrides({"Polynomial/Degree": 3, "Continuum/Degree": 3}))
        h = {name: self.table(f"output/love_numbers/love-{name}.csv").column("h")[0]
             for name in ("reduced", "polynomial", "continuum")}
        gamma = 4 * math.pi / 3 * 6.6743e-11 * 1500**2 * 2.5e5**2 / 4e9
        exact = 2.5 / (1 + 9.5 / gamma)
        self.assertAlmostEqual(h["reduced"], 2.5 / (1 + 12.5 / gamma), delta=1e-14)
        self.assertAlmostEqual(h["polynomial"] / exact, 1, delta=1e-12)
        self.assertAlmostEqual(h["continuum"] / exact, 1, delta=1e-3)

    def test_modes(self):
        """PHYSICS.md 3, in other units: radius 2, density 3 and shear modulus 0.75 have c/r = 1/4."""
        self.scene((SOURCE / "params/modes.prm").read_text(), "modes.prm")
        result = self.run_done("run", "modes.prm", *overrides({
            "Body/Radius": 2, "Body/Density": 3, "Material/Shear modulus": 0.75, "Continuum/Degree": 3, "Modes/Number": 5,
            "Output/Frames": 3}))
        folder = self.scratch / "output/modes"
        table = self.table(folder / "modes.csv")
        self.assertEqual(table.header, ["index", "omega", "kind", "degree", "overtone", "multiplicity", "spread", "exact",
                                        "reduced"])
        self.assertEqual(table.column("index"), [1, 2, 3, 4, 5])
        self.assertEqual(list(zip(*(table.column(name) for name in ("kind", "degree", "overtone", "multiplicity")))),
                         [(2, 2, 0, 5), (1, 2, 0, 5), (2, 3, 0, 7), (1, 1, 0, 3), (1, 3, 0, 7)])
        exact = [4 * omega for omega in table.column("exact")]
        for x, known in zip((exact[0], exact[1], exact[3], exact[4]),
                            (2.501132620409, 2.665622189236, 3.870238580222, 4.001936825190)):
            self.assertAlmostEqual(x, known, delta=1e-11)
        for omega, spread, x in zip(table.column("omega"), table.column("spread"), exact):
            self.assertAlmostEqual(4 * omega, x, delta=4e-3)
            self.assertLess(spread, 1e-3)
        reduced = table.column("reduced")
        self.assertAlmostEqual(4 * reduced[1], 10**0.5, delta=1e-14)
        self.assertEqual(reduced[:1] + reduced[2:], [0, 0, 0, 0])
        files = [f"graphics/modes-{j:06}.vtu" for j in range(3)]
        self.assertEqual(self.pvd(folder / "modes.pvd"), list(zip((1, 2, 3), files)))
        self.check_pictures(folder, files, self.expected_grid("continuum", 3, 0),
                            {"displacement": [3]})
        self.assertFalse((folder / "continuum.csv").exists() or (folder / "reduced.csv").exists())
        log = (folder / "log.txt").read_text()
        self.assertIn("S2", log)
        self.assertIn("the 5 lowest frequencies", log)

    def run_at_low_degrees(self, name, entries):
        """The scene, short and on a coarse mesh: the tables of its models."""
        self.scene((SOURCE / "params" / f"{name}.prm").read_text(), f"{name}.prm")
        self.run_done("run", f"{name}.prm", *overrides({"Continuum/Degree": 2, "Output/Samples": SAMPLES,
                                                        "Output/Graphics": "none", **entries}))
        models = self.json(f"output/{name}/manifest.json")["models"]
        return {model: self.table(f"output/{name}/{model}.csv") for model in models}

    def test_bounce(self):
        """The ball reaches the floor at t = 2 and leaves it."""
        tables = self.run_at_low_degrees("bounce", {"Time/End": 6, "Polynomial/Degree": 2})
        self.assertEqual(sorted(tables), ["continuum", "polynomial", "reduced"])
        for model, table in tables.items():
            self.assertAlmostEqual(table.column("first_contact")[-1], 2, delta=1e-2, msg=model)
            self.assertGreater(max(table.column("penetration")), 0, model)
            self.assertGreater(max(table.column("restitution")), 0.3, model)  # above 1 if the last height differs from the first
            energy = table.column("energy")
            self.assertLess(max(energy) - min(energy), 0.01 * max(table.column("kinetic")), model)

    def test_hertz(self):
        """On a coarse mesh, so that the numbers are those of the comments of the scene only in size."""
        tables = self.run_at_low_degrees("hertz", {"Time/End": 1, "Continuum/Degree": 3, "Continuum/Grading": 1})
        self.assertTrue(0.3 < tables["continuum"].column("contact_force")[-1] / 0.0151 < 3)

    def test_every_scene_has_a_test(self):
        # Those of other systems have theirs in systems_test.py, others of a single model in the tests of that.
        elsewhere = "".join((SOURCE / "tests/app" / name).read_text()
                            for name in ("pseudo_rigid_test.py", "polynomial_run_test.py", "table_sweeps_test.py", "companions_test.py", "continuum_equilibria_test.py",
                                         "viscoelastic_test.py"))
        names = sorted(path.stem for path in (SOURCE / "params").glob("*.prm") if "set System" not in path.read_text()
                       and f"def test_{path.stem}(" not in elsewhere)
        tests = sorted(name[len("test_"):] for name in dir(self) if (SOURCE / f"params/{name[len('test_'):]}.prm").exists())
        self.assertEqual(names, tests)

    def test_a_refined_half_ball_with_one_picture(self):
        self.scene({"Models": "continuum", "Continuum/Degree": 2, "Continuum/Refinements": 1, "Continuum/Symmetry": "z",
                    "Time/End": 0.02, "Time/Step": 0.01, "Time/Method": "rattle", "Output/Samples": 2,
                    "Initial state/Velocity": "0, -0.5, 0; 0.5, 0, 0; 0, 0, 0", "Output/Graphics": "vtu",
                    "Output/Frames": 1, "Body/Radius": 1})
        self.run_done("run", "scene.prm")
        folder = self.scratch / "output/scene"
        self.assertEqual(self.pvd(folder / "continuum.pvd"), [(0.02, "graphics/continuum-000000.vtu")])
        grid = self.expected_grid("continuum", 2, 1)
        self.assertEqual(grid, (32 * 8 * 27, 32 * 8 * 8, 12))
        self.check_pictures(folder, ["graphics/continuum-000000.vtu"], grid)
        self.assertIn("half (plane z)", (folder / "log.txt").read_text())

    def test_frequency_ratio_of_lamb(self):
        """PHYSICS.md 3: sqrt(10)/2.665622 = 1.18632; here on the coarse side, k = 3 and half the time."""
        self.scene((SOURCE / "params/lamb.prm").read_text(), "lamb.prm")
        result = self.run_done("run", "lamb.prm", *overrides({"Time/End": 20, "Output/Samples": 400, "Continuum/Degree": 3}))
        comparison = self.json("output/lamb/comparison.json")
        ratio = comparison["frequency"]["ratio"]
        print(f"ratio {ratio:.6f} ± {comparison['frequency']['ratio_uncertainty']:.1e}")
        self.assertAlmostEqual(ratio, 1.18632, delta=1e-3)
        self.assertAlmostEqual(comparison["frequency"]["reduced"]["omega"], 10**0.5, delta=1e-4)
        self.assertAlmostEqual(comparison["frequency"]["continuum"]["omega"], 2.665622, delta=3e-3)
        table = self.table("output/lamb/comparison.csv")
        self.assertEqual(len(table), 401)
        self.assertTrue(table.is_finite())
        self.assertEqual(table.header[0], "time")
        self.assertEqual(table.header[1:], list(comparison["differences"]))
        self.assertIn(comparison["summary"], result.stdout)
        self.assertIn("18.6 % faster", re.sub(r" \+- [0-9.e-]+ %", " %", result.stdout))
        self.assertLess(abs(ratio - 1.186319), comparison["frequency"]["ratio_uncertainty"])
        log = (self.scratch / "output/lamb/log.txt").read_text()
        self.assertIn(comparison["summary"], log)

    def test_frequencies_of_the_gravitating_ball(self):
        """PHYSICS.md 3 with gamma = 5."""
        self.scene((SOURCE / "params/gravitating_ball.prm").read_text(), "scene.prm")
        result = self.run_done("run", "scene.prm")
        comparison = self.json("output/scene/comparison.json")
        self.assertAlmostEqual(comparison["frequency"]["reduced"]["omega"], 14**0.5, delta=1e-4)
        self.assertAlmostEqual(comparison["frequency"]["continuum"]["omega"], 3.273115, delta=1e-3)
        self.assertIn("14.3 % faster", re.sub(r" \+- [0-9.e-]+ %", " %", result.stdout))

    def test_quiet_says_nothing(self):
        result = self.run_done("run", "quickstart.prm", "--quiet", *self.shortened("quickstart"))
        self.assertEqual((result.stdout, result.stderr), ("", ""))

    def test_a_pipe_gets_lines_only(self):
        result = self.run_done("run", "quickstart.prm", *self.shortened("quickstart"))
        self.assertNotRegex(result.stdout + result.stderr, r"[\r\x1b]")

    def scaled_run(self, name, radius, density, modulus):
        time = radius * (density / modulus) ** 0.5
        self.scene({"Models": "continuum", "Continuum/Degree": 2, "Body/Radius": repr(radius), "Body/Density": repr(density),
                    "Material/Shear modulus": repr(modulus), "Time/End": repr(time), "Output/Samples": 10,
                    "Time/Constraint tolerance": 1e-13,  # what is left of a looser one depends on round-off
                    "Initial state/Deformation": "1.25, 0, 0; 0, 1, 0; 0, 0, 0.8"}, f"{name}.prm")
        self.run_done("run", f"{name}.prm")
        table = self.table(f"output/{name}/continuum.csv")
        energy = density * radius**5 / time**2
        units = {"time": time, "Qdot": 1 / time, "x": radius, "v": radius / time, "J": energy * time, "Z": energy * time,
                 "multiplier": 1 / time**2, "a": radius, "Q": 1, "F": 1, "volume_ratio": 1, "nonaffine_kinetic_fraction": 1,
                 "nonaffine_displacement": 1, "min_jacobian": 1, "volume_error": 1, "max_volume_error": 1}
        scale = [units.get(name.rstrip("123"), energy) for name in table.header]
        table.rows = [[x / s for x, s in zip(row, scale)] for row in table.rows]
        return table

    def test_any_units_give_the_same_motion(self):
        reference = self.scaled_run("reference", 1.0, 1.0, 1.0)
        self.assertEqual(self.scaled_run("powers", 2.0**-10, 2.0**7, 2.0**-3).rows, reference.rows)
        for factors in ((1e12, 1.0, 1.0), (1e-12, 1e12, 1e-12), (6.4e6, 5500.0, 7e10)):
            difference = largest_difference(reference, self.scaled_run("scaled", *factors))
            print(factors, f"{difference:.1e}")
            self.assertLess(difference, 1e-10, factors)


if __name__ == "__main__":
    unittest.main()
