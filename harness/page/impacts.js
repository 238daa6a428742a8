// The table of impacts: what the engine reports of each, the stress that it leaves, and that of the run that is kept.
var IMPACTS = (function () {
  "use strict";

  // Of a table that people read.
  const MOST_ROWS = 50;

  const words = (name) => name.replace(/^impact_/, "").replaceAll("_", " ");

  // Columns: {head, title, at(run, row)}, which gives a text.
  function columns(model) {
    const known = new Map(RECORD.columnsOf(model).map((one) => [one.name, one])), { struck, stress } = model;
    const of = (name) => {
      const one = known.get(name), unit = one.shown ? " [" + one.shown + "]" : "";
      const at = (run, row) => {
        const value = run.of(name)[row];
        return struck && name === struck.variable ? struck.names[value] ?? String(value) :
          one.type === "Int32" ? String(value) : GIVEN.shown(one, value);
      };
      return { head: words(name) + unit, title: one.description, at };
    };
    return [{ head: "time [s]", title: "Time", at: (run, row) => run.time[row].toPrecision(10) },
      ...model.impact.filter((name) => known.get(name).type === "Int32").map(of), ...(stress ? [{ head: "stress [MPa]", title: stress.title, at: stressAt(stress) }] : []),
      ...model.impact.filter((name) => known.get(name).type !== "Int32").map(of)];
  }

  // The largest bending stress is a constant of the material times the jump of the speed; a body that is held feels none.
  const stressAt = (stress) => (run, row) => {
    const jump = Math.abs(run.of(stress.jump)[row]);
    const held = stress.speed && jump <= stress.ratio * Math.abs(run.of(stress.speed)[row]) && Math.abs(run.of(stress.impulse)[row]) > 0;
    return held ? stress.held : String(Number((jump * stress.per / 1e6).toPrecision(5)));
  };

  // `draw(run, kept)` fills `table`, and `count` with how many there are; `go(time)` is called for a row.
  function table(model, table, count, go) {
    const shown = columns(model);
    const cell = (row, text, tag) => row.appendChild(Object.assign(document.createElement(tag), { textContent: text }));
    const head = document.createElement("tr");
    for (const { head: text, title } of shown) Object.assign(cell(head, text, "th"), { scope: "col", title });
    table.tHead.replaceChildren(head);

    function line(run, kept, k) {
      const row = document.createElement("tr");
      shown.forEach(({ at }, number) => {
        const one = cell(row, "", "td");
        if (k < run.struck.length && number === 0) {
          const button = cell(one, at(run, run.struck[k]), "button");
          button.type = "button";
          button.setAttribute("aria-label", "Go to the impact at " + button.textContent + " s");
          button.addEventListener("click", () => go(run.time[run.struck[k]]));
        } else if (k < run.struck.length) cell(one, at(run, run.struck[k]), "span");
        if (kept && k < kept.struck.length) cell(one, at(kept, kept.struck[k]), "small").className = "kept";
      });
      return row;
    }

    function draw(run, kept) {
      const of = Math.min(MOST_ROWS, Math.max(run.struck.length, kept ? kept.struck.length : 0));
      table.tBodies[0].replaceChildren(...Array.from({ length: of }, (_, k) => line(run, kept, k)));
      table.hidden = !of;
      count.textContent = (!run.hits ? "No impact in this run." : run.hits === 1 ? "One impact." : run.hits + " impacts" +
        (run.struck.length < run.hits ? "; those of the time shown:" : run.hits > MOST_ROWS ? ", the first " + MOST_ROWS + ":" : ".")) +
        (kept ? " Below each, smaller: the kept run." : "");
    }

    return { draw };
  }

  return { table };
})();
