// What the models of a ball say of its motion: charts of their columns, the same style for a model everywhere.

const SQUARED = "mass*length^2/time^2", MOMENTUM = "mass*length^2/time";
const column = (model, name) => model.table.columns[name];

function seriesOf(f) {
  return MODELS.map(model => ({model, y: f(model)})).filter(s => s.y)
    .map(s => ({x: column(s.model, "time"), y: s.y, name: s.model.name, style: s.model.style}));
}

// A chart for each quantity that varies; equal ones share one; the constant ones are named in a line of text.
function chartsOf(quantities, unit) {
  const all = quantities.map(q => ({...q, series: seriesOf(q.values)})).filter(q => q.series.length);
  const scale = Math.max(...all.flatMap(q => q.series.map(s => largest(s.y))), 1e-300);
  const level = s => { const [a, b] = extent(s.y); return b - a <= 1e-9 * scale; };
  const constant = all.filter(q => q.series.every(level)), groups = [];
  for (const q of all.filter(q => !constant.includes(q))) {
    const same = groups.find(g => g.series.length === q.series.length && g.series.every((s, k) =>
      s.y.every((v, i) => Math.abs(v - q.series[k].y[i]) <= 1e-9 * scale)));
    if (same) same.names.push(q.name); else groups.push({names: [q.name], series: q.series});
  }
  const values = constant.map(q => `${q.name} = ${[...new Set(q.series.map(s => show(Math.abs(s.y[0]) < 1e-12 * scale ? 0 : s.y[0])))].join(" and ")}`);
  const drawn = g => {
    const {name, series} = lessFirst(g.names.join(" = "), g.series);
    return chart({title: withUnit(name, unit), series, xLabel: timeLabel});
  };
  return [make("div", {class: "charts"}, groups.map(drawn)),
    values.length ? make("p", {class: "note"}, `Constant to 1e−9: ${values.join(", ")}.`) : null];
}

// Two results of chartsOf in one grid, so that no row is left open between them.
function sideBySide([charts, note], [more, other]) {
  charts.append(...more.children);
  return [charts, note, other];
}

// What hardly changes in any model is drawn as its departure from a first value that all share.
function lessFirst(name, series) {
  const first = series[0].y[0], most = Math.max(...series.map(s => largest(s.y)));
  const departs = Math.max(...series.map(s => largest(s.y.map(v => v - first))));
  return departs < 1e-4 * most ? {name: `${name}, minus its first value ${show(first, 6)}`, series: series.map(s => ({...s, y: s.y.map(v => v - first)}))} : {name, series};
}

// The semi-axes, which the file has by size at each time, each followed through the times at which two are equal: the
// order of the next sample is the one nearest to straight lines through the last two. [values of axis 1, 2, 3], numbered by
// size at the start.
const ORDERS = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
const followed = new Map();
function followedAxes(model) {
  if (!model.table.has("a1")) return null;
  if (!followed.has(model.key)) {
    const sorted = indices.map(i => column(model, `a${i}`)), axes = sorted.map(a => a.slice());
    for (let n = 1; n < model.table.n; ++n) {
      const foreseen = axes.map(a => n > 1 ? 2 * a[n - 1] - a[n - 2] : a[0]);
      const miss = order => order.reduce((sum, k, i) => sum + (sorted[k][n] - foreseen[i]) ** 2, 0);
      const best = ORDERS.reduce((a, b) => miss(b) < miss(a) * (1 - 1e-9) ? b : a);
      best.forEach((k, i) => { axes[i][n] = sorted[k][n]; });
    }
    followed.set(model.key, axes);
  }
  return followed.get(model.key);
}
const axisOf = i => model => { const axes = followedAxes(model); return axes && axes[i - 1]; };

const plain = names => names.map(name => ({name, values: model => column(model, name)}));
const indices = [1, 2, 3];
const pairs = indices.flatMap(i => indices.map(j => `${i}${j}`));

function section(title, intro, ...content) {
  const parts = content.flat().filter(Boolean);
  return parts.length ? [make("h2", {}, title), intro ? make("p", {class: "note"}, intro) : null, ...parts] : [];
}

const STRESSES = {mean_von_mises: "mean", max_von_mises: "largest value", center_von_mises: "at the centre"};
function stressSections() {
  if (!MODELS.some(m => m.table.has("mean_von_mises"))) return [];
  return section("Von Mises stress", "A pseudo-rigid body has one stress everywhere.", legend(MODELS),
    chartsOf(Object.entries(STRESSES).map(([name, words]) => ({name: words, values: model => column(model, name)})), "pressure"));
}

function deformationSections() {
  if (!MODELS.some(m => m.table.has("Q11"))) return stressSections();
  const others = MODELS.filter(m => !m.isAffine);
  const meaning = others.length ? ` Of the ${others.map(m => m.name).join(" and the ")} Q is the mass moment, the affine motion nearest to its own in the sense of the mass.` : "";
  return [
    ...section("Deformation Q(t)", `x = QX carries the ball at rest to the moving one.${meaning}`, legend(MODELS), chartsOf(plain(pairs.map(p => `Q${p}`)), "")),
    ...stressSections(),
    ...(MODELS.some(m => m.table.has("a1")) ? section("Semi-axes and volume", "Semi-axes of the ellipsoid that Q makes of the ball, numbered by their size at the start. An axis keeps its number when two axes become equal; the files sort the axes at each time, a1 ≥ a2 ≥ a3.", legend(MODELS),
      sideBySide(chartsOf(indices.map(i => ({name: `semi-axis ${i}`, values: axisOf(i)})), "length"), chartsOf([{name: "volume / undeformed volume", values: model => column(model, "volume_ratio")}], ""))) : []),
  ];
}

// Departure of a vector from its first value, over `size`.
function departure(name, size) {
  return model => {
    if (!model.table.has(`${name}1`)) return null;
    const parts = indices.map(i => column(model, name + i));
    return parts[0].map((_, k) => Math.hypot(...parts.map(p => p[k] - p[0])) / size);
  };
}

function reference(name, otherwise) {
  const known = comparison && comparison.differences && comparison.differences[name];
  return known ? known.reference : otherwise();
}

// What the comparison took for the unit of energy, or what this page would.
function energyUnit() {
  const models = MODELS.filter(m => m.table.has("energy"));
  return models.length ? reference("energy_difference", () => energyReference(models)) || 1 : 0;
}

// The four charts below the first screen: difference, energy, non-affine motion, spectrum.
function keySections() {
  const charts = [], E = energyUnit(), table = tables.comparison;
  if (table && table.has("q_difference")) charts.push(chart({title: "Difference of Q, over |Q|", xLabel: timeLabel, series: [{x: table.columns.time, y: table.columns.q_difference, name: "", style: "other"}]}));
  if (E) {
    // A model whose energy hardly changes next to that of the others needs no explanation.
    const change = m => largest(energyChange(m, E)), models = MODELS.filter(m => m.table.has("energy")), seen = Math.max(...models.map(change)) / 10;
    const names = models.filter(m => (manifest.models[m.key] || {}).symplectic === false && change(m) >= seen).map(m => m.name);
    charts.push(chart({title: "Change of the energy, over E_ref", xLabel: timeLabel, series: energyChanges(E),
      note: `E_ref = ${show(E)}.${names.length ? ` The method of the ${names.join(" and of the ")} is not symplectic, so its energy can drift.` : ""}`}));
  }
  const bodies = MODELS.filter(m => m.table.has("nonaffine_kinetic_fraction") && m.table.has("kinetic"));
  if (E && bodies.length) charts.push(chart({title: "Non-affine kinetic energy, over E_ref", xLabel: timeLabel, note: "The part of the motion that x = QX cannot have.",
    series: bodies.map(m => ({x: column(m, "time"), y: column(m, "kinetic").map((k, i) => k * column(m, "nonaffine_kinetic_fraction")[i] / E), name: bodies.length > 1 ? m.name : "", style: m.style}))}));
  const [spectrum, ...words] = spectrumOf();
  if (!charts.length && !spectrum && !words.length) return [];
  return [make("h2", {}, "Differences, conservation, frequencies"), legend(MODELS), make("div", {class: "charts"}, charts), spectrum ? make("div", {class: "charts wide"}, spectrum) : null, ...words].filter(Boolean);
}
const energyChange = (m, E) => column(m, "energy").map(e => (e - column(m, "energy")[0]) / E);
const energyChanges = E => seriesOf(m => m.table.has("energy") ? energyChange(m, E) : null);

function energySections() {
  const withEnergies = MODELS.filter(m => m.table.has("energy")), withMomenta = MODELS.filter(m => m.table.has("J1"));
  const content = [];
  if (withEnergies.length) {
    content.push(...chartsOf(plain(["kinetic", "elastic", "gravitational", "external", "dissipated", "orbital", "interaction"]).map(q => ({...q, name: `${q.name} energy`})), SQUARED));
    content.push(make("h3", {}, "Momenta"), make("div", {class: "charts"}, [
      ...(withMomenta.length ? [withMomenta.every(m => m.table.has("total_J1")) ? ["total_J", "angular momentum of body and orbit", ""] : ["J", "angular momentum", "angular_momentum_difference"], ["Z", "circulation", "circulation_difference"]].map(([name, words, difference]) => {
        const J0 = reference(difference, () => Math.max(...withMomenta.map(m => largest(column(m, `${name}1`).map((_, i) => Math.hypot(...indices.map(k => column(m, name + k)[i]))))))) || 1;
        const series = seriesOf(departure(name, J0));
        return series.every(s => largest(s.y) === 0) ? make("p", {class: "note"}, `The ${words} ${name} remains 0 by the symmetry of this motion.`)
          : chart({title: `|${name} − ${name}(0)| / ${name}₀, ${words}`, xLabel: timeLabel, series, note: `${name}₀ = ${show(J0)}`});
      }) : [])]));
  }
  return content.length ? section("Energies and momenta", "", legend(MODELS), content) : [];
}

// Of kinetic and elastic energy together or, if that is round-off of the others, the largest of them.
function energyReference(models) {
  const others = Math.max(...models.map(m => Math.max(...["gravitational", "external", "dissipated"].filter(n => m.table.has(n)).map(n => largest(column(m, n))))), 0);
  const ofMotion = Math.max(...models.map(m => largest(column(m, "kinetic").map((k, i) => k + column(m, "elastic")[i]))), ...models.filter(m => m.table.has("orbital")).map(m => largest(column(m, "orbital"))));
  return ofMotion >= 1e-12 * others ? ofMotion : others;
}

const DIFFERENCES = {
  q_difference: "Q, over |Q|", q_difference_of_departure: "Q, over the largest departure of Q", strain_difference: "C = QᵀQ, over its amplitude",
  a1_difference: "largest semi-axis, relative", a2_difference: "middle semi-axis, relative", a3_difference: "smallest semi-axis, relative",
  volume_ratio_difference: "volume over reference volume", kinetic_difference: "kinetic energy, over E_ref", elastic_difference: "elastic energy, over E_ref",
  energy_difference: "energy, over E_ref", angular_momentum_difference: "angular momentum, over J₀", circulation_difference: "circulation, over J₀",
  multiplier_difference: "multiplier, over its largest value", mean_von_mises_difference: "mean von Mises stress, over its largest value",
  max_von_mises_difference: "largest von Mises stress, over its greatest value", center_von_mises_difference: "von Mises stress at the centre, over its largest value", nonaffine_kinetic_fraction: "non-affine part of the kinetic energy, of the reference model",
  nonaffine_displacement: "non-affine part of the position, of the reference model",
};

// Of several models with the richest of them, a line each.
function overviewSections() {
  const rows = Object.entries(comparison.models).map(([name, m]) => {
    const model = MODELS.find(other => other.key === name), d = m.model_difference;
    return [model ? model.name : name, d ? show(d.value, 3) : "", m.ratio ? show(m.ratio, 6) : ""];
  });
  const reference = MODELS.find(model => model.key === comparison.reference);
  const models = MODELS.filter(m => (tables[`comparison-${m.key}`] || {has: () => false}).has("q_difference"));
  const series = models.map(m => ({x: tables[`comparison-${m.key}`].columns.time, y: tables[`comparison-${m.key}`].columns.q_difference, name: m.name, style: m.style}));
  return section("Difference of the models", `Each compared with the ${reference ? reference.name : comparison.reference}.`,
    legend(models), series.length ? make("div", {class: "charts wide"}, chart({title: "Q, over |Q|", xLabel: timeLabel, series})) : null,
    tableOf(["", "largest difference of Q over |Q|", "ratio of frequencies"], rows),
    ...Object.values(comparison.models).map(m => make("p", {}, m.summary.replaceAll("+-", "±"))));
}

function differenceSections() {
  if (comparison && comparison.models) return overviewSections();
  const table = tables.comparison;
  if (!table) return [];
  const x = table.columns.time;
  const names = table.names.filter(n => !/^time$|^nonaffine|^a\d_difference$|^q_difference/.test(n) && largest(table.columns[n]) > 1e-9);
  const d = comparison && comparison.model_difference;
  const verdict = d ? `Largest difference of Q over |Q|: ${d.uncertainty === null ? `${showWithErrors(d.value, d, "", 3)}.`
    : `${showWithErrors(d.value, d, "", 4)}, the discretisation error as estimated (${partsInWords(d)})${d.resolved ? "" : ": the difference is not resolved"}.`}` : "";
  const one = n => { const {name, y} = fromFirst(DIFFERENCES[n] || n, table.columns[n]); return chart({title: name, xLabel: timeLabel, series: [{x, y, name: "", style: "other"}]}); };
  return section("Difference of the models", `${MODELS.map((m, i) => i ? m.name : m.name.replace(" ball", "").replace(/^./, c => c.toUpperCase())).join(" minus ")}. ${verdict}`,
    make("div", {class: "charts"}, [...names.map(one), ...axisDifferences()]),
    comparison ? differenceTable() : null);
}

// Of the axes as they are followed: those of the file, by size, have corners where two are equal.
function axisDifferences() {
  const [reference, model] = MODELS, [b, a] = [reference, model].map(m => m && followedAxes(m));
  if (!a || !b) return [];
  const n = Math.min(reference.table.n, model.table.n);
  return indices.map(i => ({i, y: a[i - 1].subarray(0, n).map((v, k) => (v - b[i - 1][k]) / b[i - 1][k])})).filter(d => largest(d.y) > 1e-9)
    .map(({i, y}) => chart({title: `semi-axis ${i}, relative`, xLabel: timeLabel, series: [{x: column(model, "time").subarray(0, n), y, name: "", style: "other"}]}));
}

function differenceTable() {
  const rows = Object.entries(comparison.differences).map(([name, s]) => [DIFFERENCES[name] || name, show(s.rms, 3), show(s.max, 3), show(s.time_of_max)]);
  return make("div", {}, make("h3", {}, "All differences"), tableOf(["difference", "rms", "largest", "at time"], rows),
    comparison.not_compared && comparison.not_compared.length ? make("p", {class: "note"}, `Not compared: ${comparison.not_compared.join("; ")}.`) : null);
}

function nonaffineSections() {
  const models = MODELS.filter(m => m.table.has("nonaffine_kinetic_fraction"));
  if (!models.length) return [];
  const of = (name, title, note) => chart({title, note, xLabel: timeLabel, series: models.map(m => ({x: column(m, "time"), y: column(m, name), name: models.length > 1 ? m.name : "", style: m.style}))});
  return section(`How far the ${models.length > 1 ? "models are" : `${models[0].name} is`} from an affine motion`, "0: the pseudo-rigid ball can have the same motion.", models.length > 1 ? legend(models) : null, make("div", {class: "charts"},
    of("nonaffine_kinetic_fraction", "non-affine part of the kinetic energy", "It is near 1 when the affine motion pauses."),
    of("nonaffine_displacement", "non-affine part of the position", "Root mean square over the ball, relative."),
    of("min_jacobian", "least det F at the points of integration", "1: the volume is preserved there. The constraint holds in the mean over each element, so det F departs from 1 between the points."),
    models.every(m => m.table.has("volume_error")) ? of("volume_error", "root mean square of ln det F", "0: the volume is preserved everywhere.") : null));
}

// Spectra.

function strain(model, i, j) {
  return column(model, "time").map((_, n) => indices.reduce((sum, k) => sum + column(model, `Q${k}${i}`)[n] * column(model, `Q${k}${j}`)[n], 0));
}

// Amplitudes of a signal without its mean, through Hann's window, at the angular frequencies.
function amplitudes(x, y, omegas) {
  const n = y.length, mean = y.reduce((a, b) => a + b, 0) / n;
  const weights = y.map((_, k) => 0.5 * (1 - Math.cos(2 * Math.PI * k / (n - 1)))), total = weights.reduce((a, b) => a + b, 0);
  return omegas.map(omega => {
    let re = 0, im = 0;
    for (let k = 0; k < n; ++k) { const w = weights[k] * (y[k] - mean); re += w * Math.cos(omega * x[k]); im += w * Math.sin(omega * x[k]); }
    return 2 * Math.hypot(re, im) / total;
  });
}

const MOST_SAMPLES = 3000;  // of a spectrum, so that it takes no longer than a second

function strainOfLargestVariance(model) {
  const variance = name => { const y = strain(model, ...name), mean = y.reduce((a, b) => a + b, 0) / y.length; return y.reduce((s, v) => s + (v - mean) ** 2, 0); };
  return pairs.filter(p => p[0] <= p[1]).map(p => [...p].map(Number)).reduce((a, b) => variance(b) > variance(a) ? b : a);
}

const MOST_DECADES = 5, LEAST_PERIODS = 10;
// Frequencies of an elastic sphere and of the pseudo-rigid ball at small amplitude (Lamb 1882), in units of c/r.
const EXACT_LINES = [["S2", 2.665622189236], ["S4", 5.160819], ["S2, overtone", 5.473039811966], ["S2, second overtone", 8.877243237], ["pseudo-rigid S2", Math.sqrt(10)]];

// Whether the exact lines are those of this ball: free, incompressible, with elements (the comparison says so).
const hasExactLines = () => Boolean(comparison && comparison.frequency && comparison.frequency.exact_small_amplitude_ratio);
const rateOfScene = () => Math.sqrt(Number(scene["Material/Shear modulus"]) / Number(scene["Body/Density"])) / radius;

// [the chart or null, paragraphs].
function spectrumOf() {
  const models = MODELS.filter(m => m.table.has("Q11") && m.table.n >= 16);
  if (!models.length) return [null];
  const known = comparison && comparison.frequency;
  const entry = known ? [...known.signal.slice(1)].map(Number) : strainOfLargestVariance(models[models.length - 1]);
  const signals = models.map(model => ({model, samples: [column(model, "time"), strain(model, ...entry)].map(v => Array.from(v.subarray(0, MOST_SAMPLES)))}));
  const motion = Math.max(...signals.map(s => { const [a, b] = extent(s.samples[1]); return b - a; }));
  if (!(motion > 1e-9)) return [null];
  const [x] = signals[0].samples, last = x[x.length - 1] - x[0], nyquist = Math.PI * (x.length - 1) / last;
  const fitted = key => known && known[key] && known[key].found ? known[key] : null;
  const coarse = Array.from({length: 2 * x.length}, (_, k) => nyquist * (k + 1) / (2 * x.length));
  const peaks = signals.map(s => amplitudes(...s.samples, coarse)), top = Math.max(...peaks.flat());
  const main = signals.map((s, k) => fitted(s.model.key) ? fitted(s.model.key).omega : peakOf(coarse, peaks[k])).filter(Boolean);
  const words = make("p", {class: "note"}, `${known ? `${known.reason.replace("entry of C = Q^T Q that", `The entry C${entry.join("")} of C = QᵀQ`)}. ` : ""}`
    + signals.map(s => fitted(s.model.key) ? `${s.model.name}: ω = ${showWithErrors(fitted(s.model.key).omega, fitted(s.model.key), "", 5)}${isUnitBall ? " c/r" : ""}. ` : "").join("")
    + (known && [known[models[0].key], known[models.at(-1).key]].some(m => m && m.load) ? "A line belongs to a load, not to the body. " : "")
    + (known && known.ratio ? `Ratio of the frequencies: ${showWithErrors(known.ratio, known, "ratio_", 6)}, errors: ${partsInWords(known, "ratio_")}${known.exact_small_amplitude_ratio ? `; exact for small amplitudes: ${show(known.exact_small_amplitude_ratio, 6)}` : ""}. ` : ""));
  const n_periods = main.length ? Math.min(...main) * last / (2 * Math.PI) : 0;
  if (n_periods < LEAST_PERIODS) {
    words.append(`A spectrum is not drawn: the record has ${show(n_periods, 2)} periods, and lines are apart only after about ${LEAST_PERIODS}.`);
    return [null, words];
  }
  const reach = Math.max(...peaks.map(p => coarse[p.reduce((most, a, k) => a > 10 ** (1 - MOST_DECADES) * top ? k : most, 0)]));
  const end = Math.min(nyquist, Math.max(1.3 * Math.max(...main), Math.min(1.1 * reach, 4 * Math.max(...main))));
  const n_omegas = Math.round(Math.min(4000, Math.max(400, end * last / 2)));  // a peak is 4π/last wide
  const omegas = Array.from({length: n_omegas}, (_, k) => end * k / (n_omegas - 1));
  const series = signals.map(s => ({x: omegas, y: amplitudes(...s.samples, omegas), name: s.model.name, style: s.model.style}));
  const lines = hasExactLines() ? EXACT_LINES.map(([text, omega]) => ({x: omega * rateOfScene(), text})) : [];
  return [chart({title: `Amplitude spectrum of C${entry.join("")}`, series, lines, xLabel: withUnit("angular frequency ω", "1/time"), yLabel: "amplitude", height: 300, xRange: [0, end], logarithmic: MOST_DECADES,
    note: `C = QᵀQ, through Hann's window${models[0].table.n > MOST_SAMPLES ? `, of the first ${MOST_SAMPLES} samples` : ""}.${lines.length ? " Dotted: exact frequencies at small amplitude (S: spheroidal modes with their degree)." : ""}`}), words];
}

// The place of the highest peak; null where there is none but at an end.
function peakOf(x, y) {
  let k = 0;
  for (let i = 1; i + 1 < y.length; ++i) if (y[i] >= y[i - 1] && y[i] >= y[i + 1] && (!k || y[i] > y[k])) k = i;
  if (!k) return null;
  const bend = y[k - 1] - 2 * y[k] + y[k + 1];
  return x[k] + (bend ? 0.5 * (y[k - 1] - y[k + 1]) / bend * (x[1] - x[0]) : 0);
}
