// A figure as a file: SVG with all styles written out, on white, with the title and the names of the lines.

const KEPT_STYLES = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity", "stroke-linejoin", "vector-effect", "font-size", "font-weight", "text-anchor", "visibility"];

function withStyles(svg) {
  const copy = svg.cloneNode(true), from = [svg, ...svg.querySelectorAll("*")], to = [copy, ...copy.querySelectorAll("*")];
  from.forEach((element, k) => {
    const style = getComputedStyle(element);
    for (const name of KEPT_STYLES) to[k].setAttribute(name, style.getPropertyValue(name));
    to[k].removeAttribute("class"); to[k].removeAttribute("style");
  });
  copy.querySelectorAll("[visibility=hidden]").forEach(element => element.remove());
  return copy;
}

// The text of the file. All pictures of the figure keep their places.
function svgText(figure, title, models) {
  document.documentElement.classList.add("light");
  const box = figure.getBoundingClientRect(), margin = 10, head = 34, foot = models.length ? 30 : 10, width = Math.ceil(box.width) + 2 * margin;
  const pictures = [...figure.querySelectorAll("svg")], places = pictures.map(svg => svg.getBoundingClientRect());
  const top = Math.min(...places.map(p => p.top)), height = Math.ceil(Math.max(...places.map(p => p.bottom)) - top) + head + foot;
  const root = document.createElementNS(SVG, "svg");
  for (const [name, value] of Object.entries({xmlns: SVG, width, height, viewBox: `0 0 ${width} ${height}`, "font-family": "DejaVu Sans, Arial, sans-serif"})) root.setAttribute(name, value);
  draw(root, "rect", {width, height, fill: "#ffffff"});
  draw(root, "text", {x: margin, y: 22, "font-size": 14, "font-weight": "bold", fill: "#1b1b1b"}, title);
  pictures.forEach((svg, k) => {
    const copy = withStyles(svg), p = places[k];
    for (const [name, value] of Object.entries({x: p.left - box.left + margin, y: p.top - top + head, width: p.width, height: p.height, overflow: "visible"})) copy.setAttribute(name, value);
    root.append(copy);
  });
  models.forEach((model, k) => {
    const host = document.createElementNS(SVG, "svg"), x = margin + k * width / models.length, y = height - 14;
    const line = draw(draw(host, "g"), "line", {class: `curve ${model.style}`, x1: x, x2: x + 30, y1: y, y2: y});
    figure.append(host);
    const copy = withStyles(line);
    host.remove();
    root.append(copy);
    draw(root, "text", {x: x + 36, y: y + 4, "font-size": 12, fill: "#444444"}, model.name);
  });
  document.documentElement.classList.remove("light");
  return new XMLSerializer().serializeToString(root);
}

function saveSvg(figure, title, models) {
  const link = make("a", {download: `${title.replace(/[^\w.=-]+/g, "_").replace(/^_+|_+$/g, "").slice(0, 60) || "figure"}.svg`});
  link.href = URL.createObjectURL(new Blob([svgText(figure, title, models)], {type: "image/svg+xml"}));
  link.click();
}
