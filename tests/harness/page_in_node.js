// Runs the scripts that draw a report's charts, without a browser: node page_in_node.js PAGE [old | phone | torn].
// Prints what plotly would have drawn, how long the library is, and what the page says in the end.
"use strict";
const [file, how] = process.argv.slice(2);
const html = require("fs").readFileSync(file, "utf8");

const held = {};
for (const [, id, text] of html.matchAll(/<script type="text\/plain" id="([^"]*)">([^<]*)<\/script>/g)) held[id] = text;
if (how === "torn") held["packed-arrays"] = held["packed-arrays"].slice(0, -400);
if (how === "old") delete globalThis.DecompressionStream;

const page = { drawn: [], library: "", classes: [] };
const notice = {
  textContent: "…",
  dataset: { advice: html.match(/class="unpacking" data-advice="([^"]*)"/)[1] },
  remove() { this.textContent = null; },
};
const charts = [...html.matchAll(/<div class="chart"><div class="plot"><\/div><\/div>/g)]
  .map((_, number) => ({ querySelector: () => number }));
globalThis.document = {
  getElementById: (id) => ({ textContent: held[id] }),
  querySelector: () => notice,
  querySelectorAll: (selector) => selector === ".chart" ? charts : [],
  createElement: () => ({}),
  head: { append: (script) => { page.library = script.textContent; } },
  documentElement: { classList: { add: (name) => page.classes.push(name) } },
};
globalThis.matchMedia = () => ({ matches: how === "phone", addEventListener() {} });
globalThis.Plotly = { newPlot: (place, data, layout) => page.drawn.push({ place, data, layout }) };

const scripts = [...html.matchAll(/<script>([\s\S]*?)<\/script>/g)].map((found) => found[1]);
for (const script of scripts.filter((text) => text.includes("PACKED"))) require("vm").runInThisContext(script);

process.once("beforeExit", () => {
  new (require("vm").Script)(page.library); // it is a script, whole
  console.log(JSON.stringify({ ...page, library: page.library.length, notice: notice.textContent }));
});
