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

// Weights of the values at the nodes, m + 1 rising numbers from 0 to 1, for those at m · fine + 1 places between them: cubic
// through the four nearest.
const weightsOf = new Map();
function weights(nodes, fine) {
  const key = `${nodes.map(x => x.toFixed(4))} ${fine}`, m = nodes.length - 1;
  if (!weightsOf.has(key)) weightsOf.set(key, Array.from({length: m * fine + 1}, (_, k) => {
    const cell = Math.min(m - 1, Math.floor(k / fine)), s = nodes[cell] + (nodes[cell + 1] - nodes[cell]) * (k / fine - cell);
    const n = Math.min(3, m), first = Math.max(0, Math.min(m - n, cell - 1)), row = new Array(m + 1).fill(0);
    for (let i = first; i <= first + n; ++i) {
      row[i] = 1;
      for (let j = first; j <= first + n; ++j) if (j !== i) row[i] *= (s - nodes[j]) / (nodes[i] - nodes[j]);
    }
    return row;
  }));
  return weightsOf.get(key);
}

// Where the points of a curve are along it, as parts of its length; elements have their nodes closer to their ends.
function nodesAlong(points) {
  const steps = points.slice(1).map((x, k) => Math.hypot(...minus(x, points[k]))), length = steps.reduce((a, b) => a + b, 0);
  let sum = 0;
  return length > 0 && steps.every(d => d > 1e-6 * length) ? [0, ...steps.map(d => (sum += d) / length)] : points.map((_, k) => k / (points.length - 1));
}
// The same along both directions of a lattice, from the longer one of two opposite sides.
function nodesOfFace({m, X}) {
  const w = m + 1, side = (start, step) => Array.from({length: w}, (_, k) => X[start + k * step]);
  const longer = (a, b) => { const length = s => Math.hypot(...minus(s[0], s[m])); return nodesAlong(length(a) >= length(b) ? a : b); };
  return [longer(side(0, 1), side(w * m, 1)), longer(side(0, w), side(m, w))];
}

// A lattice of (m + 1)² numbers on the finer lattice.
function refined(f, [along, across], fine) {
  const A = weights(along, fine), w = along.length, rows = weights(across, fine).map(row => Array.from({length: w}, (_, i) => row.reduce((sum, x, j) => sum + x * f(j * w + i), 0)));
  return rows.flatMap(row => A.map(a => a.reduce((sum, x, i) => sum + x * row[i], 0)));
}

// Faces of a cut, {m, at: [[u, v] of each point], values}, in steps of color(value) from 0 to 1.
function paintCut(parent, faces, color, ramp) {
  const paths = Array.from({length: N_STEPS}, () => ""), n_cells = faces.reduce((n, f) => n + f.m * f.m, 0);
  const fine = Math.max(1, Math.min(4, Math.floor(Math.sqrt(6000 / n_cells))));
  for (const face of faces) {
    const {m, at, values} = face, nodes = nodesOfFace(face), w = m * fine + 1;
    const [u, v, value] = [k => at[k][0], k => at[k][1], k => values[k]].map(f => refined(f, nodes, fine));
    for (let j = 0; j + 1 < w; ++j)
      for (let i = 0; i + 1 < w; ++i) {
        const corners = [j * w + i, j * w + i + 1, (j + 1) * w + i + 1, (j + 1) * w + i], part = color(corners.reduce((sum, k) => sum + value[k] / 4, 0));
        paths[Math.max(0, Math.min(N_STEPS - 1, Math.floor(part * N_STEPS)))] += closed(corners.map(k => [u[k], v[k]]));
      }
  }
  paths.forEach((d, k) => {
    const fill = colorOf(ramp, (k + 0.5) / N_STEPS);
    if (d) draw(parent, "path", {d, fill, stroke: fill, "stroke-width": 0.6, "vector-effect": "non-scaling-stroke"});
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
      const W = weights(nodesAlong(s.map(k => X[k])), 4), curve = [0, 1].map(d => W.map(row => row.reduce((sum, x, i) => sum + x * at[s[i]][d], 0)));
      const path = curve[0].map((u, i) => (i ? "L" : "M") + place(u, curve[1][i])).join(""), known = sides.get(key);
      sides.set(key, {path, n: (known ? known.n : 0) + 1});
    }
  }
  const all = [...sides.values()];
  return {edges: all.filter(s => s.n > 1).map(s => s.path).join(""), outline: all.filter(s => s.n === 1).map(s => s.path).join("")};
}

// A scale below a cut, from `left` to `right`; color(value) is a place in the ramp.
function colorBar(svg, {left, right, top, most, color, ramp, label}) {
  for (let k = 0; k < N_STEPS; ++k) draw(svg, "rect", {x: left + (right - left) * k / N_STEPS, y: top, width: (right - left) / N_STEPS + 0.5, height: 10, fill: colorOf(ramp, (k + 0.5) / N_STEPS)});
  const marks = ticks([0, most], Math.max(2, (right - left) / 70)), texts = tickLabels(marks);
  marks.forEach((v, i) => draw(svg, "text", {x: left + (right - left) * color(v), y: top + 23, "text-anchor": "middle"}, texts[i]));
  draw(svg, "text", {x: (left + right) / 2, y: top + 39, "text-anchor": "middle"}, label);
}
