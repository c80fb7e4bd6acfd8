// The page from top to bottom.

const STATES = {done: ["done", "complete"], interrupted: ["stopped", "interrupted"], failed: ["stopped", "stopped early"],
  running: ["stopped", "not ended: still running, or killed"], unknown: ["stopped", "without a manifest"]};

// A run in words, where no comparison has said it.
function inWords() {
  if (comparison && comparison.summary) return comparison.summary.replaceAll("+-", "±").replace(/ (=|±|%)/g, "\u00a0$1").replace(/(=|±) /g, "$1\u00a0");
  if (tables.modes) {
    const c = tables.modes.columns, off = Math.max(...c.omega.map((w, i) => Math.abs(w / c.exact[i] - 1))), [{ball}] = ballsOf("modes");
    return `The ${tables.modes.n} lowest frequencies of the ${ball} about rest lie from ${show(c.omega[0], 6)} to ${show(c.omega[tables.modes.n - 1], 6)}; they differ from the exact ones of the sphere by at most ${show(off, 2)}, relatively.`;
  }
  if (loveTables().length) {
    const [{ball, table}] = loveTables().slice(-1);
    return `The Love numbers of the ${ball}: h = ${show(table.at("h", 0), 6)}, k = ${show(table.at("k", 0), 6)}, l = ${show(table.at("l", 0), 6)} for degree ${table.at("degree", 0)}; the exact sphere has h = ${show(table.at("h_exact", 0), 6)}.`;
  }
  if (tables.connections) return `${tables.connections.n} motions on the manifolds of ${tables.equilibria.n} critical points of the potential.`;
  if (tables.section) return `${tables.section.n} crossings of ${scene["Section/Column"]} = ${scene["Section/Value"]}.`;
  if (tables.equilibria && !tables.equilibria.has("kind")) return `${tables.equilibria.n} critical points of the potential.`;
  const families = ballsOf("equilibria").map(({name}) => tables[name].columns.kind);
  if (families.length) {
    const n = f => families.reduce((sum, kind) => sum + kind.filter(f).length, 0);
    return `${n(k => k === 0)} members of the family of relative equilibria ${scene["Equilibrium/Family"]}, and ${n(k => k > 0)} special points on it.`;
  }
  if (tables.sweep) {
    const n_stopped = [...Array(tables.sweep.n).keys()].filter(i => !hasFinished(tables.sweep, i)).length;
    return `${tables.sweep.n} runs of a sweep; ${n_stopped ? `${n_stopped} of them stopped early` : "all reached their end"}.`;
  }
  const bodies = (systemFile ? [{name: scene.System, table: tables[systemFile]}] : MODELS).filter(b => b.table);
  const text = bodies.map(({name, table}) => {
    const span = `the ${name} from time ${show(table.at("time", 0))} to ${show(table.at("time", table.n - 1))}, in ${table.n} samples`;
    if (!table.has("energy")) return span;
    const first = table.at("energy", 0), drift = largest(table.columns.energy.map(e => e - first));
    return drift > 0.01 * Math.abs(first) ? `${span}, its energy from ${show(first)} to ${show(table.at("energy", table.n - 1))}` : `${span}, its energy ${show(first)} at the start and within ${show(drift, 2)} of it later`;
  }).join("; ");
  return text ? `${text[0].toUpperCase()}${text.slice(1)}.` : "There are no samples yet.";
}

function head() {
  const title = manifest.title || scene.Title || "A run of pseudorigid";
  document.title = title;
  const [style, words] = STATES[manifest.state] || STATES.unknown;
  const sentence = manifest.scene ? manifest.scene[0].toUpperCase() + manifest.scene.slice(1) + "." : "";
  return [make("h1", {}, title), make("p", {}, make("span", {class: `state ${style}`}, words), ` ${sentence}`),
    manifest.message ? make("p", {class: "warning"}, `The run ended early: ${manifest.message}. The page shows the results until then.`) : null,
    ...(manifest.warnings || []).map(w => make("p", {class: "warning"}, `${w}.`)), make("p", {class: "lead"}, inWords())];
}

// Entries of the scene that say what was asked for; the others are in used.prm.
function sceneSections() {
  const motion = (scene.Analysis || "motion") === "motion", ball = !systemFile;
  const incompressible = scene["Body/Incompressible"] === "true";
  const given = name => scene[name] !== undefined && scene[name] !== "";
  const zero = name => !given(name) || /^[0 ,;.]*$/.test(scene[name]);
  const asked = [["Models", "Models"], ["System", "System"], ["Analysis", "Analysis"]];
  const loads = Object.keys(scene).filter(e => /^(Loads|Companions)\//.test(e) && !/^(auto|false)$/.test(scene[e]));
  if (ball) asked.push(["Stored energy", "Material/Law"], ...["Body/Semi-axes", "Body/Inertia", "Material/Viscosity", "Material/Drag", "Material/Branch moduli", "Material/Branch times", "Gravity/Constant", "Gravity/Gamma", ...loads]
    .filter(e => !zero(e) && !(e === "Body/Semi-axes" && scene[e] === "1, 1, 1") && !(e === "Body/Inertia" && scene[e] === "auto"))
    .map(e => [({"Gravity/Constant": "Gravitational constant", "Gravity/Gamma": "Self-gravity γ = ρgr/μ"})[e] || e.replace(/^(Loads|Material|Body)\//, "").replace("Companions/", "Companions: "), e]));
  if (ball && motion) asked.push(["Initial deformation Q₀", "Initial state/Deformation"], ["Initial velocity Q̇₀", "Initial state/Velocity"], ...["Initial state/Equilibrium"].filter(e => given(e) && scene[e] !== "none").map(e => ["Initial equilibrium", e]));
  if (!ball) asked.push(...Object.keys(scene).filter(e => e.toLowerCase().startsWith(`${scene.System}/`)).map(e => [e.split("/")[1], e]));
  if (ball && scene.Analysis === "equilibrium") asked.push(["Family", "Equilibrium/Family"], ...(scene["Equilibrium/Number"] === "1" ? [["Parameter", "Equilibrium/First"]] : [["Parameter from", "Equilibrium/First"], ["to", "Equilibrium/Last"]]));
  if (motion) asked.push(["End", "Time/End"], ["Method", "Time/Method"], ["Tolerance of the time error", "Time/Tolerance"]);
  if (ball && (manifest.ball || []).some(model => model.discretized)) asked.push(["Degree of the finite elements", "Continuum/Degree"], ["Refinements", "Continuum/Refinements"], ["Mesh", "Continuum/Mesh"]);
  asked.push(...["Sweep/Parameters"].filter(given).map(e => ["Sweep", e]));
  const rows = asked.filter(([, e]) => given(e)).map(([label, e]) => [label, make("td", {class: "words"}, scene[e])]);
  if (ball) rows.splice(1, 0, ["Volume", make("td", {class: "words"}, incompressible ? "preserved (incompressible)" : `may change (Lamé λ = ${scene["Material/Lame lambda"]})`)]);
  const units = isUnitBall ? "Units: radius r = 1, density ρ = 1, shear modulus μ = 1; so times are in r/c with c = √(μ/ρ), energies in ρr³c²."
    : "Units are the scene's own: any consistent set of length, mass and time.";
  return section("Scene", units, tableOf(null, rows));
}

const describedColumns = name => Object.fromEntries(((manifest.columns || {})[`${name}.csv`] || []).map(c => [c.name, c]));

// A chart for each column of any table; columns that are equal share one. What is constant, or nothing but round-off
// beside the columns of the same unit, is named in a line of text.
const LABELS = ["index", "kind", "degree", "odd_in_z", "m"];  // names of what a row is, no functions of the parameter
function genericCharts(name, x, xLabel, style) {
  const table = tables[name], described = describedColumns(name), of = (column, what) => (described[column] || {})[what] || "";
  const columns = table.names.filter(n => n !== x && !LABELS.includes(n)).map(n => ({names: [n], y: table.columns[n], unit: of(n, "unit"), size: largest(table.columns[n])}));
  const scaleOf = unit => unit ? Math.max(...columns.filter(c => c.unit === unit).map(c => c.size)) : 1;
  const level = columns.filter(c => { const [least, most] = extent(c.y); return most - least <= 1e-13 * c.size; });
  const noise = columns.filter(c => !level.includes(c) && c.size <= 1e-12 * scaleOf(c.unit));
  const groups = [];
  for (const c of columns.filter(c => !level.includes(c) && !noise.includes(c))) {
    const same = groups.find(g => g.unit === c.unit && g.y.every((v, i) => Math.abs(v - c.y[i]) <= 1e-12 * scaleOf(c.unit)));
    if (same) same.names.push(...c.names); else groups.push(c);
  }
  const every = Array.from({length: table.n}, (_, i) => i), degrees = table.has("degree") ? [...new Set(table.columns.degree)] : [];
  const lines = degrees.length > 1 ? degrees.map((N, k) => ({name: `N = ${N}`, style: `line${k % 6}`, rows: every.filter(i => table.at("degree", i) === N)})) : [{name: "", style, rows: every}];
  const charts = groups.map(g => {
    const {name: title, y} = fromFirst(g.names.join(" = "), g.y), meaning = of(g.names[0], "meaning");
    const jump = /-pi to pi|^angle.*likewise/.test(meaning) ? Math.PI : 0;
    return chart({title: withUnit(title, g.unit), note: /^(likewise|as for)/.test(meaning) ? "" : meaning, xLabel,
      series: lines.map(({rows, ...line}) => ({...line, x: rows.map(i => table.columns[x][i]), y: rows.map(i => y[i]), jump}))});
  });
  const values = [...new Set(level.map(c => show(c.y[0], 6)))].map(v => `${level.filter(c => show(c.y[0], 6) === v).map(c => c.names[0]).join(" = ")} = ${v}`);
  return [lines.length > 1 ? legend(lines) : null, make("div", {class: "charts"}, charts), values.length ? make("p", {class: "note"}, `Constant: ${values.join(", ")}.`) : null,
    noise.length ? make("p", {class: "note"}, `Zero but for round-off: ${noise.map(c => `${c.names[0]} (up to ${show(c.size, 1)})`).join(", ")}.`) : null];
}

// Of each row a column: a few rows of many columns.
const MOST_COLUMNS = 12;
function turnedTable(name) {
  const table = tables[name], described = describedColumns(name), of = c => (described[c] || {}).unit || "", shown = Array.from({length: Math.min(table.n, MOST_COLUMNS)}, (_, i) => i);
  const scaleOf = unit => Math.max(unit ? 0 : 1, ...table.names.filter(c => of(c) === unit).map(c => largest(table.columns[c])));
  return [tableOf(null, table.names.map(c => [withUnit(c, of(c)), ...shown.map(i => Math.abs(table.at(c, i)) <= 1e-12 * scaleOf(of(c)) ? "0" : show(table.at(c, i), 6))])),
    table.n > MOST_COLUMNS ? make("p", {class: "note"}, `The first ${MOST_COLUMNS} of ${table.n}; the file ${name}.csv has all.`) : null];
}

// Files of modes and of equilibria, of each with the ball that wrote it: modes.csv is of the richest model that has modes,
// modes-<model>.csv of another one.
const ballsOf = stem => [[stem, (manifest.ball || []).filter(b => stem === "modes" ? !b.affine : b.affine).at(-1)], ...(manifest.ball || []).map(b => [`${stem}-${b.name}`, b])]
  .filter(([name]) => tables[name]).map(([name, ball]) => ({name, ball: ball ? `${adjectiveOf(ball)} ball` : "ball"}));

function modesSections() {
  const all = ballsOf("modes");
  return all.flatMap(({name, ball}) => modesOf(tables[name], ball, all.length > 1 ? `Modes of the ${ball}` : "Modes"));
}

function modesOf(t, ball, heading) {
  const omegas = showAlike([...t.columns.omega], 9), exact = showAlike([...t.columns.exact], 9);
  const rows = Array.from({length: t.n}, (_, i) => {
    const at = c => t.at(c, i);
    return [`${at("kind") === 1 ? "S" : "T"}${at("degree")}${at("overtone") ? `, overtone ${at("overtone")}` : ""}`, at("kind") === 1 ? "spheroidal" : "toroidal", at("multiplicity"), omegas[i], exact[i],
      show(at("omega") / at("exact") - 1, 2), show(at("spread"), 2), at("reduced") ? show(at("reduced"), 7) : ""];
  });
  const of = kind => [...Array(t.n).keys()].filter(i => t.at("kind", i) === kind);
  const series = [[1, "elastic", "spheroidal"], [2, "other", "toroidal"]].map(([kind, style, name]) => ({x: of(kind).map(i => t.at("degree", i)), y: of(kind).map(i => t.at("omega", i)), name, style, points: true})).filter(s => s.x.length);
  const reduced = [...Array(t.n).keys()].filter(i => t.at("reduced", i) > 0);
  if (reduced.length) series.push({x: reduced.map(i => t.at("degree", i)), y: reduced.map(i => t.at("reduced", i)), name: "pseudo-rigid", style: "pseudo-rigid", points: true});
  const most = Math.max(...series.flatMap(s => s.x));
  return section(heading, "Small motions about rest. S: spheroidal, T: toroidal, with the degree; difference: to the exact sphere; spread: of the copies of a mode, which are equal but for the discretisation.",
    make("div", {class: "legend"}, series.map(s => { const svg = document.createElementNS(SVG, "svg"); svg.setAttribute("width", 16); svg.setAttribute("height", 16); marker(svg, s.style, 8, 8); return make("span", {}, svg, s.name === "pseudo-rigid" ? "pseudo-rigid ball" : `${ball}, ${s.name}`); })),
    make("div", {class: "charts wide"}, chart({title: "Frequencies by degree", series, xLabel: "degree of the mode", wholeX: true, yLabel: withUnit("ω", "1/time"), xRange: [-0.3, most + 0.3], height: 320})),
    tableOf(["mode", "kind", "copies", withUnit("ω", "1/time"), "exact sphere", "difference", "spread", "pseudo-rigid ball"], rows));
}

// Love numbers of each run, love-<run>.csv.
const loveTables = () => (manifest.ball || []).map(b => ({ball: `${adjectiveOf(b)} ball`, affine: b.affine, table: tables[`love-${b.name}`]})).filter(({table}) => table);

function loveSections() {
  const all = loveTables();
  if (!all.length) return [];
  const {table: last} = all.at(-1), values = (t, c) => ({x: [...t.columns.degree], y: [...t.columns[c]]});
  const series = all.map(({ball, affine, table}, i) => ({...values(table, "h"), name: ball, style: affine ? "pseudo-rigid" : i === all.length - 1 ? "elastic" : "other", points: true}));
  const errorOf = (t, c, i) => t.at(c, i) ? `± ${show(t.at(c, i), 2)}` : "";
  const rows = all.flatMap(({ball, table: t}) => Array.from({length: t.n}, (_, i) => [ball, t.at("degree", i), show(t.at("h", i), 8), errorOf(t, "h_error", i), show(t.at("h_exact", i), 8), show(t.at("l", i), 8), errorOf(t, "l_error", i), show(t.at("l_exact", i), 8), ...["k", "k_exact", "h_load", "l_load", "k_load"].map(c => show(t.at(c, i), 6))]));
  return section("Love numbers", "Static response to tides of degree n (h, l, k) and to masses on the surface (h′, l′, k′). The line is the exact homogeneous sphere; ± bounds the error of the discretisation.",
    make("div", {class: "legend"}, series.map(s => { const svg = document.createElementNS(SVG, "svg"); svg.setAttribute("width", 16); svg.setAttribute("height", 16); marker(svg, s.style, 8, 8); return make("span", {}, svg, s.name); })),
    make("div", {class: "charts wide"}, chart({title: "h by degree", series: [{...values(last, "h_exact"), name: "exact sphere", style: "elastic"}, ...series], xLabel: "degree n of the tide", wholeX: true, yLabel: "h", height: 320})),
    tableOf(["body", "n", "h", "error", "exact h", "l", "error", "exact l", "k", "exact k", "h′", "l′", "k′"], rows));
}

// An angle that counts its turns, in a range that has 0 and π in its inside.
const isAngle = name => /full turns are counted|-pi to pi|^angle.*likewise/.test((describedColumns(systemFile)[name] || {}).meaning || "");
const wrapped = (name, values) => isAngle(name) ? values.map(v => v - 2 * Math.PI * Math.floor((v + Math.PI / 2) / (2 * Math.PI))) : values;

// The manifolds over the first two columns of the system, and where they end.
function manifoldsSections() {
  const t = tables.manifolds, ends = tables.connections;
  if (!t || !ends) return [];
  const [first, second] = t.names.slice(4, 6), x = wrapped(first, [...t.columns[first]]), y = wrapped(second, [...t.columns[second]]);
  const of = stable => {
    const curve = {x: [], y: []};
    for (let i = 0; i < t.n; ++i) {
      if (t.at("stable", i) !== stable) continue;
      const begins = i === 0 || t.at("curve", i) !== t.at("curve", i - 1), jumps = (v, name) => isAngle(name) && Math.abs(v[i] - v[i - 1]) > Math.PI;
      if (begins || jumps(x, first) || jumps(y, second)) { curve.x.push(NaN); curve.y.push(y[i]); }
      curve.x.push(x[i]); curve.y.push(y[i]);
    }
    return curve;
  };
  const curves = [[0, "elastic", "unstable manifolds"], [1, "pseudo-rigid", "stable manifolds, along single directions"]].map(([stable, style, name]) => ({...of(stable), name, style: `${style} manifold`})).filter(s => s.x.length);
  const e = tables.equilibria, points = e.has(first) && e.has(second) ? [{x: wrapped(first, [...e.columns[first]]), y: wrapped(second, [...e.columns[second]]), name: "critical points", style: "other", points: true}] : [];
  const groups = new Map();
  for (let i = 0; i < ends.n; ++i) {
    const key = ["from", "stable", "to"].map(c => ends.at(c, i)).join();
    groups.set(key, (groups.get(key) || 0) + 1);
  }
  const rows = [...groups].map(([key, n]) => { const [from, stable, to] = key.split(","); return [from, stable === "1" ? "stable" : "unstable", n, to === "0" ? "none" : to]; });
  return section("Manifolds of the critical points", "Motions on the unstable manifolds, and backwards in time on the stable ones. Squares: the critical points, numbered by rising potential.",
    legend(curves), make("div", {class: "charts wide"}, chart({title: `${second} over ${first}`, series: [...curves, ...points], xLabel: first, yLabel: second, height: 420, reads: false})),
    tableOf(["from point", "manifold", "motions", "to point"], rows));
}

// The points of a section: the first column beside that of the section, and its rate.
function sectionSections() {
  const t = tables.section;
  if (!t) return [];
  const others = t.names.filter(n => n !== "time" && n !== scene["Section/Column"]), first = others[0];
  const second = [`${first}_dot`, `v${first}`].find(n => t.has(n)) || others[1];
  const unit = n => (describedColumns(systemFile)[n] || {}).unit || "";
  return section("Section", `Where the motion crosses ${scene["Section/Column"]} = ${scene["Section/Value"]} (${scene["Section/Direction"]}).`,
    make("div", {class: "charts wide"}, chart({title: `${second} over ${first}`, series: [{x: wrapped(first, [...t.columns[first]]), y: [...t.columns[second]], name: "", style: "dot", points: true}], xLabel: withUnit(first, unit(first)), yLabel: withUnit(second, unit(second)), height: 420})));
}

const FAMILY_PARAMETERS = {maclaurin: "eccentricity e", spheroids: "a3 / radius", spinning: withUnit("spin", "1/time")};
const SPECIAL = {1: "fold: spin or circulation has an extremum", 3: "index: the number of negative directions changes, a branch may leave", 4: "instability: a growth rate begins or ends"};
function equilibriaSections() {
  const t = tables.equilibria, hasPoints = t && !t.has("parameter");
  const points = hasPoints ? section("Critical points of the potential", "A column for each, by rising potential; 0: less than 1e−12 of the largest of the same unit.", turnedTable("equilibria")) : [];
  const all = ballsOf("equilibria").filter(({name}) => tables[name].has("parameter"));
  return [...points, ...all.flatMap(({name, ball}) => familySections(name, hasPoints || all.length > 1 ? `: ${ball}` : ""))];
}

function familySections(name, whose) {
  if (scene["Equilibrium/Family"] === "static") return section(`Figure at rest${whose}`, "Under the loads, or under the part of them for which a figure was found.", turnedTable(name));
  const t = tables[name], special = [...Array(t.n).keys()].filter(i => t.at("kind", i) > 0);
  const columns = ["degree", "parameter", "omega3", "a1", "a2", "a3", "energy", "J3", "growth_rate"].filter(t.has), described = describedColumns(name);
  const family = scene["Equilibrium/Family"], parameter = FAMILY_PARAMETERS[family] || "a2 / a1";
  const shown = columns.map(c => c === "degree" ? special.map(i => t.at(c, i)) : showAlike(special.map(i => t.at(c, i)), 7));
  const title = c => c === "parameter" ? parameter : make("th", {}, c, make("br"), make("span", {class: "unit"}, unitInWords((described[c] || {}).unit).split(/(?<=[·/])/).flatMap(part => [part, make("wbr")])));
  return [...section(`Special points of the family${whose}`, "", special.length ? tableOf(["kind", ...columns.map(title)], special.map((i, k) => [`${t.at("kind", i)}: ${SPECIAL[t.at("kind", i)]}`, ...shown.map(column => column[k])])) : make("p", {}, "None in this range.")),
    ...section(`Along the family${whose}`, `Over the parameter of the family ${family}: ${parameter}.`, genericCharts(name, "parameter", parameter, "pseudo-rigid solid"))];
}

// Those that are not here stand at the end, under their own names.
const COUNTERS = {steps: "steps", substeps: "substeps of compositions", forces: "evaluations of the force", step: withUnit("longest step allowed", "time"), order: "order of the method", cells: "cells", newton_steps: "steps of Newton's iteration", factorizations: "factorisations of a tangent", gmres_iterations: "iterations of GMRES", unknowns: "unknowns",
  images: "reflections that make the ball", multipliers: "multipliers", gram_solves: "constraint solves", gram_iterations: "iterations of the constraint solver", gram_iterations_at_most: "of one solve at most", gram_renewals: "renewals of its preconditioner",
  position_iterations: "iterations on the constraint", velocity_projections: "projections of the velocity", max_scaled_constraint: "largest violation of the constraint", max_scaled_constraint_rate: "largest violation of its rate",
  pilot_forces: "evaluations of the force in pilot runs", repeated_intervals: "intervals between samples integrated again with shorter steps", failed_intervals: "of these, because a step failed", repeated_forces: "evaluations of the force in repeated attempts, in addition", stable_steps: "steps of rattle at its limit of stability along the motion", largest_frequency: withUnit("largest frequency", "1/time"), estimated_time_error: "estimated error in time", estimated_space_error: "estimated error in space, largest entry of Q", relative_space_error: "estimated error in space, relative",
  quadrature_points: "points of quadrature in a direction of an octant", estimated_quadrature_error: "estimated error of the quadrature", quadrature_pilot_forces: "evaluations of the force in pilot runs of the quadrature",
  work: "unknowns × evaluations, pilot runs included", companion_degree: "degree of the companion run", companion_refinements: "refinements of the companion run", companion_work: "companion runs: unknowns × evaluations", least_surface_stretch_ratio: "least stretch ratio at the surface (Biot's limit 0.2956)", surface_limit_time: withUnit("time at Biot's limit", "time"),
  gram_bytes: "memory of the constraint solver", messages_of_a_rank: "messages of a rank, mean", message_bytes_of_a_rank: "bytes in them", reductions: "operations in which all ranks wait for one another", kernel_bytes: "memory of the force's kernels"};
const TIMERS = {run: "wall time (s)", companion: "wall time of the companion runs (s)"};
function costSections() {
  const models = Object.entries(manifest.models);
  if (!models.length) return [];
  const names = [...new Set(models.flatMap(([, m]) => Object.keys(m.counters || {})))].sort((a, b) => (COUNTERS[a] ? Object.keys(COUNTERS).indexOf(a) : 99) - (COUNTERS[b] ? Object.keys(COUNTERS).indexOf(b) : 99));
  const timers = [...new Set(models.flatMap(([, m]) => Object.keys(m.timers || {})))].sort((a, b) => (b === "run") - (a === "run"));
  const cell = (value, name) => value === undefined ? "" : name.endsWith("_bytes") ? `${show(value / 1048576, 3)} MiB` : Number.isInteger(value) ? value.toLocaleString("en").replaceAll(",", "\u202f") : show(value);
  const rows = [...timers.map(t => [TIMERS[t] || `wall time of ${t.replaceAll("_", " ")} (s)`, ...models.map(([, m]) => t in (m.timers || {}) ? show(m.timers[t], 3) : "")]),
    ...names.map(n => [COUNTERS[n] || n.replaceAll("_", " "), ...models.map(([, m]) => cell((m.counters || {})[n], n))])];
  const named = key => (manifest.ball || []).find(model => model.name === key);
  const title = key => named(key) ? `${adjectiveOf(named(key))} ball` : key.replaceAll("_", " ");
  const memory = manifest.peak_memory_bytes ? ` and ${show(manifest.peak_memory_bytes / 1e6, 3)} MB of memory` : "";
  return section("Cost", manifest.wall_seconds ? `The whole run took ${show(manifest.wall_seconds, 3)} s${memory} on ${manifest.cpu}.` : "", tableOf(["", ...models.map(([key]) => title(key))], rows));
}

function needsSections() {
  const list = (title, lines) => lines && lines.length ? make("div", {}, make("h3", {}, title), make("ul", {}, lines.map(line => make("li", {}, line)))) : null;
  const lists = [list("Needed", manifest.needed), list("Skipped", manifest.skipped)].filter(Boolean);
  return lists.length ? section("Parts computed and parts skipped", "", make("div", {class: "columns"}, lists)) : [];
}

function originSections() {
  const rows = [["program", manifest.version && `${manifest.program} ${manifest.version}, commit ${manifest.git_hash}`], ["compiler", manifest.compiler && `${manifest.compiler}, ${manifest.flags}, ${manifest.build_type}`],
    ["libraries", Object.entries(manifest.libraries || {}).map(l => l.join(" ")).join(", ")], ["processor", manifest.cpu], ["command", (manifest.command || []).join(" ")], ["start and end", [manifest.start, manifest.end].filter(Boolean).join(" to ")]]
    .filter(([, text]) => text).map(([label, text]) => [label, make("td", {class: "words"}, text)]);
  const files = [...document.querySelectorAll("script[data-file]")].map(e => e.dataset.file).filter(name => fileText(name));
  const buttons = files.map(name => {
    const button = make("button", {type: "button"}, name);
    button.addEventListener("click", () => {
      const link = make("a", {download: name});
      link.href = URL.createObjectURL(new Blob([fileText(name)]));
      link.click();
    });
    return button;
  });
  return section("Provenance", "", tableOf(null, rows), make("p", {class: "files"}, "This page contains the files of the run: ", buttons.flatMap(b => [b, " "])));
}

function bodiesSections() {
  const figure = MODELS.length ? bodiesFigure() : null;
  return figure ? section("The bodies", "", figure) : [];
}

const MOST_CHARTS = 8;
function systemSections() {
  if (!systemFile || !tables[systemFile]) return [];
  const content = genericCharts(systemFile, "time", timeLabel, "elastic"), charts = content.find(node => node && node.className === "charts");
  const others = [...charts.children].slice(MOST_CHARTS);
  return [...section("Motion", "", content), others.length ? more(`More charts (${others.length})`, [make("div", {class: "charts"}, others)]) : null];
}

// Sections that are drawn when somebody opens them.
function more(title, nodes) {
  const content = nodes.flat().filter(Boolean);
  if (!content.length) return null;
  const details = make("details", {}, make("summary", {}, title), ...content);
  details.addEventListener("toggle", () => redraws.forEach(redraw => redraw()));
  window.addEventListener("beforeprint", () => { details.open = true; });
  return details;
}

const behindMore = [differenceSections(), bodiesSections(), deformationSections(), nonaffineSections(), energySections()];
const isFieldModel = MODELS.some(m => m.shapes);
document.getElementById("report").append(...[head(), setupSections(), overviewOfRun(), isFieldModel ? [] : behindMore.splice(1, 1), orbitSections(), systemSections(), keySections(),
  more("More charts: differences, bodies, deformation, energies, momenta", behindMore), modesSections(), loveSections(), manifoldsSections(), sectionSections(), equilibriaSections(),
  sweepSections(), sceneSections(), costSections(), needsSections(), originSections()].flat(Infinity).filter(Boolean));
redraws.forEach(redraw => redraw());
