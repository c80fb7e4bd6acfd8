// Fields on the cut of a body, painted in steps of a colour scale, and how a body is cut.

const N_STEPS = 48;
// Of the difference of two bodies: from nearly white to dark violet.
const DIFFERENCE_RAMP = [[247, 244, 249], [212, 200, 224], [170, 145, 196], [130, 90, 165], [84, 39, 122], [45, 0, 75]];
function colorOf(ramp, part) {
  const place = Math.max(0, Math.min(1, part)) * (ramp.length - 1), k = Math.min(ramp.length - 2, Math.floor(place));
  return `rgb(${ramp[k].map((c, i) => Math.round(c + (place - k) * (ramp[k + 1][i] - c))).join(",")})`;
}

// The rotation R of Q = RU, by Newton's iteration on the mean of R and its inverse transpose.
function rotationOf(Q) {
  let R = Q;
  for (let n = 0; n < 60; ++n) {
    const cofactors = [cross(R[1], R[2]), cross(R[2], R[0]), cross(R[0], R[1])], J = dot(R[0], cofactors[0]);
    if (!(Math.abs(J) > 0)) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const next = R.map((row, i) => row.map((v, j) => 0.5 * (v + cofactors[i][j] / J)));
    const change = Math.max(...next.flatMap((row, i) => row.map((v, j) => Math.abs(v - R[i][j]))));
    R = next;
    if (change < 1e-14) break;
  }
  return R;
}
const transposed = A => A.map((_, i) => A.map(row => row[i]));

// Faces of a cut as they are painted: {m, at: [[u, v] of each point], values or null}. The sub-cells of a lattice take the
// bilinear mean of the values at its points.
function paintCut(parent, faces, range, ramp) {
  const paths = Array.from({length: N_STEPS}, () => ""), n_cells = faces.reduce((n, f) => n + f.m * f.m, 0);
  const fine = Math.max(1, Math.min(4, Math.floor(Math.sqrt(6000 / n_cells))));
  for (const {m, at, values} of faces) {
    const w = m + 1;
    const mean = (f, i, j, s, t) => { const k = j * w + i; return (1 - s) * (1 - t) * f(k) + s * (1 - t) * f(k + 1) + (1 - s) * t * f(k + w) + s * t * f(k + w + 1); };
    for (let j = 0; j < m; ++j)
      for (let i = 0; i < m; ++i)
        for (let b = 0; b < fine; ++b)
          for (let a = 0; a < fine; ++a) {
            const part = (mean(k => values[k], i, j, (a + 0.5) / fine, (b + 0.5) / fine) - range[0]) / (range[1] - range[0] || 1);
            const corners = [[a, b], [a + 1, b], [a + 1, b + 1], [a, b + 1]].map(([p, q]) => [0, 1].map(d => mean(k => at[k][d], i, j, p / fine, q / fine)));
            paths[Math.max(0, Math.min(N_STEPS - 1, Math.floor(part * N_STEPS)))] += closed(corners);
          }
  }
  paths.forEach((d, k) => {
    const color = colorOf(ramp, (k + 0.5) / N_STEPS);
    if (d) draw(parent, "path", {d, fill: color, stroke: color, "stroke-width": 0.6, "vector-effect": "non-scaling-stroke"});
  });
}

// The sides of the faces, those of two faces once: edges of elements, and the outline of the cut.
function sidesOf(faces) {
  const sides = new Map();
  for (const {m, at, X} of faces) {
    const w = m + 1, side = (start, step) => Array.from({length: w}, (_, k) => start + k * step);
    for (const s of [side(0, 1), side(m, w), side(w * w - 1, -1), side(w * m, -w)]) {
      if (Math.hypot(...minus(X[s[0]], X[s[m]])) < 1e-9 * radius) continue;
      const key = s.reduce((sum, k) => sum.map((v, d) => v + X[k][d] / w), [0, 0, 0]).map(v => Math.round(1e5 * v / radius) + 0).join();
      const path = s.map((k, i) => (i ? "L" : "M") + place(at[k][0], at[k][1])).join(""), known = sides.get(key);
      sides.set(key, {path, n: (known ? known.n : 0) + 1});
    }
  }
  const all = [...sides.values()];
  return {edges: all.filter(s => s.n > 1).map(s => s.path).join(""), outline: all.filter(s => s.n === 1).map(s => s.path).join("")};
}

// A scale below a cut, from `left` to `right`.
function colorBar(svg, {left, right, top, range, ramp, label}) {
  for (let k = 0; k < N_STEPS; ++k) draw(svg, "rect", {x: left + (right - left) * k / N_STEPS, y: top, width: (right - left) / N_STEPS + 0.5, height: 10, fill: colorOf(ramp, (k + 0.5) / N_STEPS)});
  const marks = ticks(range, Math.max(2, (right - left) / 70)), texts = tickLabels(marks);
  marks.forEach((v, i) => draw(svg, "text", {x: left + (right - left) * (v - range[0]) / (range[1] - range[0]), y: top + 23, "text-anchor": "middle"}, texts[i]));
  draw(svg, "text", {x: (left + right) / 2, y: top + 39, "text-anchor": "middle"}, label);
}
