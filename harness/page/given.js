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

  // A setting is {name: of the case, values}: what differs from the case, by name, in SI units.
  const caseOf = (model, setting) => model.cases.find((one) => one.name === setting.name);

  // Of a case: what a variable is before anybody changes it.
  function startOf(model, setting, variable) {
    const { values } = caseOf(model, setting);
    return variable.name in values ? values[variable.name] : variable.start;
  }

  const valueOf = (model, setting, variable) =>
    setting.values.has(variable.name) ? setting.values.get(variable.name) : startOf(model, setting, variable);

  // The inputs that change over time, unless they are given: [variable, signal].
  const signalsOf = (model, setting) => model.given
    .filter((one) => one.name in caseOf(model, setting).signals && !setting.values.has(one.name))
    .map((one) => [one, caseOf(model, setting).signals[one.name]]);

  // All that is not at the FMU's start values: [[reference, type, value], ...].
  const valuesOf = (model, setting) => model.given.map((one) => [one, valueOf(model, setting, one)])
    .filter(([one, value]) => value !== one.start).map(([one, value]) => [one.reference, one.type, Number(value)]);

  // Keep a value; one that is as the case has it is no difference.
  function put(model, setting, variable, value) {
    const same = value === startOf(model, setting, variable) && !(variable.name in caseOf(model, setting).signals);
    if (same) setting.values.delete(variable.name); else setting.values.set(variable.name, value);
  }

  // Keys of the address that are of no variable; one of that name has a sign before it.
  const OWN = ["case", "kept"], keyOf = ({ name }) => (OWN.includes(name) ? "~" : "") + name;

  // "case=...&name=value&...", only of what differs from the start.
  function written(model, setting) {
    const pairs = model.given.filter((one) => setting.values.has(one.name)).map((one) => [keyOf(one), setting.values.get(one.name)]);
    if (setting.name !== model.cases[0].name) pairs.unshift(["case", setting.name]);
    return pairs.map((pair) => pair.map(encodeURIComponent).join("=")).join("&");
  }

  // The address of a setting, and of the one that is kept beside it, if any.
  const toHash = (model, setting, kept) =>
    "#" + [written(model, setting), ...(kept ? ["kept=" + encodeURIComponent(written(model, kept))] : [])].filter(Boolean).join("&");

  // The settings of an address: {setting, kept: a setting or null}; what means nothing here is passed over.
  function fromHash(model, hash) {
    const pairs = new URLSearchParams(hash.replace(/^#/, "")), known = new Map(model.given.map((one) => [keyOf(one), one]));
    const name = model.cases.some((one) => one.name === pairs.get("case")) ? pairs.get("case") : model.cases[0].name;
    const setting = { name, values: new Map() };
    for (const [key, text] of pairs) {
      const variable = known.get(key), value = variable && read(variable, text);
      if (value !== undefined) put(model, setting, variable, value);
    }
    return { setting, kept: pairs.has("kept") ? fromHash(model, pairs.get("kept")).setting : null };
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

  return { read, caseOf, startOf, valueOf, signalsOf, valuesOf, put, toHash, fromHash, places, placeOf, valueAt, si, shown };
})();
if (typeof module === "object") module.exports = GIVEN;
