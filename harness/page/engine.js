// The mechanism itself: the engine and FMI 3.0 for co-simulation, as WebAssembly that imports nothing.
// One module serves all models, each an image that it loads once. It runs instances one after the other; refusals are
// errors with the engine's own words.
var ENGINE = (function () {
  "use strict";

  const ARRAYS = { Float64: Float64Array, Int32: Int32Array, Boolean: Uint8Array };

  // The bytes of gzip in base64.
  async function unpacked(text) {
    if (typeof DecompressionStream === "undefined")
      throw new Error("This browser is too old for the page; it needs Chrome or Edge 80, Firefox 113, Safari 16.4, or a later one.");
    const letters = atob(text), packed = new Uint8Array(letters.length);
    for (let k = 0; k < packed.length; k++) packed[k] = letters.charCodeAt(k);
    return new Response(new Response(packed).body.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  }

  // `wasm`, `image`: the module and the model, as gzip in base64; `recorded`: {reals, flags, wholes}, the value references
  // of what rows hold.
  async function load({ wasm, image, token, recorded }) {
    const [module, model] = await Promise.all([unpacked(wasm).then((bytes) => WebAssembly.instantiate(bytes, {})), unpacked(image)]);
    const x = module.instance.exports;
    x._initialize();

    // Arrays on the module's memory are void when it grows: each is made anew where it is used.
    const view = (Kind, at, length) => new Kind(x.memory.buffer, at, length);
    function put(array) {
      const at = x.malloc(array.byteLength || 8);
      view(Uint8Array, at, array.byteLength).set(new Uint8Array(array.buffer));
      return at;
    }
    x.page_load(put(new Uint8Array(model)));
    const name = put(new TextEncoder().encode(token + "\0")), now = x.malloc(8), one = x.malloc(8), which = x.malloc(4);
    const lists = [recorded.reals, recorded.flags, recorded.wholes]
      .flatMap((references) => [put(Uint32Array.from(references)), references.length]);
    const width = 2 + recorded.reals.length + recorded.flags.length + recorded.wholes.length;
    let rows = 0, room = 0;

    // What has been said since the instance was made, which is called "page": refusals and warnings, one a line.
    function text() {
      const said = new Uint8Array(x.memory.buffer, x.page_text());
      return new TextDecoder().decode(said.slice(0, said.indexOf(0))).replace(/^page: /gm, "").trim();
    }

    function accepted(status, what) {
      if (status !== 0) throw new Error(text() || what + " was refused.");
    }

    function set(c, [reference, type, value]) {
      view(Uint32Array, which, 1)[0] = reference;
      view(ARRAYS[type], one, 1)[0] = value;
      accepted(x["fmi3Set" + type](c, which, 1, one, 1), "A value");
    }

    function get(c, [reference, type]) {
      view(Uint32Array, which, 1)[0] = reference;
      accepted(x["fmi3Get" + type](c, which, 1, one, 1), "A reading");
      return view(ARRAYS[type], one, 1)[0];
    }

    // An instance at time 0 with values [[reference, type, value], ...].
    function make(values) {
      const c = x.page_make(name);
      if (!c) throw new Error(text());
      try {
        for (const value of values) set(c, value);
        accepted(x.page_begin(c, 0), "The start");
      } catch (error) {
        x.fmi3FreeInstance(c);
        throw error;
      }
      return c;
    }

    // At most `most` rows [time, 1 behind an impact else 0, reals, flags, wholes]: at `from`, where the instance is, at
    // each of `steps` points `spacing` apart, and behind each impact between them. `now` is where the last one is.
    function run(c, from, spacing, steps, most) {
      if (room < most * width) {
        if (rows) x.free(rows);
        room = most * width;
        rows = x.malloc(8 * room);
      }
      view(Float64Array, now, 1)[0] = from;
      const count = x.page_run(c, now, spacing, steps, most, ...lists, rows);
      return { width, count, rows: view(Float64Array, rows, count * width).slice(), now: view(Float64Array, now, 1)[0] };
    }

    return { make, set, get, run, text, width, free: (c) => x.fmi3FreeInstance(c) };
  }

  return { load };
})();
if (typeof module === "object") module.exports = ENGINE;
