// The page from top to bottom.

const STATES = {done: ["done", "complete"], interrupted: ["stopped", "interrupted"], failed: ["stopped", "stopped early"],
  running: ["stopped", "not ended: still running, or killed"], unknown: ["stopped", "without a manifest"]};

function sum(model, timer) {
  return (model.timers || {})[timer] || 0;
}

// A run in words, where no comparison has said it.
function inWords() {
  if (comparison && comparison.summary) return comparison.summary.replaceAll("+-", "±");
  if (tables.modes) {
    const c = tables.modes.columns, off = Math.max(...c.omega.map((w, i) => Math.abs(w / c.exact[i] - 1)));
    return `The ${tables.modes.n} lowest frequencies of the elastic ball about rest lie from ${show(c.omega[0], 6)} to ${show(c.omega[tables.modes.n - 1], 6)}; they differ from the exact ones of the sphere by at most ${show(off, 2)}, relatively.`;
  }
  if (tables.equilibria) return tables.equilibria.has("kind") ? `${tables.equilibria.columns.kind.filter(k => k === 0).length} members of the family of relative equilibria ${scene["Equilibrium/Family"]}, and ${tables.equilibria.columns.kind.filter(k => k > 0).length} special points on it.`
    : `${tables.equilibria.n} critical points of the potential.`;
  if (tables.sweep) return `${tables.sweep.n} runs of a sweep, ${tables.sweep.columns.finished.filter(f => f === 0).length} of which stopped early.`;
  const table = systemFile ? tables[systemFile] : MODELS.length ? MODELS[0].table : null;
  if (!table) return "There are no samples yet.";
  const drift = table.has("energy") ? extent(table.columns.energy.map(e => e - table.columns.energy[0])).map(Math.abs) : null;
  return `${systemFile ? `The ${scene.System}` : `The ${MODELS.map(m => m.name).join(" and the ")}`} from time ${show(table.at("time", 0))} to ${show(table.at("time", table.n - 1))}, in ${table.n} samples`
    + (drift ? `; its energy, ${show(table.at("energy", 0))} at the start, drifts by at most ${show(Math.max(...drift), 2)}.` : ".");
}

function head() {
  const title = manifest.title || scene.Title || "A run of pseudorigid";
  document.title = title;
  const [style, words] = STATES[manifest.state] || STATES.unknown;
  const sentence = manifest.scene ? manifest.scene[0].toUpperCase() + manifest.scene.slice(1) + "." : "";
  return [make("h1", {}, title), make("p", {}, make("span", {class: `state ${style}`}, words), ` ${sentence}`),
    manifest.message ? make("p", {class: "warning"}, `The run ended before its time: ${manifest.message}. What follows is what it had reached.`) : null,
    ...(manifest.warnings || []).map(w => make("p", {class: "warning"}, `${w}.`)), make("p", {class: "lead"}, inWords())];
}

// Entries of the scene that say what was asked for; the others are in used.prm.
function sceneSections() {
  const motion = (scene.Analysis || "motion") === "motion", ball = !systemFile;
  const incompressible = scene["Body/Incompressible"] === "true";
  const given = name => scene[name] !== undefined && scene[name] !== "";
  const zero = name => !given(name) || /^[0 ,;.]*$/.test(scene[name]);
  const asked = [["Models", "Models"], ["System", "System"], ["Analysis", "Analysis"]];
  if (ball) asked.push(["Stored energy", "Material/Law"], ...["Material/Viscosity", "Material/Drag", "Gravity/Constant", "Loads/Tidal matrix", "Loads/Acceleration", "Loads/Nominal traction"].filter(e => !zero(e)).map(e => [e.split("/")[1], e]));
  if (ball && motion) asked.push(["Initial deformation Q₀", "Initial state/Deformation"], ["Initial velocity Q̇₀", "Initial state/Velocity"], ...["Initial state/Equilibrium"].filter(e => given(e) && scene[e] !== "none").map(e => ["Initial equilibrium", e]));
  if (!ball) asked.push(...Object.keys(scene).filter(e => e.toLowerCase().startsWith(`${scene.System}/`)).map(e => [e.split("/")[1], e]));
  if (ball && scene.Analysis === "equilibrium") asked.push(["Family", "Equilibrium/Family"], ["Parameter from", "Equilibrium/First"], ["to", "Equilibrium/Last"]);
  if (motion) asked.push(["End", "Time/End"], ["Method", "Time/Method"], ["Tolerance of the time error", "Time/Tolerance"]);
  if (ball && (scene.Models || "").includes("continuum")) asked.push(["Degree of the finite elements", "Continuum/Degree"], ["Refinements", "Continuum/Refinements"], ["Mesh", "Continuum/Mesh"]);
  asked.push(...["Sweep/Parameters"].filter(given).map(e => ["Sweep", e]));
  const rows = asked.filter(([, e]) => given(e)).map(([label, e]) => [label, make("td", {class: "words"}, scene[e])]);
  if (ball) rows.splice(1, 0, ["Volume", make("td", {class: "words"}, incompressible ? "preserved (incompressible)" : `may change (Lamé λ = ${scene["Material/Lame lambda"]})`)]);
  const units = isUnitBall ? "Units: radius r = 1, density ρ = 1, shear modulus μ = 1; so times are in r/c with c = √(μ/ρ), energies in ρr³c²."
    : "Units are the scene's own: any consistent set of length, mass and time.";
  return section("Scene", units, tableOf(null, rows));
}

// A chart for each column of any table.
function genericCharts(name, x, xLabel, style, points = false) {
  const table = tables[name], described = Object.fromEntries(((manifest.columns || {})[`${name}.csv`] || []).map(c => [c.name, c]));
  const constant = [], charts = [];
  for (const column of table.names.filter(n => n !== x && n !== "index" && n !== "kind")) {
    const y = table.columns[column], [least, most] = extent(y), size = Math.max(Math.abs(least), Math.abs(most));
    const unit = (described[column] || {}).unit || "", meaning = (described[column] || {}).meaning || "";
    const note = meaning.startsWith("likewise") || meaning.startsWith("as for") ? "" : meaning;
    if (most - least <= 1e-13 * size) { constant.push(`${column} = ${show(y[0], 6)}`); continue; }
    const level = most - least < 1e-4 * size;  // its changes would be a straight line
    charts.push(chart({title: withUnit(level ? `${column} − its first value ${show(y[0], 6)}` : column, unit), note, xLabel,
      series: [{x: table.columns[x], y: level ? y.map(v => v - y[0]) : y, name: "", style, points}]}));
  }
  return [make("div", {class: "charts"}, charts), constant.length ? make("p", {class: "note"}, `Constant: ${constant.join(", ")}.`) : null];
}

function wholeTable(name, mostRows = 300) {
  const table = tables[name], rows = Array.from({length: Math.min(table.n, mostRows)}, (_, i) => table.names.map(c => show(table.at(c, i), 6)));
  return [tableOf(table.names, rows), table.n > mostRows ? make("p", {class: "note"}, `The first ${mostRows} of ${table.n} rows.`) : null];
}

function modesSections() {
  if (!tables.modes) return [];
  const t = tables.modes, rows = Array.from({length: t.n}, (_, i) => {
    const at = c => t.at(c, i);
    return [`${at("kind") === 1 ? "S" : "T"}${at("degree")}${at("overtone") ? `, overtone ${at("overtone")}` : ""}`, at("kind") === 1 ? "spheroidal" : "toroidal", at("multiplicity"), show(at("omega"), 9), show(at("exact"), 9),
      show(at("omega") / at("exact") - 1, 2), show(at("spread"), 2), at("reduced") ? show(at("reduced"), 7) : ""];
  });
  const of = kind => [...Array(t.n).keys()].filter(i => t.at("kind", i) === kind);
  const series = [[1, "elastic", "spheroidal"], [2, "other", "toroidal"]].map(([kind, style, name]) => ({x: of(kind).map(i => t.at("degree", i)), y: of(kind).map(i => t.at("omega", i)), name, style, points: true})).filter(s => s.x.length);
  const reduced = [...Array(t.n).keys()].filter(i => t.at("reduced", i) > 0);
  if (reduced.length) series.push({x: reduced.map(i => t.at("degree", i)), y: reduced.map(i => t.at("reduced", i)), name: "pseudo-rigid", style: "pseudo-rigid", points: true});
  const most = Math.max(...series.flatMap(s => s.x));
  return section("Modes", "Small motions about rest. S: spheroidal, T: toroidal, with the degree; difference: to the exact sphere; spread: of the copies of a mode, by the mesh alone.",
    make("div", {class: "legend"}, series.map(s => { const svg = document.createElementNS(SVG, "svg"); svg.setAttribute("width", 16); svg.setAttribute("height", 16); marker(svg, s.style, 8, 8); return make("span", {}, svg, s.name === "pseudo-rigid" ? "pseudo-rigid ball" : `elastic ball, ${s.name}`); })),
    make("div", {class: "charts wide"}, chart({title: "Frequencies by degree", series, xLabel: "degree of the mode", wholeX: true, yLabel: withUnit("ω", "1/time"), xRange: [-0.3, most + 0.3], height: 320})),
    tableOf(["mode", "kind", "copies", withUnit("ω", "1/time"), "exact sphere", "difference", "spread", "pseudo-rigid ball"], rows));
}

const SPECIAL = {1: "fold: spin or circulation has an extremum", 3: "index: the number of negative directions changes, a branch may leave", 4: "instability: a growth rate begins or ends"};
function equilibriaSections() {
  const t = tables.equilibria;
  if (!t) return [];
  if (!t.has("parameter")) return section("Critical points of the potential", "One row each, by rising potential.", wholeTable("equilibria"));
  const special = [...Array(t.n).keys()].filter(i => t.at("kind", i) > 0);
  const columns = ["parameter", "omega3", "a1", "a2", "a3", "energy", "J3", "growth_rate"].filter(t.has);
  return [...section("Special points of the family", "", special.length ? tableOf(["kind", ...columns], special.map(i => [`${t.at("kind", i)}: ${SPECIAL[t.at("kind", i)]}`, ...columns.map(c => show(t.at(c, i), 7))])) : make("p", {}, "None in this range.")),
    ...section("Along the family", "Over the family's parameter.", genericCharts("equilibria", "parameter", `parameter of ${scene["Equilibrium/Family"]}`, "pseudo-rigid solid"))];
}

const COUNTERS = {steps: "steps", substeps: "substeps of compositions", forces: "evaluations of the force", step: withUnit("step", "time"), order: "order of the method", cells: "cells", unknowns: "unknowns",
  images: "reflections that make the ball", multipliers: "multipliers", gram_iterations: "iterations of the constraint solver", gram_solves: "constraint solves", estimated_time_error: "estimated time error", relative_space_error: "estimated error in space, relative",
  pilot_forces: "evaluations of the force in pilot runs", largest_frequency: "largest frequency", position_iterations: "iterations on the constraint", velocity_projections: "projections of the velocity",
  max_scaled_constraint: "largest violation of the constraint", max_scaled_constraint_rate: "largest violation of its rate"};
function costSections() {
  const models = Object.entries(manifest.models);
  if (!models.length) return [];
  const names = [...new Set(models.flatMap(([, m]) => Object.keys(m.counters || {})))].sort((a, b) => (COUNTERS[a] ? Object.keys(COUNTERS).indexOf(a) : 99) - (COUNTERS[b] ? Object.keys(COUNTERS).indexOf(b) : 99));
  const timers = [...new Set(models.flatMap(([, m]) => Object.keys(m.timers || {})))];
  const cell = (value, name) => value === undefined ? "" : name.endsWith("_bytes") ? `${show(value / 1048576, 3)} MiB` : Number.isInteger(value) ? value.toLocaleString("en").replaceAll(",", "\u202f") : show(value);
  const rows = [...timers.map(t => [t === "run" ? "wall time (s)" : `wall time of ${t.replaceAll("_", " ")} (s)`, ...models.map(([, m]) => show(sum(m, t), 4))]),
    ...names.map(n => [COUNTERS[n] || n.replace(/_bytes$/, ": memory").replaceAll("_", " "), ...models.map(([, m]) => cell((m.counters || {})[n], n))])];
  const title = key => key === "continuum" ? "elastic ball" : key === "reduced" ? "pseudo-rigid ball" : key.replaceAll("_", " ");
  return section("Cost", manifest.wall_seconds ? `The whole run took ${show(manifest.wall_seconds, 3)} s on ${manifest.cpu}.` : "", tableOf(["", ...models.map(([key]) => title(key))], rows));
}

function needsSections() {
  const list = (title, lines) => lines && lines.length ? make("div", {}, make("h3", {}, title), make("ul", {}, lines.map(line => make("li", {}, line)))) : null;
  const lists = [list("Needed", manifest.needed), list("Skipped", manifest.skipped)].filter(Boolean);
  return lists.length ? section("What was needed, and what was skipped", "", make("div", {class: "columns"}, lists)) : [];
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
  return section("Where it comes from", "", tableOf(null, rows), make("p", {class: "files"}, "This page holds the run's files: ", buttons.flatMap(b => [b, " "])));
}

function bodiesSections() {
  const figure = MODELS.length ? bodiesFigure() : null;
  return figure ? section("The bodies", "", figure) : [];
}

function systemSections() {
  return systemFile && tables[systemFile] ? section("Motion", "", genericCharts(systemFile, "time", timeLabel, "elastic")) : [];
}

document.getElementById("report").append(...[head(), bodiesSections(), systemSections(), deformationSections(), differenceSections(), spectrumSections(), nonaffineSections(), energySections(), modesSections(), equilibriaSections(),
  tables.sweep ? section("Sweep", "A row for each run.", wholeTable("sweep")) : [], sceneSections(), costSections(), needsSections(), originSections()].flat().filter(Boolean));
redraws.forEach(redraw => redraw());
