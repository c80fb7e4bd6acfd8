// Charts of the orbit of the first companion, of the spin and of the bulge.

const lengthOf = v => Math.hypot(...v);
const crossOf = (a, b) => indices.map(i => a[i % 3] * b[(i + 1) % 3] - a[(i + 1) % 3] * b[i % 3]);
const vectorAt = (model, name, n) => indices.map(i => column(model, name + i)[n]);

// The mean motion of the Kepler orbit, |r × v|/(a² √|1 − e²|), and the spin along r × v over it.
function ratioOfSpin(model) {
  const a = column(model, "semi_major_axis"), e = column(model, "eccentricity");
  return Array.from(a, (axis, n) => {
    const normal = crossOf(vectorAt(model, "companion", n), vectorAt(model, "companion_velocity", n)), h = lengthOf(normal);
    const rate = h / (axis * axis * Math.sqrt(Math.abs(1 - e[n] * e[n])));
    return dot(vectorAt(model, "spin", n), normal) / h / rate;
  });
}

function orbitSections() {
  const models = MODELS.filter(m => m.table.has("companion1"));
  if (!models.length) return [];
  const of = (title, values, more = {}) => chart({title, xLabel: timeLabel, ...more,
    series: models.map(m => ({x: column(m, "time"), y: values(m), name: models.length > 1 ? m.name : "", style: m.style, jump: more.jump}))});
  const distance = m => Array.from(column(m, "time"), (_, n) => lengthOf(vectorAt(m, "companion", n)));
  const bound = models.every(m => column(m, "semi_major_axis").every(a => a > 0));
  return section("Orbit, spin and bulge", "Of the first companion, relative to the centre of the body. The elements are those of the Kepler orbit of point masses with the same position and velocity.",
    models.length > 1 ? legend(models) : null, make("div", {class: "charts"},
      of(withUnit("distance", "length"), distance),
      bound ? of(withUnit("semi-major axis", "length"), m => column(m, "semi_major_axis")) : null,
      of("eccentricity", m => column(m, "eccentricity")),
      bound ? of("spin over mean motion", ratioOfSpin, {note: "1: the rotation is synchronous."}) : null,
      of("lag of the bulge (radians)", m => column(m, "lag"), {jump: Math.PI / 2, note: "Positive: the bulge is ahead of the companion."})));
}
