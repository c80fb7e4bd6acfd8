// A sweep: values over the parameter that takes most values, a line for each choice of the others, and of two parameters
// a map.

const SWEPT_UNITS = [[/^(kinetic|elastic|gravitational|external|dissipated|energy)$/, SQUARED], [/^[JZ]\d$/, MOMENTUM], [/^[ax]\d$/, "length"], [/^v\d$/, "length/time"], [/^Qdot/, "1/time"], [/^multiplier$/, "1/time^2"], [/^frequency$/, "1/time"], [/(_omega_\d+|^omega3|^growth_rate)$/, "1/time"], [/^surface\d$/, "length"], [/_von_mises$/, "pressure"]];
const MOST_LINES = 6, MOST_RUNS = 30;

function sweptUnit(name) {
  return (describedColumns(`${systemFile}`)[name] || {}).unit || (SWEPT_UNITS.find(([names]) => names.test(name)) || [0, ""])[1];
}

// What the runs have to show: {title, base: the column of a single run, y: a value for each run, NaN where there is none}.
// What is conserved or does not change within any run is shown once.
function sweptQuantities(t) {
  if (t.has("compared")) return comparedQuantities(t);
  if (isTableSweep()) return tableQuantities(t);
  const list = [], add = (base, y, words = base) => list.push({base, y, title: withUnit(words, sweptUnit(base))});
  if (t.has("frequency")) {
    add("frequency", t.columns.frequency.map(v => v > 0 ? v : NaN), "frequency of C = QᵀQ");
    add("amplitude", t.columns.amplitude, "amplitude of C = QᵀQ");
  }
  for (const name of t.names) {
    if (t.has(`${name}_drift`)) add(name, t.columns[name], `${name}, conserved`);
    if (!name.endsWith("_min")) continue;
    const base = name.slice(0, -4), least = t.columns[name], most = t.columns[`${base}_max`];
    if (least.every((v, i) => most[i] - v <= 1e-9 * (Math.abs(v) + Math.abs(most[i])))) { add(base, least, `${base}, constant in each run`); continue; }
    add(base, least, `${base}, least`);
    add(base, most, `${base}, greatest`);
  }
  return list;
}

// Sweeps of modes, Love numbers and equilibria: columns of the tables of every model. 0 stands for a run that failed.
const TABLE_COLUMNS = {"modes": /^(.*)_(omega)_(\d+)$/, "love numbers": /^(.*)_([hlk])_(\d+)$/, "equilibrium": /^(.*)_(omega3|a1|a3|surface1|surface3|J3|energy|growth_rate)()$/};
const isTableSweep = () => scene.Analysis in TABLE_COLUMNS;
function tableQuantities(t) {
  const words = {"modes": (_, i) => `frequency ${i}`, "love numbers": (letter, i) => `${letter} of degree ${i}`, "equilibrium": name => name}[scene.Analysis];
  const columns = t.names.map(name => [name, name.match(TABLE_COLUMNS[scene.Analysis])]).filter(([, match]) => match);
  const order = scene.Analysis === "equilibrium" ? columns.map(([, match]) => match[2]) : [];
  return columns.sort(([, a], [, b]) => order.indexOf(a[2]) - order.indexOf(b[2])).map(([name, [, model, column, i]]) => ({base: name,
    y: t.columns[name].map((v, row) => t.at(t.has(`${model}_finished`) ? `${model}_finished` : "finished", row) ? v : NaN), isMap: ["1", "2"].includes(i) || column === "a1",
    unit: sweptUnit(i ? name : column), title: withUnit(`${model}: ${words(column, i)}`, sweptUnit(i ? name : column))}));
}

// Of a sweep of several models, the comparison of each with the last. −1 and, of a ratio, 0 stand for "not known".
const COMPARED = [["frequency_ratio", "ratio of frequencies"], ["frequency_ratio_error", "error bar of the ratio"], ["max_von_mises_ratio", "ratio of the largest stresses (rms)"], ["mean_von_mises_ratio", "ratio of the mean stresses (rms)"], ["strain_difference_max", "difference of C, over its amplitude"], ["q_difference_max", "difference of Q, relative"], ["elastic_difference_max", "difference of the elastic energy, over E₀"], ["max_stretch_difference_max", "difference of the largest stretch, relative"], ["dissipated_difference_max", "difference of the dissipated energy, relative"], ["tenth_of_period_after", "time until a tenth of a period apart"], ["phase_after_10_periods", "phase difference after ten periods, in periods"], ["phase_difference_max", "largest phase difference, in periods"]];
// The column of the error bar of a quantity. −1 stands for "not known".
const BARS = {frequency_ratio: "frequency_ratio_error", max_von_mises_ratio: "max_von_mises_ratio_error", mean_von_mises_ratio: "mean_von_mises_ratio_error",
  ...Object.fromEntries(["q", "strain", "elastic", "max_stretch", "dissipated", "phase"].map(of => [`${of}_difference_max`, `${of}_difference_error`]))};
function barOf(t, model, end) {
  const bars = t.columns[`${model}_${BARS[end]}`];
  return bars && bars.map(v => v >= 0 ? v : NaN);
}
function comparedQuantities(t) {
  const list = [], known = c => t.columns[c].map((v, i) => t.at("compared", i) && v > 0 ? v : NaN);
  for (const [end, words] of COMPARED)
    for (const name of t.names) {
      const model = name.slice(0, -end.length - 1);
      if (name === `${model}_${end}` && known(name).some(Number.isFinite)) list.push({base: name, y: known(name), title: withUnit(`${model}: ${words}`, end === "tenth_of_period_after" ? "time" : ""), isMap: ["frequency_ratio", "max_von_mises_ratio", "strain_difference_max"].includes(end), bar: barOf(t, model, end)});
    }
  if (known("nonaffine_displacement").some(Number.isFinite)) list.push({base: "nonaffine_displacement", y: known("nonaffine_displacement"), title: "largest non-affine part of the position"});
  return list;
}

// The columns between the number of the run and what it has brought.
const sweptNames = t => t.names.slice(1, t.names.indexOf(t.has("compared") ? "compared" : "finished"));
// Whether all models of a run came to its end.
const hasFinished = (t, i) => t.names.filter(n => n === "finished" || n.endsWith("_finished")).every(n => t.at(n, i) === 1);

// Whether values jump from run to run by no more than where the samples fall: the least of an energy that vanishes for a
// moment, the largest axis at the moment when two are equal.
function isOfSampling(y, lines, scale) {
  const [least, most] = finiteExtent(y);
  if (most - least > 0.02 * scale) return false;
  let bends = 0, n = 0;
  for (const {rows} of lines)
    for (let k = 1; k + 1 < rows.length; ++k, ++n) bends += Math.abs(y[rows[k - 1]] - 2 * y[rows[k]] + y[rows[k + 1]]);
  return n > 0 && bends / n > 0.02 * (most - least);
}

const finiteExtent = y => extent(y.filter(Number.isFinite));

// The runs for each choice of the parameters other than x, by rising x.
function linesOver(t, x, others) {
  const groups = new Map();
  for (let i = 0; i < t.n; ++i) {
    const name = others.map(o => `${o} = ${show(t.at(o, i))}`).join(", ");
    groups.set(name, [...(groups.get(name) || []), i]);
  }
  return [...groups].map(([name, rows]) => ({name, rows: rows.sort((a, b) => t.at(x, a) - t.at(x, b))}));
}

function sweepSections() {
  const t = tables.sweep;
  if (!t) return [];
  const swept = sweptNames(t), n_values = name => new Set(t.columns[name]).size;
  const x = swept.reduce((a, b) => n_values(b) > n_values(a) ? b : a), others = swept.filter(name => name !== x);
  const all = linesOver(t, x, others), n_lines = Math.min(all.length, MOST_LINES);
  const lines = Array.from({length: n_lines}, (_, k) => ({...all[n_lines > 1 ? Math.round(k * (all.length - 1) / (n_lines - 1)) : 0], style: `line${k}`}));
  const quantities = sweptQuantities(t), scale = new Map();
  const unitOf = q => q.unit ?? sweptUnit(q.base);
  for (const q of quantities) scale.set(unitOf(q), Math.max(scale.get(unitOf(q)) || 1e-300, ...finiteExtent(q.y).map(Math.abs).filter(Number.isFinite)));
  const scaleOf = q => scale.get(unitOf(q));
  const isLevel = q => { const [a, b] = finiteExtent(q.y); return !(b - a > 1e-7 * scaleOf(q)); };
  const level = quantities.filter(isLevel), jumping = t.has("compared") || isTableSweep() ? [] : quantities.filter(q => !isLevel(q) && isOfSampling(q.y, all, scaleOf(q)));
  const drawn = quantities.filter(q => !level.includes(q) && !jumping.includes(q));
  const absent = q => { const n = q.y.filter(v => !Number.isFinite(v)).length; return n ? `${n} of ${t.n} runs do not have it.` : ""; };
  const draws = q => chart({title: q.title, xLabel: x, note: [absent(q), q.bar ? "The vertical lines are error bars." : ""].filter(Boolean).join(" "), series: lines.map(l => {
    const rows = l.rows.filter(i => Number.isFinite(q.y[i]));
    return {x: rows.map(i => t.at(x, i)), y: rows.map(i => q.y[i]), name: l.name, style: l.style, points: rows.length === 1, bar: q.bar && rows.map(i => q.bar[i])};
  }).filter(s => s.x.length)});
  const named = list => [...new Set(list.map(q => q.base))].map(base => {
    const of = list.filter(q => q.base === base);
    return of.length === quantities.filter(q => q.base === base).length ? base : of[0].title.replace(/ \(.*/, "");
  }).join("; ");
  const lineWords = others.length ? `, for ${lines.length < all.length ? `${lines.length} of the ${all.length}` : "all"} values of ${others.join(", ")}` : "";
  return [...mapSections(t, swept, x, quantities, drawn),
    ...section("Sweep", t.has("compared") ? `Each model against the last, over ${x}${lineWords}.` : isTableSweep() ? `Values of each run over ${x}${lineWords}; sweep.csv has further columns.` : `Values of each run over ${x}${lineWords}: conserved quantities, and the least and the greatest value of the others within the run.`,
      others.length ? legend(lines) : null, make("div", {class: "charts"}, drawn.slice(0, MOST_CHARTS).map(draws)),
      drawn.length > MOST_CHARTS ? more(`More charts (${drawn.length - MOST_CHARTS})`, [make("div", {class: "charts"}, drawn.slice(MOST_CHARTS).map(draws))]) : null,
      level.length ? make("p", {class: "note"}, `The same in all runs to 1e−7: ${named(level)}.`) : null,
      jumping.length ? make("p", {class: "note"}, `Not drawn, because they vary little and only with the places of the samples: ${named(jumping)}.`) : null),
    ...runsSection(t)];
}

function runsSection(t) {
  const failed = [...Array(t.n).keys()].filter(i => !hasFinished(t, i)), listed = (failed.length ? failed : [...Array(t.n).keys()]).slice(0, MOST_RUNS);
  const head = t.has("compared") ? ["run", ...sweptNames(t), ...t.names.filter(n => /_(finished|frequency_ratio|frequency_ratio_error)$/.test(n))] : isTableSweep() ? ["run", ...sweptNames(t), "finished", ...sweptQuantities(t).map(q => q.base).slice(0, MOST_LINES)] : t.names.slice(0, t.names.findIndex(n => /_(end|min|max|drift)$/.test(n))).filter(n => !t.has(`${n}_drift`));
  const words = {finished: "to its end", estimated_time_error: "estimated time error", frequency: withUnit("frequency", "1/time")};
  const cell = (c, i) => /(^|_)finished$/.test(c) ? (t.at(c, i) ? "yes" : "no") : c === "frequency" && !t.at(c, i) ? "none" : show(t.at(c, i), 5);
  return section(failed.length ? "Runs that stopped early" : "Runs", `${listed.length} of ${failed.length || t.n}; the file sweep.csv has all, with the values at the end.`, tableOf(head.map(c => words[c] || c), listed.map(i => head.map(c => cell(c, i)))));
}

// Over two parameters of three values or more each: frequency, amplitude and the drift of the energy, or, where a run has
// none of them, what else there is.
const MOST_MAPS = 3;
function mapSections(t, swept, x, quantities, drawn) {
  if (swept.length !== 2) return [];
  const y = swept.find(name => name !== x);
  if ([x, y].some(name => new Set(t.columns[name]).size < 3)) return [];
  let maps = quantities.filter(q => q.isMap || q.base === "frequency" || q.base === "amplitude");
  if (t.has("energy_drift")) {
    const size = largest(t.columns.energy) || 1;
    maps.push({title: "drift of the energy, over its largest value", y: t.columns.energy_drift.map(v => v / size), note: "Runs that are integrated together share a step, so the drift can jump between groups."});
  }
  maps = maps.concat(drawn.filter(q => !maps.includes(q))).slice(0, Math.max(MOST_MAPS, maps.filter(q => q.isMap).length));
  return section("Map", `Over ${x} and ${y}: a cell for each run. Grey: the run has no such value.`, make("div", {class: "charts"}, maps.map(m => mapChart({title: m.title, note: m.note, x: t.columns[x], y: t.columns[y], values: m.y, xLabel: x, yLabel: y}))));
}

// Rising in brightness, so that they keep their order in grey (matplotlib's viridis at nine places).
const RAMP = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
const rampColor = part => colorOf(RAMP, part);

// Borders of the cells about values: halfway between neighbours, the first and the last as wide as their halves.
function borders(values) {
  const v = [...new Set(values)].sort((a, b) => a - b), middle = v.slice(1).map((b, i) => (v[i] + b) / 2);
  return {values: v, edges: [2 * v[0] - middle[0], ...middle, 2 * v[v.length - 1] - middle[middle.length - 1]]};
}

const N_COLORS = 64;
function mapChart({title, note = "", x, y, values, xLabel, yLabel, height = 260}) {
  const host = make("div"), readout = make("div", {class: "readout"});
  const columns = borders(x), rows = borders(y), finite = values.filter(Number.isFinite), positive = finite.filter(v => v > 0);
  const isLogarithmic = positive.length > 0 && positive.length === finite.length && largest(finite) > 100 * extent(finite)[0];
  const scaled = v => isLogarithmic ? Math.log10(v) : v, [low, high] = finite.length ? padless(extent(finite.map(scaled))) : [0, 1];
  const level = v => Math.min(N_COLORS - 1, Math.floor(N_COLORS * (scaled(v) - low) / (high - low)));
  const redraw = () => {
    const width = Math.max(260, host.clientWidth || 350);
    host.replaceChildren();
    const svg = draw(host, "svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${title} over ${xLabel} and ${yLabel}`});
    const yTicks = ticks([rows.edges[0], rows.edges.at(-1)], 5), yTexts = tickLabels(yTicks);
    const scaleTicks = isLogarithmic ? ticks([low, high], Math.min(5, Math.max(1, high - low))).filter(v => high - low < 1 || Math.abs(v - Math.round(v)) < 1e-9) : ticks([low, high], 5);
    const scaleTexts = isLogarithmic ? scaleTicks.map(v => show(10 ** v, 2)) : tickLabels(scaleTicks);
    const left = 30 + 7 * Math.max(...yTexts.map(s => s.length)), right = width - 34 - 7 * Math.max(1, ...scaleTexts.map(s => s.length)), top = 8, bottom = height - 38;
    const X = v => left + (right - left) * (v - columns.edges[0]) / (columns.edges.at(-1) - columns.edges[0]);
    const Y = v => bottom - (bottom - top) * (v - rows.edges[0]) / (rows.edges.at(-1) - rows.edges[0]);
    draw(svg, "rect", {class: "missing", x: left, y: top, width: right - left, height: bottom - top});
    const cells = Array.from({length: N_COLORS}, () => "");
    const at = new Map(columns.values.map((v, k) => [v, k])), up = new Map(rows.values.map((v, k) => [v, k]));
    for (let i = 0; i < values.length; ++i) {
      if (!Number.isFinite(values[i])) continue;
      const a = at.get(x[i]), b = up.get(y[i]);
      cells[level(values[i])] += `M${X(columns.edges[a]).toFixed(2)} ${Y(rows.edges[b]).toFixed(2)}H${X(columns.edges[a + 1]).toFixed(2)}V${Y(rows.edges[b + 1]).toFixed(2)}H${X(columns.edges[a]).toFixed(2)}z`;
    }
    cells.forEach((d, k) => { if (d) draw(svg, "path", {d, fill: rampColor((k + 0.5) / N_COLORS), "shape-rendering": "crispEdges"}); });
    const xTicks = ticks([columns.edges[0], columns.edges.at(-1)], Math.max(3, (right - left) / 52)), xTexts = tickLabels(xTicks);
    xTicks.forEach((v, i) => draw(svg, "text", {x: X(v), y: bottom + 15, "text-anchor": "middle"}, xTexts[i]));
    yTicks.forEach((v, i) => draw(svg, "text", {x: left - 6, y: Y(v) + 4, "text-anchor": "end"}, yTexts[i]));
    draw(svg, "rect", {class: "frame", x: left, y: top, width: right - left, height: bottom - top});
    draw(svg, "text", {x: (left + right) / 2, y: height - 5, "text-anchor": "middle"}, xLabel);
    draw(svg, "text", {x: 0, y: 0, "text-anchor": "middle", transform: `translate(11 ${(top + bottom) / 2}) rotate(-90)`}, yLabel);
    const place = v => bottom - (bottom - top) * (v - low) / (high - low);
    for (let k = 0; k < N_COLORS; ++k) draw(svg, "rect", {x: right + 10, y: bottom - (bottom - top) * (k + 1) / N_COLORS, width: 12, height: (bottom - top) / N_COLORS + 0.5, fill: rampColor((k + 0.5) / N_COLORS)});
    scaleTicks.forEach((v, i) => draw(svg, "text", {x: right + 27, y: place(v) + 4}, scaleTexts[i]));
    const nearestTo = (places, px, P) => places.reduce((a, b) => Math.abs(P(b) - px) < Math.abs(P(a) - px) ? b : a);
    svg.addEventListener("pointermove", event => {
      const box = svg.getBoundingClientRect();
      const a = nearestTo(columns.values, (event.clientX - box.left) / box.width * width, X), b = nearestTo(rows.values, (event.clientY - box.top) / box.height * height, Y);
      const i = values.findIndex((_, k) => x[k] === a && y[k] === b);
      readout.textContent = i < 0 ? "" : `${xLabel} ${show(a)}, ${yLabel} ${show(b)}: ${show(values[i], 6)}`;
    });
    svg.addEventListener("pointerleave", () => { readout.textContent = ""; });
  };
  redraws.push(redraw);
  return figureOf(title, readout, [host], [isLogarithmic ? "The colour scale is logarithmic." : "", note].filter(Boolean).join(" "), []);
}

// A range that is not empty.
const padless = ([least, most]) => most > least ? [least, most] : padded([least, most]);
