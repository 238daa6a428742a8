// Plays the mechanism of a report: every .animation element holds its data as JSON (see animation.py).
(function () {
  "use strict";

  const SVG = "http://www.w3.org/2000/svg";
  const INK = "#1c2733";
  // Of the picture, in its own pixels: the most it takes, and the room around the mechanism.
  const MOST_WIDTH = 1000, MOST_HEIGHT = 520, MARGIN = 40;
  // How long an impact flashes while playing, in seconds of the reader's time.
  const FLASH = 0.4;
  const SLIDER = 1000;

  function element(name, attributes, parent) {
    const made = document.createElementNS(SVG, name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    if (parent) parent.appendChild(made);
    return made;
  }

  // The last index whose value is not above x; `values` increase.
  function lastUpTo(values, x) {
    let low = -1, high = values.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (values[middle] <= x) low = middle; else high = middle;
    }
    return low;
  }

  // Functions that draw one kind of shape each: they make its elements, and return what moves them.
  // `to(x, y)` gives "x,y" in the picture, `turn(angle)` a rotation; y points up in the mechanism, down in the picture.
  const makers = {
    wheel(shape, layer, scale) {
      const group = element("g", {}, layer);
      const points = [];
      for (let k = 0; k < shape.count; k++)
        for (const [radius, angle] of shape.outline) {
          const direction = angle + k * shape.pitch;
          points.push((scale * radius * Math.cos(direction)).toFixed(1) + "," +
            (-scale * radius * Math.sin(direction)).toFixed(1));
        }
      element("polygon", { points: points.join(" "), fill: shape.colour, stroke: INK, "stroke-width": 1.5,
        "stroke-linejoin": "round" }, group);
      // its x axis, so that one sees it turn
      const [radius, angle] = shape.outline[0];
      element("line", { x2: scale * radius * Math.cos(angle), y2: -scale * radius * Math.sin(angle), stroke: INK,
        "stroke-width": 1.5, "stroke-dasharray": "9 4 2 4", opacity: 0.55 }, group);
      return (place, value) => group.setAttribute("transform", place + turn(value(shape.angle)));
    },
    disc(shape, layer, scale) {
      const circle = element("circle", { fill: shape.colour, stroke: INK, "stroke-width": 1.5 }, layer);
      return (place, value) => {
        circle.setAttribute("transform", place);
        circle.setAttribute("r", scale * Math.abs(value(shape.radius)));
      };
    },
    bar(shape, layer, scale) {
      const link = element("path", { fill: shape.colour, stroke: INK, "stroke-width": 1.5 }, layer);
      return (place, value) => {
        const length = scale * value(shape.length);
        // One that strikes ends in a point: where it touches is then plain to see.
        const end = shape.pointed ? `H${0.7 * length} L${length} 0 L${0.7 * length} 6` : `H${length} a6 6 0 0 1 0 12`;
        link.setAttribute("transform", place + turn(value(shape.angle)));
        link.setAttribute("d", `M0 -6 ${end} H0 a6 6 0 0 1 0 -12 Z`);
      };
    },
    hinge(shape, layer) {
      const group = element("g", { stroke: INK, "stroke-width": 1.6, fill: "#fff" }, layer);
      if (typeof shape.at !== "string") {
        element("path", { d: "M0 0 l-11 19 h22 Z" }, group);
        element("path", { d: "M-16 19 h32 M-9 19 l-5 6 m13 -6 l-5 6 m13 -6 l-5 6 m13 -6 l-5 6", fill: "none" }, group);
      }
      element("circle", { r: 4.5 }, group);
      return (place) => group.setAttribute("transform", place);
    },
    striker(shape, layer, scale, flash) {
      const group = element("g", { "class": "flash", visibility: "hidden" }, layer);
      element("circle", { r: 20, fill: flash, opacity: 0.28 }, group);
      element("circle", { r: 9, fill: flash, stroke: "#fff", "stroke-width": 2 }, group);
      return (place, value, struck) => {
        group.setAttribute("transform", place);
        group.setAttribute("visibility", struck ? "visible" : "hidden");
      };
    },
  };

  function turn(angle) {
    return " rotate(" + (-angle * 180 / Math.PI).toFixed(3) + ")";
  }

  // The picture of a mechanism, one of them or all that there is (`panel` is `data`); returns draw(time, struck).
  function picture(svg, panel, data) {
    const [left, bottom, right, top] = panel.view;
    const [width, height] = panel.size || [MOST_WIDTH, MOST_HEIGHT];
    const scale = Math.min(width / (right - left), height / (top - bottom));
    svg.setAttribute("viewBox", [0, 0, scale * (right - left) + 2 * MARGIN, scale * (top - bottom) + 2 * MARGIN]
      .map((number) => number.toFixed(1)).join(" "));
    const movers = panel.shapes.map((shape) => makers[shape.kind](shape, svg, scale, data.flash));
    return function (time, struck) {
      const before = Math.max(0, Math.min(lastUpTo(data.time, time), data.time.length - 2));
      const after = Math.min(before + 1, data.time.length - 1);
      const span = data.time[after] - data.time[before];
      const part = span > 0 ? Math.min(1, Math.max(0, (time - data.time[before]) / span)) : 0;
      const value = (number) => {
        if (typeof number === "number") return number;
        const column = panel.columns[number[0]];
        return number[1] * (column[before] + part * (column[after] - column[before]));
      };
      const ends = {};
      panel.shapes.forEach((shape, i) => {
        const [x, y] = typeof shape.at === "string" ? ends[shape.at] : shape.at.map(value);
        if (shape.kind === "bar") {
          const angle = value(shape.angle), length = value(shape.length);
          ends[shape.name] = [x + length * Math.cos(angle), y + length * Math.sin(angle)];
        }
        const place = "translate(" + (MARGIN + scale * (x - left)).toFixed(2) + " " +
          (MARGIN + scale * (top - y)).toFixed(2) + ")";
        movers[i](place, value, struck);
      });
    };
  }

  function animate(root) {
    const find = (selector) => root.querySelector(selector);
    const data = JSON.parse(find("script[type='application/json']").textContent);
    const slider = find("input"), play = find(".play"), speed = find("select");
    const lamps = [...root.querySelectorAll(".lamp")];
    const start = data.time[0], end = data.time[data.time.length - 1];
    const svgs = [...root.querySelectorAll("svg")];
    // Each picture flashes at its own impacts.
    const pictures = (data.panels || [data]).map((panel, i) =>
      ({ impacts: panel.impacts, svg: svgs[i], draw: picture(svgs[i], panel, data) }));
    let now = start, playing = false, stamp = null;

    for (const instant of data.impacts) {
      const mark = document.createElement("i");
      mark.style.left = 100 * (instant - start) / (end - start || 1) + "%";
      mark.style.background = data.flash;
      find(".marks").appendChild(mark);
    }

    // Of which component of a machine an impact is, or of which ones, if several have one at once.
    function whose(last) {
      const names = (data.whose || []).filter((_, i) => data.impacts[i] === data.impacts[last]);
      return names.length ? ", " + [...new Set(names)].join(", ") : "";
    }

    function show() {
      const last = lastUpTo(data.impacts, now);
      // Standing still, an impact shows for as long as the slider cannot distinguish it from now.
      const least = (end - start) / SLIDER;
      const flashes = (impacts) => {
        const latest = lastUpTo(impacts, now);
        return latest >= 0 && now - impacts[latest] <= Math.max(playing ? FLASH * speed.value : 0, least);
      };
      const struck = flashes(data.impacts);
      for (const one of pictures) {
        const hit = flashes(one.impacts);
        one.draw(now, hit);
        one.svg.classList.toggle("hit", hit);
      }
      // What an impact has closed is active from then on, not only from the next frame.
      let frame = Math.max(0, lastUpTo(data.time, now));
      if (last >= 0 && data.impacts[last] > data.time[frame]) frame = Math.min(frame + 1, data.time.length - 1);
      data.contacts.forEach((contact, i) => lamps[i].classList.toggle("lit", contact.active[frame] === "1"));
      [...find(".marks").children].forEach((mark, i) => mark.classList.toggle("now", struck && i === last));
      const text = now.toFixed(data.decimals) + " s";
      find(".time").textContent = "t = " + text;
      find(".struck").textContent = last < 0 ? "" :
        "impact " + (last + 1) + " of " + data.impacts.length + " at " + Number(data.impacts[last].toPrecision(7)) + " s" +
        whose(last);
      slider.value = Math.round(SLIDER * (now - start) / (end - start || 1));
      slider.setAttribute("aria-valuetext", text);
    }

    function set(state) {
      playing = state;
      stamp = null;
      play.textContent = playing ? "Pause" : "Play";
      if (playing) requestAnimationFrame(tick);
      show();
    }

    function tick(instant) {
      if (!playing) return;
      if (stamp !== null) now = Math.min(end, now + speed.value * (instant - stamp) / 1000);
      stamp = instant;
      if (now >= end) return set(false);
      show();
      requestAnimationFrame(tick);
    }

    function go(time) {
      now = time;
      set(false);
    }

    play.addEventListener("click", () => {
      if (!playing && now >= end) now = start;
      set(!playing);
    });
    slider.addEventListener("input", () => go(start + (end - start) * slider.value / SLIDER));
    if (find(".next"))
      find(".next").addEventListener("click", () =>
        go(data.impacts[(lastUpTo(data.impacts, now) + 1) % data.impacts.length]));

    show();
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) {
      // It plays by itself once, when the reader first sees it, unless they were faster.
      const seen = new IntersectionObserver((entries) => {
        if (!entries.some((entry) => entry.isIntersecting)) return;
        seen.disconnect();
        if (now === start && !playing) set(true);
      }, { threshold: 0.5 });
      seen.observe(find("svg"));
    }
  }

  document.querySelectorAll(".animation").forEach(animate);
})();
