// A chart as SVG, whose colours follow the page's: curves, dots, areas, bars, lanes, instants as lines across it; a
// cursor with values, a legend that hides and shows. Charts of one `group` have one cursor and one zoom.
var CURVES = (function () {
  "use strict";

  const { element } = PLAYER;
  const WIDTH = 560, HEIGHT = 250, LEFT = 56, RIGHT = 12, TOP = 16, BOTTOM = 26, LANE = 32, BAR = 12, LINE = 16, LETTER = 6.3;
  // As many colours as there are; dots that answer to the pointer are no farther [px]; a click moves no farther [px].
  const COLOURS = 7, NEAR = 40, STILL = 5, NARROWEST = 1e-9;
  const KEYS = "Arrow keys move the cursor, + and - zoom, 0 shows all.";

  const make = (tag, attributes, ...inside) => {
    const made = Object.assign(document.createElement(tag), attributes);
    made.append(...inside);
    return made;
  };
  const colour = (given) => typeof given === "number" ? "var(--c" + (given % COLOURS + 1) + ")" : given;

  // Charts that zoom and point together.
  function group() {
    const members = [], own = { members, range: null };
    own.zoom = (range) => {
      // so far that numbers still differ
      if (range && range[1] - range[0] <= NARROWEST * Math.max(...range.map(Math.abs))) return;
      own.range = range;
      members.forEach((one) => one.draw());
    };
    own.point = (x) => members.forEach((one) => one.point(x));
    return own;
  }

  // A chart in `host` of {title, x, y: labels with units, curves, marks, lanes, ...} (see plot.py); `hooks.go(x)` is
  // called when the reader clicks at a place, `hooks.buttons` stand beside the title.
  function plot(host, spec, share = group(), hooks = {}) {
    const reset = make("button", { type: "button", textContent: "Whole range", hidden: true });
    const told = make("output", { className: "at" });
    const heading = make("b"), caption = make("figcaption", {}, heading,
      make("span", { textContent: spec.y && spec.y !== spec.title ? spec.y : "" }), told, reset, ...(hooks.buttons || []));
    const svg = element("svg", { role: "img", tabindex: 0, "aria-description": KEYS });
    // the inner one is a picture of its own, that cuts off what lies beyond
    const layerX = element("g", {}, svg), layerY = element("g", {}, svg), inner = element("svg", {}, svg);
    const legend = make("ul", { className: "curves" }), figure = make("figure", { className: "plot" }, caption, svg, legend);
    host.append(figure);
    const unitOfX = /^(.*?) ?(?:\[(.*)\])?$/.exec((spec.x || "").split(";")[0]), hidden = new Set(), values = new Map(), states = [];
    let width = WIDTH, x = null, y = null, cursor = null, bottom = 0, at = null, drag = null, dragged = false;

    const shown = () => spec.curves.filter((one) => !hidden.has(one.name));
    // A cursor serves curves that go from left to right; among other points the nearest one is named.
    const hasCursor = () => Boolean(spec.lanes || spec.bars || spec.curves.some((one) => one.line && one.over));
    const zooms = () => !spec.to_scale && !spec.bars;

    function take(next) {
      spec = next;
      heading.textContent = spec.title;
      figure.classList.toggle("still", Boolean(spec.still));
      // curves of one run share their places
      const known = new Map();
      for (const one of spec.curves) {
        if (!known.has(one.x)) known.set(one.x, AXES.isOver(one.x));
        one.over = known.get(one.x);
      }
      entries();
      draw();
    }

    // The legend: an entry for each name.
    function entries() {
      const names = [...new Set(spec.curves.map((one) => one.name))];
      if (names.join("\n") === [...values.keys()].join("\n")) return;
      values.clear();
      legend.replaceChildren(...names.map((name) => {
        const one = spec.curves.find((each) => each.name === name), value = make("b");
        const swatch = make("i");
        swatch.style.background = colour(one.colour);
        const button = make("button", { type: "button", title: one.about || "" }, swatch, name + " ", value);
        button.setAttribute("aria-pressed", "true");
        button.addEventListener("click", () => {
          if (!hidden.delete(name)) hidden.add(name);
          button.setAttribute("aria-pressed", String(!hidden.has(name)));
          draw();
        });
        values.set(name, value);
        return make("li", {}, button);
      }));
      legend.hidden = spec.legend === false;
    }

    // --- the picture ---------------------------------------------------------------------------------------------
    function rangeOfX() {
      return share.range && zooms() ? share.range : whole();
    }

    function whole() {
      if (spec.range) return spec.range;
      if (spec.bars) return [-0.5, spec.bars.length - 0.5];
      const found = AXES.extent(shown().map((one) => one.x)) || [0, 1];
      // a curve over time fills the width, dots need room
      if (hasCursor() && !shown().some((one) => one.dots) && found[1] > found[0]) return found;
      return spec.log_x ? [found[0] / 1.2, found[1] * 1.2] : AXES.roomy(found, 0.04);
    }

    const drawn = new Map();
    function anew(layer, parts, work) {
      const key = parts.join();
      if (drawn.get(layer) === key) return;
      drawn.set(layer, key);
      layer.replaceChildren();
      work();
    }

    // Of the points of a curve, those between two places and one on each side.
    function within(one, [low, high]) {
      return one.over && (one.x[0] < low || one.x[one.x.length - 1] > high) ? [Math.max(0, AXES.before(one.x, low) - 1), Math.min(one.x.length, AXES.before(one.x, high) + 2)] : [0, one.x.length];
    }

    function rangeOfY(range) {
      const all = shown(), found = AXES.extent(all.map((one) => one.y), (_, k) => within(all[k], range)) || [spec.log_y ? 1 : 0, 10];
      if (spec.log_y) return [found[0] / 1.3, found[1] * 1.3];
      if (spec.from_zero || spec.bars) return [Math.min(0, found[0] * 1.05), Math.max(found[1] * 1.05, 0) || 1];
      return AXES.roomy(found, 0.05);
    }

    // Both axes with one scale, as a shape needs it.
    function toScale(rangeX, rangeY, wide, high) {
      const scale = Math.max((rangeX[1] - rangeX[0]) / wide, (rangeY[1] - rangeY[0]) / high);
      const around = ([a, b], size) => [(a + b) / 2 - scale * size / 2, (a + b) / 2 + scale * size / 2];
      return [around(rangeX, wide), around(rangeY, high)];
    }

    function draw() {
      const lanes = spec.lanes || [], own = spec.height || (lanes.length ? TOP + BOTTOM + LANE * lanes.length : HEIGHT);
      // a long name of the axis has a line of its own
      const isLong = (spec.x || "").length * LETTER > 0.45 * (width - LEFT), height = own + (isLong ? LINE : 0);
      bottom = own - BOTTOM;
      const size = `0 0 ${width} ${height}`;
      if (svg.getAttribute("viewBox") !== size) svg.setAttribute("viewBox", size);
      inner.replaceChildren();
      let rangeX = rangeOfX(), rangeY = lanes.length ? [0, 1] : rangeOfY(rangeX);
      if (spec.to_scale) [rangeX, rangeY] = toScale(rangeX, rangeY, width - LEFT - RIGHT, bottom - TOP);
      x = AXES.axis(rangeX, LEFT, width - RIGHT, spec.log_x);
      y = AXES.axis(rangeY, bottom, TOP, spec.log_y);
      reset.hidden = !(share.range && zooms());
      // axes stay where nothing of them has changed
      anew(layerX, [size, x.low, x.high, spec.x], () => ticksOfX(isLong));
      anew(layerY, [size, y.low, y.high, lanes.length], () => lanes.length || ticksOfY());
      const inside = width - LEFT - RIGHT;
      anew(inner, [size], () => Object.entries({ x: LEFT, y: 0, width: inside, height, viewBox: `${LEFT} 0 ${inside} ${height}` })
        .forEach(([name, value]) => inner.setAttribute(name, value)));
      for (const mark of spec.marks || []) if (mark >= x.low && mark <= x.high)
        element("path", { d: `M${x.place(mark).toFixed(1)} ${TOP}V${bottom}`, "class": "struck" }, inner);
      lanes.forEach((lane, k) => drawLane(lane, k));
      if (spec.bars) shown().forEach((one, k, all) => drawBars(one, k, all.length));
      else for (const one of shown()) drawCurve(one);
      cursor = element("path", { "class": "cursor" }, inner);
      svg.setAttribute("aria-label", spec.label || described());
      point(at);
    }

    function ticksOfX(isLong) {
      if (spec.bars) return spec.bars.forEach((name, k) => text(name, { x: x.place(k), y: bottom + 17, "text-anchor": "middle" }, layerX));
      const room = (width - LEFT - RIGHT) / 75, exponent = spec.log_x ? 0 : AXES.exponentOf(Math.max(Math.abs(x.low), Math.abs(x.high)));
      const found = spec.log_x ? AXES.decades(x.low, x.high, room) : AXES.ticks(x.low, x.high, Math.max(2, Math.min(8, room)));
      const texts = spec.log_x ? found.map((one) => AXES.number(one)) : AXES.labels(found, exponent);
      const words = (exponent ? "×" + AXES.power(exponent) + " " : "") + (spec.x || ""), end = isLong ? 0 : words.length * LETTER + 14;
      found.forEach((value, k) => {
        const place = x.place(value).toFixed(1);
        element("path", { d: `M${place} ${TOP}V${bottom}`, "class": "grid" }, layerX);
        if (place < width - end) text(texts[k], { x: place, y: bottom + 17, "text-anchor": "middle" }, layerX);
      });
      const most = Math.floor((width - 8) / LETTER), shortened = words.length > most ? words.slice(0, most - 1) + "…" : words;
      const name = text(shortened, { x: width - RIGHT, y: bottom + 17 + (isLong ? LINE : 0), "text-anchor": "end", "class": "name" }, layerX);
      if (shortened !== words) element("title", {}, name).textContent = words;
    }

    function ticksOfY() {
      const exponent = spec.log_y ? 0 : AXES.exponentOf(Math.max(Math.abs(y.low), Math.abs(y.high)));
      const found = spec.log_y ? AXES.decades(y.low, y.high, 5) : AXES.ticks(y.low, y.high, Math.max(2, Math.min(6, bottom / 40)));
      const texts = spec.log_y ? found.map((one) => AXES.number(one)) : AXES.labels(found, exponent);
      found.forEach((value, k) => {
        const place = y.place(value).toFixed(1);
        element("path", { d: `M${LEFT} ${place}H${width - RIGHT}`, "class": "grid" }, layerY);
        text(texts[k], { x: LEFT - 6, y: place, dy: "0.35em", "text-anchor": "end" }, layerY);
      });
      if (exponent) text("×" + AXES.power(exponent), { x: LEFT - 6, y: 9, "text-anchor": "end", "class": "name" }, layerY);
    }

    function text(words, attributes, layer) {
      const made = element("text", attributes, layer);
      made.textContent = words;
      return made;
    }

    function drawCurve(one) {
      const paint = colour(one.colour);
      if (one.filled) element("path", { d: AXES.path(one.x, one.y, 0, one.x.length, x.place, y.place) + "Z", fill: paint, "class": "area" }, inner);
      if (one.line) element("path", { d: AXES.path(one.x, one.y, ...within(one, [x.low, x.high]), x.place, y.place), stroke: paint,
        "class": "curve" + (one.kept ? " kept" : "") }, inner);
      if (one.dots) element("path", { d: AXES.dots(one.x, one.y, x.place, y.place), stroke: paint, "class": "dots" }, inner);
    }

    function drawBars(one, place, count) {
      const wide = 0.7 * (x.place(1) - x.place(0)) / count;
      one.y.forEach((value, k) => {
        if (!AXES.isNumber(value)) return;
        const [top, foot] = [y.place(Math.max(value, 0)), y.place(Math.min(value, 0))];
        element("rect", { x: (x.place(k) + (place - count / 2) * wide).toFixed(1), y: top.toFixed(1), width: wide.toFixed(1),
          height: Math.max(foot - top, 0.5).toFixed(1), fill: colour(one.colour), "class": "bar" }, inner);
      });
    }

    // A lane: its name, and under it a bar for each time that it is on; empty it keeps its place.
    function drawLane(lane, k) {
      const top = TOP + k * LANE + LANE - BAR - 4;
      element("path", { d: `M${LEFT} ${top + BAR / 2}H${width - RIGHT}`, "class": "grid" }, inner);
      const bars = (spans, draw) => {
        for (const [from, to] of spans || []) if (to >= x.low && from <= x.high)
          draw(x.place(from).toFixed(1), Math.max(0.8, x.place(to) - x.place(from)).toFixed(1));
      };
      bars(lane.spans, (place, wide) => element("rect", { x: place, y: top, width: wide, height: BAR, fill: colour(lane.colour), "class": "bar" }, inner));
      bars(lane.striped, (place, wide) => element("path", { d: `M${place} ${top + BAR / 2}h${wide}`, "stroke-width": BAR, "class": "sticks" }, inner));
      const label = element("text", { x: LEFT + 2, y: top - 4 }, inner);
      element("title", {}, label).textContent = lane.about || lane.name;
      states[k] = element("tspan", {}, label);
      states[k].textContent = lane.name;
    }

    // What a reader who does not see it gets to know: names and ranges.
    function described() {
      const over = spec.bars ? "for " + spec.bars.join(", ") : `over ${spec.x}, from ${AXES.number(x.low)} to ${AXES.number(x.high)}`;
      const ranges = [...values.keys()].slice(0, 8).map((name) => {
        const found = AXES.extent(spec.curves.filter((one) => one.name === name).map((one) => one.y));
        return name + (found ? `, ${AXES.number(found[0])} to ${AXES.number(found[1])}` : "");
      });
      const lanes = (spec.lanes || []).map((lane) => `${lane.name}, ${lane.spans.length} times`);
      return `${[...new Set([spec.title, spec.y])].filter(Boolean).join(": ")}, ${over}: ${[...ranges, ...lanes].join("; ")}.`;
    }

    // --- the cursor ----------------------------------------------------------------------------------------------
    // Show the values at a place; null: nowhere.
    function point(place) {
      at = place === null || !x || !hasCursor() || !(place >= x.low && place <= x.high) ? null : spec.bars ? Math.round(place) : place;
      if (!cursor || !hasCursor()) return;
      cursor.setAttribute("d", at === null ? "" : `M${x.place(at).toFixed(1)} ${TOP}V${bottom}`);
      told.textContent = at === null ? "" : spec.bars ? spec.bars[at] : `${unitOfX[1]} ${AXES.number(at, 6)} ${unitOfX[2] === "1" ? "" : unitOfX[2] || ""}`;
      for (const one of spec.curves) if ((one.over || spec.bars) && one.line && !one.kept)
        values.get(one.name).textContent = at === null || hidden.has(one.name) ? "" : AXES.number(spec.bars ? one.y[at] : AXES.valueAt(one.x, one.y, at));
      (spec.lanes || []).forEach((lane, k) => {
        const on = at !== null && lane.spans.find(([from, to]) => from <= at && at <= to);
        states[k].textContent = lane.name + (at === null ? "" : on ? `: ${AXES.number(on[0], 7)} … ${AXES.number(on[1], 7)}` : ": –");
      });
    }

    // Name the point that is nearest to the pointer.
    function nearest(left, top) {
      let best = null, least = NEAR;
      for (const one of shown()) for (let k = 0; k < one.x.length; k++) {
        if (!AXES.isNumber(one.x[k]) || !AXES.isNumber(one.y[k])) continue;
        const far = Math.hypot(x.place(one.x[k]) - left, y.place(one.y[k]) - top);
        if (far < least) [best, least] = [[one, k], far];
      }
      cursor.setAttribute("d", best ? `M${x.place(best[0].x[best[1]]).toFixed(1)} ${y.place(best[0].y[best[1]]).toFixed(1)}m-6 0a6 6 0 1 0 12 0a6 6 0 1 0 -12 0` : "");
      const which = best && best[0].labels ? best[0].labels[best[1]] : best && values.size > 1 ? best[0].name : "";
      told.textContent = best ? `${which ? which + ": " : ""}${AXES.number(best[0].x[best[1]])}, ${AXES.number(best[0].y[best[1]])}` : "";
    }

    // Where the pointer is, in the units of the picture.
    function where(event) {
      const box = svg.getBoundingClientRect(), scale = width / (box.width || width);
      return [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    }
    const limited = (left) => x.value(Math.min(width - RIGHT, Math.max(LEFT, left)));

    svg.addEventListener("pointerdown", (event) => {
      // a finger moves the page
      if (event.button !== 0 || event.pointerType === "touch") return;
      dragged = false;
      drag = { from: where(event)[0], box: null };
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", (event) => {
      const [left, top] = where(event);
      if (hasCursor()) share.point(limited(left)); else nearest(left, top);
      if (!drag || !zooms() || Math.abs(left - drag.from) < STILL) return;
      if (!drag.box) drag.box = element("rect", { y: TOP, height: bottom - TOP, "class": "chosen" }, svg);
      const [a, b] = [drag.from, left].sort((one, other) => one - other).map((one) => Math.min(width - RIGHT, Math.max(LEFT, one)));
      drag.box.setAttribute("x", a);
      drag.box.setAttribute("width", b - a);
    });
    svg.addEventListener("pointerup", (event) => {
      const begun = drag, left = where(event)[0];
      drag = null;
      if (!begun || !begun.box) return;
      dragged = true;
      begun.box.remove();
      const [low, high] = [limited(begun.from), limited(left)].sort((one, other) => one - other);
      if (high > low) share.zoom([low, high]);
    });
    svg.addEventListener("pointercancel", () => {
      if (drag && drag.box) drag.box.remove();
      drag = null;
    });
    svg.addEventListener("pointerleave", () => {
      if (hasCursor()) return hooks.go ? undefined : share.point(null);
      cursor.setAttribute("d", "");
      told.textContent = "";
    });
    svg.addEventListener("click", (event) => hooks.go && !dragged && hooks.go(limited(where(event)[0])));
    svg.addEventListener("dblclick", () => share.zoom(null));
    reset.addEventListener("click", () => share.zoom(null));
    svg.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key], size = x.high - x.low;
      if (step && hasCursor() && !x.log) {
        const next = (at === null ? (x.low + x.high) / 2 : at) + step * (spec.bars ? 1 : size * (event.shiftKey ? 0.1 : 0.01));
        share.point(Math.min(x.high, Math.max(x.low, next)));
        if (hooks.go) hooks.go(at);
      } else if ("+-".includes(event.key) && zooms() && !x.log) {
        const middle = at === null ? (x.low + x.high) / 2 : at, half = size * (event.key === "+" ? 0.25 : 1);
        const [low, high] = whole();
        share.zoom(middle - half <= low && middle + half >= high ? null : [middle - half, middle + half]);
      } else if (event.key === "0" || event.key === "Escape") share.zoom(null);
      else return;
      event.preventDefault();
    });

    // Drawn again at each width that it gets, so that texts keep their size.
    if (typeof ResizeObserver === "function") new ResizeObserver(() => {
      const next = Math.round(svg.clientWidth || svg.getBoundingClientRect().width);
      if (!next || next === width) return;
      width = next;
      draw();
    }).observe(figure);

    const own = { figure, draw, take, point, get spec() { return spec; } };
    share.members.push(own);
    take(spec);
    return own;
  }

  return { plot, group, colour };
})();
if (typeof module === "object") module.exports = CURVES;
