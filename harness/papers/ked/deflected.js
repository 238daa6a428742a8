// Plays a bending linkage: every .deflected element holds its data as JSON (see ked_charts.py).
(function () {
  "use strict";

  const { element, fit, held, player } = PLAYER;
  const INK = "#1c2733", PALE = "#b6c0ca";
  // Of the picture, in its own pixels: its size at most, and the room around the rigid motion.
  const MOST_WIDTH = 900, MOST_HEIGHT = 460, MARGIN = 70;
  // Straight pieces of a bent member, and seconds of a turn.
  const PIECES = 16, TURN = 6;

  function animate(root) {
    const find = (selector) => root.querySelector(selector);
    const data = held(root);
    const svg = find("svg"), play = find(".play"), slider = find(".angle"), times = find(".times"), kind = find("select");
    const count = data.degrees.length;
    const { across, down } = fit(svg, data.view, MOST_WIDTH, MOST_HEIGHT, MARGIN);

    // Numbers `size` to a frame, at an angle: linear between two frames, and the last one is followed by the first.
    function at(numbers, size, degrees) {
      const place = degrees / 360 * count, before = Math.floor(place) % count, part = place - Math.floor(place);
      const after = (before + 1) % count, found = [];
      for (let k = 0; k < size; k++)
        found.push((1 - part) * numbers[before * size + k] + part * numbers[after * size + k]);
      return found;
    }

    const place = (x, y) => across(x) + "," + down(y);

    // A member from its ends as they are displaced, `factor` times: along it linear, across it the cubic of a beam.
    function curve(member, degrees, factor) {
      const [x0, y0] = at(member.start, 2, degrees), [x1, y1] = at(member.end, 2, degrees);
      const length = Math.hypot(x1 - x0, y1 - y0), c = (x1 - x0) / length, s = (y1 - y0) / length;
      const [u0, v0, t0, u1, v1, t1] = at(member[kind.value], 6, degrees);
      const points = [];
      for (let k = 0; k <= PIECES; k++) {
        const z = k / PIECES, z2 = z * z, z3 = z2 * z;
        const along = z * length + factor * ((1 - z) * u0 + z * u1);
        const across = factor * ((1 - 3 * z2 + 2 * z3) * v0 + (z - 2 * z2 + z3) * length * t0 +
          (3 * z2 - 2 * z3) * v1 + (z3 - z2) * length * t1);
        points.push([x0 + c * along - s * across, y0 + s * along + c * across]);
      }
      return points;
    }

    function path(factor) {
      const rigid = data.path.rigid, bent = data.path[kind.value], points = [];
      for (let k = 0; k < 2 * count; k += 2)
        points.push(place(rigid[k] + factor * bent[k], rigid[k + 1] + factor * bent[k + 1]));
      return points.join(" ");
    }

    const line = { fill: "none", "stroke-linejoin": "round", "stroke-linecap": "round" };
    const rigidPath = element("polygon", { ...line, stroke: PALE, "stroke-width": 1.5 }, svg);
    const bentPath = element("polygon", { ...line, "class": "bent-path", stroke: INK, "stroke-width": 1.5,
      "stroke-dasharray": "5 4" }, svg);
    const rigid = data.members.map(() => element("line", { stroke: PALE, "stroke-width": 5 }, svg));
    const bent = data.members.map((member) =>
      element("polyline", { ...line, "class": "bent", stroke: member.colour, "stroke-width": 4 }, svg));
    const pins = data.members.flatMap(() => [0, 1].map(() =>
      element("circle", { r: 4.5, fill: "#fff", stroke: INK, "stroke-width": 1.5 }, svg)));
    let degrees = 0;

    function show() {
      const factor = Number(times.value);
      rigidPath.setAttribute("points", path(0));
      bentPath.setAttribute("points", path(factor));
      data.members.forEach((member, i) => {
        const [x0, y0] = at(member.start, 2, degrees), [x1, y1] = at(member.end, 2, degrees);
        const [px0, py0] = place(x0, y0).split(","), [px1, py1] = place(x1, y1).split(",");
        for (const [key, value] of Object.entries({ x1: px0, y1: py0, x2: px1, y2: py1 })) rigid[i].setAttribute(key, value);
        const points = curve(member, degrees, factor).map(([x, y]) => place(x, y));
        bent[i].setAttribute("points", points.join(" "));
        [points[0], points[PIECES]].forEach((point, k) => {
          const [x, y] = point.split(",");
          pins[2 * i + k].setAttribute("cx", x);
          pins[2 * i + k].setAttribute("cy", y);
        });
      });
      const text = degrees.toFixed(1) + "°";
      find(".time").textContent = "crank " + text + ", deflection × " + factor;
      slider.value = degrees;
      slider.setAttribute("aria-valuetext", text);
    }

    function advance(seconds) {
      degrees = (degrees + 360 * seconds / TURN) % 360;
      return true;
    }

    const playing = player(play, advance, show);
    play.addEventListener("click", () => playing.set(!playing.playing));
    slider.addEventListener("input", () => {
      degrees = Number(slider.value) % 360;
      playing.set(false);
    });
    times.addEventListener("input", show);
    kind.addEventListener("change", show);
    show();
  }

  document.querySelectorAll(".deflected").forEach(animate);
})();
