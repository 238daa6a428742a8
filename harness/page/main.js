// The page: what is given -> a run -> picture, curves, impacts; what is given stands in the address.
(function () {
  "use strict";

  const find = (selector) => document.querySelector(selector);
  const held = (id) => document.getElementById(id).textContent;
  const MODEL = JSON.parse(held("model"));
  const byName = new Map(RECORD.columnsOf(MODEL).map((one) => [one.name, one]));
  const starts = () => ({ name: MODEL.cases[0].name, values: new Map() });
  const copy = (one) => ({ name: one.name, values: new Map(one.values) });
  // What is given; what was given when a run was asked for, by its number; the run that is kept, {setting, run}.
  // What is shown: the run, and what it was given; nothing of the live run, whose inputs were others before.
  let { setting, kept: asks } = GIVEN.fromHash(MODEL, location.hash);
  const asked = new Map();
  let kept = null, run = null, ran = null, view = null, player = null, newest = 0, drawn = 0, coming = null, waiting = false, isLive = false;

  // --- what is given ---------------------------------------------------------------------------------------------
  const hosts = { input: "#inputs", parameter: "#parameters", setting: "#settings" };
  const puts = MODEL.given.map((variable) => {
    const put = CONTROLS.control(find(hosts[variable.group]), variable, (value, drags) => {
      const same = value === GIVEN.valueOf(MODEL, setting, variable) && !GIVEN.signalsOf(MODEL, setting).some(([one]) => one === variable);
      GIVEN.put(MODEL, setting, variable, value);
      if (!same) given(isLive && variable.causality === "input");
      // a slider that is dragged comes into the address when it is let go
      if (!drags) address();
    });
    return () => put(GIVEN.valueOf(MODEL, setting, variable), GIVEN.startOf(MODEL, setting, variable),
      GIVEN.signalsOf(MODEL, setting).filter(([one]) => one === variable).map(([, signal]) => SIGNALS.words(signal))[0]);
  });
  const choice = find("#case");
  choice.addEventListener("change", () => {
    setting = { name: choice.value, values: new Map() };
    given();
    address();
  });

  // Shows what is given, and asks for what comes of it, unless it acts by itself on the live run.
  function given(acts) {
    puts.forEach((put) => put());
    choice.value = setting.name;
    find("#about-case").textContent = GIVEN.caseOf(MODEL, setting).description;
    offers();
    if (acts) return;
    if (isLive) begin(); else ask();
  }

  // Of what the files are: of the run that is shown, as the kept one is; of what is given, where it runs live or none is.
  const filed = () => ran || setting;
  function offers() {
    find("#inputs-csv").hidden = !GIVEN.signalsOf(MODEL, filed()).length;
  }

  // Each change is a step of the history.
  function address() {
    const hash = GIVEN.toHash(MODEL, setting, kept && kept.setting);
    if (hash === (location.hash || "#")) return;
    try {
      history.pushState(null, "", hash);
    } catch {
      // A host that shows the page in a frame of its own may have no address for it: then there is nothing to send.
    }
  }

  // --- the engine: in a worker, or here where there can be none -----------------------------------------------------
  const references = (list) => list.map((one) => one.reference);
  const engine = {
    wasm: held("wasm"), image: held("image"), token: MODEL.token,
    recorded: { reals: references(MODEL.reals), flags: references(MODEL.flags), wholes: references(MODEL.wholes) },
    constants: MODEL.constants.map((one) => [one.reference, one.type]),
  };
  let post = inWorker() || here();

  function inWorker() {
    try {
      const code = [...document.querySelectorAll("script.engine")].map((one) => one.textContent).join("") + "RUNNER.serve(self);";
      const worker = new Worker(URL.createObjectURL(new Blob([code], { type: "text/javascript" })));
      worker.onmessage = ({ data }) => take(data);
      worker.onerror = () => {
        worker.terminate();
        post = here();
        given();
      };
      worker.postMessage(engine);
      return (question) => worker.postMessage(question);
    } catch {
      return null;
    }
  }

  function here() {
    const ready = RUNNER.answering(engine, take);
    return (question) => ready.then((answer) => answer(question))
      .catch((error) => take({ id: question.id, live: question.live, parts: [], rows: [], text: error.message, refused: true }));
  }

  function ask() {
    newest += 1;
    // what the address keeps beside it runs first
    const one = asks || setting, { stop, steps } = GIVEN.caseOf(MODEL, one);
    asked.set(newest, copy(one));
    find("#state").textContent = "computing …";
    post({ id: newest, values: GIVEN.valuesOf(MODEL, one), stop, steps,
      signals: GIVEN.signalsOf(MODEL, one).map(([variable, signal]) => [variable.reference, variable.type, signal]) });
  }

  // What has come of a run: its next rows, or a refusal. Parts of one run make a whole.
  function take(found) {
    if (found.live) return liveRun.take(found);
    if (coming && coming.id === found.id)
      found = { ...found, constants: coming.constants, parts: [...coming.parts, ...found.parts] };
    if (isLive || found.id < drawn || (coming && found.id < coming.id)) return;
    coming = found;
    if (asks && found.id === newest && (found.finished || found.refused)) {
      kept = found.parts.length ? { setting: asks, run: RECORD.record(MODEL, found) } : null;
      asks = null;
      shownKept();
      return ask();
    }
    if (waiting || asks) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      if (!isLive) draw(coming);
    });
  }

  // --- what is shown ---------------------------------------------------------------------------------------------
  const go = (time) => player && player.go(time);
  const together = CURVES.group(), byNames = (names) => names.map((name) => byName.get(name));
  const charts = MODEL.charts.map(({ title, names, ladder }) => RUN_CHARTS.quantity(find("#charts"), title, byNames(names), ladder, together, go));
  if (MODEL.parts.length) charts.push(RUN_CHARTS.contacts(find("#charts"), MODEL.parts, together, go));
  const table = IMPACTS.table(MODEL, find("#impacts"), find("#impact-count"), go);

  function say(selector, text) {
    const element = find(selector);
    if (element.textContent !== text) element.textContent = text;
    element.hidden = !text;
  }

  function draw(found) {
    drawn = found.id;
    const one = asked.get(found.id);
    for (const id of asked.keys()) if (id < drawn) asked.delete(id);
    say("#refusal", found.refused ? found.text || "The run was refused." : "");
    say("#note", found.refused ? "" : found.text);
    if (found.id === newest && (found.finished || found.refused)) find("#state").textContent = "";
    document.body.classList.toggle("stale", Boolean(found.refused) && !found.parts.length);
    if (!found.parts.some((part) => part.length)) return;
    const picture = SCENE.pictured(MODEL, run = RECORD.record(MODEL, found), one), { stop } = GIVEN.caseOf(MODEL, one);
    Object.assign(run, { from: 0, to: stop });
    ran = one;
    offers();
    view = picture.shapes.length ? picture.view : null;
    // the first picture waits for no curve
    if (player) curves(run); else requestAnimationFrame(() => setTimeout(() => isLive || (curves(run), moved(0))));
    play({ ...picture, time: Array.from(run.time), end: stop, decimals: MODEL.decimals, flash: "var(--hit)",
      impacts: run.struck.map((row) => run.time[row]),
      contacts: MODEL.contacts.map((one) => ({ active: run.of(one.variable) })) });
  }

  // Up to which time curves are drawn.
  let drawnTo = 0;

  function curves(shown) {
    const behind = kept && !isLive ? kept.run : null;
    if (behind) shown.to = Math.max(GIVEN.caseOf(MODEL, filed()).stop, behind.time[behind.count - 1]);
    run = shown;
    drawnTo = shown.time[shown.count - 1];
    charts.forEach((chart) => chart.draw(shown, behind));
    table.draw(shown, behind);
  }

  function play(data) {
    find(".animation svg").classList.toggle("none", !data.shapes.length);
    find("#no-picture").hidden = Boolean(data.shapes.length);
    if (player) player.take(data); else player = ANIMATION.animate(find(".animation"), data, moved);
  }

  function moved(time) {
    let low = 0, high = run.count;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (run.time[middle] <= time) low = middle; else high = middle;
    }
    // a live run goes on while its curves wait to be drawn
    together.point(isLive ? Math.min(time, drawnTo) : time);
  }

  // --- live ----------------------------------------------------------------------------------------------------------
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const liveRun = LIVE.live(MODEL, (question) => post(question), {
    begin: (data, anew) => {
      play(data);
      if (anew) document.body.classList.toggle("stale", false);
      if (anew) find("#state").textContent = "";
      if (anew) moved(data.time[0]);
      if (anew && !still) player.run(true);
    },
    grow: () => player.grow(), go, draw: curves, note: (text) => { say("#refusal", ""); say("#note", text); },
    refuse: (text) => {
      find("#state").textContent = "";
      say("#refusal", text);
      if (player) player.run(false);
    },
  });
  function begin() {
    find("#state").textContent = "computing …";
    liveRun.start(setting, view);
  }
  find("#live").addEventListener("click", () => {
    isLive = !isLive;
    find("#live").setAttribute("aria-pressed", String(isLive));
    find("#restart").hidden = !isLive;
    find("#keep").hidden = isLive;
    coming = ran = null;
    if (isLive) begin();
    else {
      liveRun.stop();
      if (player) {
        player.run(false);
        player.go(0);
      }
      ask();
    }
  });
  find("#restart").addEventListener("click", begin);

  // --- kept, reset, files, address ------------------------------------------------------------------------------------
  function shownKept() {
    find("#keep").setAttribute("aria-pressed", String(Boolean(kept)));
    find("#keep").textContent = kept ? "Drop the kept run" : "Keep to compare";
  }
  find("#keep").addEventListener("click", () => {
    kept = kept || !ran ? null : { setting: copy(ran), run };
    shownKept();
    if (ran) curves(Object.assign({ ...run }, { to: GIVEN.caseOf(MODEL, ran).stop }));
    if (ran) player.go(0);
    address();
  });
  find("#reset").addEventListener("click", () => {
    setting = starts();
    go(0);
    given();
    address();
  });
  find("#csv").addEventListener("click", () => run && FILES.save(MODEL.name + ".csv", "text/csv", FILES.csv(MODEL, run)));
  find("#toml").addEventListener("click", () => FILES.save(MODEL.name + ".toml", "application/toml", FILES.toml(MODEL, filed())));
  find("#inputs-csv").addEventListener("click", () =>
    FILES.save(MODEL.name + "_inputs.csv", "text/csv", FILES.inputs(MODEL, filed())));
  addEventListener("hashchange", () => {
    ({ setting, kept: asks } = GIVEN.fromHash(MODEL, location.hash));
    kept = null;
    shownKept();
    given();
  });

  given();
})();
