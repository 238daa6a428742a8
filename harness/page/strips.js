// Contacts over time: a strip for each, empty where it is open, full where it slips or just touches, hatched where it sticks.
var STRIPS = (function () {
  "use strict";

  const HIGH = 22, BAR = 14;

  // When a column is true: [[from, to], ...] in the times of its rows; `on(row)`.
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

  // A chart in `host` of `parts`: [{name, active, sticks}] with names of flags, "" for none.
  function chart(host, parts, go) {
    const frame = CURVES.frame(host, "Contacts", "full: closed; striped: sticks", parts.length * HIGH + CURVES.AROUND, go);
    frame.svg.setAttribute("aria-label", "Contacts over time: " + parts.map((one) => one.name).join(", "));

    function draw(run) {
      frame.begin(run);
      parts.forEach(({ name, active, sticks }, k) => {
        const top = CURVES.TOP + k * HIGH + (HIGH - BAR) / 2;
        const bars = (on, bar) => {
          for (const [from, to] of intervals(run.time, run.count, on))
            bar(frame.across(from), Math.max(0.8, frame.across(to) - frame.across(from)).toFixed(1));
        };
        frame.text(name, { x: CURVES.LEFT - 6, y: top + BAR / 2, dy: "0.35em", "text-anchor": "end", "class": "part" });
        const on = (flag) => (row) => run.of(flag)[row] === 1;
        if (active) bars(on(active), (x, width) =>
          frame.add("rect", { x, y: top, height: BAR, width, fill: CURVES.colour(k) }));
        if (sticks) bars(on(sticks), (x, width) =>
          frame.add("path", { d: `M${x} ${top + BAR / 2}h${width}`, "stroke-width": BAR, "class": "sticks" }));
      });
      frame.end();
    }

    return { draw, show: (time) => frame.cursor(time) };
  }

  return { chart, intervals };
})();
if (typeof module === "object") module.exports = STRIPS;
