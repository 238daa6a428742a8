// Curves over time as SVG, whose colours follow the page's: one chart for each unit, with the values of the time shown.
var CURVES = (function () {
  "use strict";

  const WIDTH = 560, HEIGHT = 230, LEFT = 62, RIGHT = 10, TOP = 8, BOTTOM = 26;
  // As many colours as the reports have, and no more lines across the curves than leave them to be seen.
  const COLOURS = 7, MOST_MARKS = 150;

  // Round numbers between two, about `count` of them.
  function ticks(low, high, count) {
    const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((digit) => digit * power >= raw * (1 - 1e-9));
    const first = Math.ceil(low / step - 1e-9), found = [];
    for (let k = first; k * step <= high + 1e-9 * step; k++) found.push(Number((k * step).toPrecision(12)));
    return found;
  }

  // From the least to the greatest of the columns, with some room; what is constant stands in the middle.
  function span(columns) {
    let low = Infinity, high = -Infinity;
    for (const column of columns) for (const value of column) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    if (!(low <= high)) return [-1, 1];
    const room = high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high)) ? 0.05 * (high - low) :
      Math.abs(high) * 0.1 || 1;
    return [low - room, high + room];
  }

  // A chart in `host` of variables with one unit; `go(time)` is called when the reader points at a time.
  function chart(host, title, variables, stop, go) {
    const { element } = PLAYER;
    const unit = variables[0].shown, figure = document.createElement("figure");
    const caption = document.createElement("figcaption"), legend = document.createElement("ul");
    caption.textContent = title + (unit ? " [" + unit + "]" : "");
    const svg = element("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img" });
    svg.setAttribute("aria-label", caption.textContent + " over time: " + variables.map((one) => one.name).join(", "));
    const values = variables.map((one, k) => {
      const item = document.createElement("li"), swatch = document.createElement("i"), value = document.createElement("b");
      swatch.style.background = colour(k);
      item.title = one.description;
      item.append(swatch, one.name.replaceAll("_", " ") + " ", value);
      legend.append(item);
      return value;
    });
    figure.append(caption, svg, legend);
    host.append(figure);
    svg.addEventListener("click", (event) => {
      const box = svg.getBoundingClientRect(), x = (event.clientX - box.left) * WIDTH / box.width;
      go(Math.min(stop, Math.max(0, (x - LEFT) / (WIDTH - LEFT - RIGHT) * stop)));
    });
    const across = (time) => (LEFT + (WIDTH - LEFT - RIGHT) * time / stop).toFixed(1);
    let cursor, held;

    function draw(run) {
      const columns = variables.map((one) => run.of(one.name).map((value) => value * one.factor));
      const [low, high] = span(columns);
      const up = (value) => (TOP + (HEIGHT - TOP - BOTTOM) * (high - value) / (high - low)).toFixed(1);
      held = { run, columns };
      svg.replaceChildren();
      const text = (words, attributes) => { element("text", attributes, svg).textContent = words; };
      const digits = Math.max(1, Math.ceil(Math.log10(Math.max(Math.abs(low), Math.abs(high)) / (high - low))) + 2);
      for (const value of ticks(low, high, 5)) {
        element("path", { d: `M${LEFT} ${up(value)}H${WIDTH - RIGHT}`, "class": "grid" }, svg);
        text(String(Number(value.toPrecision(Math.min(digits, 15)))),
          { x: LEFT - 6, y: up(value), dy: "0.35em", "text-anchor": "end" });
      }
      for (const time of ticks(0, stop, 6)) {
        element("path", { d: `M${across(time)} ${TOP}V${HEIGHT - BOTTOM}`, "class": "grid" }, svg);
        text(time + " s", { x: across(time), y: HEIGHT - 8, "text-anchor": "middle" });
      }
      for (const row of run.struck.slice(0, MOST_MARKS))
        element("path", { d: `M${across(run.time[row])} ${TOP}V${HEIGHT - BOTTOM}`, "class": "struck" }, svg);
      columns.forEach((column, k) => {
        const points = Array.from(column, (value, row) => Number.isFinite(value) ? across(run.time[row]) + "," + up(value) : "");
        element("polyline", { points: points.join(" "), fill: "none", stroke: colour(k), "stroke-width": 2,
          "stroke-linejoin": "round" }, svg);
      });
      cursor = element("path", { "class": "cursor" }, svg);
    }

    // The values at a row, which is shown at `time`.
    function show(time, row) {
      if (!held) return;
      cursor.setAttribute("d", `M${across(time)} ${TOP}V${HEIGHT - BOTTOM}`);
      held.columns.forEach((column, k) => { values[k].textContent = Number(column[row].toPrecision(5)); });
    }

    return { draw, show };
  }

  const colour = (k) => "var(--c" + (k % COLOURS + 1) + ")";

  return { chart, ticks, span };
})();
if (typeof module === "object") module.exports = CURVES;
