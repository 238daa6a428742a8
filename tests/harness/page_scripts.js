// Runs the scripts of a page as the page does, in node. From standard input: {page: file, folder: of the scripts, calls:
// [[name, ...arguments]]}; to standard output: what each call gives.
"use strict";
const fs = require("fs"), path = require("path"), vm = require("vm");

const asked = JSON.parse(fs.readFileSync(0, "utf8"));
const script = (name) => require(path.join(asked.folder, name));
const html = asked.page ? fs.readFileSync(asked.page, "utf8") : "";
const held = (id) => html.match(new RegExp(`<script[^>]* id="${id}">([^]*?)</script>`))[1];
const model = () => JSON.parse(held("model"));

// The worker as the page starts it: its code, and a scope of its own.
function worker() {
  const scope = { heard: [], postMessage: (found) => { scope.heard.push(structuredClone(found)); scope.wake && scope.wake(); } };
  const code = held("engine-code") + held("runner-code") + "RUNNER.serve(scope);";
  vm.runInNewContext(code, { scope, WebAssembly, TextEncoder, TextDecoder, performance, setTimeout,
    Float64Array, Int32Array, Uint32Array, Uint8Array });
  const data = model(), references = (list) => list.map((one) => one.reference);
  const plan = { stop: data.stop, steps: data.steps, reals: references(data.reals), flags: references(data.flags),
    constants: data.constants.map((one) => [one.reference, one.type]) };
  scope.onmessage({ data: { bytes: Buffer.from(held("wasm"), "base64"), token: asked.token || data.token, plan } });
  return scope;
}

async function until(scope, done) {
  while (!scope.heard.some(done)) await new Promise((wake) => { scope.wake = wake; });
}

const calls = {
  // What a run with other values records: {refused, text, ...}.
  async run(values) {
    const { record, csv } = script("record.js"), data = model(), scope = worker();
    const known = new Map(data.given.map((one) => [one.name, one]));
    scope.onmessage({ data: { id: 1, values: Object.entries(values)
      .map(([name, value]) => [known.get(name).reference, known.get(name).type, Number(value)]) } });
    await until(scope, (found) => found.finished || found.refused);
    const parts = scope.heard.flatMap((found) => found.parts), last = scope.heard.at(-1);
    if (!parts.length) return { refused: last.refused, text: last.text, count: 0 };
    const run = record(data, { ...last, parts });
    const columns = Object.fromEntries(data.moving.map((name) => [name, run.of(name)]));
    const constants = { ...run.constants };
    for (const one of data.given) constants[one.name] = Number(one.name in values ? values[one.name] : one.start);
    return { refused: last.refused, finished: last.finished, text: last.text, count: run.count, messages: scope.heard.length,
      time: Array.from(run.time), struck: run.struck.map((row) => run.time[row]), csv: csv(data, run),
      picture: script("scene.js").scene(data.shapes, columns, constants) !== null };
  },
  // Numbers of the questions that were answered when several came at once.
  async several(count) {
    const scope = worker();
    for (let id = 1; id <= count; id++) scope.onmessage({ data: { id, values: [] } });
    await until(scope, (found) => found.finished);
    return scope.heard.map((found) => found.id);
  },
  // What the reader sees after each of `steps`: {set: [name, value]}, {hash}, {click: selector}.
  async session(options, steps) {
    const { document, location, errors, blobs, when } = require("./page_document.js").opened(html, options);
    const find = (selector) => document.querySelector(selector), text = (selector) => find(selector)?.textContent ?? null;
    const seen = () => ({ alert: find("#refusal").hidden ? "" : text("#refusal"), note: find("#note").hidden ? "" : text("#note"),
      count: text("#impact-count"), first: text("#impacts tbody td"), time: text(".time"), struck: text(".struck"),
      shapes: find(".animation svg").children.length, curves: document.querySelectorAll("#charts polyline").length,
      values: document.querySelectorAll("#charts b").filter((one) => one.textContent).length, hash: location.hash,
      files: blobs.map((one) => one.text.split("\r\n")[0]).filter((line) => line.startsWith("time")), errors });
    const settled = () => when(() => text("#state") === "" && text("#impact-count"));
    await settled();
    const found = [seen()];
    for (const step of steps) {
      if (step.set) {
        const field = find("#of_" + step.set[0]);
        Object.assign(field, typeof step.set[1] === "boolean" ? { checked: step.set[1] } : { value: step.set[1] });
        field.dispatch("change");
      }
      if (step.slide) {
        const slider = find("#of_" + step.slide[0]).parentNode.children.find((one) => one.type === "range");
        slider.value = step.slide[1];
        slider.dispatch("input");
      }
      if (step.hash !== undefined) {
        location.hash = step.hash;
        document.dispatch("hashchange");
      }
      if (step.click) find(step.click).click();
      await settled();
      found.push(seen());
    }
    return found;
  },
  scene: (...given) => script("scene.js").scene(...given),
  ticks: (...given) => script("curves.js").ticks(...given),
  hash(hash) {
    const given = script("given.js"), values = given.fromHash(model().given, hash);
    return [Object.fromEntries(values), given.toHash(model().given, values)];
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
