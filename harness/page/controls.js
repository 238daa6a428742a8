// A slider and a field for each number that is given, a box for yes or no.
var CONTROLS = (function () {
  "use strict";

  // Builds the control of a variable into `host`; `changed(value)` is called with SI values. Returns `put(value)`.
  function control(host, variable, changed) {
    const make = (tag, attributes) => Object.assign(document.createElement(tag), attributes);
    const words = variable.name.replaceAll("_", " ");
    const row = make("div", { className: "control" });
    const label = make("label", { htmlFor: "of_" + variable.name, textContent: words });
    const about = make("small", { id: "about_" + variable.name, textContent: variable.description });
    const field = make("input", { id: "of_" + variable.name, type: variable.type === "Boolean" ? "checkbox" : "number" });
    field.setAttribute("aria-describedby", about.id);
    host.append(row);
    if (variable.type === "Boolean") {
      field.addEventListener("change", () => changed(field.checked));
      row.append(label, field, about);
      return (value) => {
        field.checked = value;
        row.classList.toggle("changed", value !== variable.start);
      };
    }
    const slider = make("input", { type: "range", min: 0, max: GIVEN.places(variable), step: 1 });
    const unit = make("span", { className: "unit", textContent: variable.shown });
    const withUnit = words + (variable.shown ? " in " + variable.shown : "");
    slider.setAttribute("aria-label", withUnit + ", slider");
    field.setAttribute("aria-label", withUnit);
    field.step = variable.type === "Int32" ? "1" : "any";
    slider.addEventListener("input", () => changed(GIVEN.valueAt(variable, Number(slider.value))));
    field.addEventListener("change", () => {
      const shown = GIVEN.read(variable, field.value);
      changed(shown === undefined ? variable.start : variable.type === "Int32" ? shown : GIVEN.si(variable, shown));
    });
    row.append(label, field, unit, slider, about);
    return (value) => {
      field.value = GIVEN.shown(variable, value);
      slider.value = GIVEN.placeOf(variable, value);
      slider.setAttribute("aria-valuetext", field.value + " " + variable.shown);
      row.classList.toggle("changed", value !== variable.start);
    };
  }

  return { control };
})();
