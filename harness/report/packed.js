// Opens what a report holds compressed, in elements whose id begins with "packed-" (see packed.py).
var PACKED = (function () {
  "use strict";

  async function bytes(name) {
    const held = atob(document.getElementById("packed-" + name).textContent);
    const compressed = new Blob([Uint8Array.from(held, (letter) => letter.charCodeAt(0))]);
    const stream = compressed.stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  async function text(name) {
    return new TextDecoder().decode(await bytes(name));
  }

  // Arrays of numbers from the differences of their bit patterns, of which the lowest bytes stand first.
  function arrays(packed, lengths) {
    let begin = 0;
    return lengths.map((length) => {
      const own = new Uint8Array(8 * length);
      for (let byte = 0; byte < 8; byte++)
        for (let i = 0; i < length; i++) own[8 * i + byte] = packed[begin++];
      const patterns = new BigInt64Array(own.buffer);
      for (let i = 1; i < length; i++) patterns[i] += patterns[i - 1];
      return Array.from(new Float64Array(own.buffer));
    });
  }

  // The figures of all charts, in their order.
  async function figures() {
    const held = await text("figures");
    const kept = arrays(await bytes("arrays"), JSON.parse(held).lengths);
    const isReference = (value) => value !== null && typeof value === "object" && Number.isInteger(value.shared);
    return JSON.parse(held, (key, value) => isReference(value) ? kept[value.shared] : value).figures;
  }

  return { bytes, text, figures };
})();
