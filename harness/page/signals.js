// Inputs over time: a number, {mean, amplitude, period, phase} or {times, values}, as of model/cases.py.
var SIGNALS = (function () {
  "use strict";

  function at(signal, time) {
    if (typeof signal === "number") return signal;
    const { mean, amplitude, period, phase, times, values } = signal;
    if (period) return mean + amplitude * Math.sin(2 * Math.PI * time / period + phase);
    const after = times.findIndex((one) => time <= one);
    if (after < 0) return values[values.length - 1];
    if (after === 0) return values[0];
    const [t, later, x, y] = [times[after - 1], times[after], values[after - 1], values[after]];
    return x + (y - x) * (time - t) / (later - t);
  }

  // Of people: what a signal is.
  function words(signal) {
    return signal.period ? "a sine of " + Number(signal.period.toPrecision(4)) + " s" : "a table over time";
  }

  return { at, words };
})();
if (typeof module === "object") module.exports = SIGNALS;
