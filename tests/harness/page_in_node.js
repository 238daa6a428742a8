// Runs the scripts that draw a report's charts, without a browser: node page_in_node.js PAGE [old | torn].
// Prints what stands in each chart, and what the page says in the end.
"use strict";
const [file, how] = process.argv.slice(2);
let html = require("fs").readFileSync(file, "utf8");
if (how === "torn") html = html.replace(/(id="packed-arrays">[^<]*?)[^<]{400}</, "$1<");
const { document, errors } = require("./page_document.js").opened(html, { unpacks: how !== "old" });

const notice = document.querySelector(".unpacking");
const count = (root, ...selectors) => selectors.reduce((sum, one) => sum + root.querySelectorAll(one).length, 0);
process.once("beforeExit", () => {
  const charts = document.querySelectorAll(".chart").map((root) => ({
    drawn: count(root, "path.curve", "path.dots", "path.area", "rect.bar", "path.axis"),
    paths: root.querySelectorAll("path.curve").map((one) => one.getAttribute("d")),
    label: root.querySelector("svg") && root.querySelector("svg").getAttribute("aria-label"),
    names: root.querySelectorAll("li button").map((one) => one.textContent.trim()),
  }));
  const drawn = document.documentElement.classList.contains("drawn");
  console.log(JSON.stringify({ charts, notice: notice.parentNode ? notice.textContent : null, drawn, errors }));
});
