"""What needs(scene) skips leaves the results as they are: every skip is overridden by a scene that asks for the part, and
the two runs are compared. Method and step are given, since their choice looks at the largest frequency, which a full ball
may have where its octant has not. reduced_run_test.py looks at quantities and pictures of the reduced model alone and at
the libraries in its process, continuum/sectors_test.cpp at single steps in the sectors."""

from program_test import SOURCE, ProgramTest, largest_difference, main, overrides

RELEASE = {
    "Initial state/Velocity": "0.3, 0, 0; 0, 0.3, 0; 0, 0, -0.6",
    "Time/End": 1, "Time/Step": 0.01, "Time/Method": "rattle",
    "Continuum/Degree": 3,
    "Output/Samples": 10,
}
NOTHING = 1e-300  # asks for a part of the model and lets it contribute nothing that a double can see
# Sums in another order, and multipliers that iterations leave somewhere within round-off of the constraints: the runs
# differ by 6e-14 at most after 100 steps. An error in a reflected plane or in a load is not smaller than 1e-6.
ROUND_OFF = 1e-11


class Skipping(ProgramTest):
    def run_scene(self, output, entries=()):
        """What `check` says is needed and what is skipped, of the run whose results are in `output`."""
        options = overrides(dict(entries))
        self.run_done("run", "scene.prm", "--quiet", "--output", output, *options)
        described = self.run_done("check", "scene.prm", *options).stdout
        return described.split("Needed:\n")[1].split("Skipped:\n")

    def same_bytes(self, name, a, b):
        self.assertEqual(self.bytes(a, name), self.bytes(b, name), name)

    def close(self, name, a, b):
        difference = largest_difference(self.table(a, name), self.table(b, name))
        self.assertLess(difference, ROUND_OFF, f"{name} of {a} and {b}")

    def test_one_model_without_the_other(self):
        self.scene(RELEASE)
        self.run_scene("both")
        _, skipped = self.run_scene("reduced", {"Models": "reduced"})
        self.assertIn("no mesh, no deal.II, MPI or PETSc", skipped)
        self.same_bytes("reduced.csv", "both", "reduced")
        _, skipped = self.run_scene("continuum", {"Models": "continuum"})
        self.assertIn("reduced model: not among Models", skipped)
        self.assertIn("comparison: only one model runs", skipped)
        self.same_bytes("continuum.csv", "both", "continuum")

    def test_companion_run(self):
        self.scene(RELEASE)
        self.run_scene("with")
        _, skipped = self.run_scene("without", {"Continuum/Error estimate": "none"})
        self.assertIn("no companion run", skipped)
        counters = [self.json(folder, "manifest.json")["models"]["continuum"]["counters"] for folder in ("with", "without")]
        self.assertIn("companion_work", counters[0])
        self.assertNotIn("companion_work", counters[1])
        self.same_bytes("continuum.csv", "with", "without")
        self.same_bytes("reduced.csv", "with", "without")

    def test_pictures_and_quantities(self):
        self.scene(RELEASE)
        self.run_scene("all", {"Output/Graphics": "vtu", "Output/Frames": 3})
        _, skipped = self.run_scene("pictures", {"Output/Quantities": "state"})
        self.assertIn("quantities: energies, momenta, multiplier, axes, nonaffine", skipped)
        self.assertIn("no folder is made", skipped)
        for name in "reduced.csv", "continuum.csv":
            everything, few = self.table("all", name), self.table("pictures", name)
            self.assertLess(len(few.header), len(everything.header))
            for column in few.header:
                # The multiplier of a sample is the first guess of the next step's, so round-off is not the same.
                for a, b in zip(few.column(column), everything.column(column)):
                    self.assertAlmostEqual(a, b, delta=ROUND_OFF, msg=f"{column} of {name}")

    def test_sectors(self):
        """All sectors are reflections of one octant mesh, hence one discretisation: they differ by round-off, where another
        mesh of the same degree would differ by its error, 5e-4 here."""
        self.scene({**RELEASE, "Models": "continuum"})
        needed, _ = self.run_scene("octant")
        self.assertIn("octant, one of 8", needed)
        for symmetry, n_images in (("xy", 4), ("z", 2), ("none", 1)):
            self.run_scene(symmetry, {"Continuum/Symmetry": symmetry})
            counters = self.json(symmetry, "manifest.json")["models"]["continuum"]["counters"]
            self.assertEqual(counters["images"], n_images)
            self.close("continuum.csv", "octant", symmetry)

    def test_a_reduced_model_beside_finite_elements(self):
        """With deal.II in the process, and the same numbers to the last bit."""
        self.scene({**RELEASE, "Models": "reduced"})
        self.run_scene("without")
        self.run_scene("with", {"Models": "reduced, continuum"})
        self.same_bytes("reduced.csv", "without", "with")

    def test_diagonal_form(self):
        """Of a body that is diagonal but for 1e-300, nine unknowns are integrated in place of three."""
        self.scene({**RELEASE, "Models": "reduced"})
        self.run_scene("diagonal")
        self.run_scene("general", {"Initial state/Deformation": f"1, {NOTHING}, 0; 0, 1, 0; 0, 0, 1"})
        self.assertEqual(set(self.table("diagonal", "reduced.csv").column("Q12")), {0})
        self.assertNotEqual(self.table("general", "reduced.csv").column("Q12")[-1], 0)
        self.close("reduced.csv", "diagonal", "general")

    def test_stabilisation(self):
        self.scene({**RELEASE, "Models": "continuum"})
        _, skipped = self.run_scene("without")
        self.assertIn("volumetric stabilisation: neither", skipped)
        needed, _ = self.run_scene("with", {"Continuum/Volumetric stiffness": NOTHING})
        self.assertIn("volumetric stabilisation: kappa = 1e-300", needed)
        self.assertLess(max(self.table("with", "continuum.csv").column("volumetric")), NOTHING)
        for column in self.table("without", "continuum.csv").header:
            for a, b in zip(*(self.table(name, "continuum.csv").column(column) for name in ("without", "with"))):
                self.assertAlmostEqual(a, b, delta=ROUND_OFF, msg=column)

    def test_stabilisation_of_a_violent_start(self):
        """By the energy of deformation at the start, in every unit of stress; not in a model without elements."""
        self.scene({**RELEASE, "Models": "continuum", "Material/Shear modulus": 0.1})
        for amplitude, kappa in (0.09, "volumetric stabilisation: neither"), (0.11, "volumetric stabilisation: kappa = 0.3"):
            velocity = f"{amplitude}, 0, 0; 0, {amplitude}, 0; 0, 0, {-2 * amplitude}"  # 0.28 and 0.35 c/r
            self.assertIn(kappa, "".join(self.run_scene("check", {"Initial state/Velocity": velocity})))
        polynomial = {"Models": "polynomial", "Initial state/Velocity": "1.1, 0, 0; 0, 1.1, 0; 0, 0, -2.2"}
        self.assertIn("volumetric stabilisation: neither", "".join(self.run_scene("polynomial", polynomial)))

    def test_gravity(self):
        self.scene({**RELEASE, "Models": "reduced"})
        _, skipped = self.run_scene("without")
        self.assertIn("no elliptic integrals", skipped)
        needed, _ = self.run_scene("with", {"Gravity/Constant": NOTHING})
        self.assertIn("self-gravity", needed)
        self.close("reduced.csv", "without", "with")

    def test_planes_that_are_not_reached(self):
        """The centre of mass of the pseudo-rigid body is then a part of its state."""
        self.scene(RELEASE)
        _, skipped = self.run_scene("without")
        self.assertIn("contact: Loads/Plane normals is empty", skipped)
        needed, _ = self.run_scene("with", {"Loads/Plane normals": "0, 0, 1; 0, 0, -1",
                                            "Loads/Plane points": "0, 0, -9; 0, 0, 9"})
        self.assertIn("contact with rigid planes: 2", needed)
        for name in "reduced.csv", "continuum.csv":
            free, loaded = self.table("without", name), self.table("with", name)
            for column in free.header:
                for a, b in zip(free.column(column), loaded.column(column)):
                    self.assertAlmostEqual(a, b, delta=ROUND_OFF, msg=f"{column} of {name}")

    def test_loads_and_dissipation(self):
        self.scene(RELEASE)
        _, skipped = self.run_scene("free")
        for path, value, words in (
                ("Loads/Tidal matrix", f"{NOTHING}, 0, 0; 0, 0, 0; 0, 0, 0", "external potential"),
                ("Loads/Nominal traction", f"{NOTHING}, 0, 0; 0, 0, 0; 0, 0, 0", "traction"),
                ("Loads/Pressure", NOTHING, "follower pressure"),
                ("Loads/Tidal amplitude", f"{NOTHING}, 0, 0; 0, 0, 0; 0, 0, 0", "periodic tide"),
                ("Material/Viscosity", NOTHING, "dissipation"),
                ("Material/Drag", NOTHING, "dissipation")):
            with self.subTest(path):
                self.assertIn(words, skipped)
                needed, _ = self.run_scene("loaded", {path: value})
                self.assertIn(words, needed)
                self.close("reduced.csv", "free", "loaded")
                self.close("continuum.csv", "free", "loaded")

    def test_shapes_of_modes(self):
        self.scene((SOURCE / "params/modes.prm").read_text())
        few = {"Continuum/Degree": 3, "Modes/Number": 2}
        self.run_scene("shapes", few)
        _, skipped = self.run_scene("numbers", {**few, "Output/Graphics": "none"})
        self.assertIn("no folder is made", skipped)
        self.same_bytes("modes.csv", "shapes", "numbers")


if __name__ == "__main__":
    main()
