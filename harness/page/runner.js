// Runs, in slices between which a newer question is heard: in a worker, or in the page where there is none.
// `post` gets what is known so far, finished or not: of a run that takes long its beginning is there to be seen.
var RUNNER = (function () {
  "use strict";

  // Points of the grid and rows of a slice, and after how long others have their turn [ms].
  const SLICE = 20, ROOM = 2000, TURN = 40;

  const others = () => new Promise((go) => setTimeout(go));

  // How many points of the grid a slice has reached.
  function onGrid({ rows, width, count }) {
    let reached = 0;
    for (let k = 1; k < count; k++) if (rows[k * width + 1] === 0) reached++;
    return reached;
  }

  // Inputs [[reference, type, signal], ...] as they are at a time.
  const setAt = (engine, c, signals, time) =>
    signals.forEach(([reference, type, signal]) => engine.set(c, [reference, type, SIGNALS.at(signal, time)]));

  // `constants`: [[reference, type], ...] of what a run gives once.
  function runner(engine, constants, post) {
    let newest = 0;

    // The run of {id, values, signals, stop, steps}; those that are asked for later end it, or take its place before it
    // has begun. Signals are held from point to point.
    async function ask(asked) {
      newest = asked.id;
      await others();
      if (newest !== asked.id) return;
      const found = { id: asked.id, width: engine.width, parts: [], constants: [], finished: false, text: "" };
      let c;
      try {
        c = engine.make([...asked.values, ...asked.signals.map(([reference, type, one]) => [reference, type, SIGNALS.at(one, 0)])]);
      } catch (error) {
        post({ ...found, text: error.message, refused: true });
        return;
      }
      try {
        found.constants = constants.map((one) => engine.get(c, one));
        await advance(c, asked, found);
      } catch (error) {
        post({ ...found, text: error.message, refused: true, finished: true });
      } finally {
        engine.free(c);
      }
    }

    async function advance(c, { stop, steps: all, signals }, found) {
      const spacing = stop / all, slice = signals.length ? 1 : SLICE;
      let point = 0, now = 0, since = performance.now(), first = true, refused = false;
      while (point < all && !refused) {
        // Behind a slice that was full before its end, the next point of the grid is nearer.
        const behind = now > (point + 1e-6) * spacing;
        const steps = behind ? 1 : Math.min(slice, all - point);
        const apart = ((point + steps) * spacing - now) / steps;
        if (!behind) setAt(engine, c, signals, now);
        const part = engine.run(c, now, apart, steps, ROOM);
        const grid = onGrid(part);
        refused = grid < steps && part.count < ROOM;
        point += grid;
        now = part.now;
        // The first row of a slice is the last one of that before.
        found.parts.push(first ? part.rows : part.rows.subarray(part.width));
        first = false;
        if (performance.now() - since < TURN) continue;
        post({ ...found, text: engine.text(), refused });
        found.parts = [];
        await others();
        if (newest !== found.id) return;
        since = performance.now();
      }
      post({ ...found, text: engine.text(), refused, finished: true });
    }

    return { ask, stop: () => { newest = 0; } };
  }

  // Answers questions: those with `live` go to the stepper, all others are runs.
  // `made`: what the engine is loaded from, and `constants`.
  async function answering(made, post) {
    const engine = await ENGINE.load(made);
    const whole = runner(engine, made.constants, post), steps = STEPPER.stepper(engine, made.constants, post);
    return (asked) => {
      if (!asked.live) {
        steps.end();
        return whole.ask(asked);
      }
      whole.stop();
      return steps[asked.live](asked);
    };
  }

  // In a worker: the first message is what the engine is made of, all others are questions.
  function serve(scope) {
    let ready;
    scope.onmessage = ({ data }) => {
      if (!ready) {
        // rows are handed over, not copied
        ready = answering(data, (found) => scope.postMessage(found, (found.parts || [found.rows]).map((rows) => rows.buffer)));
        return;
      }
      ready.then((answer) => answer(data)).catch((error) =>
        scope.postMessage({ id: data.id, live: data.live, parts: [], text: error.message, refused: true }));
    };
  }

  return { runner, answering, serve, setAt };
})();
if (typeof module === "object") module.exports = RUNNER;
