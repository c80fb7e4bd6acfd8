// The bodies at a few times: each from outside, and one over the other, cut along a plane that the motion keeps or, where
// there is none, by their outlines. What moves in other ways than x = QX is drawn through its material points
// (shapes.csv, shapes-<model>.csv), the pseudo-rigid body through those of the richest model. Centres of mass are put on
// one another.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const unit = a => a.map(v => v / Math.hypot(...a));
const times = (A, x) => A.map(row => dot(row, x));

const radius = Number(scene["Body/Radius"] || 1);
const semiAxes = numbers(scene["Body/Semi-axes"] || "1, 1, 1").map(a => a * radius);

// A patch is a lattice of (m + 1)² material points on the surface (plane 0) or on the coordinate plane with the normal 1,
// 2 or 3: {plane, m, X: reference places, outward: ±1}. Those of the computed sector are followed by their reflections.
function patchesOfShapes(table) {
  const c = table.columns, patches = [];
  const end = c.time.findIndex(t => t !== c.time[0]);
  const n = end < 0 ? table.n : end;
  for (let first = 0, i = 1; i <= n; ++i)
    if (i === n || c.face[i] !== c.face[first]) {
      const rows = Array.from({length: i - first}, (_, k) => first + k);
      patches.push({plane: c.plane[first], m: Math.round(Math.sqrt(rows.length)) - 1, rows, signs: [1, 1, 1],
        X: rows.map(k => [c.X1[k], c.X2[k], c.X3[k]])});
      first = i;
    }
  const all = [];
  const mirrored = [0, 1, 2].map(d => patches.every(p => p.X.every(X => X[d] > -1e-9 * radius)));
  for (let bits = 0; bits < 8; ++bits) {
    const signs = [0, 1, 2].map(d => (bits >> d & 1) ? -1 : 1);
    if (signs.some((s, d) => s < 0 && !mirrored[d])) continue;
    for (const p of patches) {
      if (p.plane > 0 && signs[p.plane - 1] < 0) continue;
      all.push(oriented({...p, signs, X: p.X.map(X => X.map((v, d) => signs[d] * v))}));
    }
  }
  return {patches: all, rowsPerTime: n};
}

// Of a run without a continuum: a cubed sphere, and in each coordinate plane four quarters of a disc and of a ring.
function ownPatches() {
  const lattice = (m, point) => Array.from({length: (m + 1) ** 2}, (_, k) => point(k % (m + 1) / m, Math.floor(k / (m + 1)) / m));
  const placed = X => X.map((v, d) => v * semiAxes[d]);
  const patches = [];
  for (let axis = 0; axis < 3; ++axis)
    for (const side of [-1, 1])
      for (const a of [-1, 0])
        for (const b of [-1, 0])
          patches.push({plane: 0, m: 6, X: lattice(6, (s, t) => {
            const X = [];
            X[axis] = side; X[(axis + 1) % 3] = Math.tan(Math.PI / 4 * (a + s)); X[(axis + 2) % 3] = Math.tan(Math.PI / 4 * (b + t));
            return placed(unit(X));
          })});
  for (let axis = 0; axis < 3; ++axis)
    for (let quarter = 0; quarter < 4; ++quarter)
      for (const inner of [0, 0.5])
        patches.push({plane: axis + 1, m: 8, X: lattice(8, (s, t) => {
          const X = [0, 0, 0], angle = Math.PI / 2 * (quarter + s), r = inner + 0.5 * t;
          X[(axis + 1) % 3] = r * Math.cos(angle); X[(axis + 2) % 3] = r * Math.sin(angle);
          return placed(X);
        })});
  return {patches: patches.map(oriented), rowsPerTime: 0};
}

function oriented(patch) {
  const {m, X} = patch, k = (m >> 1) * (m + 1) + (m >> 1);
  const normal = cross(minus(X[k + 1], X[k]), minus(X[k + m + 1], X[k]));
  return {...patch, outward: dot(normal, X[k]) >= 0 ? 1 : -1};
}

function deformationAt(table, i) {
  return [1, 2, 3].map(a => [1, 2, 3].map(b => table.at(`Q${a}${b}`, i)));
}

// The bodies: {key, style, patches, positions: of each time the places of each patch's points, or null}.
function bodiesOfRun() {
  const models = MODELS.filter(m => m.shapes || (m.isAffine && m.table.has("Q11")));
  if (!models.length) return null;
  const richest = models.find(m => m.shapes), table = models[models.length - 1].table;
  const common = richest ? patchesOfShapes(richest.shapes) : ownPatches();
  const moments = richest ? Array.from({length: Math.floor(richest.shapes.n / common.rowsPerTime)}, (_, j) => richest.shapes.at("time", j * common.rowsPerTime))
    : [...new Set([0, 0.13, 0.29, 0.47, 0.71, 1].map(part => Math.round(part * (table.n - 1))))].map(i => table.at("time", i));
  const bodies = models.map(model => {
    const {patches, rowsPerTime} = model.shapes && model !== richest ? patchesOfShapes(model.shapes) : common;
    return {...model, patches, positions: moments.map((_, j) => positionsAt(model, patches, rowsPerTime, moments, j))};
  });
  return {moments, bodies};
}

// null where the model has no sample or no picture at this time, as one that stopped before the others.
function positionsAt(model, patches, rowsPerTime, moments, j) {
  const {table, shapes} = model, i = table.n > 1 ? nearest(table.columns.time, moments[j]) : 0;
  if (!(Math.abs(table.at("time", i) - moments[j]) <= 1e-9 * (1 + Math.abs(moments[j])))) return null;
  if (!shapes) {
    const Q = deformationAt(table, i);
    return patches.map(p => p.X.map(X => times(Q, X)));
  }
  const first = firstRowAt(shapes, rowsPerTime, moments[j]);
  if (first < 0) return null;
  const c = shapes.columns, center = ["x1", "x2", "x3"].map(name => table.has(name) ? table.at(name, i) : 0);
  return patches.map(p => p.rows.map(row => {
    const k = row + first;
    return [c.x1[k], c.x2[k], c.x3[k]].map((v, d) => p.signs[d] * v - center[d]);
  }));
}

function firstRowAt(shapes, rowsPerTime, time) {
  for (let first = 0; first + rowsPerTime <= shapes.n; first += rowsPerTime)
    if (Math.abs(shapes.at("time", first) - time) <= 1e-9 * (1 + Math.abs(time))) return first;
  return -1;
}

// Where one looks from: angles of the camera about the axis x3 and above the plane x3 = 0.
const camera = {azimuth: -1.03, elevation: 0.33};
function viewFrom({azimuth, elevation}) {
  const to = [Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation)];
  const right = [-Math.sin(azimuth), Math.cos(azimuth), 0];
  return [right, cross(to, right), to];
}

const place = (u, v) => `${u.toFixed(4)} ${(-v).toFixed(4)}`;

// Points of the outline of {Ay: |y| = 1} seen along the third row of the view.
function outline(A, view) {
  const B = [0, 1].map(k => [0, 1, 2].map(j => dot(view[k], A.map(row => row[j]))));
  const S = [[dot(B[0], B[0]), dot(B[0], B[1])], [dot(B[0], B[1]), dot(B[1], B[1])]];
  let path = "";
  for (let k = 0; k < 72; ++k) {
    const n = [Math.cos(k * Math.PI / 36), Math.sin(k * Math.PI / 36)];
    const Sn = [S[0][0] * n[0] + S[0][1] * n[1], S[1][0] * n[0] + S[1][1] * n[1]], h = Math.sqrt(n[0] * Sn[0] + n[1] * Sn[1]);
    path += (k ? "L" : "M") + place(Sn[0] / h, Sn[1] / h);
  }
  return path + "z";
}
const undeformed = view => outline([[semiAxes[0], 0, 0], [0, semiAxes[1], 0], [0, 0, semiAxes[2]]], view);

// The quadrilaterals of the surface that face the camera: f(corner places in view, corner indices, patch, i, j).
function visitFront(patches, positions, view, f) {
  patches.forEach((p, n) => {
    if (p.plane !== 0) return;
    const seen = positions[n].map(x => times(view, x)), w = p.m + 1;
    for (let j = 0; j < p.m; ++j)
      for (let i = 0; i < p.m; ++i) {
        const corners = [j * w + i, j * w + i + 1, (j + 1) * w + i + 1, (j + 1) * w + i].map(k => seen[k]);
        const normal = cross(minus(corners[2], corners[0]), minus(corners[3], corners[1])).map(v => v * p.outward);
        if (normal[2] > 0) f(corners, normal, p, i, j);
      }
  });
}
const closed = corners => corners.map((c, k) => (k ? "L" : "M") + place(c[0], c[1])).join("") + "z";

const BASE = {elastic: [0, 114, 178], "pseudo-rigid": [213, 94, 0], "third-model": [0, 132, 95], "fourth-model": [168, 67, 127],
  "fifth-model": [125, 98, 0], "sixth-model": [86, 92, 100]};
function shade(style, light) {
  const t = Math.max(0, Math.min(1, light)), base = BASE[style.replace(" solid", "")];
  const mix = t < 0.55 ? base.map(c => c * (0.55 + 0.45 * t / 0.55)) : base.map(c => c + (255 - c) * 0.62 * (t - 0.55) / 0.45);
  return `rgb(${mix.map(Math.round).join(",")})`;
}

function drawOutside(svg, body, positions) {
  const {patches} = body;
  const view = viewFrom(camera), light = unit([-0.45, 0.55, 0.9]), n_shades = 32;
  const faces = Array.from({length: n_shades}, () => "");
  let edges = "";
  visitFront(patches, positions, view, (c, normal, p, i, j) => {
    const brightness = 0.5 * (1 + dot(unit(normal), light));
    faces[Math.min(n_shades - 1, Math.floor(brightness * n_shades))] += closed(c);
    for (const [on, a, b] of [[j === 0, 0, 1], [i === p.m - 1, 1, 2], [j === p.m - 1, 2, 3], [i === 0, 3, 0]])
      if (on) edges += `M${place(c[a][0], c[a][1])}L${place(c[b][0], c[b][1])}`;
  });
  faces.forEach((path, k) => {
    if (path) draw(svg, "path", {d: path, fill: shade(body.style, (k + 0.5) / n_shades), stroke: shade(body.style, (k + 0.5) / n_shades), "stroke-width": 0.6, "vector-effect": "non-scaling-stroke"});
  });
  draw(svg, "path", {class: "edge", d: edges, "vector-effect": "non-scaling-stroke"});
  draw(svg, "path", {class: "undeformed", d: undeformed(view), "vector-effect": "non-scaling-stroke"});
}

// The coordinate plane (its normal, 1 to 3) in which all bodies stay what they cut out of it, and in which most happens.
function keptPlane(bodies) {
  let best = 0, most = -1;
  for (const d of [2, 1, 3]) {
    let leaves = 0, moves = 0;
    for (const body of bodies)
      for (const positions of body.positions.filter(Boolean))
        body.patches.forEach((p, n) => {
          if (p.plane !== d) return;
          positions[n].forEach((x, k) => {
            leaves = Math.max(leaves, Math.abs(x[d - 1]));
            moves = Math.max(moves, Math.hypot(...minus(x, p.X[k])));
          });
        });
    if (leaves < 2e-3 * radius && moves > 1.001 * most && bodies.every(b => b.patches.some(p => p.plane === d))) { best = d; most = moves; }
  }
  return best;
}

const PLANE_AXES = {1: [1, 2], 2: [0, 2], 3: [0, 1]};
function drawCut(svg, body, positions, plane) {
  const {patches} = body, [a, b] = PLANE_AXES[plane], border = new Map();
  let inside = "", elements = "", rim = "";
  patches.forEach((p, n) => {
    if (p.plane !== plane) return;
    const w = p.m + 1, at = k => positions[n][k];
    const side = (start, step) => Array.from({length: w}, (_, k) => start + k * step);
    const sides = [side(0, 1), side(p.m, w), side(w * w - 1, -1), side(w * p.m, -w)];
    inside += sides.flatMap(s => s.slice(0, -1)).map((k, i) => (i ? "L" : "M") + place(at(k)[a], at(k)[b])).join("") + "z";
    for (const s of sides) {
      const middle = s.reduce((sum, k) => sum.map((v, d) => v + p.X[k][d] / w), [0, 0, 0]);
      const key = middle.map(v => Math.round(1e5 * v / radius)).join(), known = border.get(key);
      const path = s.map((k, i) => (i ? "L" : "M") + place(at(k)[a], at(k)[b])).join("");
      const length = Math.hypot(...minus(p.X[s[0]], p.X[s[p.m]]));
      if (length > 1e-9 * radius) border.set(key, {path, n: (known ? known.n : 0) + 1});
    }
  });
  for (const {path, n} of border.values()) if (n > 1) elements += path; else rim += path;
  if (body.hasElements) draw(svg, "path", {class: "tint", d: inside});
  draw(svg, "path", {class: `element ${body.style}`, d: elements, "vector-effect": "non-scaling-stroke"});
  draw(svg, "path", {class: `curve ${body.style}`, d: rim, "vector-effect": "non-scaling-stroke"});
}

// Along axis 2. The stroke of all faces is covered by their filling but for the outer half of the outline.
const ALONG_2 = [[1, 0, 0], [0, 0, 1], [0, -1, 0]];
function drawOutline(svg, body, positions, Q) {
  if (!body.shapes) {
    const A = Q.map(row => row.map((v, j) => v * semiAxes[j]));
    draw(svg, "path", {class: `curve ${body.style}`, d: outline(A, ALONG_2), "vector-effect": "non-scaling-stroke"});
    return;
  }
  let path = "";
  visitFront(body.patches, positions, ALONG_2, c => { path += closed(c); });
  draw(svg, "path", {class: `curve ${body.style}`, d: path, "stroke-width": 4, style: "stroke-width: 4", "vector-effect": "non-scaling-stroke"});
  draw(svg, "path", {d: path, style: "fill: var(--card); stroke: var(--card); stroke-width: .6", "vector-effect": "non-scaling-stroke"});
  draw(svg, "path", {class: "tint", d: path});
}

function bodiesFigure() {
  const run = bodiesOfRun();
  if (!run) return null;
  const {moments, bodies} = run, plane = keptPlane(bodies);
  const size = 1.06 * Math.max(...semiAxes, ...bodies.flatMap(b => b.positions.filter(Boolean).flatMap(ps =>
    ps.flatMap(p => p.map(x => Math.hypot(...x))))));
  const picture = label => {
    const svg = document.createElementNS(SVG, "svg");
    svg.setAttribute("viewBox", [-size, -size, 2 * size, 2 * size].join(" "));
    svg.setAttribute("role", "img");
    svg.setAttribute("aria-label", label);
    return svg;
  };
  const outside = [];
  const cards = moments.map((t, j) => {
    const card = make("div", {class: "time"}, make("div", {class: "title"}, `t = ${show(t)}`));
    for (const body of bodies) {
      if (!body.positions[j]) continue;
      const svg = picture(`${body.name} at time ${show(t)}`);
      svg.classList.add("turn");
      outside.push(() => { svg.replaceChildren(); drawOutside(svg, body, body.positions[j]); });
      card.append(svg);
    }
    const both = picture(`cut or outlines at time ${show(t)}`);
    for (const body of bodies) {
      if (!body.positions[j]) continue;
      if (plane) drawCut(both, body, body.positions[j], plane);
      else drawOutline(both, body, body.positions[j], body.shapes ? null : deformationAt(body.table, nearest(body.table.columns.time, t)));
    }
    const view = plane ? PLANE_AXES[plane].map(d => [0, 1, 2].map(k => k === d ? 1 : 0)) : ALONG_2;
    draw(both, "path", {class: "undeformed", d: undeformed(view), "vector-effect": "non-scaling-stroke"});
    card.append(both);
    return card;
  });
  const redraw = () => outside.forEach(f => f());
  redraw();
  const figure = figureOf("The bodies at these times", null, [make("div", {class: "times"}, cards)], captionOf(bodies, plane), bodies);
  turnByDragging(figure, redraw);
  return make("div", {}, legend(bodies), figure);
}

const ALL_OF = ["", "the body", "both", "all"];
function captionOf(bodies, plane) {
  const below = plane
    ? `Below: ${ALL_OF[Math.min(bodies.length, 3)]} cut along the plane x${plane} = 0, x${PLANE_AXES[plane][0] + 1} to the right and x${PLANE_AXES[plane][1] + 1} up.`
    : `Below: the outline${bodies.length > 1 ? `s of ${ALL_OF[Math.min(bodies.length, 3)]}` : ""} seen along axis 2, x1 to the right and x3 up.`;
  const withElements = bodies.find(b => b.hasElements);
  const lines = withElements ? `edges of the finite elements${bodies.some(b => !b.shapes) ? ", the same material lines in the pseudo-rigid ball" : ""}` : "material lines";
  const rows = bodies.length < 3 ? bodies.map((b, k) => `${["Above", "In the middle"][k]}: the ${b.name} from outside, x3 up`).join(". ")
    : `From above: the ${bodies.map(b => b.name).join(", the ")}, from outside, x3 up`;
  return `${rows}. ${below} Thin lines: ${lines}. Dashed: the undeformed body. Drag a body to rotate the view.`;
}

function turnByDragging(figure, redraw) {
  let from = null;
  figure.addEventListener("pointerdown", event => { if (event.target.closest(".turn")) from = [event.clientX, event.clientY, camera.azimuth, camera.elevation]; });
  window.addEventListener("pointermove", event => {
    if (!from) return;
    camera.azimuth = from[2] - 0.01 * (event.clientX - from[0]);
    camera.elevation = Math.max(-1.5, Math.min(1.5, from[3] + 0.01 * (event.clientY - from[1])));
    redraw();
  });
  window.addEventListener("pointerup", () => { from = null; });
}
