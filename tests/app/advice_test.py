"""Every sentence of the program that recommends a setting: a scene that provokes it, and the scene with the setting, which
`pseudorigid check` accepts. A sentence of the sources that no scene here provokes fails the test."""
import re
import unittest

from program_test import DONE, SOURCE, words
from refused_input import RefusedInputTest

MESH = SOURCE / "meshes/ellipsoid.msh"
GRAVITY = {"Gravity/Constant": 1}
COMPRESSIBLE = {"Body/Incompressible": "false"}
MODES = {"Analysis": "modes", "Models": "continuum"}
LOVE = {"Analysis": "love numbers", "Models": "reduced", **GRAVITY}
FAMILY = {"Analysis": "equilibrium", "Models": "reduced", **GRAVITY}
SWEEP = {"Models": "reduced", "Sweep/Parameters": "l: 1, 2", "Material/Shear modulus": "$(l)"}
SPIN = {"Initial state/Velocity": "0, 0.1, 0; -0.1, 0, 0; 0, 0, 0"}
TIDE = {"Loads/Tidal matrix": "0.1, 0, 0; 0, 0.1, 0; 0, 0, -0.2"}
BODY = {"System": "rigid body"}
VERTICAL = {"Rigid body/Rotation": "1, 0, 0; 0, 1, 0; 0, 0, 1", "Rigid body/Form": "lagrange"}
FLAT = {"Rigid body/Inertia": "1, 0, 0; 0, 1, 0; 0, 0, 2"}

# What is refused, the entry that is blamed, and what helps: None is a setting of the message's own words, "; set A = x".
CASES = (
    # Models.
    ({**SWEEP, "Models": "continuum", **COMPRESSIBLE, **GRAVITY}, "Gravity/Constant", None),
    ({**COMPRESSIBLE, **GRAVITY, "Models": "continuum"}, "Gravity/Constant", None),
    ({**COMPRESSIBLE, **GRAVITY, "Models": "polynomial"}, "Gravity/Constant", None),
    ({**COMPRESSIBLE, **GRAVITY, "Models": "reduced, polynomial, continuum"}, "Gravity/Constant", None),
    ({"Models": "continuum", "Material/Law": "none"}, "Material/Law", None),
    ({"Models": "continuum", "Material/Law": "none", **COMPRESSIBLE}, "Material/Law", None),
    ({"Models": "continuum", "Body/Semi-axes": "1.1, 1, 1"}, "Body/Semi-axes", None),
    ({"Models": "continuum", "Body/Inertia": "1, 0, 0; 0, 1, 0; 0, 0, 1"}, "Body/Inertia", None),
    ({"Models": "polynomial, continuum", "Body/Inertia": "1, 0, 0; 0, 1, 0; 0, 0, 1"}, "Body/Inertia", None),
    ({"Models": "polynomial", "Body/Inertia": "1, 0, 0; 0, 1, 0; 0, 0, 1"}, "Body/Inertia", None),
    ({"Models": "polynomial, continuum", "Continuum/Mesh": MESH, "Body/Semi-axes": "1.3, 0.8, 1"}, "Continuum/Mesh", None),
    ({"Analysis": "modes", "Models": "reduced"}, "Analysis", None),
    ({**FAMILY, "Models": "continuum", "Equilibrium/Family": "dedekind"}, "Equilibrium/Family", None),
    ({**FAMILY, "Models": "reduced, continuum", "Material/Law": "none"}, "Material/Law", None),
    ({**FAMILY, "Models": "continuum", "Equilibrium/Family": "static", "Loads/Acceleration": "1, 0, 0"}, "Equilibrium/Family", None),
    ({**FAMILY, "Models": "polynomial", "Polynomial/Degree": "1, 3", "Equilibrium/Family": "static", "Loads/Acceleration": "1, 0, 0"}, "Equilibrium/Family", None),
    ({**FAMILY, "Models": "polynomial", "Polynomial/Degree": 3, "Material/Viscosity": 1}, "Material/Viscosity", None),
    ({**FAMILY, **TIDE, "Models": "polynomial", "Polynomial/Degree": 3, "Gravity/Constant": 0, "Material/Law": "none", "Equilibrium/Family": "static"},
     "Equilibrium/Family", None),
    ({**FAMILY, **TIDE, "Models": "polynomial", "Polynomial/Degree": 3, "Body/Semi-axes": "1, 1, 1.3", "Equilibrium/Family": "static"}, "Body/Semi-axes", None),
    ({**FAMILY, "Models": "polynomial", "Polynomial/Degree": 3, "Material/Law": "none", "Equilibrium/Family": "static",
      "Loads/Nominal traction": "0.1, 0, 0; 0, 0, 0; 0, 0, 0"}, "Loads/Nominal traction", None),
    ({**FAMILY, "Models": "reduced, polynomial", "Equilibrium/Family": "dedekind"}, "Equilibrium/Family", None),
    ({**FAMILY, "Models": "polynomial", "Equilibrium/Family": "riemann-s"}, "Equilibrium/Family", None),
    # Methods.
    ({"Models": "continuum", "Time/Method": "gauss-16"}, "Time/Method", None),
    ({"Models": "continuum", "Time/Method": "explicit-8"}, "Time/Method", None),
    ({"Models": "continuum", "Time/Method": "rattle-4", "Material/Viscosity": 0.1}, "Time/Method", None),
    ({"Models": "continuum", "Time/Method": "symmetric-4", "Material/Drag": 0.1}, "Time/Method", None),
    ({"Models": "polynomial", "Time/Method": "symmetric-8", "Material/Drag": 0.1}, "Time/Method", None),
    ({"Models": "reduced", "Time/Method": "energy-momentum", "Material/Viscosity": 0.1}, "Time/Method", None),
    ({"Models": "reduced", "Time/Method": "rattle-6", "Material/Viscosity": 0.1}, "Time/Method", None),
    ({"System": "double pendulum", "Double pendulum/Form": "lagrange", "Time/Method": "rattle-4"}, "Time/Method", None),
    ({"System": "torus", "Time/Method": "symmetric-8"}, "Time/Method", None),
    ({"System": "mass points", "Mass points/Drag": 1, "Time/Method": "symmetric-8"}, "Time/Method", None),
    # Sweeps.
    ({**SWEEP, "Output/Graphics": "vtu"}, "Output/Graphics", None),
    ({**SWEEP, **FAMILY}, "Equilibrium/Number", None),
    ({**SWEEP, **FAMILY, "Equilibrium/Number": 1, "Equilibrium/Family": "static"}, "Models", None),
    ({"System": "double pendulum", "Analysis": "equilibrium", "Sweep/Parameters": "l: 1, 2", "Time/End": "$(l)"}, "Analysis", None),
    # Love numbers.
    ({**LOVE, "Body/Incompressible": "false"}, "Body/Incompressible", None),
    ({**LOVE, "Body/Semi-axes": "1, 1, 1.1"}, "Body/Semi-axes", None),
    ({**LOVE, "Output/Graphics": "vtu"}, "Output/Graphics", None),
    ({**LOVE, "Gravity/Constant": 0}, "Gravity/Constant", {"Gravity/Constant": 1}),
    ({**LOVE, "Models": "polynomial", "Polynomial/Degree": "auto"}, "Polynomial/Degree", {"Polynomial/Degree": 3}),
    # Modes.
    ({**MODES, "Material/Drag": 0.1}, "Material/Drag", {"Material/Drag": None}),
    ({**MODES, "Initial state/Center": "1, 0, 0"}, "Initial state/Center", {"Initial state/Center": None}),
    ({**MODES, "Initial state/Center velocity": "1, 0, 0"}, "Initial state/Center velocity",
     {"Initial state/Center velocity": None}),
    ({**MODES, "Continuum/Mesh": MESH}, "Continuum/Mesh", None),
    ({**MODES, "Continuum/Symmetry": "none"}, "Continuum/Symmetry", None),
    ({**MODES, "Initial state/Deformation": "2, 0, 0; 0, 1, 0; 0, 0, 0.5"}, "Initial state/Deformation",
     {"Initial state/Deformation": None}),
    ({**MODES, **GRAVITY, "Initial state/Equilibrium": "maclaurin"}, "Initial state/Equilibrium",
     {"Initial state/Equilibrium": None}),
    ({**MODES, **SPIN}, "Initial state/Velocity", {"Initial state/Velocity": None}),
    ({**MODES, "Material/Viscosity": 1, **TIDE, "Initial state/Center": "1, 0, 0"}, "Initial state/Center",
     {"Material/Viscosity": None, "Loads/Tidal matrix": None, "Initial state/Center": None}),
    ({**MODES, "Models": "polynomial", "Body/Semi-axes": "1.1, 1, 1"}, "Body/Semi-axes", {"Body/Semi-axes": None}),
    ({**MODES, "Models": "polynomial", "Polynomial/Degree": "1, 3"}, "Polynomial/Degree", {"Polynomial/Degree": 13}),
    ({**MODES, "Continuum/Degree": "auto"}, "Continuum/Degree", {"Continuum/Degree": 2}),
    ({**MODES, "Continuum/Refinements": "auto"}, "Continuum/Refinements", {"Continuum/Refinements": 1}),
    # Equilibria.
    ({**FAMILY, "Body/Semi-axes": "1.1, 1, 1"}, "Body/Semi-axes", None),
    ({**FAMILY, **TIDE}, "Loads/Tidal matrix", None),
    ({**FAMILY, "Loads/Nominal traction": "0.1, 0, 0; 0, 0, 0; 0, 0, 0"}, "Loads/Nominal traction", None),
    ({"Models": "reduced", "Material/Law": "none", "Analysis": "equilibrium"}, "Gravity/Constant", {"Gravity/Constant": 1}),
    ({"Models": "reduced", "Material/Law": "none", **FAMILY, "Gravity/Constant": 0, "Equilibrium/Family": "static"},
     "Material/Law", {"Gravity/Constant": 1}),
    ({**FAMILY, "Models": "polynomial", "Polynomial/Degree": "auto"}, "Polynomial/Degree", {"Polynomial/Degree": "1, 3, 5"}),
    ({**FAMILY, "Models": "polynomial", "Equilibrium/Family": "dedekind"}, "Equilibrium/Family",
     {"Equilibrium/Family": "jacobi"}),
    # The body and its mesh.
    ({"Models": "continuum", **SPIN, "Continuum/Symmetry": "octant"}, "Continuum/Symmetry", None),
    ({"Models": "continuum", "Continuum/Mesh": MESH, "Body/Semi-axes": "1.3, 0.8, 1", "Continuum/Symmetry": "x"},
     "Continuum/Symmetry", None),
    ({"Models": "continuum", "Material/Law": "none", **GRAVITY, "Continuum/Volumetric stiffness": 0},
     "Continuum/Volumetric stiffness", {"Continuum/Volumetric stiffness": "auto"}),
    ({"Models": "continuum", "Continuum/Degree": 1}, "Continuum/Degree", {"Continuum/Degree": 2}),
    ({"Models": "reduced", **GRAVITY, "Body/Inertia": "1, 0, 0; 0, 1, 0; 0, 0, 1"}, "Body/Inertia", None),
    ({"Models": "reduced", **COMPRESSIBLE, "Material/Lame lambda": 1e13}, "Material/Lame lambda", None),
    ({"Models": "reduced", "Body/Radius": "1e-200"}, "Body/Radius", {"Body/Radius": 1}),
    # Analyses of the other systems.
    *(({"Models": "reduced", "Analysis": "manifolds"}, "Analysis", {"Models": None, "System": system})
      for system in ("mass points", "double pendulum", "torus")),
    ({"System": "torus", "Analysis": "modes"}, "Analysis", {"System": "ball", "Models": "continuum"}),
    ({**BODY, **VERTICAL}, "Rigid body/Rotation", None),
    ({**BODY, **VERTICAL, **FLAT}, "Rigid body/Rotation", None),
    ({**BODY, **FLAT}, "Rigid body/Inertia", {"Rigid body/Form": "euler"}),
    ({**BODY, "Rigid body/Form": "euler", "Rigid body/Fixed point": "false",
      "Rigid body/Springs": "1, 0, 0, 2, 0, 0, 1, 0"}, "Rigid body/Springs", None),
)
# Words of messages that recommend a setting without "; set ": their cases are in the table above too, but for those of the
# files of a run, of which other tests are.
RECOMMENDS = re.compile(r"\bset [A-Z][a-z]|\bgive it\b|\bleave (the entry|out)\b|\buse Euler|\bfor modes give\b|"
                        r"\bchoose units\b|\bexpected a number > 0 for a fluid\b|\bas 1, 3, 5\b|\bpolynomial bodies take\b")
# The syntax itself, which is not advice; said of a disk, a build and a report.
OTHER_TESTS = ("set Name = value", "set Radius = 1", "nearest choice", "build the preset", "Examples", "set Deformation",
               "set Velocity")


def literals(path):
    """The string literals of a source, neighbours joined."""
    text = re.sub(r"^\s*//.*$", "", path.read_text(), flags=re.M)
    return ["".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', group))
            for group in re.findall(r'(?:"(?:[^"\\\n]|\\.)*"\s*)+', text)]


class Advice(RefusedInputTest):
    def provoked(self, scene, entry):
        self.scene({"Time/End": 1, **scene})
        result = self.run_program("check", "scene.prm")
        self.assert_one_sentence(result, f": {entry}: ")
        return result.stderr

    def accepted(self, scene, settings):
        changed = {**scene, **settings}
        self.scene({"Time/End": 1, **{path: value for path, value in changed.items() if value is not None}})
        result = self.run_program("check", "scene.prm")
        self.assertEqual(result.returncode, DONE, f"{settings}: {result.stderr}")

    @staticmethod
    def settings_of(message, entry):
        """"; set A = x and B = y, or set C = z or w": [{A: x, B: y}, {C: z}, {C: w}]."""
        advice = re.split("; set |, or set ", message.rstrip("\n"))[1:]
        alternatives = []
        section = entry.rpartition("/")[0]
        for clause in advice:
            name = None
            for alternative in clause.split(" or "):
                settings = {}
                for setting in alternative.split(" and "):
                    left, equals, right = setting.partition(" = ")
                    name = left if equals else name
                    path = name if "/" in name or name in ("Models", "Analysis", "System") else f"{section}/{name}"
                    settings[path] = right if equals else left
                alternatives.append(settings)
        return alternatives

    def test_what_is_recommended_is_accepted(self):
        messages = []
        for scene, entry, settings in CASES:
            with self.subTest(scene=scene):
                message = self.provoked(scene, entry)
                messages.append(message)
                recommended = [settings] if settings else self.settings_of(message, entry)
                self.assertTrue(recommended, f"{message} recommends nothing")
                for one in recommended:
                    self.accepted(scene, one)
        self.check_all_are_tried(messages)

    def check_all_are_tried(self, messages):
        for path in sorted((SOURCE / "src").rglob("*")):
            if path.suffix not in (".h", ".cpp") or path.name in ("entries.h", "analysis_entries.h"):
                continue
            for literal in literals(path):
                if not RECOMMENDS.search(literal) or any(word in literal for word in OTHER_TESTS):
                    continue
                pattern = re.compile(".+".join(re.escape(part) for part in re.split(r"\{[^}]*\}", literal)))
                self.assertTrue(any(pattern.search(message) for message in messages), f"{path}: {literal}")

    def test_every_method_that_is_refused(self):
        """Of every method in scenes in which some are refused: what is recommended in its place is accepted."""
        viscous = {"Material/Viscosity": 0.1}
        for scene in ({"Models": "continuum", **viscous}, {"Models": "reduced", **viscous}, {"Models": "polynomial", **viscous},
                      {"System": "double pendulum", "Double pendulum/Form": "lagrange"}, {"System": "torus"},
                      {"System": "rigid body", "Rigid body/Form": "euler"}):
            n_refused = 0
            for method in words("Time/Method"):
                with self.subTest(scene=scene, method=method):
                    self.scene({"Time/End": 1, **scene, "Time/Method": method})
                    result = self.run_program("check", "scene.prm")
                    if result.returncode == DONE:
                        continue
                    n_refused += 1
                    self.assert_one_sentence(result, "Time/Method: ")
                    recommended = self.settings_of(result.stderr, "Time/Method")
                    self.assertTrue(recommended, result.stderr)
                    for one in recommended:
                        self.accepted(scene, one)
            self.assertGreater(n_refused, 0, scene)

    def test_bounds_that_are_named(self):
        """A bound that was computed is printed to three digits: the number that is printed is allowed."""
        reduced = {"Models": "reduced", "Time/End": 3}
        for scene, entry, pattern in (
                ({**reduced, "Time/Step": 1e-13}, "Time/Step", r"a step of at least (\S+),"),
                ({**reduced, "Time/End": 1e300, "Material/Shear modulus": 0.37}, "Time/End", r"expected at most (\S+),"),
                ({**reduced, "Initial state/Velocity": "0, 1e30, 0; 0, 0, 0; 0, 0, 0", "Material/Shear modulus": 0.37},
                 "Initial state/Velocity", r"c/r = (\S+) "),
                ({**reduced, "Initial state/Center": "1e30, 0, 0", "Body/Radius": 0.37}, "Initial state/Center",
                 r"values up to (\S+) in"),
                ({**reduced, "Loads/Pressure": 1e30, "Material/Shear modulus": 0.37}, "Loads/Pressure", r"values up to (\S+) in"),
                ({**reduced, "Body/Inertia": "1e-30, 0, 0; 0, 1e-30, 0; 0, 0, 1e-30", "Body/Radius": 0.7}, "Body/Inertia",
                 r"entry between (\S+) and"),
                ({**reduced, "Body/Inertia": "1e30, 0, 0; 0, 1e30, 0; 0, 0, 1e30", "Body/Radius": 0.7}, "Body/Inertia",
                 r"entry between \S+ and (\S+),")):
            with self.subTest(entry):
                bound = re.search(pattern, self.provoked(scene, entry))[1]
                value = re.sub(r"1e-?30", bound, str(scene[entry])) if "1e" in str(scene[entry]) and ";" in str(scene[entry]) \
                    else bound if "," not in str(scene[entry]) else f"{bound}, 0, 0"
                self.accepted(scene, {entry: value})

    def test_matrices_that_are_proposed(self):
        cases = (
            ({"Models": "reduced", "Initial state/Deformation": "1.1, 0.2, 0; 0, 1, 0; 0.1, 0, 0.8"},
             "Initial state/Deformation", r'"set Deformation = ([^"]*)"'),
            ({"Models": "reduced", "Initial state/Velocity": "0.3, 0, 0.1; 0, 0.1, 0; 0, 0.2, 0"}, "Initial state/Velocity",
             r'"set Velocity = ([^"]*)"'),
            ({"Models": "reduced", "Loads/Tidal matrix": "0, 0.1, 0; 0, 0, 0; 0, 0, 0"}, "Loads/Tidal matrix",
             r'symmetric part is "([^"]*)"'),
            ({"Models": "reduced", "Body/Inertia": "1, 0.1, 0; 0, 1, 0; 0, 0, 1"}, "Body/Inertia", r'symmetric part is "([^"]*)"'),
            ({**BODY, "Rigid body/Rotation": "0.866, -0.5, 0; 0.5, 0.866, 0; 0, 0, 1"}, "Rigid body/Rotation",
             r'nearest rotation is "([^"]*)"'))
        for scene, entry, pattern in cases:
            with self.subTest(entry):
                self.accepted(scene, {entry: re.search(pattern, self.provoked(scene, entry))[1]})


if __name__ == "__main__":
    unittest.main()
