// Files that the reader takes along: what a run has recorded, and what it was given.
var FILES = (function () {
  "use strict";

  const END = "\r\n";
  const heading = (one) => one.name + (one.unit ? " [" + one.unit + "]" : "");

  // All of a run in SI units, with the digits that make each number again.
  function csv(model, run) {
    const recorded = RECORD.columnsOf(model).filter((one) => !one.name.startsWith("drawing_"));
    const columns = [run.time, ...recorded.map((one) => run.of(one.name))];
    const lines = [["time [s]", ...recorded.map(heading)].join(",")];
    for (let row = 0; row < run.count; row++) lines.push(columns.map((column) => String(column[row])).join(","));
    return lines.join(END) + END;
  }

  // What is not at the FMU's start values, for `mechanism-fmu run --parameters`; how the run goes on stands in a comment.
  function toml(model, setting) {
    const one = GIVEN.caseOf(model, setting), over = GIVEN.signalsOf(model, setting);
    const table = over.length ? " --input " + model.name + "_inputs.csv" : "";
    const lines = model.given.map((variable) => [variable, GIVEN.valueOf(model, setting, variable)])
      .filter(([variable, value]) => value !== variable.start)
      .map(([{ name, unit }, value]) => name + " = " + text(value) + (unit ? "  # " + unit : ""));
    return ["# " + model.name + ", SI units: mechanism-fmu run build/" + model.name + ".fmu --parameters FILE.toml" + table +
      " --stop-time " + one.stop + " --step " + one.stop / one.steps, ...lines, ""].join("\n");
  }

  // A TOML number is no integer where it has a point or an exponent; both are read.
  const text = (value) => typeof value === "boolean" ? String(value) : String(value).replace("e+", "e");

  // The inputs over time, for --input.
  function inputs(model, setting) {
    const one = GIVEN.caseOf(model, setting), over = GIVEN.signalsOf(model, setting);
    const lines = [["time [s]", ...over.map(([variable]) => heading(variable))].join(",")];
    for (let k = 0; k <= one.steps; k++) {
      const time = k * one.stop / one.steps;
      lines.push([time, ...over.map(([, signal]) => SIGNALS.at(signal, time))].join(","));
    }
    return lines.join(END) + END;
  }

  function save(name, type, content) {
    const address = URL.createObjectURL(new Blob([content], { type }));
    Object.assign(document.createElement("a"), { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  }

  return { csv, toml, inputs, save };
})();
if (typeof module === "object") module.exports = FILES;
