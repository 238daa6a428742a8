// Draws the charts of a report: its .chart elements, with the figures of packed.js in their order.
(function () {
  "use strict";

  // Charts of one section that measure the same to the right share cursor and zoom.
  const groups = new Map();
  function groupOf(root, figure) {
    const section = root.closest("section");
    if (!groups.has(section)) groups.set(section, new Map());
    const own = groups.get(section), key = figure.x + (figure.log_x ? " lg" : "");
    if (figure.to_scale || figure.bars || !own.has(key)) own.set(key, CURVES.group());
    return own.get(key);
  }

  const quoted = (words) => /[",\n]/.test(words) ? '"' + words.replaceAll('"', '""') + '"' : words;

  // The points of a chart's curves, with all digits; curves over the same places share a column for them.
  function csv(figure) {
    const columns = [];
    let places = null;
    for (const one of figure.curves) {
      if (one.x !== places) columns.push([figure.x, places = one.x]);
      columns.push([one.name + (one.about ? " (" + one.about + ")" : ""), one.y]);
    }
    for (const lane of figure.lanes || []) columns.push([lane.name + " from", lane.spans.map((span) => span[0])], [lane.name + " to", lane.spans.map((span) => span[1])]);
    const lines = [columns.map(([heading]) => quoted(heading)).join(",")];
    for (let row = 0; row < Math.max(...columns.map((column) => column[1].length)); row++)
      lines.push(columns.map(([, values]) => values[row] ?? "").join(","));
    return lines.join("\r\n") + "\r\n";
  }

  function saving(figure) {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", textContent: "CSV", title: "Save the numbers of this chart" });
    button.addEventListener("click", () => {
      const address = URL.createObjectURL(new Blob([csv(figure)], { type: "text/csv" }));
      const name = figure.title.toLowerCase().replace(/[^a-z0-9]+/g, "_").replace(/^_|_$/g, "") || "chart";
      Object.assign(document.createElement("a"), { href: address, download: name + ".csv" }).click();
      setTimeout(() => URL.revokeObjectURL(address), 10000);
    });
    return button;
  }

  async function draw() {
    const figures = await PACKED.figures();
    document.querySelectorAll(".chart").forEach((root, place) => {
      const figure = figures[place];
      if (figure.axes) PARALLEL.plot(root, figure);
      else CURVES.plot(root, figure, groupOf(root, figure), { buttons: [saving(figure)] });
    });
  }

  // The page says from the beginning what to do if the charts do not come, as where no script runs at all.
  const notice = document.querySelector(".unpacking");
  draw().then(() => {
    notice.remove();
    document.documentElement.classList.add("drawn");
  }).catch((error) => {
    const old = typeof DecompressionStream === "undefined";
    notice.textContent = (old ? "This browser cannot unpack the charts. " : `The charts cannot be drawn: ${error}. `) +
      notice.dataset.advice;
  });
})();
