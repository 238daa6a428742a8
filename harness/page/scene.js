// A run as the player of the reports takes it: what report/scene.py and report/animation.py make of a recorded one.
var SCENE = (function () {
  "use strict";

  // A bar that turns further than this between two frames [rad] may point anywhere in between.
  const SURE_TURN = 0.2;
  // More teeth than this are no picture; nothing smaller is drawn [m].
  const MOST_TEETH = 10000, LEAST_SIZE = 1e-12;

  // `columns`: arrays of what moves, by name; `constants`: numbers of all else. Null where there is nothing to draw.
  function scene(shapes, columns, constants) {
    if (!shapes.length) return null;
    const names = Object.keys(columns);
    const plain = (quantity) => typeof quantity === "string" ? quantity.replace(/^-/, "") : "";
    const sign = (quantity) => typeof quantity === "string" && quantity[0] === "-" ? -1 : 1;
    const moves = (quantity) => plain(quantity) in columns;
    const at = (quantity, frame) => typeof quantity === "number" ? quantity :
      sign(quantity) * (moves(quantity) ? columns[plain(quantity)][frame] : constants[plain(quantity)]);
    const pairs = (points) => points.map((point) => point.map((quantity) => at(quantity, 0)));

    // For the player: a number, or [column, sign].
    const number = (quantity) =>
      moves(quantity) ? [names.indexOf(plain(quantity)), sign(quantity)] : at(quantity, 0);
    const place = (where) => typeof where === "string" ? where : where.map(number);

    const struckWith = new Set(shapes.filter((shape) => shape.kind === "striker").map((shape) => shape.at));
    function shown(shape) {
      const record = { kind: shape.kind, name: shape.name || "", at: place(shape.at) };
      for (const key of ["angle", "length", "radius"]) if (key in shape) record[key] = number(shape[key]);
      if (shape.kind === "bar") record.pointed = struckWith.has(shape.name);
      if (shape.kind === "wheel") {
        record.count = Math.round(Math.min(Math.max(at(shape.count, 0), 1), MOST_TEETH));
        record.pitch = (shape.clockwise ? -1 : 1) * 2 * Math.PI / record.count;
        record.outline = pairs(shape.outline);
      }
      if (shape.points) record.points = pairs(shape.points);
      if (shape.copies) record.copies = pairs(shape.copies);
      if (shape.kind === "link") record.hull = hull(record.points);
      if (shape.to !== undefined) record.to = place(shape.to);
      if (shape.colour) record.colour = shape.colour;
      return record;
    }

    // In all frames: of what stands still, one value.
    const values = (quantity) => !moves(quantity) ? [at(quantity, 0)] :
      sign(quantity) > 0 ? columns[plain(quantity)] : columns[plain(quantity)].map((value) => -value);
    // From the least to the greatest; NaN where there is one.
    function extent(values) {
      let low = Infinity, high = -Infinity;
      for (const value of values) [low, high] = [Math.min(low, value), Math.max(high, value)];
      return [low, high];
    }

    // The box [m] that holds everything in all frames and on the way between them: left, bottom, right, top.
    function bounds() {
      const box = [Infinity, Infinity, -Infinity, -Infinity], ends = {};
      const hold = (spot, radius) => {
        const [left, right] = extent(spot.x), [bottom, top] = extent(spot.y), around = spot.slack + radius;
        if (!(left - around > box[0])) box[0] = left - around;
        if (!(bottom - around > box[1])) box[1] = bottom - around;
        if (!(right + around < box[2])) box[2] = right + around;
        if (!(top + around < box[3])) box[3] = top + around;
      };
      const spotOf = (where) => typeof where === "string" ? ends[where] : { x: values(where[0]), y: values(where[1]), slack: 0 };
      for (const shape of shapes) {
        const spot = spotOf(shape.at);
        hold(spot, radiusOf(shape));
        if (shape.kind === "bar") {
          ends[shape.name] = farEnd(shape, spot);
          hold(ends[shape.name], 0);
        }
        if (shape.points) pairs(shape.points).forEach(([x, y], k) => {
          ends[shape.name + "." + k] = { ...spot, slack: spot.slack + Math.hypot(x, y) };
        });
        if (shape.to !== undefined) hold(spotOf(shape.to), 0);
      }
      return box;
    }

    function farEnd(bar, from) {
      const lengths = values(bar.length), angles = values(bar.angle);
      let turn = 0;
      for (let frame = 1; frame < angles.length; frame++) turn = Math.max(turn, Math.abs(angles[frame] - angles[frame - 1]));
      if (turn > SURE_TURN) return { ...from, slack: from.slack + largest(lengths) };
      const of = (values, frame) => values.length > 1 ? values[frame] : values[0];
      const far = (from, part) => Array.from({ length: Math.max(from.length, lengths.length, angles.length) }, (_, frame) =>
        of(from, frame) + of(lengths, frame) * part(of(angles, frame)));
      return { x: far(from.x, Math.cos), y: far(from.y, Math.sin), slack: from.slack };
    }

    // The points of a link or outline, and those of each of its copies.
    function chains(shape) {
      const points = pairs(shape.points);
      const turned = ([x, y, angle]) => {
        const c = Math.cos(angle), s = Math.sin(angle);
        return points.map(([u, v]) => [x + c * u - s * v, y + s * u + c * v]);
      };
      return [points, ...pairs(shape.copies || []).map(turned)];
    }

    const largest = (values) => Math.max(...extent(values).map(Math.abs));

    function radiusOf(shape) {
      if (shape.kind === "disc") return largest(values(shape.radius));
      if (shape.points) return Math.max(...chains(shape).flat().map(([x, y]) => Math.hypot(x, y)));
      return shape.outline ? Math.max(...pairs(shape.outline).map(([radius]) => Math.abs(radius))) : 0;
    }

    const view = bounds(), size = Math.max(view[2] - view[0], view[3] - view[1]);
    if (!view.every(Number.isFinite) || !(size >= LEAST_SIZE)) return null;
    return { columns: names.map((name) => columns[name]), shapes: shapes.map(shown), view };
  }

  // The picture of a run with a setting, as the player has it; of a model without a drawing, none, for its clock alone.
  function pictured(model, run, setting) {
    const columns = Object.fromEntries(model.moving.map((name) => [name, run.of(name)]));
    const constants = { ...run.constants };
    for (const one of model.given) constants[one.name] = Number(GIVEN.valueOf(model, setting, one));
    return scene(model.shapes, columns, constants) || { columns: [], shapes: [], view: [0, 0, 1, 1] };
  }

  // The corners of the convex hull of points, counter-clockwise: two of points on a line, one of equal points.
  // Source: A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, Inf. Process. Lett. 9 (1979).
  function hull(points) {
    const sorted = [...points].sort(([a, b], [c, d]) => a - c || b - d)
      .filter(([x, y], k, all) => !k || x !== all[k - 1][0] || y !== all[k - 1][1]);
    const half = (ordered) => {
      const corners = [];
      for (const [x, y] of ordered) {
        while (corners.length > 1) {
          const [[ax, ay], [bx, by]] = corners.slice(-2);
          if ((bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0) break;
          corners.pop();
        }
        corners.push([x, y]);
      }
      return corners.slice(0, -1);
    };
    return sorted.length < 3 ? sorted : [...half(sorted), ...half([...sorted].reverse())];
  }

  return { scene, pictured };
})();
if (typeof module === "object") module.exports = SCENE;
