"""Functions of the report's scripts (src/io/report/), run by node where it is installed."""
import json
import shutil
import subprocess
import unittest

from program_test import SOURCE

STUBS = """
const window = {addEventListener() {}};
const document = {scripts: [], body: {}, createElement: () => ({setAttribute() {}, append() {}})};
const describedColumns = () => ({});  // of page.js, from the manifest of a run
"""
SCRIPTS = ("data.js", "charts.js", "fields.js", "bodies.js", "motion.js", "orbit.js", "overview.js", "sweep.js")


@unittest.skipUnless(shutil.which("node"), "node is not installed")
class ReportScripts(unittest.TestCase):
    def result(self, expression):
        """The value of a JavaScript expression among the scripts' functions."""
        sources = [(SOURCE / "src/io/report" / name).read_text() for name in SCRIPTS]
        text = "\n".join([STUBS, *sources, f"console.log(JSON.stringify({expression}));"])
        return json.loads(subprocess.run(["node", "-"], input=text, capture_output=True, text=True, check=True).stdout)

    def test_axes_are_followed_through_crossings(self):
        # A spheroid and an ellipsoid in pulsation: each axis is a smooth function, the file has them sorted.
        for axes in ("[1 + 0.2 * Math.cos(t), 1 - 0.1 * Math.cos(t), 1 - 0.1 * Math.cos(t)]",
                     "[1.1 + 0.2 * Math.cos(t), 1.0 - 0.2 * Math.cos(1.3 * t), 0.7 + 0.05 * Math.cos(t)]"):
            apart = self.result(f"""(() => {{
              const n = 400, time = Array.from({{length: n}}, (_, k) => 0.05 * k), at = t => {axes};
              const largestFirst = time.map(t => at(t).sort((a, b) => b - a));
              const table = {{n, has: () => true, columns: Object.fromEntries([0, 1, 2].map(i => [`a${{i + 1}}`, Float64Array.from(largestFirst, a => a[i])]))}};
              const found = followedAxes({{key: "x", table}});
              return Math.max(...time.flatMap((t, k) => at(t).map((a, i) => Math.abs(a - found[i][k]))));
            }})()""")
            self.assertLess(apart, 1e-14, axes)

    def test_a_lattice_is_refined_by_cubics(self):
        """Cubics are exact, on lattices of any size; of fewer than four points polynomials of their degree."""
        for m in 1, 2, 3, 4, 8:
            apart = self.result(f"""(() => {{
              const m = {m}, fine = 4, p = Math.min(3, m), at = (u, v) => 1 + u - 2 * v + u ** p - 0.5 * v ** p + 0.25 * u ** p * v ** p;
              const nodes = Array.from({{length: m + 1}}, (_, k) => 0.5 - 0.5 * Math.cos(Math.PI * k / m)), w = m * fine + 1;
              const values = refined(k => at(nodes[k % (m + 1)], nodes[Math.floor(k / (m + 1))]), [nodes, nodes], fine);
              const place = k => {{ const c = Math.min(m - 1, Math.floor(k / fine)); return nodes[c] + (nodes[c + 1] - nodes[c]) * (k / fine - c); }};
              return Math.max(...values.map((x, k) => Math.abs(x - at(place(k % w), place(Math.floor(k / w))))));
            }})()""")
            self.assertLess(apart, 1e-12, m)

    def test_nodes_of_a_lattice(self):
        """Of elements those along their sides; equal ones if a side has no length."""
        self.assertEqual(self.result("nodesAlong([[0, 0, 0], [1, 0, 0], [3, 0, 0], [4, 0, 0]])"), [0, 0.25, 0.75, 1])
        self.assertEqual(self.result("nodesAlong([[1, 0, 0], [1, 0, 0], [1, 0, 0]])"), [0, 0.5, 1])

    def test_rotation_of_a_deformation(self):
        # Q = R U with a turn of 0.7 about x3 and a symmetric U.
        R = self.result("""(() => {
          const c = Math.cos(0.7), s = Math.sin(0.7), R = [[c, -s, 0], [s, c, 0], [0, 0, 1]], U = [[1.3, 0.2, 0.1], [0.2, 0.9, 0], [0.1, 0, 0.8]];
          const found = rotationOf(R.map(row => [0, 1, 2].map(j => dot(row, U.map(u => u[j])))));
          return Math.max(...found.flatMap((row, i) => row.map((x, j) => Math.abs(x - R[i][j]))));
        })()""")
        self.assertLess(R, 1e-13)

    def test_spin_over_mean_motion(self):
        """A spin of 3 about the normal of an inclined ellipse with a = 4, e = 0.6 and the mean motion 0.25; the spin has a part along the orbit."""
        ratio = self.result("""(() => {
          const c = Math.cos(0.3), s = Math.sin(0.3), speed = 4 * 0.25 * Math.sqrt(1.6 / 0.4), turned = v => [v[0], c * v[1] - s * v[2], s * v[1] + c * v[2]];
          const vectors = {companion: turned([1.6, 0, 0]), companion_velocity: turned([0, speed, 0]), spin: turned([0.7, 0.2, 3])};
          const columns = {semi_major_axis: [4], eccentricity: [0.6]};
          for (const [name, v] of Object.entries(vectors)) v.forEach((x, i) => { columns[`${name}${i + 1}`] = [x]; });
          return ratioOfSpin({table: {columns}})[0];
        })()""")
        self.assertAlmostEqual(ratio, 12, delta=1e-12)

    def test_phase_lead(self):
        # Frequencies 3 and 2.5: after time t the first is ahead by t / (4 pi) cycles; noise does not count.
        apart = self.result("""(() => {
          const x = Float64Array.from({length: 2001}, (_, k) => 0.01 * k), wave = (w, noise) => x.map((t, k) => Math.cos(w * t) + noise * Math.cos(1000.7 * k));
          const lead = phaseLead({x, y: wave(2.5, 0.02)}, {x, y: wave(3, 0)});
          return Math.max(...lead.x.map((t, k) => Math.abs(lead.y[k] - 0.5 * t / (2 * Math.PI))));
        })()""")
        self.assertLess(apart, 0.02)

    def test_noise_is_told_from_a_curve(self):
        for y, expected in (("Math.sin(0.1 * k)", False), ("Math.sin(0.1 * k) + 1e-3 * Math.cos(2.9 * k * k)", False),
                            ("Math.cos(2.9 * k * k)", True), ("0.01 * k + Math.cos(2.9 * k * k)", True), ("0", False)):
            self.assertEqual(self.result(f"isNoise(Float64Array.from({{length: 200}}, (_, k) => {y}))"), expected, y)

    TABLE = """(() => {
      const columns = {run: [1, 2], m: [1, 2], finished: [1, 1], frequency: [3, 0], amplitude: [0.1, 0.2], energy: [1, 2], energy_drift: [1e-9, 1e-9],
        gravitational_end: [0, 0], gravitational_min: [0, 0], gravitational_max: [0, 0], a1_end: [1, 1], a1_min: [0.9, 0.8], a1_max: [1.1, 1.2]};
      for (const name in columns) columns[name] = Float64Array.from(columns[name]);
      return {names: Object.keys(columns), columns, n: 2, has: name => name in columns, at: (name, i) => columns[name][i]};
    })()"""

    def test_quantities_of_a_sweep(self):
        # What is conserved or constant stands once; a run without a frequency has none.
        found = self.result(f"sweptQuantities({self.TABLE}).map(q => [q.title, Array.from(q.y, v => Number.isNaN(v) ? null : v)])")
        self.assertEqual(found, [
            ["frequency of C = QᵀQ (1/time)", [3, None]], ["amplitude of C = QᵀQ", [0.1, 0.2]],
            ["energy, conserved (mass·length²/time²)", [1, 2]],
            ["gravitational, constant in each run (mass·length²/time²)", [0, 0]],
            ["a1, least (length)", [0.9, 0.8]], ["a1, greatest (length)", [1.1, 1.2]]])

    def test_cells_of_a_map(self):
        self.assertEqual(self.result("borders([4, 1, 2, 1, 4])"), {"values": [1, 2, 4], "edges": [0.5, 1.5, 3, 5]})
        self.assertEqual(self.result("[rampColor(0), rampColor(1), rampColor(2)]"), ["rgb(68,1,84)", "rgb(253,231,37)", "rgb(253,231,37)"])

    def test_what_hangs_on_the_samples_is_told_from_a_smooth_curve(self):
        lines = "[{rows: Array.from({length: 100}, (_, k) => k)}]"
        smooth, jumping = "Math.sin(0.05 * k)", "(k % 2)"
        for y, scale, expected in ((smooth, 1000, False), (jumping, 1000, True), (jumping, 1, False)):
            self.assertEqual(self.result(f"isOfSampling(Float64Array.from({{length: 100}}, (_, k) => {y}), {lines}, {scale})"), expected)


if __name__ == "__main__":
    unittest.main()
