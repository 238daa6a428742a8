// The page: what is given -> a run -> picture, curves, impacts; what is given stands in the address.
(function () {
  "use strict";

  const find = (selector) => document.querySelector(selector);
  const held = (id) => document.getElementById(id).textContent;
  const MODEL = JSON.parse(held("model"));
  // Of a table that people read.
  const MOST_ROWS = 50;
  const starts = new Map(MODEL.given.map((one) => [one.name, one.start]));
  // What was given when a run was asked for, by its number.
  const asked = new Map();
  const byName = new Map([...MODEL.reals, ...MODEL.flags].map((one) => [one.name, one]));
  let values = GIVEN.fromHash(MODEL.given, location.hash);
  let run = null, player = null, newest = 0, drawn = 0, coming = null, waiting = false;

  const valueOf = (name) => values.has(name) ? values.get(name) : starts.get(name);

  // --- what is given ---------------------------------------------------------------------------------------------
  const puts = MODEL.given.map((variable) => {
    const put = CONTROLS.control(find(variable.causality === "input" ? "#inputs" : "#parameters"), variable, (value) => {
      if (value === variable.start) values.delete(variable.name); else values.set(variable.name, value);
      given();
    });
    return () => put(valueOf(variable.name));
  });

  function given() {
    puts.forEach((put) => put());
    ask();
    try {
      history.replaceState(null, "", GIVEN.toHash(MODEL.given, values));
    } catch {
      // A host that shows the page in a frame of its own may have no address for it: then there is nothing to send.
    }
  }

  // --- the run: in a worker, or here where there can be none --------------------------------------------------------
  const bytes = Uint8Array.from(atob(held("wasm").trim()), (letter) => letter.charCodeAt(0));
  const plan = {
    stop: MODEL.stop, steps: MODEL.steps, reals: MODEL.reals.map((one) => one.reference),
    flags: MODEL.flags.map((one) => one.reference), constants: MODEL.constants.map((one) => [one.reference, one.type]),
  };
  let post = inWorker() || here();

  function inWorker() {
    try {
      const code = held("engine-code") + held("runner-code") + "RUNNER.serve(self);";
      const worker = new Worker(URL.createObjectURL(new Blob([code], { type: "text/javascript" })));
      worker.onmessage = ({ data }) => take(data);
      worker.onerror = () => {
        worker.terminate();
        post = here();
        ask();
      };
      worker.postMessage({ bytes, token: MODEL.token, plan });
      return (question) => worker.postMessage(question);
    } catch {
      return null;
    }
  }

  function here() {
    const ready = ENGINE.load(bytes, MODEL.token).then((engine) => RUNNER.runner(engine, plan, take));
    return (question) => ready.then((one) => one.ask(question))
      .catch((error) => take({ id: question.id, parts: [], text: error.message, refused: true }));
  }

  function ask() {
    newest += 1;
    asked.set(newest, new Map(values));
    find("#state").textContent = "computing …";
    post({ id: newest, values: MODEL.given.filter((one) => values.has(one.name))
      .map((one) => [one.reference, one.type, Number(values.get(one.name))]) });
  }

  // What has come of a run: its next rows, or a refusal. Parts of one run make a whole.
  function take(found) {
    if (coming && coming.id === found.id)
      found = { ...found, constants: coming.constants, parts: [...coming.parts, ...found.parts] };
    if (found.id < drawn || (coming && found.id < coming.id)) return;
    coming = found;
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      draw(coming);
    });
  }

  // --- what is shown ---------------------------------------------------------------------------------------------
  const charts = MODEL.charts.map(({ title, names }) => CURVES.chart(find("#charts"), title,
    names.map((name) => byName.get(name)), MODEL.stop, (time) => player && player.go(time)));

  function draw(found) {
    drawn = found.id;
    for (const id of asked.keys()) if (id < drawn) asked.delete(id);
    const last = found.id === newest;
    const alert = find("#refusal"), note = find("#note");
    alert.hidden = !found.refused;
    alert.textContent = found.refused ? found.text || "The run was refused." : "";
    note.hidden = found.refused || !found.text;
    note.textContent = found.refused ? "" : found.text;
    if (last && (found.finished || found.refused)) find("#state").textContent = "";
    document.body.classList.toggle("stale", Boolean(found.refused) && !found.parts.length);
    if (!found.parts.some((part) => part.length)) return;
    run = RECORD.record(MODEL, found);
    charts.forEach((chart) => chart.draw(run));
    impacts();
    const data = played(asked.get(found.id));
    find(".animation svg").classList.toggle("none", !data.shapes.length);
    find("#no-picture").hidden = Boolean(data.shapes.length);
    if (player) player.take(data); else player = ANIMATION.animate(find(".animation"), data, moved);
  }

  // The run for the player: of a model without a drawing, a clock without a picture.
  function played(asked) {
    const columns = Object.fromEntries(MODEL.moving.map((name) => [name, run.of(name)]));
    const constants = { ...run.constants };
    for (const one of MODEL.given) constants[one.name] = Number(asked.has(one.name) ? asked.get(one.name) : one.start);
    const picture = SCENE.scene(MODEL.shapes, columns, constants) || { columns: [], shapes: [], view: [0, 0, 1, 1] };
    return {
      ...picture, time: Array.from(run.time), end: MODEL.stop, decimals: MODEL.decimals, flash: "var(--hit)",
      impacts: run.struck.map((row) => run.time[row]),
      contacts: MODEL.contacts.map((one) => ({ active: run.of(one.variable).join("") })),
    };
  }

  function moved(time) {
    let low = 0, high = run.count;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (run.time[middle] <= time) low = middle; else high = middle;
    }
    charts.forEach((chart) => chart.show(time, low));
  }

  function impacts() {
    const table = find("#impacts"), columns = MODEL.impact.map((name) => byName.get(name));
    const cell = (row, text, tag) => { row.append(Object.assign(document.createElement(tag || "td"), { textContent: text })); };
    const head = document.createElement("tr"), body = run.struck.slice(0, MOST_ROWS).map((row) => {
      const line = document.createElement("tr");
      cell(line, run.time[row].toPrecision(10));
      for (const one of columns) cell(line, GIVEN.shown(one, run.of(one.name)[row]));
      return line;
    });
    cell(head, "time [s]", "th");
    for (const one of columns) {
      cell(head, one.name.replace(/^impact_/, "").replaceAll("_", " ") + (one.shown ? " [" + one.shown + "]" : ""), "th");
      Object.assign(head.lastChild, { scope: "col", title: one.description });
    }
    table.tHead.replaceChildren(head);
    table.tBodies[0].replaceChildren(...body);
    table.hidden = !body.length;
    const count = run.struck.length;
    find("#impact-count").textContent = !count ? "No impact in this run." :
      count === 1 ? "One impact." : count + " impacts" + (count > MOST_ROWS ? ", the first " + MOST_ROWS + ":" : ".");
  }

  // --- reset, file, address ----------------------------------------------------------------------------------------
  find("#reset").addEventListener("click", () => {
    values = new Map();
    if (player) player.go(0);
    given();
  });
  find("#csv").addEventListener("click", () => {
    if (!run) return;
    const address = URL.createObjectURL(new Blob([RECORD.csv(MODEL, run)], { type: "text/csv" }));
    Object.assign(document.createElement("a"), { href: address, download: MODEL.name + ".csv" }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  });
  addEventListener("hashchange", () => {
    values = GIVEN.fromHash(MODEL.given, location.hash);
    puts.forEach((put) => put());
    ask();
  });

  puts.forEach((put) => put());
  ask();
})();
