// What every picture that plays in a report has: its elements, its scale, and a button that plays and pauses it.
// A page may hold it more than once, hence `var`.
var PLAYER = (function () {
  "use strict";

  const SVG = "http://www.w3.org/2000/svg";

  function element(name, attributes, parent) {
    const made = document.createElementNS(SVG, name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    if (parent) parent.appendChild(made);
    return made;
  }

  // Give a picture its size for what it shows, at most `width` by `height` of its own pixels with a margin around;
  // returns the scale [pixels/m], and functions for the places of x and y in the picture.
  function fit(svg, view, width, height, margin) {
    const [left, bottom, right, top] = view;
    const scale = Math.min(width / (right - left), height / (top - bottom));
    svg.setAttribute("viewBox", [0, 0, scale * (right - left) + 2 * margin, scale * (top - bottom) + 2 * margin]
      .map((number) => number.toFixed(1)).join(" "));
    return {
      scale,
      across: (x) => (margin + scale * (x - left)).toFixed(2),
      down: (y) => (margin + scale * (top - y)).toFixed(2),
    };
  }

  // The data that an element holds as JSON.
  function held(root) {
    return JSON.parse(root.querySelector("script[type='application/json']").textContent);
  }

  // Play and pause by a button: `advance(seconds)` of the reader's time returns whether it goes on, `show()` draws.
  function player(button, advance, show) {
    const state = { playing: false, set };
    let stamp = null;

    function set(playing) {
      state.playing = playing;
      stamp = null;
      button.textContent = playing ? "Pause" : "Play";
      if (playing) requestAnimationFrame(tick);
      show();
    }

    function tick(instant) {
      if (!state.playing) return;
      const goesOn = stamp === null || advance((instant - stamp) / 1000);
      stamp = instant;
      if (!goesOn) return set(false);
      show();
      requestAnimationFrame(tick);
    }

    return state;
  }

  return { element, fit, held, player };
})();
