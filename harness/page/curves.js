// Curves over time as SVG, whose colours follow the page's: one chart for each unit, with the values of the time shown.
var CURVES = (function () {
  "use strict";

  const WIDTH = 560, HEIGHT = 230, LEFT = 86, RIGHT = 10, TOP = 8, BOTTOM = 26, AROUND = TOP + BOTTOM;
  // As many colours as the reports have, and no more lines across the curves than leave them to be seen.
  const COLOURS = 7, MOST_MARKS = 150;

  const colour = (k) => "var(--c" + (k % COLOURS + 1) + ")";

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

  // A figure in `host` with a time axis, of all `height` pixels; `go(time)` is called when the reader points at a time.
  function frame(host, title, about, height, go) {
    const { element } = PLAYER, figure = document.createElement("figure"), caption = document.createElement("figcaption");
    const svg = element("svg", { viewBox: `0 0 ${WIDTH} ${height}`, role: "img" });
    const axis = element("g", {}, svg), drawn = element("g", {}, svg);
    let from = NaN, to = NaN, line = null;
    caption.textContent = title + (about ? " [" + about + "]" : "");
    figure.append(caption, svg);
    host.append(figure);
    const place = (time) => LEFT + (WIDTH - LEFT - RIGHT) * (time - from) / (to - from), across = (time) => place(time).toFixed(1);
    const places = (times) => Array.from(times, (time) => tenth(Math.round(10 * place(time))));
    const add = (name, attributes, to = drawn) => element(name, attributes, to);
    const text = (words, attributes, to) => { add("text", attributes, to).textContent = words; };
    svg.addEventListener("click", (event) => {
      const box = svg.getBoundingClientRect(), x = (event.clientX - box.left) * WIDTH / box.width;
      go(Math.min(to, Math.max(from, from + (x - LEFT) / (WIDTH - LEFT - RIGHT) * (to - from))));
    });

    // An empty chart of a run's times, with its impacts; the axis stays where its times do.
    function begin(run) {
      if (from !== run.from || to !== run.to) {
        [from, to] = [run.from, run.to];
        axis.replaceChildren();
        for (const time of ticks(from, to, 6)) {
          add("path", { d: `M${across(time)} ${TOP}V${height - BOTTOM}`, "class": "grid" }, axis);
          text(time + " s", { x: across(time), y: height - 8, "text-anchor": "middle" }, axis);
        }
      }
      drawn.replaceChildren();
      for (const row of run.struck.slice(0, MOST_MARKS))
        add("path", { d: `M${across(run.time[row])} ${TOP}V${height - BOTTOM}`, "class": "struck" });
    }

    const cursor = (time) => {
      if (line) line.setAttribute("d", `M${across(Math.min(to, Math.max(from, time)))} ${TOP}V${height - BOTTOM}`);
    };
    return { figure, svg, begin, add, text, places, across, cursor, end: () => { line = add("path", { "class": "cursor" }); } };
  }

  // Tenths of a pixel as texts: a number is written once, and not for each point anew.
  const TENTHS = Array.from({ length: 10 * WIDTH + 1 }, (_, k) => k / 10 + "");
  const tenth = (k) => TENTHS[k] || k / 10 + "";

  // The points of a line in tenths of a pixel, at `places`, the texts of where its times stand; of those that lie on one
  // level only the ends.
  function polyline(places, column, down) {
    let points = "", level = NaN, last = "";
    for (let row = 0; row < column.length; row++) {
      const y = Math.round(10 * down(column[row]));
      if (y !== y) continue;
      const point = places[row] + "," + tenth(y) + " ";
      if (y === level) last = point;
      else {
        points += last + point;
        last = "";
      }
      level = y;
    }
    return points + last;
  }

  // A chart in `host` of variables with one unit.
  function chart(host, title, variables, go) {
    const within = frame(host, title, variables[0].shown, HEIGHT, go), legend = document.createElement("ul");
    within.svg.setAttribute("aria-label", title + " over time: " + variables.map((one) => one.name).join(", "));
    const values = variables.map((one, k) => {
      const item = document.createElement("li"), swatch = document.createElement("i"), value = document.createElement("b");
      swatch.style.background = colour(k);
      item.title = one.description;
      item.append(swatch, one.name.replaceAll("_", " ") + " ", value);
      legend.append(item);
      return value;
    });
    within.figure.append(legend);
    const columnsOf = (run) => variables.map((one) => one.factor === 1 ? run.of(one.name) : run.of(one.name).map((value) => value * one.factor));
    let held;

    // A run {from, to, ...} with another one behind it, dashed.
    function draw(run, kept) {
      const columns = columnsOf(run), behind = kept ? columnsOf(kept) : [], [low, high] = span([...columns, ...behind]);
      const up = (value) => (TOP + (HEIGHT - TOP - BOTTOM) * (high - value) / (high - low)).toFixed(1);
      held = columns;
      within.begin(run);
      const digits = Math.max(1, Math.ceil(Math.log10(Math.max(Math.abs(low), Math.abs(high)) / (high - low))) + 2);
      for (const value of ticks(low, high, 5)) {
        within.add("path", { d: `M${LEFT} ${up(value)}H${WIDTH - RIGHT}`, "class": "grid" });
        within.text(String(Number(value.toPrecision(Math.min(digits, 15)))),
          { x: LEFT - 6, y: up(value), dy: "0.35em", "text-anchor": "end" });
      }
      const down = (value) => TOP + (HEIGHT - TOP - BOTTOM) * (high - value) / (high - low);
      const lines = (time, columns, more) => {
        const places = within.places(time);
        columns.forEach((column, k) =>
          within.add("polyline", { points: polyline(places, column, down), fill: "none", stroke: colour(k), "stroke-linejoin": "round", ...more }));
      };
      if (kept) lines(kept.time, behind, { "class": "kept", "stroke-width": 1.5 });
      lines(run.time, columns, { "stroke-width": 2 });
      within.end();
    }

    // The values at a row, which is shown at `time`.
    function show(time, row) {
      if (!held) return;
      within.cursor(time);
      held.forEach((column, k) => { values[k].textContent = Number((column[row] ?? NaN).toPrecision(5)); });
    }

    return { draw, show };
  }

  return { chart, frame, ticks, span, colour, LEFT, TOP, AROUND };
})();
if (typeof module === "object") module.exports = CURVES;
