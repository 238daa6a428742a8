// What is given: values that differ from the start, in SI units; the address; where a slider stands.
var GIVEN = (function () {
  "use strict";

  // Places of a slider: the start of one that goes from half to twice of it is one of them.
  const PLACES = 300;

  // The value that `text` means for a variable; undefined for none.
  function read(variable, text) {
    if (variable.type === "Boolean") return text === "true" ? true : text === "false" ? false : undefined;
    const value = text.trim() === "" ? NaN : Number(text);
    if (!Number.isFinite(value)) return undefined;
    return variable.type === "Int32" ? Math.round(value) : value;
  }

  // "#name=value&...", only of what differs from the start.
  function toHash(given, values) {
    return "#" + given.filter((one) => values.has(one.name))
      .map((one) => encodeURIComponent(one.name) + "=" + encodeURIComponent(values.get(one.name))).join("&");
  }

  // The values of an address; names and values that mean nothing here are passed over.
  function fromHash(given, hash) {
    const values = new Map(), known = new Map(given.map((one) => [one.name, one]));
    for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
      const variable = known.get(name), value = variable && read(variable, text);
      if (value !== undefined && value !== variable.start) values.set(name, value);
    }
    return values;
  }

  // Whether a slider has a place for each whole number.
  const counts = ({ type, range: [low, high] }) => type === "Int32" && high - low <= PLACES;

  function places(variable) {
    const [low, high] = variable.range;
    return counts(variable) ? Math.max(1, Math.floor(high) - Math.ceil(low)) : PLACES;
  }

  function placeOf(variable, value) {
    const [low, high] = variable.range;
    if (counts(variable)) return value - Math.ceil(low);
    return high > low ? Math.round(PLACES * (value - low) / (high - low)) : 0;
  }

  // The value at a place: as many digits as places need; that of the start is the start itself.
  function valueAt(variable, place) {
    const [low, high] = variable.range;
    if (counts(variable)) return Math.ceil(low) + place;
    if (place === placeOf(variable, variable.start)) return variable.start;
    const value = low + (high - low) * place / PLACES, factor = variable.factor;
    if (variable.type === "Int32") return Math.round(value);
    const digit = Math.ceil(-Math.log10((high - low) * factor / PLACES)) + 1;
    const shown = digit > 0 ? Number((value * factor).toFixed(Math.min(digit, 100))) : value * factor;
    return Math.min(high, Math.max(low, si(variable, shown)));
  }

  // A number in the unit that is shown as one in SI units, without the noise of the factor.
  const si = (variable, shown) => Number((shown / variable.factor).toPrecision(15));

  // A value for people, in the unit that is shown.
  const shown = (variable, value) => String(Number((value * variable.factor).toPrecision(6)));

  return { read, toHash, fromHash, places, placeOf, valueAt, si, shown };
})();
if (typeof module === "object") module.exports = GIVEN;
