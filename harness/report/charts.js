// Draws the charts of a report: every .chart element holds its figure as JSON (see page.py).
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

  function chart(root) {
    const figure = JSON.parse(root.querySelector("script").textContent);
    const place = root.querySelector(".plot");
    function draw() {
      const layout = phone.matches ? merged(merged(figure.layout, NARROW), figure.narrow) : merged(figure.layout, {});
      Plotly.newPlot(place, figure.data, layout,
        { displaylogo: false, responsive: true, displayModeBar: phone.matches ? false : "hover" });
    }
    draw();
    phone.addEventListener("change", draw);
  }

  document.querySelectorAll(".chart").forEach(chart);
})();
