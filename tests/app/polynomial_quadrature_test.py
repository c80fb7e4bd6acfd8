"""The rule of quadrature of the model polynomial: it follows a tight tolerance, its error is estimated and said, and a
resumed run keeps both."""
import signal

from program_test import DONE, STOPPED, TIME_LIMIT, ProgramTest, main, overrides

RELEASE = {"Models": "polynomial", "Polynomial/Degree": 3, "Initial state/Velocity": "0.1, 0, 0; 0, 0.1, 0; 0, 0, -0.2",
           "Time/End": 2, "Time/Tolerance": 1e-4, "Output/Samples": 20}
TIGHT = {**RELEASE, "Polynomial/Degree": 5, "Time/End": 5, "Time/Tolerance": 1e-9}


class PolynomialQuadrature(ProgramTest):
    def run_scene(self, entries, folder="out"):
        self.scene(entries)
        result = self.run_done("run", "scene.prm", "--output", folder)
        return self.table(folder, "polynomial.csv"), self.counters(folder), result.stderr

    def counters(self, folder):
        return self.json(folder, "manifest.json")["models"]["polynomial"]["counters"]

    def apart(self, a, b):
        return max(abs(x - y) for name in ("Q11", "Q33") for x, y in zip(a.column(name), b.column(name)))

    def test_a_loose_tolerance_keeps_the_least_points(self):
        least, counters, said = self.run_scene(RELEASE)
        self.assertEqual(counters["quadrature_points"], 3)
        self.assertIn("3 points of quadrature", said)
        finer, of_finer, _ = self.run_scene({**RELEASE, "Time/Step": counters["step"], "Polynomial/Quadrature points": 7})
        self.assertEqual(of_finer["quadrature_points"], 7)
        self.assertLess(of_finer["estimated_quadrature_error"], 1e-3 * counters["estimated_quadrature_error"])
        self.assertGreater(counters["estimated_quadrature_error"], self.apart(least, finer))

    def test_a_tight_tolerance_takes_more_points(self):
        """So many that four more change Q by less."""
        tight, counters, _ = self.run_scene({**RELEASE, "Time/Tolerance": 1e-9})
        points = int(counters["quadrature_points"])
        self.assertGreater(points, 3)
        self.assertLess(counters["estimated_quadrature_error"], 1e-9)
        finer, _, _ = self.run_scene({**RELEASE, "Time/Tolerance": 1e-9, "Polynomial/Quadrature points": points + 4})
        self.assertLess(self.apart(tight, finer), 1e-9)

    def test_points_that_gravity_leaves_above_the_tolerance_are_said(self):
        _, counters, said = self.run_scene({**RELEASE, "Time/Tolerance": 1e-9, "Gravity/Constant": 1})
        self.assertGreater(counters["estimated_quadrature_error"], 1e-9)
        self.assertIn("below the error of the quadrature", said)

    def test_a_run_interrupted_at_its_start_finds_the_same_rule(self):
        """Wherever the signal meets it: in the search for the rule, in that for the step, or in the run."""
        whole, counters, _ = self.run_scene(TIGHT, "whole")
        self.scene(TIGHT)
        process = self.start_program("run", "scene.prm", "--output", "half")
        log = self.scratch / "half/log.txt"
        self.wait_until(log.exists, "the log is there")
        process.send_signal(signal.SIGINT)
        self.assertIn(process.wait(TIME_LIMIT), (DONE, STOPPED))
        self.run_done("run", "scene.prm", "--output", "half", "--resume")
        self.assertEqual(self.bytes("half", "polynomial.csv"), self.bytes("whole", "polynomial.csv"))
        for name in "quadrature_points", "estimated_quadrature_error":
            self.assertEqual(self.counters("half")[name], counters[name])

    def test_a_later_end_keeps_the_rule(self):
        """Its error grows like t^(3/2)."""
        _, first, _ = self.run_scene(TIGHT)
        self.run_done("run", "scene.prm", "--output", "out", "--resume", *overrides({"Time/End": 10, "Output/Samples": 40}))
        resumed = self.counters("out")
        self.assertEqual(resumed["quadrature_points"], first["quadrature_points"])
        self.assertAlmostEqual(resumed["estimated_quadrature_error"] / first["estimated_quadrature_error"], 2**1.5)


if __name__ == "__main__":
    main()
