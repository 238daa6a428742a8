// The charts of a run on a page: one for each unit, and a lane for each contact; all with one cursor and one zoom.
var RUN_CHARTS = (function () {
  "use strict";

  // No more lines across the curves than leave them to be seen.
  const HEIGHT = 230, MOST_MARKS = 150, TIME = "time [s]";
  // What rounding leaves of nothing, in SI units.
  const NOTHING = 1e-12;

  const common = (run) => ({ x: TIME, y: "", range: [run.from, run.to], marks: run.struck.slice(0, MOST_MARKS).map((row) => run.time[row]) });

  // Of units, [[unit, how many are one SI unit], ...], that in which a magnitude is nearest to ten, in orders of magnitude.
  function unitOf(units, most) {
    const away = ([, factor]) => Math.abs(Math.log10(most * factor) - 1);
    return most > NOTHING && most < Infinity ? units.reduce((best, next) => away(next) < away(best) ? next : best) : units[0];
  }

  // A chart in `host` of variables with one unit, or another one of its `ladder`, [[unit, how many are one], ...]:
  // {draw(run, another one behind it or null)}.
  function quantity(host, title, variables, ladder, share, go) {
    const fixed = { height: HEIGHT, label: title + " over time: " + variables.map((one) => one.name).join(", ") };
    const units = [[variables[0].shown, variables[0].factor], ...ladder];
    let plot = null;

    const curves = (run, factor, more) => variables.map((one, k) => ({
      name: one.name.replaceAll("_", " "), about: one.description, colour: k, line: true, x: run.time, ...more,
      y: factor === 1 ? run.of(one.name) : run.of(one.name).map((value) => value * factor),
    }));

    function draw(run, kept) {
      const columns = [run, ...(kept ? [kept] : [])].flatMap((each) => variables.map((one) => each.of(one.name)));
      const most = Math.max(...(AXES.extent(columns) || [NaN]).map(Math.abs)), [unit, factor] = unitOf(units, most);
      const spec = {
        ...fixed, ...common(run), still: most <= NOTHING,
        title: title + (unit ? " [" + unit + "]" : "") + (most <= NOTHING ? ": 0 all the time" : ""),
        curves: [...(kept ? curves(kept, factor, { kept: true }) : []), ...curves(run, factor)],
      };
      if (plot) plot.take(spec); else plot = CURVES.plot(host, spec, share, { go });
    }

    return { draw };
  }

  // When something is on: [[from, to], ...] in the times of its rows; `on(row)`.
  function intervals(time, count, on) {
    const found = [];
    for (let row = 0, from = null; row < count; row++) {
      if (from === null && on(row)) from = time[row];
      if (from !== null && (!on(row) || row === count - 1)) {
        found.push([from, time[row]]);
        from = null;
      }
    }
    return found;
  }

  // A chart in `host` of `parts`, [{name, active, sticks}] with names of flags, "" for none: full where closed, striped
  // where it sticks.
  function contacts(host, parts, share, go) {
    const fixed = { title: "Contacts", label: "Contacts over time: " + parts.map((one) => one.name).join(", "), curves: [] };
    let plot = null;

    function draw(run) {
      const spans = (flag) => flag ? intervals(run.time, run.count, (row) => run.of(flag)[row] === 1) : [];
      const lanes = parts.map(({ name, active, sticks }, k) => ({ name, colour: k, spans: spans(active), striped: spans(sticks) }));
      const spec = { ...fixed, ...common(run), y: "full: closed; striped: sticks", lanes };
      if (plot) plot.take(spec); else plot = CURVES.plot(host, spec, share, { go });
    }

    return { draw };
  }

  return { quantity, contacts, intervals, unitOf };
})();
if (typeof module === "object") module.exports = RUN_CHARTS;
