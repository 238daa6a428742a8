// Many designs, each a line across upright axes, coloured by one of them; a range that is drawn on an axis leaves only
// the designs that lie in it. On a canvas: there may be thousands.
var PARALLEL = (function () {
  "use strict";

  const HEIGHT = 380, TOP = 30, BOTTOM = 62, NARROWEST = 92, AXIS = 9;
  // Viridis, a colour scale that keeps its order without colours, too: S. van der Walt and N. Smith, 2015.
  const SCALE = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
  const { element } = PLAYER;

  function hue(part) {
    const place = Math.min(Math.max(part, 0), 1) * (SCALE.length - 1), k = Math.min(Math.floor(place), SCALE.length - 2);
    return "rgb(" + SCALE[k].map((one, n) => Math.round(one + (SCALE[k + 1][n] - one) * (place - k))).join(",") + ")";
  }

  // {title, axes: [{name, about, values, log}], colour: number of an axis} in `host`.
  function plot(host, { title, axes, colour, designs }) {
    const make = (tag, name) => Object.assign(document.createElement(tag), { className: name || "" });
    const figure = make("figure", "plot parallel"), caption = make("figcaption"), told = make("output", "at"), stack = make("div", "stack scroll");
    const canvas = make("canvas"), svg = element("svg", { role: "group" }), all = make("button");
    caption.append(Object.assign(make("b"), { textContent: title }), told, all);
    Object.assign(all, { type: "button", textContent: "All designs", hidden: true });
    stack.tabIndex = 0;
    stack.append(canvas, svg);
    figure.append(caption, stack);
    host.append(figure);
    const chosen = axes.map(() => null), count = axes[0].values.length;
    const ends = axes.map(({ values }) => [Math.min(...values), Math.max(...values)]);
    svg.setAttribute("aria-label", title + ": " + axes.map((one, k) => `${one.name}, ${AXES.number(ends[k][0])} to ${AXES.number(ends[k][1])}`).join("; "));
    let width = 0;

    const part = (k, value) => {
      const [low, high] = ends[k], to = axes[k].log ? Math.log : (one) => one;
      return high > low ? (to(value) - to(low)) / (to(high) - to(low)) : 0.5;
    };
    const parts = axes.map((one, k) => one.values.map((value) => part(k, value)));
    const across = (k) => (k + 0.5) * width / axes.length;
    const down = (share) => HEIGHT - BOTTOM - share * (HEIGHT - BOTTOM - TOP);
    const isIn = (row) => chosen.every((range, k) => !range || (parts[k][row] >= range[0] && parts[k][row] <= range[1]));

    function lines() {
      const scale = globalThis.devicePixelRatio || 1, pen = canvas.getContext("2d");
      [canvas.width, canvas.height] = [width * scale, HEIGHT * scale];
      pen.scale(scale, scale);
      const order = Array.from({ length: count }, (_, row) => row), within = order.filter(isIn);
      const line = (row) => {
        pen.beginPath();
        axes.forEach((_, k) => pen.lineTo(across(k), down(parts[k][row])));
        pen.stroke();
      };
      pen.globalAlpha = Math.min(0.9, Math.max(0.12, 120 / count));
      if (within.length < count) {
        pen.strokeStyle = "rgba(128,128,128,0.25)";
        order.forEach(line);
      }
      for (const row of within) {
        pen.strokeStyle = hue(parts[colour][row]);
        line(row);
      }
      all.hidden = !chosen.some(Boolean);
      const some = within.slice(0, 12).map((row) => designs[row]).join(", ");
      told.textContent = all.hidden ? "" : `${within.length} of ${count} designs${within.length ? ": " + some + (within.length > 12 ? ", …" : "") : ""}`;
    }

    function frame() {
      svg.setAttribute("viewBox", `0 0 ${width} ${HEIGHT}`);
      svg.setAttribute("width", width);
      svg.replaceChildren();
      axes.forEach((one, k) => {
        const x = across(k), say = (words, y, name) => {
          const made = element("text", { x, y, "text-anchor": "middle", "class": name || "" }, svg);
          made.textContent = words;
          return made;
        };
        element("path", { d: `M${x} ${TOP}V${HEIGHT - BOTTOM}`, "class": "axis" }, svg);
        say(AXES.number(ends[k][1], 4), TOP - 8);
        say(AXES.number(ends[k][0], 4), HEIGHT - BOTTOM + 16);
        // two lines, as wide as there is room for
        const room = Math.max(10, Math.floor(width / axes.length / 6.6)), words = one.name;
        const cut = words.length > room ? Math.max(words.lastIndexOf(" ", room), words.lastIndexOf(".", room) + 1) : words.length;
        const first = words.slice(0, cut > 0 ? cut : room), rest = words.slice(first.length).trim();
        const about = say(first, HEIGHT - BOTTOM + 33, k === colour ? "name own" : "name");
        if (rest) say(rest.length > room ? rest.slice(0, room - 1) + "…" : rest, HEIGHT - BOTTOM + 48, "name");
        element("title", {}, about).textContent = one.about || one.name;
        if (chosen[k]) element("rect", { x: x - AXIS / 2, width: AXIS, y: down(chosen[k][1]), height: Math.max(2, down(chosen[k][0]) - down(chosen[k][1])), "class": "chosen" }, svg);
        const grip = element("rect", { x: x - 14, width: 28, y: TOP - 4, height: HEIGHT - BOTTOM - TOP + 8, "class": "grip" }, svg);
        grip.addEventListener("pointerdown", (event) => choose(event, k));
      });
    }

    // A range drawn on an axis; a click on it takes it away.
    function choose(event, k) {
      const top = () => svg.getBoundingClientRect().top;
      const at = (one) => Math.min(1, Math.max(0, (HEIGHT - BOTTOM - (one.clientY - top())) / (HEIGHT - BOTTOM - TOP))), begun = at(event);
      const move = (next) => {
        chosen[k] = [Math.min(begun, at(next)), Math.max(begun, at(next))];
        draw();
      };
      const end = (next) => {
        removeEventListener("pointermove", move);
        removeEventListener("pointerup", end);
        if (Math.abs(at(next) - begun) < 0.01) chosen[k] = null;
        draw();
      };
      addEventListener("pointermove", move);
      addEventListener("pointerup", end);
      event.preventDefault();
    }

    function draw() {
      lines();
      frame();
    }

    all.addEventListener("click", () => {
      chosen.fill(null);
      draw();
    });
    // As wide as there is room for, but with all axes apart: then it scrolls inside itself.
    function fit() {
      const next = Math.max(stack.clientWidth || 600, axes.length * NARROWEST);
      if (next === width) return;
      width = next;
      canvas.style.width = width + "px";
      canvas.style.height = HEIGHT + "px";
      draw();
    }
    if (typeof ResizeObserver === "function") new ResizeObserver(fit).observe(figure);
    fit();
  }

  return { plot, hue };
})();
if (typeof module === "object") module.exports = PARALLEL;
