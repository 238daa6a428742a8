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
    // counted: beyond 2^53 one more is the same number
    for (let k = 0; k <= 4 * count && (first + k) * step <= high + 1e-9 * step; k++) found.push(Number(((first + k) * step).toPrecision(12)));
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
    let after = Math.min(before(x, at), last);
    while (after < last && x[after + 1] === at) after += 1;
    const [x1, y1] = [x[after], y[after]];
    if (after === 0 || x1 === at) return y1;
    const [x0, y0] = [x[after - 1], y[after - 1]];
    return isNumber(y0) && isNumber(y1) ? y0 + (y1 - y0) * (at - x0) / (x1 - x0) : null;
  }

  // The path through points `from` to `to`, in tenths of a pixel. Of points beside each other in one column of pixels
  // the first, the least, the greatest and the last are drawn: no peak is lost. What is no number is a gap.
  function path(x, y, from, to, across, down) {
    let text = "", open = false, column = NaN, kept = false;
    // of this column: places across and down, and at which point the least and the greatest stand
    let firstX, firstY, lastX, lastY, leastX, least, leastAt, greatestX, greatest, greatestAt;
    function say(a, b) {
      text += (open ? "L" : "M") + Math.round(10 * a) / 10 + " " + Math.round(10 * b) / 10;
      open = true;
    }
    function flush() {
      if (!kept) return;
      kept = false;
      say(firstX, firstY);
      const low = () => { if (least !== firstY && least !== lastY) say(leastX, least); };
      const high = () => { if (greatest !== firstY && greatest !== lastY) say(greatestX, greatest); };
      if (leastAt < greatestAt) { low(); high(); } else { high(); low(); }
      if (lastX !== firstX || lastY !== firstY) say(lastX, lastY);
    }
    for (let k = from; k < to; k++) {
      const a = isNumber(x[k]) && isNumber(y[k]) ? across(x[k]) : NaN, b = down(y[k]);
      if (!(Number.isFinite(a) && Number.isFinite(b))) {
        flush();
        open = false;
        column = NaN;
      } else if (Math.floor(a) !== column) {
        flush();
        kept = true;
        column = Math.floor(a);
        firstX = lastX = leastX = greatestX = a;
        firstY = lastY = least = greatest = b;
        leastAt = greatestAt = k;
      } else {
        if (b < least) [leastX, least, leastAt] = [a, b, k];
        if (b > greatest) [greatestX, greatest, greatestAt] = [a, b, k];
        [lastX, lastY] = [a, b];
      }
    }
    flush();
    return text;
  }

  // The path of dots, of which two in one place are one.
  function dots(x, y, across, down) {
    const places = new Set();
    for (let k = 0; k < x.length; k++)
      if (isNumber(x[k]) && isNumber(y[k])) places.add("M" + Math.round(2 * across(x[k])) / 2 + " " + Math.round(2 * down(y[k])) / 2 + "h0");
    return [...places].join("");
  }

  // From the least to the greatest of lists of numbers.
  function extent(lists, within = (list) => [0, list.length]) {
    let low = Infinity, high = -Infinity;
    lists.forEach((list, number) => {
      const [from, to] = within(list, number);
      for (let k = from; k < to; k++) {
        const value = list[k];
        if (value === null || !Number.isFinite(value)) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    });
    return low <= high ? [low, high] : null;
  }

  // With some room; what is constant stands in the middle.
  function roomy([low, high], part) {
    const size = high - low;
    const room = size > 1e-12 * Math.max(Math.abs(low), Math.abs(high)) ? part * size : Math.abs(high) * 0.1 || 1;
    return [low - room, high + room];
  }

  // An axis from `low` to `high` on the pixels from `begin` to `end`.
  function axis([low, high], begin, end, log) {
    const to = log ? Math.log10 : (value) => value, back = log ? (value) => 10 ** value : (value) => value;
    const [a, b] = [to(low), to(high)], scale = (end - begin) / (b - a || 1);
    return { low, high, log, place: (value) => begin + scale * (to(value) - a), value: (place) => back(a + (place - begin) / scale) };
  }

  return { extent, roomy, axis, ticks, decades, exponentOf, power, number, labels, before, isNumber, isOver, valueAt, path, dots };
})();
if (typeof module === "object") module.exports = AXES;
