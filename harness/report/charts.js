// Draws the charts of a report: its .chart elements, with the figures of packed.js in their order.
(function () {
  "use strict";

  // A phone's screen. There a finger that moves over a chart moves the page, and the tool bar would cover the title.
  const phone = matchMedia("(max-width: 640px)");
  const NARROW = { dragmode: false, margin: { l: 52, r: 8 }, font: { size: 11 }, legend: { font: { size: 11 } } };

  function merged(base, changes) {
    const result = Object.assign({}, base);
    for (const key in changes) {
      const change = changes[key];
      const deep = change && typeof change === "object" && !Array.isArray(change);
      result[key] = deep ? merged(base && base[key], change) : change;
    }
    return result;
  }

  function chart(root, figure) {
    const place = root.querySelector(".plot");
    function draw() {
      const layout = phone.matches ? merged(merged(figure.layout, NARROW), figure.narrow) : merged(figure.layout, {});
      Plotly.newPlot(place, figure.data, layout,
        { displaylogo: false, responsive: true, displayModeBar: phone.matches ? false : "hover" });
    }
    draw();
    phone.addEventListener("change", draw);
  }

  // What is folded has no size: it gets one when it unfolds.
  function fitWhenUnfolded(fold) {
    fold.addEventListener("toggle", () => {
      if (fold.open) fold.querySelectorAll(".js-plotly-plot").forEach((place) => Plotly.Plots.resize(place));
    });
  }

  async function draw() {
    const figures = await PACKED.figures();
    const library = document.createElement("script");
    library.textContent = await PACKED.text("library");
    document.head.append(library);
    document.querySelectorAll(".chart").forEach((root, place) => chart(root, figures[place]));
    document.querySelectorAll("details").forEach(fitWhenUnfolded);
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
