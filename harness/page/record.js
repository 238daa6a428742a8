// What a run has recorded, by name: columns and impacts.
var RECORD = (function () {
  "use strict";

  const columnsOf = (model) => [...model.reals, ...model.flags, ...model.wholes];
  const placesOf = (model) => new Map(columnsOf(model).map((variable, k) => [variable.name, 2 + k]));
  const named = (model, constants) => Object.fromEntries(model.constants.map((variable, k) => [variable.name, constants[k]]));

  // Of `found` = {width, parts: [rows, ...], constants} as the runner posts it; `model` is the page's data.
  function record(model, found) {
    const width = found.width, rows = joined(found.parts), count = rows.length / width, places = placesOf(model);
    function column(at) {
      const found = new Float64Array(count);
      for (let row = 0, k = at; row < count; row++, k += width) found[row] = rows[k];
      return found;
    }
    const kept = new Map();
    // Of an output by its name, in SI units; made when it is first asked for.
    function of(name) {
      if (!kept.has(name)) kept.set(name, column(places.get(name)));
      return kept.get(name);
    }
    const time = column(0), struck = [];
    for (let row = 0; row < count; row++) if (rows[row * width + 1] === 1) struck.push(row);
    return { count, time, of, struck, hits: struck.length, constants: named(model, found.constants), text: found.text,
      finished: found.finished };
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

  // The last seconds of a live run: as a record, and rows are added. At most `most` rows and `span` seconds are
  // kept; impacts are counted in `hits` even when they are gone.
  function last(model, constants, span, most) {
    const places = placesOf(model), time = [], columns = new Map(), rows = [];
    const run = { count: 0, time, struck: [], hits: 0, constants: named(model, constants), text: "", finished: true };
    run.of = (name) => {
      if (!columns.has(name)) columns.set(name, rows.map((row) => row[places.get(name)]));
      return columns.get(name);
    };
    run.add = (more, width) => {
      for (let at = 0; at < more.length; at += width) {
        const row = more.slice(at, at + width);
        rows.push(row);
        time.push(row[0]);
        columns.forEach((column, name) => column.push(row[places.get(name)]));
        if (row[1] === 1) run.hits += 1;
      }
      let old = Math.max(0, rows.length - most);
      while (time.length && time[old] < time[time.length - 1] - span) old++;
      for (const column of [rows, time, ...columns.values()]) column.splice(0, old);
      run.count = rows.length;
      run.struck = [];
      rows.forEach((row, k) => { if (row[1] === 1) run.struck.push(k); });
    };
    return run;
  }

  return { record, last, columnsOf };
})();
if (typeof module === "object") module.exports = RECORD;
