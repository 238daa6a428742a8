// What a run has recorded, by name: columns, impacts, the file of it.
var RECORD = (function () {
  "use strict";

  // Of `found` = {width, parts: [rows, ...], constants} as the runner posts it; `model` is the page's data.
  function record(model, found) {
    const width = found.width, rows = joined(found.parts), count = rows.length / width;
    const place = new Map([...model.reals, ...model.flags].map((variable, k) => [variable.name, 2 + k]));
    const column = (at) => Float64Array.from({ length: count }, (_, row) => rows[row * width + at]);
    const kept = new Map();
    // Of a real or flag by its name, in SI units; made when it is first asked for.
    function of(name) {
      if (!kept.has(name)) kept.set(name, column(place.get(name)));
      return kept.get(name);
    }
    const time = column(0), struck = [];
    for (let row = 0; row < count; row++) if (rows[row * width + 1] === 1) struck.push(row);
    const constants = Object.fromEntries(model.constants.map((variable, k) => [variable.name, found.constants[k]]));
    return { count, time, of, struck, constants, text: found.text, finished: found.finished };
  }

  function joined(parts) {
    const whole = new Float64Array(parts.reduce((length, part) => length + part.length, 0));
    let at = 0;
    for (const part of parts) {
      whole.set(part, at);
      at += part.length;
    }
    return whole;
  }

  // All of a run in SI units, with the digits that make each number again.
  function csv(model, run) {
    const recorded = [...model.reals, ...model.flags].filter((one) => !one.name.startsWith("drawing_"));
    const head = ["time [s]", ...recorded.map((one) => one.name + (one.unit ? " [" + one.unit + "]" : ""))];
    const columns = [run.time, ...recorded.map((one) => run.of(one.name))];
    const lines = [head.join(",")];
    for (let row = 0; row < run.count; row++) lines.push(columns.map((column) => String(column[row])).join(","));
    return lines.join("\r\n") + "\r\n";
  }

  return { record, csv };
})();
if (typeof module === "object") module.exports = RECORD;
