"""Results of every analysis go to standard output and into log.txt; progress goes to standard error."""
import subprocess

from program_test import SOURCE, STOPPED, ProgramTest, main

PENDULUM = {"System": "double pendulum"}
ANALYSES = {
    "modes": ({"Models": "polynomial", "Analysis": "modes", "Polynomial/Degree": 3, "Modes/Number": 3}, "  2  S2 "),
    "family": ({"Models": "reduced", "Analysis": "equilibrium", "Equilibrium/Family": "maclaurin", "Material/Law": "none",
                "Gravity/Constant": 1, "Equilibrium/First": 0.1, "Equilibrium/Last": 0.3, "Equilibrium/Number": 3},
               "3 equilibria, 3 of them stable"),
    "families": ({"Models": "reduced, polynomial", "Analysis": "equilibrium", "Equilibrium/Family": "maclaurin",
                  "Material/Law": "none", "Gravity/Constant": 1, "Equilibrium/First": 0.1, "Equilibrium/Last": 0.3,
                  "Equilibrium/Number": 2, "Polynomial/Degree": 1}, "degree 1: 2 equilibria"),
    "static": ({"Models": "reduced", "Analysis": "equilibrium", "Equilibrium/Family": "static",
                "Loads/Tidal matrix": "-0.4, 0, 0; 0, 0.2, 0; 0, 0, 0.2"}, "  V = "),
    "points": ({**PENDULUM, "Analysis": "equilibrium"}, "4 critical points"),
    "manifolds": ({"System": "torus", "Analysis": "manifolds", "Time/End": 5, "Output/Samples": 5, "Manifolds/Starts": 4},
                  "  point 2, unstable manifold: "),
    "section": ({**PENDULUM, "Analysis": "section", "Section/Column": "theta", "Time/End": 20}, " crossings of theta = 0"),
    "motion": ({"Models": "reduced", "Time/End": 5}, "drift of the energy"),
    "system": ({**PENDULUM, "Time/End": 5}, "drift of the energy"),
}


class StandardOutput(ProgramTest):
    def test_results_of_every_analysis(self):
        for name, (entries, words) in ANALYSES.items():
            with self.subTest(name):
                self.scene({"Initial state/Velocity": "0.1, 0, 0; 0, -0.1, 0; 0, 0, 0", **entries} if "Models" in entries and
                           "Analysis" not in entries else entries)
                result = self.run_done("run", "scene.prm", "--output", name)
                self.assertIn(words, result.stdout)
                for line in result.stdout.splitlines():
                    self.assertNotIn(f"{line}\n", result.stderr)
                self.assertIn(f"results are in {name}\n", result.stderr)
                if "Analysis" in entries:
                    self.assertIn(words, (self.scratch / name / "log.txt").read_text())
                quiet = self.run_done("run", "scene.prm", "--output", name, "--quiet")
                self.assertEqual((quiet.stdout, quiet.stderr), ("", ""))

    def test_results_that_cannot_be_printed(self):
        self.scene(ANALYSES["modes"][0])
        with open("/dev/full", "w") as full:
            result = self.run_program("run", "scene.prm", "--output", "modes", capture_output=False, stdout=full,
                                      stderr=subprocess.PIPE)
        self.assertEqual(result.returncode, STOPPED)
        self.assertIn("cannot write 'standard output'", result.stderr)
        self.assertEqual(len(self.table("modes/modes.csv")), 3)

    def test_energy_of_free_bodies_is_constant(self):
        """Nothing moves the energy of mass points and of a free rigid body: it is the kinetic energy, and compared with it."""
        for scene in "free_body", "t_handle":
            text = (SOURCE / f"params/{scene}.prm").read_text()
            self.scene(text, f"{scene}.prm")
            result = self.run_done("run", f"{scene}.prm")
            self.assertIn("constant to round-off", result.stdout)
        for system in "mass points", "rigid body":
            self.scene({"System": system})
            lines = self.run_done("run", "scene.prm").stdout.splitlines()
            (line,) = [line for line in lines if "energy" in line and ("drift" in line or "round-off" in line)]
            self.assertTrue("round-off" in line or float(line.split()[-1]) < 1e-5, line)


if __name__ == "__main__":
    main()
