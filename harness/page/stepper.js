// A live run: it is taken from time to time, and its inputs may be others each time.
var STEPPER = (function () {
  "use strict";

  // Rows of one answer.
  const ROOM = 2000;

  // `constants`: as of the runner. Each question {live, id, ...} has one answer {live, id, rows, now, text, refused}.
  function stepper(engine, constants, post) {
    let c = null, now = 0;

    function end() {
      if (c) engine.free(c);
      c = null;
    }

    function answer(asked, found) {
      post({ live: asked.live, id: asked.id, now, refused: false, text: c ? engine.text() : "", ...found });
    }

    // An instance with values [[reference, type, value], ...] at time 0.
    function begin(asked) {
      end();
      now = 0;
      try {
        c = engine.make(asked.values);
        const { rows } = engine.run(c, 0, 1, 0, 1);
        answer(asked, { rows, constants: constants.map((one) => engine.get(c, one)) });
      } catch (error) {
        answer(asked, { rows: new Float64Array(0), text: error.message, refused: true });
      }
    }

    // On to `until` by `points` points, with inputs [[reference, type, signal], ...] that are held between them; with
    // `strike`, no further than to the first point behind an impact.
    function go(asked) {
      if (!c) return answer(asked, { rows: new Float64Array(0) });
      const parts = [], apart = (asked.until - now) / asked.points, each = asked.strike || asked.signals.length ? 1 : asked.points;
      let refused = false, struck = false, error;
      try {
        RUNNER.setAt(engine, c, asked.inputs, now);
        for (let point = 0; point < asked.points && !refused && !(struck && asked.strike); point += each) {
          RUNNER.setAt(engine, c, asked.signals, now);
          const target = now + each * apart;
          const part = engine.run(c, now, apart, each, ROOM);
          parts.push(part.rows.subarray(part.width));
          for (let k = 1; k < part.count; k++) struck ||= part.rows[k * part.width + 1] === 1;
          now = part.now;
          refused = part.count < ROOM && target - now > 1e-9 * Math.max(1e-3, target);
        }
      } catch (problem) {
        refused = true;
        error = problem.message;
      }
      const rows = new Float64Array(parts.reduce((length, part) => length + part.length, 0));
      parts.reduce((at, part) => (rows.set(part, at), at + part.length), 0);
      answer(asked, { rows, struck, refused, ...(error ? { text: error } : {}) });
    }

    return { begin, go, end };
  }

  return { stepper };
})();
if (typeof module === "object") module.exports = STEPPER;
