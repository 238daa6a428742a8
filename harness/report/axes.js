// The numbers of a chart: round ticks, texts, and the path of a curve with no more points than a screen can show.
var AXES = (function () {
  "use strict";

  const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  const power = (exponent) => "10" + String(exponent).replace("-", "⁻").replace(/\d/g, (digit) => RAISED[digit]);

  // Round numbers between two, about `count` of them.
  function ticks(low, high, count) {
    const raw = (high - low) / count, unit = 10 ** Math.floor(Math.log10(raw));
    const step = unit * [1, 2, 5, 10].find((digit) => digit * unit >= raw * (1 - 1e-9));
    const first = Math.ceil(low / step - 1e-9), found = [];
    for (let k = first; k * step <= high + 1e-9 * step; k++) found.push(Number((k * step).toPrecision(12)));
    return found;
  }

  // The same on a logarithmic axis: powers of ten, and what is between them where there are few.
  function decades(low, high, count) {
    const from = Math.floor(Math.log10(low)), to = Math.ceil(Math.log10(high)), many = to - from > 3, found = [];
    const every = Math.max(1, Math.ceil((to - from) / count));
    for (let k = from; k <= to; k++)
      for (const digit of many ? (k % every ? [] : [1]) : [1, 2, 5]) {
        const value = Number(digit + "e" + k);
        if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) found.push(value);
      }
    return found;
  }

  // The power of ten, a multiple of three, that texts of numbers up to `largest` leave out; 0 where they are short.
  const exponentOf = (largest) => largest >= 1e5 || (largest > 0 && largest < 1e-2) ? 3 * Math.floor(Math.log10(largest) / 3) : 0;

  // A number for people, to `digits`.
  function number(value, digits = 5) {
    if (typeof value !== "number" || !Number.isFinite(value)) return "–";
    const exponent = exponentOf(Math.abs(value)), short = Number((value / 10 ** exponent).toPrecision(digits));
    return String(short).replace("-", "−") + (exponent ? "·" + power(exponent) : "");
  }

  // Texts of ticks that leave out a power of ten, with as many decimals as keep them apart.
  function labels(values, exponent) {
    const step = values.length > 1 ? Math.abs(values[1] - values[0]) / 10 ** exponent : 1;
    const places = Math.min(12, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
    return values.map((value) => (value / 10 ** exponent).toFixed(places).replace("-", "−"));
  }

  // Of increasing numbers: how many are less than `limit`.
  function before(values, limit) {
    let low = 0, high = values.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (values[middle] < limit) low = middle + 1; else high = middle;
    }
    return low;
  }

  const isNumber = (value) => typeof value === "number" && Number.isFinite(value);

  // Whether a curve goes from left to right without a gap in x.
  function isOver(x) {
    for (let k = 0; k < x.length; k++) if (!isNumber(x[k]) || (k && x[k] < x[k - 1])) return false;
    return x.length > 1;
  }

  // The value of a curve that goes from left to right; what it steps to where it steps.
  function valueAt(x, y, at) {
    const last = x.length - 1;
    if (!(at >= x[0] && at <= x[last])) return null;
    const after = Math.min(before(x, at), last), [x1, y1] = [x[after], y[after]];
    if (after === 0 || x1 === at) return y1;
    const [x0, y0] = [x[after - 1], y[after - 1]];
    return isNumber(y0) && isNumber(y1) ? y0 + (y1 - y0) * (at - x0) / (x1 - x0) : null;
  }

  // The path through points `from` to `to`, in tenths of a pixel. Of points beside each other in one column of pixels
  // the first, the least, the greatest and the last are drawn: no peak is lost. What is no number is a gap.
  function path(x, y, from, to, across, down) {
    const parts = [];
    let open = false, column = NaN, kept = null;
    const say = ([a, b]) => {
      parts.push((open ? "L" : "M") + Math.round(10 * a) / 10 + " " + Math.round(10 * b) / 10);
      open = true;
    };
    function flush() {
      if (!kept) return;
      const { first, least, greatest, last } = kept;
      const between = least[2] < greatest[2] ? [least, greatest] : [greatest, least];
      for (const point of new Set([first, ...between, last])) say(point);
      kept = null;
    }
    for (let k = from; k < to; k++) {
      const point = isNumber(x[k]) && isNumber(y[k]) ? [across(x[k]), down(y[k]), k] : null;
      if (!point || Number.isNaN(point[0] + point[1])) {
        flush();
        open = false;
        column = NaN;
        continue;
      }
      if (Math.floor(point[0]) !== column) {
        flush();
        column = Math.floor(point[0]);
        kept = { first: point, least: point, greatest: point, last: point };
      }
      if (point[1] < kept.least[1]) kept.least = point;
      if (point[1] > kept.greatest[1]) kept.greatest = point;
      kept.last = point;
    }
    flush();
    return parts.join("");
  }

  // The path of dots, of which two in one place are one.
  function dots(x, y, across, down) {
    const places = new Set();
    for (let k = 0; k < x.length; k++)
      if (isNumber(x[k]) && isNumber(y[k])) places.add("M" + Math.round(2 * across(x[k])) / 2 + " " + Math.round(2 * down(y[k])) / 2 + "h0");
    return [...places].join("");
  }

  return { ticks, decades, exponentOf, power, number, labels, before, isNumber, isOver, valueAt, path, dots };
})();
if (typeof module === "object") module.exports = AXES;
