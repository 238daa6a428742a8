// Whole runs, in slices between which a newer question is heard: in a worker, or in the page where there is none.
// `post` gets what is known so far, finished or not: of a run that takes long its beginning is there to be seen.
var RUNNER = (function () {
  "use strict";

  // Points of the grid and rows of a slice, and after how long others have their turn [ms].
  const SLICE = 20, ROOM = 2000, TURN = 25;

  const others = () => new Promise((go) => setTimeout(go));

  // `plan`: {stop, steps, reals, flags: value references, constants: [[reference, type], ...]}.
  function runner(engine, plan, post) {
    const reals = engine.list(plan.reals), flags = engine.list(plan.flags);
    const spacing = plan.stop / plan.steps;
    let newest = 0;

    // The run of {id, values}; those that are asked for later end it, or take its place before it has begun.
    async function ask({ id, values }) {
      newest = id;
      await others();
      if (newest !== id) return;
      const found = { id, width: 2 + reals.count + flags.count, parts: [], constants: [], finished: false, text: "" };
      let c;
      try {
        c = engine.make(values);
      } catch (error) {
        post({ ...found, text: error.message, refused: true });
        return;
      }
      try {
        found.constants = plan.constants.map((one) => engine.get(c, one));
        await advance(c, found);
      } finally {
        engine.free(c);
      }
    }

    async function advance(c, found) {
      let point = 0, now = 0, since = performance.now(), first = true, refused = false;
      while (point < plan.steps && !refused) {
        // Behind a slice that was full before its end, the next point of the grid is nearer.
        const behind = now > (point + 1e-6) * spacing;
        const steps = behind ? 1 : Math.min(SLICE, plan.steps - point);
        const apart = ((point + steps) * spacing - now) / steps;
        const slice = engine.run(c, now, apart, steps, ROOM, reals, flags);
        const grid = onGrid(slice);
        refused = grid < steps && slice.count < ROOM;
        point += grid;
        now = slice.now;
        // The first row of a slice is the last one of that before.
        found.parts.push(first ? slice.rows : slice.rows.subarray(slice.width));
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

    // How many points of the grid a slice has reached.
    function onGrid({ rows, width, count }) {
      let reached = 0;
      for (let k = 1; k < count; k++) if (rows[k * width + 1] === 0) reached++;
      return reached;
    }

    return { ask };
  }

  // In a worker: the first message is {bytes, token, plan}, all others are questions.
  function serve(scope) {
    let ready;
    scope.onmessage = ({ data }) => {
      if (!ready) {
        ready = ENGINE.load(data.bytes, data.token).then((engine) =>
          runner(engine, data.plan, (found) => scope.postMessage(found)));
        return;
      }
      ready.then((one) => one.ask(data)).catch((error) =>
        scope.postMessage({ id: data.id, parts: [], text: error.message, refused: true }));
    };
  }

  return { runner, serve };
})();
if (typeof module === "object") module.exports = RUNNER;
