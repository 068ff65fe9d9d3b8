// SPDX-License-Identifier: BSD-3-Clause
// Added to viewer.html by the test: uses the page as a person does, and writes
// down what came of it, for chromium --dump-dom.
setTimeout(() => {
  const seen = {};
  seen.total = $("total").textContent;
  seen.shownAtFirst = $("shown").textContent;
  seen.missing = !$("missing").hidden;
  paint();
  seen.inside = curves.every(c => c.points.map(onScreen).every(
      q => !q.hidden && q.x >= 0 && q.x <= width && q.y >= 0 && q.y <= height));
  const rectangle = canvas.getBoundingClientRect();
  const point = (type, x, y) => canvas.dispatchEvent(new PointerEvent(type, {
    clientX: rectangle.left + x, clientY: rectangle.top + y, bubbles: true }));
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
