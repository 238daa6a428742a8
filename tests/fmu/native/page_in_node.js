// Runs a model in the module of all pages, as a page does. From standard input: {wasm, image, token, given: [[reference,
// type, value]], start, spacing, steps, reals, flags, wholes}; to standard output: {imports, text, rows, width}.
"use strict";
const fs = require("fs");

async function main() {
  const asked = JSON.parse(fs.readFileSync(0, "utf8"));
  const module = await WebAssembly.compile(fs.readFileSync(asked.wasm));
  const imports = WebAssembly.Module.imports(module).length;
  const { exports: x } = await WebAssembly.instantiate(module, {});
  x._initialize();
  const put = (array) => {
    const at = x.malloc(array.byteLength || 8);
    new Uint8Array(x.memory.buffer).set(new Uint8Array(array.buffer), at);
    return at;
  };
  x.page_load(put(new Uint8Array(fs.readFileSync(asked.image))));
  const text = () => {
    const bytes = new Uint8Array(x.memory.buffer, x.page_text());
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0))).trim();
  };
  const answer = (rows, width) => process.stdout.write(JSON.stringify({ imports, text: text(), rows, width }));
  const arrays = { Float64: Float64Array, Int32: Int32Array, Boolean: Uint8Array };

  const c = x.page_make(put(new TextEncoder().encode(asked.token + "\0")));
  if (!c) return answer([], 0);
  for (const [reference, type, value] of asked.given) {
    const status = x["fmi3Set" + type](c, put(Uint32Array.of(reference)), 1, put(arrays[type].of(value)), 1);
    if (status) return answer([], 0);
  }
  if (x.page_begin(c, asked.start)) return answer([], 0);
  const width = 2 + asked.reals.length + asked.flags.length + asked.wholes.length, room = 4 * asked.steps + 100;
  const now = put(Float64Array.of(asked.start)), out = x.malloc(8 * room * width);
  const count = x.page_run(c, now, asked.spacing, asked.steps, room, put(Uint32Array.from(asked.reals)),
    asked.reals.length, put(Uint32Array.from(asked.flags)), asked.flags.length,
    put(Uint32Array.from(asked.wholes)), asked.wholes.length, out);
  const rows = Array.from(new Float64Array(x.memory.buffer, out, count * width), String);
  x.fmi3FreeInstance(c);
  answer(rows, width);
}
main();
