// Charts: SVG at the width that they have on the page, drawn again when it changes.

const redraws = [];
let redrawDue = 0;
window.addEventListener("resize", () => {
  cancelAnimationFrame(redrawDue);
  redrawDue = requestAnimationFrame(() => redraws.forEach(redraw => redraw()));
});

for (const [event, printing] of [["beforeprint", true], ["afterprint", false]])
  window.addEventListener(event, () => {
    document.body.classList.toggle("printing", printing);
    redraws.forEach(redraw => redraw());
  });

// About n round numbers from `least` to `most`.
function ticks([least, most], n) {
  const raw = (most - least) / n, power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 2.5, 5, 10].find(m => m * power >= 0.999 * raw);
  const result = [];
  for (let k = Math.ceil(least / step - 1e-9); k * step <= most + 1e-9 * step; ++k) result.push(k * step);
  return result;
}

function tickLabels(values) {
  const size = Math.max(...values.map(Math.abs)), step = values.length > 1 ? values[1] - values[0] : size || 1;
  if (size >= 1e5 || (size > 0 && size < 1e-3)) {
    const power = Math.floor(Math.log10(size)), digits = Math.max(0, Math.ceil(power - Math.log10(step) - 1e-9) + (step / 10 ** Math.floor(Math.log10(step)) === 2.5 ? 1 : 0));
    return values.map(v => v === 0 || Math.abs(v) < 1e-9 * size ? "0" : `${(v / 10 ** power).toFixed(digits)}e${power}`.replaceAll("-", "−"));
  }
  const power = Math.floor(Math.log10(step) + 1e-9);
  const digits = Math.max(0, -power + (Math.abs(step / 10 ** power - 2.5) < 1e-6 ? 1 : 0));
  return values.map(v => (Math.abs(v) < 1e-9 * size ? 0 : v).toFixed(digits).replace("-", "−"));
}

// A range that is not empty and ends a little beyond the values.
function padded([least, most]) {
  if (!(most > least)) {
    const d = Math.abs(most) || 1;
    return [least - 0.5 * d, most + 0.5 * d];
  }
  const d = 0.06 * (most - least);
  return [least - d, most + d];
}

// Of more points than pixels: first, least, greatest and last of each pixel.
function thinned(x, y, toPixel) {
  const points = [];
  let pixel = null, of = null;
  const close = () => { if (of) for (const i of [...new Set([of.first, of.least, of.most, of.last])].sort((a, b) => a - b)) points.push(i); };
  for (let i = 0; i < x.length; ++i) {
    const p = Math.round(toPixel(x[i]));
    if (p !== pixel) { close(); pixel = p; of = {first: i, least: i, most: i, last: i}; }
    if (y[i] < y[of.least]) of.least = i;
    if (y[i] > y[of.most]) of.most = i;
    of.last = i;
  }
  close();
  return points;
}

// The sample nearest to a place on the axis; x rises.
function nearest(x, place) {
  let low = 0, high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] < place) low = middle; else high = middle;
  }
  return place - x[low] < x[high] - place ? low : high;
}

// Value of a series at a place, for reading off; none beyond its end, as of a model that was stopped before the other.
function valueAt(s, x) {
  return x > s.x[s.x.length - 1] + 1e-9 * Math.abs(x) ? NaN : s.y[nearest(s.x, x)];
}

// What is next to the pointer, at pixel (px, py): {x, text}.
function readingOf(series, X, Y, px, py) {
  const named = (s, y) => `${s.name ? `${s.name}: ` : ""}${show(y, 6)}`;
  if (series.every(s => s.points)) {
    const all = series.flatMap(s => Array.from(s.x, (x, i) => ({x, text: named(s, s.y[i]), apart: Math.hypot(X(x) - px, Y(s.y[i]) - py)})));
    return all.reduce((a, b) => b.apart < a.apart ? b : a);
  }
  const longest = series.reduce((a, b) => b.x[b.x.length - 1] > a.x[a.x.length - 1] ? b : a);
  const x = longest.x[longest.x.reduce((best, v, i) => Math.abs(X(v) - px) < Math.abs(X(longest.x[best]) - px) ? i : best, 0)];
  return {x, text: series.map(s => named(s, valueAt(s, x))).join("; ")};
}

// An upright line's text: to the right of the line or to the left, where there is room.
function placeText(text, at, width, rightFirst) {
  const length = text.getComputedTextLength(), right = at + 4, left = at - 4 - length;
  const places = (rightFirst ? [right, left] : [left, right]).filter(x => x >= 0 && x + length <= width);
  text.setAttribute("x", places.length ? places[0] : Math.max(0, width - length));
}

// A figure with a button that saves it. `title`: a text or an element.
function figureOf(title, readout, content, note, models) {
  const figure = make("figure"), name = typeof title === "string" ? make("div", {class: "title"}, title) : title;
  const button = make("button", {type: "button", class: "save", title: "Save this figure as an SVG file"}, "SVG");
  button.addEventListener("click", () => saveSvg(figure, name.textContent, models));
  figure.append(make("div", {class: "heading"}, name, button, readout || ""), ...content, note ? make("figcaption", {}, note) : "");
  return figure;
}

// A curve that turns at every other sample is noise of a scale that the samples do not resolve.
function isNoise(y) {
  if (y.length < 60) return false;
  let turns = 0, bends = 0;
  for (let k = 1; k + 1 < y.length; ++k) {
    const before = y[k] - y[k - 1], after = y[k + 1] - y[k];
    if (before * after < 0) ++turns;
    bends += Math.abs(after - before);
  }
  const [least, most] = extent(y);
  return turns > 0.35 * (y.length - 2) && bends / (y.length - 2) > 0.02 * (most - least);
}

// Of noise: {x, least, mean, most} in groups of samples.
function envelopeOf(x, y) {
  const n = Math.max(6, Math.ceil(y.length / 40)), groups = {x: [], least: [], mean: [], most: []};
  for (let first = 0; first < y.length; first += n) {
    const part = y.subarray ? y.subarray(first, first + n) : y.slice(first, first + n), [least, most] = extent(part);
    groups.x.push((x[first] + x[Math.min(y.length, first + n) - 1]) / 2);
    groups.least.push(least); groups.most.push(most); groups.mean.push(part.reduce((a, b) => a + b, 0) / part.length);
  }
  return groups;
}

function drawEnvelope(svg, s, X, Y) {
  const {x, least, mean, most} = envelopeOf(s.x, s.y), at = (k, y) => `${X(x[k]).toFixed(1)} ${Y(y[k]).toFixed(1)}`, places = x.map((_, k) => k);
  draw(svg, "path", {class: `band ${s.style}`, d: `M${[...places.map(k => at(k, most)), ...places.slice().reverse().map(k => at(k, least))].join("L")}z`});
  draw(svg, "path", {class: `curve ${s.style}`, d: `M${places.map(k => at(k, mean)).join("L")}`});
}

// series: [{x, y, name, style, points: bool, jump, bar}], the curve is broken where y changes by more than `jump`; bar: half the
// length of an error bar at each point, NaN where there is none; marks:
// [{x, text, style}] are upright lines, `lines` [{x, text}] thinner ones with the text along them. NaN breaks a curve too.
// `reads`: values are shown at the pointer. `logarithmic`: the axis upwards, over so many decades.
function chart({title, series, xLabel, yLabel = "", marks = [], lines = [], height = 210, xRange = null, wholeX = false, note = "", reads = true, logarithmic = 0}) {
  const host = make("div"), readout = make("div", {class: "readout"}), noisy = logarithmic ? [] : series.filter(s => !s.points && isNoise(s.y));
  const words = [note, noisy.length ? `Noise is drawn as a band between its least and its greatest values${noisy.length < series.length ? ` (${noisy.map(s => s.name).join(", ")})` : ""}; the line is its mean.` : ""].filter(Boolean).join(" ");
  const figure = figureOf(title, readout, [host], words, series.filter(s => s.name));
  const redraw = () => {
    const width = Math.max(260, host.clientWidth || 350);
    host.replaceChildren();
    const svg = draw(host, "svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${title}: ${yLabel} over ${xLabel}`});
    const xs = xRange || extent(series.flatMap(s => extent(s.x)));
    const barred = s => [...s.y, ...(s.bar || []).flatMap((b, i) => b > 0 ? [s.y[i] - b, s.y[i] + b] : [])];
    const range = extent(series.flatMap(s => extent(barred(s)))), top10 = Math.ceil(Math.log10(range[1] || 1));
    const ys = logarithmic ? [top10 - logarithmic, top10] : padded(range);
    const scaled = v => logarithmic ? Math.max(ys[0], Math.log10(Math.max(v, 1e-300))) : v;
    const yTicks = ticks(ys, height > 250 ? 6 : 5).filter(v => !logarithmic || Math.abs(v - Math.round(v)) < 1e-9);
    const yTexts = logarithmic ? yTicks.map(v => `1e${Math.round(v)}`.replace("-", "−")) : tickLabels(yTicks);
    const left = 14 + 7 * Math.max(...yTexts.map(t => t.length)) + (yLabel ? 16 : 0), right = width - 12;
    const top = 8 + (marks.length ? 16 * Math.min(2, marks.length) + 4 : 0), bottom = height - 38;
    const X = v => left + (right - left) * (v - xs[0]) / (xs[1] - xs[0] || 1);
    const Y = v => bottom - (bottom - top) * (scaled(v) - ys[0]) / (ys[1] - ys[0]), yOfTick = v => bottom - (bottom - top) * (v - ys[0]) / (ys[1] - ys[0]);
    const xTicks = ticks(xs, Math.max(3, (right - left) / 52)).filter(v => !wholeX || Math.abs(v - Math.round(v)) < 1e-9), xTexts = tickLabels(xTicks);
    xTicks.forEach((v, i) => {
      draw(svg, "line", {class: "grid", x1: X(v), x2: X(v), y1: top, y2: bottom});
      draw(svg, "text", {x: X(v), y: bottom + 15, "text-anchor": "middle"}, xTexts[i]);
    });
    yTicks.forEach((v, i) => {
      draw(svg, "line", {class: !logarithmic && Math.abs(v) < 1e-9 * (ys[1] - ys[0]) ? "zero" : "grid", x1: left, x2: right, y1: yOfTick(v), y2: yOfTick(v)});
      draw(svg, "text", {x: left - 6, y: yOfTick(v) + 4, "text-anchor": "end"}, yTexts[i]);
    });
    draw(svg, "text", {x: (left + right) / 2, y: height - 5, "text-anchor": "middle"}, xLabel);
    if (yLabel) draw(svg, "text", {x: 0, y: 0, "text-anchor": "middle", transform: `translate(11 ${(top + bottom) / 2}) rotate(-90)`}, yLabel);
    marks.forEach((mark, i) => {
      if (mark.x < xs[0] || mark.x > xs[1]) return;
      draw(svg, "line", {class: `curve thin ${mark.style}`, x1: X(mark.x), x2: X(mark.x), y1: top - 4, y2: bottom});
      placeText(draw(svg, "text", {class: "strong", y: top - 6 - 16 * (Math.min(2, marks.length) - 1 - i % 2)}, mark.text), X(mark.x), width, X(mark.x) < (left + right) / 2);
    });
    for (const line of lines.filter(l => l.x >= xs[0] && l.x <= xs[1])) {
      draw(svg, "line", {class: "exact", x1: X(line.x), x2: X(line.x), y1: top, y2: bottom});
      draw(svg, "text", {transform: `translate(${X(line.x) - 4} ${top + 6}) rotate(-90)`, "text-anchor": "end"}, line.text);
    }
    for (const s of series.filter(s => s.bar))
      draw(svg, "path", {class: `curve thin ${s.style}`, d: s.bar.map((b, i) => b > 0 ? `M${X(s.x[i]).toFixed(1)} ${Y(s.y[i] - b).toFixed(1)}V${Y(s.y[i] + b).toFixed(1)}` : "").join("")});
    for (const s of series) {
      if (noisy.includes(s)) { drawEnvelope(svg, s, X, Y); continue; }
      if (s.points) { for (let i = 0; i < s.x.length; ++i) marker(svg, s.style, X(s.x[i]), Y(s.y[i])); continue; }
      const places = s.x.length > 2 * width ? thinned(s.x, s.y, X) : s.x.keys();
      let path = "", before = NaN;
      for (const i of places) {
        if (!(s.x[i] >= xs[0] && s.x[i] <= xs[1])) { before = NaN; continue; }
        path += `${Math.abs(s.y[i] - before) <= (s.jump || Infinity) ? "L" : "M"}${X(s.x[i]).toFixed(1)} ${Y(s.y[i]).toFixed(1)}`;
        before = s.y[i];
      }
      draw(svg, "path", {class: `curve ${s.style}`, d: path});
    }
    if (!reads) return;
    const cursor = draw(svg, "line", {class: "cursor", y1: top, y2: bottom, visibility: "hidden"});
    const say = event => {
      const box = svg.getBoundingClientRect(), {x, text} = readingOf(series, X, Y, (event.clientX - box.left) / box.width * width, (event.clientY - box.top) / box.height * height);
      cursor.setAttribute("x1", X(x)); cursor.setAttribute("x2", X(x)); cursor.setAttribute("visibility", "visible");
      readout.textContent = `${xLabel.replace(/ \(.*/, "")} ${show(x)} · ${text}`;
    };
    svg.addEventListener("pointermove", say);
    svg.addEventListener("pointerdown", say);
    svg.addEventListener("pointerleave", () => { cursor.setAttribute("visibility", "hidden"); readout.textContent = ""; });
  };
  redraws.push(redraw);
  return figure;
}

// Circles, of the pseudo-rigid ball diamonds, of what is neither squares; dots where there are many.
function marker(svg, style, x, y) {
  if (style === "dot") { draw(svg, "circle", {class: style, cx: x.toFixed(1), cy: y.toFixed(1), r: 1.2}); return; }
  if (style === "other") { draw(svg, "rect", {class: style, "stroke-width": 2, x: x - 4, y: y - 4, width: 8, height: 8, fill: "none"}); return; }
  if (style === "pseudo-rigid") draw(svg, "path", {class: `${style} solid`, "stroke-width": 2, d: `M${x} ${y - 6}l6 6l-6 6l-6 -6z`, fill: "none"});
  else draw(svg, "circle", {class: style, "stroke-width": 2, cx: x, cy: y, r: 4, fill: "none"});
}

function legend(models) {
  return make("div", {class: "legend"}, models.map(model => {
    const svg = document.createElementNS(SVG, "svg");
    svg.setAttribute("width", 36); svg.setAttribute("height", 10);
    draw(svg, "line", {class: `curve ${model.style}`, x1: 0, x2: 36, y1: 5, y2: 5});
    return make("span", {}, svg, model.name);
  }));
}
