// A mechanism that lives: it goes on as long as it plays, and an input that is moved acts at once.
var LIVE = (function () {
  "use strict";

  // What is kept of the past [s], in rows at most; how often curves are drawn [ms]; points of one answer.
  const LONGEST = 10, MOST = 3000, CURVES_EACH = 80, MOST_POINTS = 50;

  // `post(question)` asks the engine. `shown`: {begin(data), grow(), go(time), draw(run), refuse(text), note(text)}.
  function live(model, post, shown) {
    let id = 0, setting = null, run = null, data = null, box = null;
    // Up to when there are rows; whether an answer is due, to a question for an impact, and whether that is next.
    let known = 0, waits = false, looksFor = false, wanted = false, sent = new Map(), drawn = 0, refusal = "";

    function sizes() {
      const { stop, steps } = GIVEN.caseOf(model, setting);
      return { stop, step: stop / steps, span: Math.min(LONGEST, stop) };
    }

    // An input that follows a signal has no value of its own: one that it is given later is news, whichever it is.
    const driven = () => GIVEN.signalsOf(model, setting);
    const inputs = () => model.given.filter((one) => one.causality === "input" && !driven().some(([other]) => other === one))
      .map((one) => [one, Number(GIVEN.valueOf(model, setting, one))]);
    const signals = () => driven().map(([one, signal]) => [one.reference, one.type, signal]);

    // From time 0, with a setting {name, values}, whose inputs may change from then on; `view` is what is seen at least.
    function start(given, view) {
      setting = given;
      [id, run, known, waits, looksFor, wanted, sent, box] = [id + 1, null, 0, true, false, false, new Map(inputs()), view];
      const first = signals().map(([reference, type, signal]) => [reference, type, SIGNALS.at(signal, 0)]);
      post({ live: "begin", id, values: [...GIVEN.valuesOf(model, setting), ...first] });
    }

    function stop() {
      if (setting) post({ live: "end" });
      setting = null;
    }

    function ask(until, points, strike) {
      const moved = inputs().filter(([one, value]) => sent.get(one) !== value);
      moved.forEach(([one, value]) => sent.set(one, value));
      driven().forEach(([one]) => sent.delete(one));
      [waits, looksFor] = [true, strike];
      post({ live: "go", id, until, points, strike, signals: signals(),
        inputs: moved.map(([one, value]) => [one.reference, one.type, value]) });
    }

    // The clock goes from one time to another: what it needs is asked for a frame before. What was refused stands still.
    function ahead(from, to) {
      if (!run && !waits) shown.refuse(refusal);
      if (!run) return from;
      const until = to + (to - from);
      if (!waits && until > known)
        ask(until, Math.min(MOST_POINTS, Math.max(1, Math.ceil((until - known) / sizes().step))), false);
      return Math.min(to, known);
    }

    // On to the next impact, for as long as a whole run at most.
    function strike() {
      wanted = waits;
      if (!waits && run) ask(known + sizes().stop, Math.ceil(sizes().stop / sizes().step), true);
    }

    // An answer of the engine; those to what has ended since are no news.
    function take(found) {
      if (!setting || found.id !== id) return;
      waits = false;
      refusal = found.refused ? found.text || "The engine gives up here." : "";
      if (found.refused) shown.refuse(refusal);
      else shown.note(found.text);
      if (!found.rows.length) return;
      const begins = found.live === "begin", since = known;
      if (begins) run = RECORD.last(model, found.constants, sizes().span, MOST);
      if (begins) data = { time: run.time, end: undefined, impacts: [], decimals: model.decimals, flash: "var(--hit)", ahead,
        strike, contacts: model.contacts.map((one) => ({ active: run.of(one.variable) })) };
      const hits = run.hits;
      run.add(found.rows, model.width);
      known = found.now;
      data.impacts.splice(0, Infinity, ...run.struck.map((row) => run.time[row]));
      if (begins || run.hits > hits || performance.now() - drawn > CURVES_EACH) draw(begins);
      shown.grow();
      if (wanted && !begins) return strike();
      if (!looksFor) return;
      looksFor = false;
      shown.go(found.struck ? data.impacts.find((time) => time > since) : known);
      if (!found.struck) shown.note("No impact in the next " + sizes().stop + " s.");
    }

    // Curves, and the picture anew where the mechanism has left it.
    function draw(begins) {
      drawn = performance.now();
      Object.assign(run, { from: run.time[0], to: Math.max(run.time[0] + sizes().span, known) });
      shown.draw(run);
      const picture = SCENE.pictured(model, run, setting);
      const [left, bottom, right, top] = picture.view, before = box || picture.view;
      box = [Math.min(left, before[0]), Math.min(bottom, before[1]), Math.max(right, before[2]), Math.max(top, before[3])];
      const left_it = box.some((edge, k) => edge !== before[k]) || model.shapes.some((shape) => shape.kind === "trace");
      if (!begins && !left_it) return;
      Object.assign(data, picture, { view: box });
      shown.begin(data, begins);
    }

    return { start, stop, take };
  }

  return { live };
})();
