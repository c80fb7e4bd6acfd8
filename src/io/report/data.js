// The run's files, as they stand in this page.

function fileText(name) {
  const element = [...document.scripts].find(script => script.dataset.file === name);
  return element ? element.textContent.replace(/&lt;/g, "<").replace(/&amp;/g, "&") : "";
}

function parseJson(name) {
  const text = fileText(name);
  return text ? JSON.parse(text) : null;
}

// {names, columns: {name: numbers}, n}; null without samples. A killed run may leave a last line without an end.
function parseCsv(name) {
  const lines = fileText(name).split("\n").slice(0, -1);
  if (lines.length < 2) return null;
  const names = lines[0].split(",");
  const columns = Object.fromEntries(names.map(column => [column, new Float64Array(lines.length - 1)]));
  for (let i = 1; i < lines.length; ++i) {
    const values = lines[i].split(",");
    names.forEach((column, j) => { columns[column][i - 1] = Number(values[j]); });
  }
  return {names, columns, n: lines.length - 1, at: (column, i) => columns[column][i], has: column => column in columns};
}

const manifest = parseJson("manifest.json") || {models: {}, state: "unknown"};
const scene = manifest.entries || {};  // {"Section/Entry": "value"}
const comparison = parseJson("comparison.json");
const systemFile = manifest.system;
const tables = Object.fromEntries(["comparison", "shapes", "modes", "equilibria", "sweep", "manifolds", "connections", "section"]
  .concat(systemFile || [], (manifest.ball || []).flatMap(({name}) => [name, `shapes-${name}`, `frames-${name}`, `comparison-${name}`, `modes-${name}`, `love-${name}`, `equilibria-${name}`])).map(name => [name, parseCsv(`${name}.csv`)]));

// As a ball is called; the run may have found its degree.
function adjectiveOf(model) {
  const degree = ((manifest.models[model.name] || {}).counters || {}).degree;
  return model.finds_degree && degree ? `${model.adjective} N = ${degree}` : model.adjective;
}

// The models of the run, the richest in motions first. What moves in other ways than x = QX is drawn through its own
// points: those of the pictures of the run, else with elements shapes.csv, else shapes-<model>.csv.
// The pseudo-rigid ball and that with elements have styles of their own, the others one after the other.
const STYLES = ["third-model", "fourth-model", "fifth-model", "sixth-model"];
const isAffine = model => model.affine ?? !model.discretized;
const styleOf = (model, i, all) => model.discretized ? "elastic" : isAffine(model) ? "pseudo-rigid" : STYLES[all.slice(0, i).filter(m => !isAffine(m)).length % STYLES.length];
const MODELS = (manifest.ball || []).map((model, i, all) => ({key: model.name, name: `${adjectiveOf(model)} ball`, hasElements: model.discretized,
  isAffine: isAffine(model), frames: tables[`frames-${model.name}`],
  shapes: !isAffine(model) && tables[`frames-${model.name}`] || tables[model.discretized ? "shapes" : `shapes-${model.name}`],
  style: styleOf(model, i, all), table: tables[model.name]}))
  .filter(model => model.table && model.table.has("time")).reverse();
if (MODELS.length === 1) MODELS[0].style += " solid";  // dashes are for telling it from the other

const matrix = text => text.split(";").map(row => row.split(",").map(Number));
const numbers = text => text.split(",").map(Number);

// Units. A ball with r, ρ and μ equal to 1 is measured in r, r/c and ρr³c²; else the units are the scene's own.
const isUnitBall = !systemFile && ["Body/Radius", "Body/Density", "Material/Shear modulus"].every(e => Number(scene[e]) === 1)
  && scene["Material/Law"] !== "none";
const UNIT_WORDS = {"": "", "time": "r/c", "length": "r", "mass": "ρr³", "1/time": "c/r", "1/time^2": "c²/r²",
  "length/time": "c", "pressure": "μ", "mass*length^2/time^2": "ρr³c²", "mass*length^2/time": "ρr⁴c"};
function unitInWords(unit) {
  if (!unit) return "";
  if (isUnitBall && unit in UNIT_WORDS) return UNIT_WORDS[unit];
  return unit.replaceAll("*", "·").replaceAll("^2", "²").replaceAll("^3", "³");
}
const withUnit = (label, unit) => unitInWords(unit) ? `${label} (${unitInWords(unit)})` : label;
const timeLabel = `time (${isUnitBall ? "r/c" : "the scene's unit"})`;

// Numbers for people: `digits` significant ones, without noise behind them.
function show(value, digits = 4) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e6 || size < 1e-3 ? value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e")
    : String(Number(value.toPrecision(digits)));
  return text.replace("-", "−").replace("e-", "e−");
}

// An error to one digit, rounded up.
const digitUp = error => { const place = 10 ** Math.floor(Math.log10(error) + 1e-9); return Number((Math.ceil(error / place * (1 - 1e-9)) * place).toPrecision(1)); };
const showError = error => error > 0 ? show(digitUp(error), 1) : "0";

// With the digits that the uncertainty leaves, `digits` at most; an uncertainty behind the last of them is left out.
function showWithin(value, uncertainty, digits) {
  const placeOf = v => Math.floor(Math.log10(Math.abs(v)) + 1e-9), finest = value ? placeOf(value) - digits + 1 : -digits;
  if (!(uncertainty >= 0.5 * 10 ** finest)) return show(value, digits);
  const rounded = digitUp(uncertainty), decimals = -Math.max(finest, placeOf(rounded));
  if (decimals < 0 || decimals > 6) return `${show(value, Math.max(1, (value ? placeOf(value) : 0) + decimals + 1))} ± ${show(rounded, 1)}`;
  return `${value.toFixed(decimals).replace("-", "−")} ± ${rounded.toFixed(decimals)}`;
}

// The sum of its errors, or the words for those that are not known; fit, time and space are those of `errors` with the prefix.
function showWithErrors(value, errors, prefix, digits) {
  const total = errors[`${prefix}uncertainty`];
  if (typeof total === "number") return showWithin(value, total, digits);
  return `${show(value, digits)} (${["fit", "time", "space"].filter(part => errors[`${prefix}${part}_error`] === null).map(part => `error in ${part} not known`).join(", ")})`;
}
// "fit 0.003, time 2e−6, space 4e−4"
function partsInWords(errors, prefix = "") {
  return ["fit", "time", "space"].filter(part => typeof errors[`${prefix}${part}_error`] === "number").map(part => `${part} ${showError(errors[`${prefix}${part}_error`])}`).join(", ");
}

// Numbers of one column: all to the last place of the largest one's `digits`.
function showAlike(values, digits) {
  const size = Math.max(...values.map(Math.abs)), decimals = digits - 1 - Math.floor(Math.log10(size || 1));
  return values.map(v => v === 0 ? "0" : decimals < 0 || decimals > digits + 2 ? show(v, digits) : v.toFixed(decimals).replace("-", "−"));
}

// What hardly changes is drawn as its departure from its first value: its changes would be a straight line.
function fromFirst(name, y) {
  const [least, most] = extent(y);
  return most - least < 1e-4 * Math.max(Math.abs(least), Math.abs(most)) ? {name: `${name}, minus its first value ${show(y[0], 6)}`, y: y.map(v => v - y[0])} : {name, y};
}

function extent(values) {
  let least = Infinity, most = -Infinity;
  for (const v of values) { if (v < least) least = v; if (v > most) most = v; }
  return [least, most];
}
const largest = values => Math.max(...extent(values).map(Math.abs));

// Elements of the page.
const SVG = "http://www.w3.org/2000/svg";
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children.flat().filter(child => child !== null && child !== undefined));
  return element;
}
function draw(parent, tag, attributes = {}, text = "") {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text) element.textContent = text;
  parent.append(element);
  return element;
}

function tableOf(head, rows) {
  const line = (cells, tag) => make("tr", {}, cells.map(cell =>
    cell instanceof Node ? cell : make(tag, {}, String(cell))));
  return make("div", {class: "scroll"}, make("table", {},
    head ? make("thead", {}, line(head, "th")) : null, make("tbody", {}, rows.map(row => line(row, "td")))));
}
