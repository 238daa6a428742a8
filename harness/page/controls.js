// A slider and a field for each number that is given, a box for yes or no.
var CONTROLS = (function () {
  "use strict";

  const make = (tag, attributes) => Object.assign(document.createElement(tag), attributes);

  // Builds the control of a variable into `host`; `changed(value, drags)` is called with SI values, `drags` while a slider
  // is on its way. Returns `put(value, start, over)`: the value, what it is compared with, what else it follows over time.
  function control(host, variable, changed) {
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
      return (value, start) => {
        field.checked = value;
        row.classList.toggle("changed", value !== start);
      };
    }
    const slider = make("input", { type: "range", min: 0, max: GIVEN.places(variable), step: 1 });
    const unit = make("span", { className: "unit", textContent: variable.shown });
    const withUnit = words + (variable.shown ? " in " + variable.shown : "");
    let compared = variable.start, put = "";
    slider.setAttribute("aria-label", withUnit + ", slider");
    field.setAttribute("aria-label", withUnit);
    field.step = variable.type === "Int32" ? "1" : "any";
    slider.addEventListener("input", () => changed(GIVEN.valueAt(variable, Number(slider.value)), true));
    slider.addEventListener("change", () => changed(GIVEN.valueAt(variable, Number(slider.value))));
    field.addEventListener("change", () => {
      put = "";
      const shown = GIVEN.read(variable, field.value);
      changed(shown === undefined ? compared : variable.type === "Int32" ? shown : GIVEN.si(variable, shown));
    });
    row.append(label, field, unit, slider, about);
    return (value, start, over) => {
      // what stands there already: of many controls one has moved
      const asked = [value, start, over].join();
      if (asked === put) return;
      put = asked;
      compared = start;
      field.value = over ? "" : GIVEN.shown(variable, value);
      field.placeholder = over ? "varies" : "";
      slider.value = GIVEN.placeOf(variable, value);
      slider.setAttribute("aria-valuetext", over || field.value + " " + variable.shown);
      about.textContent = (over ? "Now " + over + ". " : "") + variable.description;
      row.classList.toggle("changed", !over && value !== start);
    };
  }

  return { control };
})();
