// SPDX-License-Identifier: BSD-3-Clause
// Added to viewer.html by the test: uses the page as a person does, and writes
// down what came of it, for chromium --dump-dom.
setTimeout(() => {
  const seen = {};
  canvas.setPointerCapture = () => {};  // synthetic pointers cannot be captured
  seen.total = $("total").textContent;
  seen.shownAtFirst = $("shown").textContent;
  paint();
  seen.inside = curves.every(c => c.x.every((x, i) => x >= 0 && x <= width && c.y[i] >= 0 && c.y[i] <= height));
  const rectangle = canvas.getBoundingClientRect();
  const click = (x, y) => {
    for (const type of ["pointermove", "pointerdown", "pointerup"]) {
      canvas.dispatchEvent(new PointerEvent(type, {
        clientX: rectangle.left + x, clientY: rectangle.top + y, pointerId: 1, bubbles: true }));
    }
  };
  const longest = curves.reduce((a, b) => a.length > b.length ? a : b);
  const middle = longest.n >> 1;
  const under = nearest(longest.x[middle], longest.y[middle]);
  click(longest.x[middle], longest.y[middle]);
  seen.selectedRight = document.body.dataset.selected === String(under);
  seen.card = $("card").hidden ? "" : $("card").textContent;
  seen.photos = $("card").querySelectorAll("figure").length;
  click(2, 2);
  seen.selectedNothing = document.body.dataset.selected;
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
