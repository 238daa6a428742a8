// Runs the scripts of a page as the page does, in node. From standard input: {page: file, folder: of the scripts, calls:
// [[name, ...arguments]]}; to standard output: what each call gives.
"use strict";
const fs = require("fs"), path = require("path"), vm = require("vm");

const asked = JSON.parse(fs.readFileSync(0, "utf8"));
const script = (name) => require(path.join(asked.folder, name));
// What each other's scripts find in the page.
for (const name of ["signals", "given", "record"]) globalThis[name.toUpperCase()] = script(name + ".js");
const html = asked.page ? fs.readFileSync(asked.page, "utf8") : "";
const held = (id) => html.match(new RegExp(`<script[^>]* id="${id}">([^]*?)</script>`))[1];
const model = () => JSON.parse(held("model"));

// The worker as the page starts it: its code, and a scope of its own.
function worker() {
  const scope = { heard: [], postMessage: (found) => { scope.heard.push(structuredClone(found)); scope.wake && scope.wake(); } };
  const code = [...html.matchAll(/<script class="engine">([^]*?)<\/script>/g)].map((one) => one[1]).join("") + "RUNNER.serve(scope);";
  vm.runInNewContext(code, { scope, WebAssembly, TextEncoder, TextDecoder, performance, setTimeout,
    Float64Array, Int32Array, Uint32Array, Uint8Array, atob, Response, DecompressionStream: asked.old ? undefined : DecompressionStream });
  const data = model(), references = (list) => list.map((one) => one.reference);
  const recorded = { reals: references(data.reals), flags: references(data.flags), wholes: references(data.wholes) };
  scope.onmessage({ data: { wasm: held("wasm"), image: held("image"), token: asked.token || data.token, recorded,
    constants: data.constants.map((one) => [one.reference, one.type]) } });
  return scope;
}

async function until(scope, done) {
  while (!scope.heard.some(done)) await new Promise((wake) => { scope.wake = wake; });
}

const signalsOf = (data, setting) => GIVEN.signalsOf(data, setting).map(([one, signal]) => [one.reference, one.type, signal]);
function settingOf(data, values, name = data.cases[0].name) {
  return { name, values: new Map(Object.entries(values)) };
}

const calls = {
  // What a run of a case with other values records: {refused, text, ...}.
  async run(values, name) {
    const { csv } = script("files.js"), data = model(), scope = worker(), setting = settingOf(data, values, name);
    const { stop, steps } = GIVEN.caseOf(data, setting);
    scope.onmessage({ data: { id: 1, stop, steps, values: GIVEN.valuesOf(data, setting), signals: signalsOf(data, setting) } });
    await until(scope, (found) => found.finished || found.refused);
    const parts = scope.heard.flatMap((found) => found.parts), last = scope.heard.at(-1);
    if (!parts.length) return { refused: last.refused, text: last.text, count: 0 };
    const run = RECORD.record(data, { ...last, parts });
    return { refused: last.refused, finished: last.finished, text: last.text, count: run.count, messages: scope.heard.length,
      time: Array.from(run.time), struck: run.struck.map((row) => run.time[row]), csv: csv(data, run),
      picture: script("scene.js").pictured(data, run, setting).shapes.length > 0,
      last: Object.fromEntries(data.wholes.map((one) => [one.name, run.of(one.name).at(-1)])) };
  },
  // Numbers of the questions that were answered when several came at once.
  async several(count) {
    const scope = worker();
    for (let id = 1; id <= count; id++) scope.onmessage({ data: { id, values: [], signals: [], stop: 1, steps: 100 } });
    await until(scope, (found) => found.finished);
    return scope.heard.map((found) => found.id);
  },
  // What the reader sees after each of `steps`: {set: [name, value]}, {hash}, {click: selector}.
  async session(options, done) {
    const { document, location, errors, blobs, steps, asked, when } = require("./page_document.js").opened(html, options);
    const find = (selector) => document.querySelector(selector), text = (selector) => find(selector)?.textContent ?? null;
    const seen = () => ({ alert: find("#refusal").hidden ? "" : text("#refusal"), note: find("#note").hidden ? "" : text("#note"),
      count: text("#impact-count"), first: text("#impacts tbody td"), time: text(".time"), struck: text(".struck"),
      shapes: find(".animation svg").children.length, curves: document.querySelectorAll("#charts path.curve").length,
      values: document.querySelectorAll("#charts li b").filter((one) => one.textContent).length, hash: location.hash,
      kept: document.querySelectorAll("#charts .kept").length, texts: blobs.splice(0).map((one) => one.text),
      impacts: document.querySelectorAll("#impacts tbody tr").map((row) => row.children.map((one) => one.textContent)),
      heads: document.querySelectorAll("#impacts th").map((one) => one.textContent), steps: steps.splice(0), playing: text(".play"), asked: asked.splice(0), errors });
    const settled = () => when(() => text("#state") === "" && (text("#impact-count") || !find("#refusal").hidden));
    await settled();
    const found = [seen()];
    for (const step of done) {
      if (step.set) {
        const field = find("#of_" + step.set[0]);
        Object.assign(field, typeof step.set[1] === "boolean" ? { checked: step.set[1] } : { value: step.set[1] });
        field.dispatch("change");
      }
      if (step.slide) {
        const slider = find("#of_" + step.slide[0]).parentNode.children.find((one) => one.type === "range");
        slider.value = step.slide[1];
        slider.dispatch("input");
        slider.dispatch("change");
      }
      if (step.hash !== undefined) {
        location.hash = step.hash;
        document.dispatch("hashchange");
      }
      if (step.choose) {
        find("#case").value = step.choose;
        find("#case").dispatch("change");
      }
      if (step.click) find(step.click).click();
      if (step.until) await when(() => new RegExp(step.until[1]).test(text(step.until[0])));
      await settled();
      found.push(seen());
    }
    return found;
  },
  scene: (...given) => script("scene.js").scene(...given),
  signal: (signal, time) => SIGNALS.at(signal, time),
  hash(hash, data = model()) {
    const { setting, kept } = GIVEN.fromHash(data, hash);
    return [setting.name, Object.fromEntries(setting.values), GIVEN.toHash(data, setting, kept)];
  },
  // Of each slider: what its places give, and the place of what each gives.
  sliders() {
    const given = script("given.js");
    return model().given.filter((one) => one.range).map((one) => {
      const values = Array.from({ length: given.places(one) + 1 }, (_, place) => given.valueAt(one, place));
      return { name: one.name, start: one.start, range: one.range, values,
        places: values.map((value) => given.placeOf(one, value)), ofStart: given.valueAt(one, given.placeOf(one, one.start)) };
    });
  },
};

(async () => {
  const answers = [];
  for (const [name, ...given] of asked.calls) answers.push(await calls[name](...given));
  process.stdout.write(JSON.stringify(answers));
})();
