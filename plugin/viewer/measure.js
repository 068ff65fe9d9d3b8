// SPDX-License-Identifier: BSD-3-Clause
// Measuring in viewer.html: points that are picked, what lies between them, and
// its standard deviation. Positions are relative to `origin`.
"use strict";

// ---- covariances: [xx, xy, xz, yy, yz, zz]
const quadratic = (q, d) => q[0] * d.x * d.x + q[3] * d.y * d.y + q[5] * d.z * d.z +
    2 * (q[1] * d.x * d.y + q[2] * d.x * d.z + q[4] * d.y * d.z);
const trace = q => q[0] + q[3] + q[5];
const weighted = (v, a, w, b) => a.map((x, i) => v * x + w * b[i]);
const round = sigma => [sigma * sigma, 0, 0, sigma * sigma, 0, sigma * sigma];
// Of a length, with that of the scale.
const withScale = (value, sigma) => Math.hypot(sigma, value * data.frame.scaleSigma);
const relative = v => new THREE.Vector3(...v).sub(origin);

// ---- what can be picked: { name, at, q, free }. On a curve, `free` is the tangent: along it, a point is where it was clicked.
const nodeItem = i => ({ name: "node " + i, word: String(i), at: relative(data.nodes[i][0]), q: data.nodes[i][1] });
const pointItem = i => ({ name: "point " + i, at: relative(data.points[i][0]), q: data.points[i][1] });
// The nearest point of the primitive `k` of a curve; of ellipses and splines `near` itself.
function fitItem(c, k, near, tangent) {
  const fit = c.fits[k], item = { name: `${fit.k} ${c.id}.${k}`, fit, curve: c.id };
  if (fit.k === "line") {
    const line = new THREE.Line3(relative(fit.a), relative(fit.b)), t = line.closestPointToPointParameter(near, true);
    return Object.assign(item, { line, at: line.at(t, new THREE.Vector3()), q: weighted((1 - t) ** 2, fit.qa, t * t, fit.qb),
                                 free: line.delta(new THREE.Vector3()).normalize() });
  }
  if (!fit.o) return Object.assign(item, { at: near, q: round(fit.s), free: tangent });
  const center = relative(fit.o), normal = new THREE.Vector3(...fit.n);
  const out = near.clone().sub(center).projectOnPlane(normal).normalize();
  return Object.assign(item, { center, at: center.clone().addScaledVector(out, fit.r), q: round(fit.s), free: normal.cross(out) });
}
// The primitive of a curve that stands for a sample.
function fitAt(c, sample) {
  const k = c.fits.findIndex(f => (((sample - f.i[0]) % c.n) + c.n) % c.n <= f.i[1] - 1);
  return k < 0 ? c.fits.length - 1 : k;
}
function variance(item, direction) {
  const d = item.free ? direction.clone().addScaledVector(item.free, -direction.dot(item.free)) : direction;
  return quadratic(item.q, d);
}

// ---- what there is to measure: { what, from, to, value, sigma, unit }, as in dimensions.csv; `title`, if it is not `what`
function between(a, b, what, from, to) {
  const d = b.at.clone().sub(a.at), value = d.length(), u = value > 0 ? d.divideScalar(value) : new THREE.Vector3(1, 0, 0);
  return { what, from, to, value, sigma: withScale(value, Math.sqrt(variance(a, u) + variance(b, u))), unit: data.frame.unit };
}
function measuresOf(item) {
  const { name, fit, line } = item, unit = data.frame.unit;
  if (line) {
    const u = line.delta(new THREE.Vector3()).normalize();
    return [{ what: "length", from: name, to: "", value: fit.l, unit,
              sigma: withScale(fit.l, Math.sqrt(quadratic(fit.qa, u) + quadratic(fit.qb, u))) }];
  }
  return fit && fit.r ? [{ what: "radius", from: name, to: "", value: fit.r, sigma: withScale(fit.r, fit.rs), unit }] : [];
}
function directionVariance({ fit, line }) {
  const length = line.distance(), u = line.delta(new THREE.Vector3()).divideScalar(length), sum = weighted(1, fit.qa, 1, fit.qb);
  return (trace(sum) - quadratic(sum, u)) / (2 * length * length);
}
// From the straight line through `a` to a point, across the line.
function fromLine(a, item) {
  const t = a.line.closestPointToPointParameter(item.at, false), s = Math.min(1, Math.max(0, t));
  const foot = { at: a.line.at(t, new THREE.Vector3()), q: weighted((1 - s) ** 2, a.fit.qa, s * s, a.fit.qb) };
  return { ...between(foot, item, "distance", a.name, item.name), title: "across" };
}
function measuresBetween(a, b) {
  const rows = [between(a, b, "distance", a.fit ? "A" : a.name, b.fit ? "B" : b.name)];
  if (a.line && b.line && a.fit !== b.fit) {
    const [long, short] = a.fit.l >= b.fit.l ? [a, b] : [b, a];
    const sine = long.free.clone().cross(short.free).length(), angle = Math.atan2(sine, Math.abs(long.free.dot(short.free)));
    const sigma = Math.sqrt(directionVariance(long) + directionVariance(short)), degrees = 180 / Math.PI;
    rows.push({ what: "angle", from: long.name, to: short.name, value: angle * degrees, sigma: sigma * degrees, unit: "deg" });
    const middle = { name: short.name, at: short.line.at(.5, new THREE.Vector3()), q: weighted(.25, short.fit.qa, .25, short.fit.qb) };
    if (angle < Math.min(3 * sigma, 1 / degrees)) rows.push(fromLine(long, middle));
  } else if (a.line && !b.fit) rows.push(fromLine(a, b));
  else if (b.line && !a.fit) rows.push(fromLine(b, a));
  if (a.fit && b.fit && a.fit !== b.fit && a.fit.k === "circle" && b.fit.k === "circle") {
    const value = a.center.distanceTo(b.center), sigma = withScale(value, Math.hypot(a.fit.rs, b.fit.rs));
    rows.push({ what: "distance", from: a.name, to: b.name, value, sigma, unit: data.frame.unit, title: "between centres" });
  }
  return rows;
}
// Of B from A, along the axes.
function components(a, b) {
  return axes.map((axis, k) => ({ what: "xyz"[k], value: b.at.clone().sub(a.at).dot(axis), unit: data.frame.unit,
                                  sigma: withScale(b.at.clone().sub(a.at).dot(axis), Math.sqrt(variance(a, axis) + variance(b, axis))) }));
}
// A number as well as it is known.
function known({ value, sigma, unit }) {
  const ending = unit === "deg" ? "\u00b0" : unit ? " " + unit : "";
  if (!(sigma > 0)) return Number(value.toPrecision(7)) + ending;
  const decimals = Math.min(15, Math.max(0, 1 - Math.floor(Math.log10(sigma))));
  return `${value.toFixed(decimals)} \u00b1 ${sigma.toFixed(decimals)}${ending}`;
}
const coordinates = item => item.at.clone().add(origin).toArray()
    .map(x => Number(x.toFixed(Math.min(15, Math.max(0, 6 - Math.floor(Math.log10(size)))))));
// For a shell: the distance between two points is what it is told to be.
const alignCommand = (a, b) => "colmap_curvix align --workspace_path \u2026 --distance " +
    [a, b].map(item => item.word || coordinates(item).join()).join(" ") + " LENGTH";

// ---- picking
// Nodes first, then curves, then points of the model.
function itemAt(x, y, reach) {
  const node = nearestOf(nodesShown() ? nodePlaces : [], x, y, reach);
  if (node >= 0) return nodeItem(node);
  const hit = segmentAt(x, y, reach);
  if (hit) {
    const { c, i } = hit, [a, b] = [c.points[i], c.points[i + 1]], near = new THREE.Vector3();
    rayAt(x, y).distanceSqToSegment(a, b, null, near);
    const t = near.distanceTo(a) / (a.distanceTo(b) || 1);
    return fitItem(c, fitAt(c, Math.round(c.kept[i] + t * (c.kept[i + 1] - c.kept[i])) % c.n), near, b.clone().sub(a).normalize());
  }
  const point = nearestOf($("points").checked ? pointPlaces : [], x, y, reach);
  return point >= 0 ? pointItem(point) : null;
}
let picked = [];
function pick(item) {
  if (state.selected >= 0) select(-1);
  picked = item ? picked.length === 1 ? [...picked, item] : [item] : [];
  showPicked();
}
const titleOf = item => item.name.replace("node", "junction") + (item.fit ? ` (curve ${item.curve})` : "");
function showPicked() {
  const card = openCard(state.measuring || picked.length > 0), [a, b] = picked;
  markPicked();
  if (card.hidden) return;
  if (!a) { make("h2", "Measure", card); make("div", "Click a junction, a curve or a point, then another one.", card); return; }
  const table = rows => {
    const body = make("table", null, card);
    for (const [name, value] of rows) { const r = make("tr", null, body); make("td", name, r); make("td", value, r); }
  };
  picked.forEach((item, k) => {
    make("h2", "AB"[k] + ": " + titleOf(item), card);
    table([...measuresOf(item).map(m => [m.what, known(m)]), ["at", coordinates(item).join(", ")]]);
  });
  if (!b) { make("div", "Click another one to measure between the two.", card, { className: "soft" }); return; }
  make("h2", "From A to B", card);
  table([...measuresBetween(a, b).map(m => [m.title || m.what, known(m)]),
         ...(axes ? components(a, b).map(m => ["along " + m.what, known(m)]) : [])]);
  if (a.line && b.line) {
    const normal = normalOf(a.line, b.line);
    if (normal) make("button", "Look square at both", card).onclick = () => lookSquare(normal, [a.free, b.free]);
  }
  make("div", "If you know the distance, this scales the results:", card, { className: "soft" });
  const code = make("code", null, card);  // which breaks between options only
  for (const part of alignCommand(a, b).split(/ (?=--)/)) { make("span", part, code); code.append(" "); }
}
// Of the plane that two lines span; null: they are on one line.
function normalOf(first, second) {
  const u = first.delta(new THREE.Vector3()).normalize(), v = second.delta(new THREE.Vector3()).normalize();
  let normal = u.clone().cross(v);
  if (normal.length() < .02) normal = u.clone().cross(second.getCenter(new THREE.Vector3()).sub(first.getCenter(new THREE.Vector3())));
  return normal.length() > 1e-6 * size ? normal.normalize() : null;
}
// Along `normal`, from this side, with one of the directions upright or level: that which comes nearest to up.
function lookSquare(normal, directions) {
  if (normal.dot(eye.position.clone().sub(controls.target)) < 0) normal = normal.clone().negate();
  const wanted = Math.abs(normal.dot(up)) < .98 ? up : new THREE.Vector3().setFromMatrixColumn(eye.matrixWorld, 1);
  const candidates = [].concat(...directions.map(d => [d, d.clone().negate(), d.clone().cross(normal), normal.clone().cross(d)]));
  const upright = candidates.reduce((best, v) => v.dot(wanted) > best.dot(wanted) ? v : best);
  lookAlong(normal, upright.clone().projectOnPlane(normal).normalize());
}
