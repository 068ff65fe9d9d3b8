// SPDX-License-Identifier: BSD-3-Clause
// Added to viewer.html by the test: uses the page as a person does, and writes
// down what came of it, for chromium --dump-dom.

// Every measure that dimensions.csv may have: its row without the unit to value
// and sigma.
function allMeasures() {
  const lines = [], others = [];
  for (const c of curves) c.fits.forEach((f, k) => {
    const item = fitItem(c, k, c.points[0], null);
    (item.line ? lines : others).push(item);
  });
  const longest = lines.sort((a, b) => b.fit.l - a.fit.l).slice(0, 20);
  const circles = others.filter(item => item.fit.k === "circle");
  const nodes = data.nodes.map((_, i) => nodeItem(i)), found = {};
  const add = m => { found[[m.what, m.from, m.to].join()] = [m.value, m.sigma]; };
  for (const item of [...lines, ...others]) measuresOf(item).forEach(add);
  for (const list of [longest, circles, nodes]) {
    list.forEach((a, i) => list.slice(i + 1).forEach(b => measuresBetween(a, b).forEach(add)));
  }
  return found;
}
// Whether a line that begins behind the camera can be picked where it is seen.
function isPickedBesideCamera(c) {
  const [from, to] = [c.points[0], c.points[c.points.length - 1]];
  const along = to.clone().sub(from), across = along.clone().cross(Math.abs(along.dot(up)) < .9 * along.length() ? up : side);
  $("parallel").checked = false;
  eye.position.lerpVectors(from, to, .4).add(across.setLength(.05 * along.length()));
  controls.target.copy(to);
  eye.lookAt(to);
  paint();
  const behind = onScreen(from), spot = onScreen(new THREE.Vector3().lerpVectors(from, to, .45));
  for (const other of curves) other.shown = other === c;
  const isPicked = behind.hidden && !spot.hidden && nearest(spot.x, spot.y, 20) === c.id;
  filter();
  return isPicked;
}
// Two nodes by mouse, two points of curves by a finger, elevations and a picture.
function measureLikeAPerson(seen, click, point) {
  seen.measures = allMeasures();
  $("measure").click();
  lookAs("Plan");
  paint();
  seen.lookingDown = eye.position.clone().sub(controls.target).normalize().dot(up);
  // Without perspective, what is seen does not depend on the height.
  const above = [0, 1].map(k => onScreen(up.clone().multiplyScalar(k * size)));
  seen.rises = Math.hypot(above[0].x - above[1].x, above[0].y - above[1].y);
  const bar = $("scalebar"), drawn = onScreen(side.clone().multiplyScalar(parseFloat(bar.textContent))), from = onScreen(new THREE.Vector3());
  seen.scaleBar = Math.hypot(drawn.x - from.x, drawn.y - from.y) / parseFloat(bar.style.width);
  lookAs("Oblique");
  paint();
  // Nodes that no other one covers.
  const spots = nodePlaces.map(onScreen);
  const apart = spots.map((p, i) => i).filter(i => spots.every((q, j) => i === j || Math.hypot(q.x - spots[i].x, q.y - spots[i].y) > 12));
  const [first, second] = [apart[0], apart[apart.length - 1]];
  for (const i of [first, second]) click(spots[i].x, spots[i].y);
  seen.nodesPicked = picked.map(item => item.name).join() === `node ${first},node ${second}`;
  seen.command = $("card").querySelector("code").textContent.trim().endsWith(`--distance ${first} ${second} LENGTH`);
  paint();
  seen.label = $("label").textContent;
  // Lines that no other one covers.
  const spot = c => onScreen(new THREE.Vector3().lerpVectors(c.points[0], c.points[c.points.length - 1], .4));
  const lines = curves.filter(c => c.type === "line" && nearest(spot(c).x, spot(c).y + 12, 22) === c.id);
  const free = c => fitItem(c, 0, c.points[0]).free;
  for (const c of [lines[0], lines.find(other => Math.abs(free(other).dot(free(lines[0]))) < .1)]) {
    for (const type of ["pointerdown", "pointerup"]) point(type, spot(c).x, spot(c).y + 12, { pointerType: "touch" });
  }
  seen.linesPicked = picked.filter(item => item.line).length;
  seen.coordinates = /--distance \S+,\S+,\S+ \S+,\S+,\S+ LENGTH/.test($("card").textContent);
  const directions = picked.map(item => item.free);
  $("card").querySelector("button").click();
  const out = eye.position.clone().sub(controls.target).normalize();
  seen.square = Math.max(...directions.map(d => Math.abs(out.dot(d))));
  window.onkeydown({ key: "Escape", target: canvas, preventDefault() {} });
  seen.measuringAfterEscape = state.measuring;
  if (renderer) {
    const image = picture(), pixels = image.getContext("2d").getImageData(0, 0, image.width, image.height).data;
    seen.pictureSize = Math.max(image.width, image.height);
    seen.pictureDark = pixels.filter((v, i) => i % 4 === 0 && v < 200).length;
    seen.pictureCorner = [...pixels.slice(0, 4)];
  }
  seen.pickedBesideCamera = isPickedBesideCamera(lines[0]);
  lookAs("Photo");
}
setTimeout(() => {
  const seen = {};
  seen.total = $("total").textContent;
  seen.shownAtFirst = $("shown").textContent;
  seen.missing = !$("missing").hidden;
  paint();
  seen.inside = curves.every(c => c.points.map(onScreen).every(
      q => !q.hidden && q.x >= 0 && q.x <= width && q.y >= 0 && q.y <= height));
  const rectangle = canvas.getBoundingClientRect();
  const point = (type, x, y, more) => canvas.dispatchEvent(new PointerEvent(type, {
    clientX: rectangle.left + x, clientY: rectangle.top + y, bubbles: true, isPrimary: true, ...more }));
  const click = (x, y) => { for (const type of ["pointermove", "pointerdown", "pointerup"]) point(type, x, y); };
  const longest = curves.reduce((a, b) => a.length > b.length ? a : b);
  const place = onScreen(new THREE.Vector3().lerpVectors(longest.points[0], longest.points[1], .5));
  if (renderer) {
    const gl = renderer.getContext(), pixel = new Uint8Array(4);
    gl.readPixels(place.x, height - place.y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    seen.drawn = pixel[3] > 0;
    gl.readPixels(2, 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    seen.drawnNowhere = pixel[3] > 0;
  }
  const under = nearest(place.x, place.y);
  click(place.x, place.y);
  seen.selectedRight = document.body.dataset.selected === String(under);
  seen.card = $("card").hidden ? "" : $("card").textContent;
  seen.photos = $("card").querySelectorAll("figure").length;
  click(2, 2);
  seen.selectedNothing = document.body.dataset.selected;
  const before = eye.position.clone(), away = distance();
  canvas.dispatchEvent(new MouseEvent("mousedown", { clientX: 100, clientY: 100 }));
  document.dispatchEvent(new MouseEvent("mousemove", { clientX: 200, clientY: 120 }));
  document.dispatchEvent(new MouseEvent("mouseup"));
  seen.turned = before.distanceTo(eye.position) / away;
  canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: -100 }));
  seen.zoomed = distance() / away;
  measureLikeAPerson(seen, click, point);
  $("minLength").value = 100;
  $("minLength").dispatchEvent(new Event("input"));
  seen.shownLongest = $("shown").textContent;
  seen.objects = (formats.OBJ().match(/^o /gm) || []).length;
  seen.plyHead = formats.PLY().slice(0, 4);
  seen.jsonCurves = JSON.parse(formats.JSON()).length;
  seen.error = document.body.dataset.error || "";
  const result = document.createElement("pre");
  result.id = "probe";
  result.textContent = "PROBE" + JSON.stringify(seen) + "PROBE";
  document.body.appendChild(result);
}, 300);
