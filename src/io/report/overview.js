// The first screen: how each model was computed, the cut of both bodies, the motion of both, and the errors.

// The models of which the first screen shows a cut: the reference, and the poorest in motions.
const shownPair = () => MODELS.length > 1 ? [MODELS[0], MODELS.at(-1)] : MODELS;

function meshInWords(c) {
  const chosen = (name, found) => scene[name] === "auto" && found !== undefined ? found : scene[name];
  const refinements = Number(chosen("Continuum/Refinements", c.refinements)), file = scene["Continuum/Mesh"] && scene["Continuum/Mesh"] !== "builtin";
  return [`degree ${chosen("Continuum/Degree", c.degree)}`, refinements ? `refined ${refinements === 1 ? "once" : `${refinements} times`}` : "", file ? "mesh from a file" : "", `${c.unknowns || "?"} unknowns${c.images > 1 ? ` on 1/${c.images} of the ball` : ""}`].filter(Boolean).join(", ");
}

function setupSections() {
  const rows = Object.entries(manifest.models).filter(([, m]) => m.method).map(([key, m]) => {
    const c = m.counters || {}, ball = (manifest.ball || []).find(b => b.name === key);
    const name = ball ? `${adjectiveOf(ball)} ball` : key.replaceAll("_", " ");
    const method = `${m.method} (${m.symplectic ? "symplectic" : "not symplectic"})`;
    const step = c.step ? `${show(c.step, 3)}, ${c.steps} steps` : `${c.steps} steps`;
    const mesh = ball && ball.discretized ? meshInWords(c)
      : ball ? (isAffine(ball) ? "x = QX, 9 unknowns" : `polynomials, ${c.unknowns || "?"} unknowns`) : "";
    return [name, method, step, c.estimated_time_error ? show(c.estimated_time_error, 1) : "not known", ...(manifest.ball || []).length ? [mesh] : [], m.timers && m.timers.run !== undefined ? show(m.timers.run, 2) : ""];
  });
  if (!rows.length) return [];
  const head = ["model", "method", `step (${isUnitBall ? "r/c" : "time"})`, "error in time", ...(manifest.ball || []).length ? ["space"] : [], "time (s)"];
  const isText = i => i === 1 || i === 2 || (i === 4 && head.length > 5);
  const table = tableOf(head.map((text, i) => isText(i) ? make("th", {class: "words"}, text) : text), rows.map(row => row.map((text, i) => isText(i) ? make("td", {class: "words"}, String(text)) : text)));
  table.classList.add("setup");
  const tolerance = scene["Time/Tolerance"] && !/\d/.test(scene["Time/Step"] || "") ? ` The step follows from the tolerance ${scene["Time/Tolerance"]} of Q.` : "";
  const limits = Object.entries(manifest.models).filter(([, m]) => (m.counters || {}).surface_limit_time !== undefined).map(([key, m]) => {
    const ball = (manifest.ball || []).find(b => b.name === key);
    return make("p", {class: "warning"}, `From t = ${show(m.counters.surface_limit_time, 4)} on, the surface of the ${ball ? adjectiveOf(ball) : key} ball is somewhere beyond Biot's limit; wrinkles of the size of the mesh may grow from then on.`);
  });
  return [table, ...limits, make("p", {class: "note"}, `Error in time: estimated, of Q over the whole run.${tolerance}`)];
}

// The moments of the cut, and at each the faces of both bodies: {times, at(j) → [{model, faces}], plane}.
function cutsOfRun() {
  const pair = shownPair(), reference = pair.find(m => m.shapes && !m.isAffine);
  if (!reference || (pair[1] && pair[1] !== reference && !pair[1].shapes && !pair[1].table.has("Q11"))) return null;
  const {patches, rowsPerTime} = patchesOfShapes(reference.shapes), n = Math.floor(reference.shapes.n / rowsPerTime);
  const times = Array.from({length: n}, (_, j) => reference.shapes.at("time", j * rowsPerTime));
  const bodies = pair.filter(m => m === reference || m.isAffine).map(model => ({...model, patches,
    positions: times.map((_, j) => positionsAt(model === reference ? model : {...model, shapes: null}, patches, rowsPerTime, times, j))}));
  const kept = keptPlane(bodies), plane = kept || [2, 1, 3].find(d => patches.some(p => p.plane === d));
  if (!plane) return null;
  const axes = PLANE_AXES[plane];
  const at = j => bodies.map(body => {
    if (!body.positions[j]) return null;
    const i = nearest(body.table.columns.time, times[j]);
    const view = kept || !body.table.has("Q11") ? null : transposed(rotationOf(deformationAt(body.table, i)));
    const faces = patches.map((p, k) => ({p, k})).filter(({p}) => p.plane === plane).map(({p, k}) => {
      const x = body.positions[j][k], seen = view ? x.map(v => times3(view, v)) : x;
      return {m: p.m, X: p.X, x, at: seen.map(v => axes.map(d => v[d])), values: stressesAt(body, p, j, rowsPerTime, times[j])};
    });
    return {model: body, faces};
  });
  return {times, at, plane, isKept: kept > 0};
}
const times3 = times;

// Von Mises stresses at the points of a patch; null without pictures of the run.
function stressesAt(model, patch, j, rowsPerTime, time) {
  if (model.isAffine) {
    const table = model.frames, i = table ? nearest(table.columns.time, time) : -1;
    return i >= 0 && Math.abs(table.at("time", i) - time) < 1e-9 * (1 + Math.abs(time)) ? patch.X.map(() => table.at("von_mises", i)) : null;
  }
  return model.shapes.has("von_mises") ? patch.rows.map(row => model.shapes.at("von_mises", row + j * rowsPerTime)) : null;
}

// The panels at one moment: {title, model, faces with values}.
function panelsAt(cuts, j) {
  const bodies = cuts.at(j).filter(Boolean), withStress = bodies.every(b => b.faces.every(f => f.values));
  const panels = bodies.map(({model, faces}) => ({title: model.name, model, faces, isStress: withStress}));
  if (bodies.length === 2) {
    const [a, b] = bodies;
    panels.push({title: "difference of positions", model: a.model, isDifference: true,
      faces: a.faces.map((f, k) => ({...f, values: f.x.map((x, i) => Math.hypot(...minus(x, b.faces[k].x[i])))}))});
  }
  return panels;
}

function cutFigure() {
  const cuts = cutsOfRun();
  if (!cuts) return null;
  const differences = tables.comparison && tables.comparison.has("q_difference") ? tables.comparison : tables[`comparison-${shownPair().at(-1).key}`];
  const size = t => differences && differences.has("q_difference") ? differences.at("q_difference", nearest(differences.columns.time, t)) : t;
  let shown = cuts.times.reduce((best, t, j) => size(t) > size(cuts.times[best]) ? j : best, 0);
  const host = make("div"), choices = make("div", {class: "choices"}), heading = make("div", {class: "title"});
  const buttons = cuts.times.map((t, j) => {
    const button = make("button", {type: "button"}, show(t));
    button.addEventListener("click", () => { shown = j; redraw(); });
    return button;
  });
  choices.append("t = ", ...buttons.flatMap(b => [b, " "]));
  const redraw = () => { drawPanels(host, panelsAt(cuts, shown), cuts.plane); heading.textContent = `The bodies cut open at t = ${show(cuts.times[shown])}`; buttons.forEach((b, j) => b.classList.toggle("chosen", j === shown)); };
  const [a, b] = PLANE_AXES[cuts.plane].map(d => d + 1);
  const hasStress = panelsAt(cuts, shown)[0].isStress;
  const caption = `${cuts.isKept ? `The plane x${cuts.plane} = 0` : `The material plane X${cuts.plane} = 0, seen in axes that rotate with the body`}, x${a} to the right and x${b} up. Dashed: the undeformed body. `
    + (hasStress ? "Both bodies have one scale of stress, whose colours follow the square root." : "To see stresses, run the scene with Output/Graphics = vtu.");
  redraws.push(redraw);
  return figureOf(heading, null, [host, choices], caption, shownPair());
}

function drawPanels(host, panels, plane) {
  const width = Math.max(260, host.clientWidth || 700), n = panels.length, gap = 14, side = Math.min(300, (width - gap * (n - 1)) / n);
  const reach = 1.04 * Math.max(...semiAxes, ...panels.flatMap(p => p.faces.flatMap(f => f.at.map(v => Math.max(Math.abs(v[0]), Math.abs(v[1]))))));
  const height = side + 20 + 48, left = (width - n * side - (n - 1) * gap) / 2;
  const view = PLANE_AXES[plane].map(d => [0, 1, 2].map(k => k === d ? 1 : 0));
  host.replaceChildren();
  const svg = draw(host, "svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": panels.map(p => p.title).join(", ")});
  const values = own => own.flatMap(p => p.faces.flatMap(f => f.values)), greatest = own => Math.max(...extent(values(own))) || 1;
  const scaleOf = (most, ramp, shape) => ({most, ramp, color: v => shape(Math.max(0, v) / most)}), stressed = panels.filter(p => p.isStress);
  const stress = stressed.length ? scaleOf(greatest(stressed), RAMP, Math.sqrt) : null;
  panels.forEach((panel, k) => {
    const x = left + k * (side + gap);
    draw(svg, "text", {class: "strong", x: x + side / 2, y: 13, "text-anchor": "middle"}, panel.title);
    const group = draw(svg, "g", {transform: `translate(${x + side / 2} ${20 + side / 2}) scale(${side / 2 / reach})`});
    const scale = panel.isDifference ? scaleOf(greatest([panel]), DIFFERENCE_RAMP, v => v) : stress;
    if (scale) paintCut(group, panel.faces, scale.color, scale.ramp);
    const {edges, outline: rim} = sidesOf(panel.faces), keep = {"vector-effect": "non-scaling-stroke"};
    if (panel.model.hasElements || !panel.isDifference) draw(group, "path", {class: scale ? "edge" : `element ${panel.model.style}`, d: edges, ...keep});
    draw(group, "path", {class: `curve ${panel.isDifference ? "other" : panel.model.style} solid`, d: rim, ...keep});
    draw(group, "path", {class: "undeformed", d: undeformed(view), ...keep});
    if (panel.isDifference) colorBar(svg, {left: x + 8, right: x + side - 8, top: side + 26, ...scale, label: withUnit("distance", "length")});
  });
  if (stress) colorBar(svg, {left: left + 8, right: left + stressed.length * (side + gap) - gap - 8, top: side + 26, ...stress, label: `von Mises stress (${isUnitBall ? "μ" : "the scene's unit"})`});
}

// Which stretch shows the motion: the entry that the comparison fitted, or the one that varies most.
function shownStretch() {
  const models = MODELS.filter(m => m.table.has("Q11"));
  if (!models.length) return null;
  const known = comparison && comparison.frequency && comparison.frequency.signal;
  const entry = known && known[1] === known[2] ? Number(known[1]) : indices.reduce((a, b) => spreadOf(models.at(-1), b) > spreadOf(models.at(-1), a) ? b : a);
  const isDiagonal = models.every(m => pairs.every(p => p[0] === p[1] || largest(column(m, `Q${p}`)) < 1e-6));
  return {name: isDiagonal ? `Q${entry}${entry}` : `√C${entry}${entry}`, note: isDiagonal ? "" : `Stretch of the material line along axis ${entry}; C = QᵀQ.`,
    series: models.map(m => ({x: column(m, "time"), y: strain(m, entry, entry).map(Math.sqrt), name: m.name, style: m.style}))};
}
const spreadOf = (model, i) => { const [a, b] = extent(strain(model, i, i)); return b - a; };

// Times at which y crosses its mean, up and down in turn; noise within a tenth of the amplitude does not count.
function crossingsOf(x, y) {
  const mean = y.reduce((a, b) => a + b, 0) / y.length, dead = 0.1 * Math.max(...y.map(v => Math.abs(v - mean)));
  const found = [];
  let side = 0, last = 0;
  for (let k = 0; k < y.length; ++k) {
    const d = y[k] - mean, now = d > dead ? 1 : d < -dead ? -1 : 0;
    if (!now) continue;
    if (side && now !== side) {
      let i = last;
      while ((y[i + 1] - mean) * side > 0) ++i;
      found.push({time: x[i] + (x[i + 1] - x[i]) * (y[i] - mean) / (y[i] - y[i + 1]), up: now > 0});
    }
    side = now;
    last = k;
  }
  return found;
}

// By how many cycles the second series is ahead of the first, at the crossings of both.
function phaseLead(reference, other) {
  const [a, b] = [crossingsOf(reference.x, reference.y), crossingsOf(other.x, other.y)];
  if (a.length < 3 || b.length < 3) return null;
  const offset = a[0].up === b[0].up ? 0 : 0.5;
  const phase = (list, t) => {
    let k = list.findIndex(c => c.time >= t);
    if (k === 0) return t === list[0].time ? 0 : NaN;
    if (k < 0) return NaN;
    return (k - 1 + (t - list[k - 1].time) / (list[k].time - list[k - 1].time)) / 2;
  };
  const times = [...a, ...b].map(c => c.time).sort((p, q) => p - q);
  const points = times.map(t => [t, phase(b, t) + offset - phase(a, t)]).filter(p => Number.isFinite(p[1]));
  return points.length > 1 ? {x: points.map(p => p[0]), y: points.map(p => p[1])} : null;
}

function motionCharts() {
  const stretch = shownStretch();
  if (!stretch) return [];
  const charts = [chart({title: stretch.name, note: stretch.note, series: stretch.series, xLabel: timeLabel, height: 190})];
  const [reference, other] = [stretch.series[0], stretch.series.at(-1)];
  const lead = stretch.series.length > 1 ? phaseLead(reference, other) : null;
  if (lead) charts.push(chart({title: `Phase lead of the ${other.name} (cycles)`, series: [{...lead, name: "", style: "other"}], xLabel: timeLabel, height: 150,
    note: `From the times at which ${stretch.name} crosses its mean. 0.5: opposite phase.`}));
  return charts;
}

// The largest difference of Q and the errors within it, as bars on a logarithmic axis.
function budgetFigure() {
  const d = comparison && comparison.model_difference;
  if (!d || !(d.value > 0)) return null;
  const parts = [["difference of the models", d.value, "budget-model"], ...["space", "time", "quadrature"].filter(p => d[`${p}_error`] !== undefined && (d[`${p}_error`] !== 0 || p !== "quadrature")).map(p => [`error in ${p}`, d[`${p}_error`], "budget-error"])];
  const known = parts.filter(([, v]) => v > 0), low = Math.floor(Math.log10(Math.min(...known.map(p => p[1]))) - 0.3), high = Math.ceil(Math.log10(d.value));
  const host = make("div");
  const redraw = () => {
    const width = Math.max(260, host.clientWidth || 700), row = 22, height = row * parts.length + 34, left = Math.min(170, 0.42 * width), right = width - 70;
    host.replaceChildren();
    const svg = draw(host, "svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "largest difference of Q and its errors"});
    const X = v => left + (right - left) * (Math.log10(v) - low) / (high - low || 1), every = Math.ceil((high - low) / Math.max(2, (right - left) / 60));
    for (let k = high; k >= low; k -= every) {
      draw(svg, "line", {class: "grid", x1: X(10 ** k), x2: X(10 ** k), y1: 0, y2: height - 30});
      draw(svg, "text", {x: X(10 ** k), y: height - 16, "text-anchor": "middle"}, k > -3 && k < 4 ? String(10 ** k).slice(0, 6) : `1e${k}`.replace("-", "−"));
    }
    draw(svg, "text", {x: (left + right) / 2, y: height - 2, "text-anchor": "middle"}, "over |Q|");
    parts.forEach(([name, v, style], i) => {
      draw(svg, "text", {x: left - 6, y: row * i + 15, "text-anchor": "end"}, name);
      if (v > 0) draw(svg, "rect", {class: style, x: left, y: row * i + 4, width: Math.max(1, X(v) - left), height: row - 8});
      draw(svg, "text", {class: "strong", x: v > 0 ? X(v) + 5 : left + 5, y: row * i + 15}, typeof v !== "number" ? "not known" : v > 0 ? show(v, i ? 1 : 3) : "0");
    });
  };
  redraws.push(redraw);
  return figureOf("Largest difference of Q, and the errors in it", null, [host], d.resolved === false ? "The difference is not resolved: the errors are as large." : "", []);
}

function overviewOfRun() {
  const cut = MODELS.length ? cutFigure() : null, charts = motionCharts(), budget = budgetFigure();
  if (!cut && !charts.length) return [];
  return [legend(MODELS), make("div", {class: cut ? "first" : "charts"}, ...cut ? [cut, make("div", {}, charts)] : charts), budget].filter(Boolean);
}
