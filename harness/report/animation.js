// Plays the mechanism of a report: every .animation element holds its data as JSON (see animation.py). A page whose data
// change plays them by ANIMATION.animate.
var ANIMATION = (function () {
  "use strict";

  const { element, fit, held, player } = PLAYER;
  const INK = "var(--ink)";
  // Of the picture, in its own pixels: the most it takes, and the room around the mechanism.
  const MOST_WIDTH = 1000, MOST_HEIGHT = 520, MARGIN = 40;
  // How long an impact flashes while playing, in seconds of the reader's time.
  const FLASH = 0.4;
  const SLIDER = 1000;
  // What is made as it plays leaps no further than this, in seconds of the reader's time.
  const LEAP = 0.1;

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
    link(shape, layer, scale) {
      const group = element("g", { "stroke-linejoin": "round", "stroke-linecap": "round" }, layer);
      const points = pixels(shape.hull, scale);
      // once wider in ink, for an edge around the rod or plate
      for (const [colour, width] of [[INK, 14], [shape.colour, 11]])
        element("polygon", { points, fill: colour, stroke: colour, "stroke-width": width }, group);
      if (shape.points.length === 1)
        element("line", { x2: 7, y2: 0, stroke: INK, "stroke-width": 1.5 }, group); // one sees it turn
      return (place, value) => group.setAttribute("transform", place + turn(value(shape.angle)));
    },
    polyline(shape, layer, scale) {
      const closed = shape.points.length > 2;
      const draw = (points, into) => element(closed ? "polygon" : "polyline", { points: pixels(points, scale),
        fill: closed ? shape.colour : "none", "fill-opacity": 0.6, stroke: INK, "stroke-width": closed ? 1.5 : 2,
        "stroke-linejoin": "round" }, into);
      const all = shape.copies ? element("g", {}, layer) : null, line = draw(shape.points, all || layer);
      for (const [x, y, angle] of shape.copies || []) {
        const c = Math.cos(angle), s = Math.sin(angle);
        draw(shape.points.map(([a, b]) => [x + c * a - s * b, y + s * a + c * b]), all);
      }
      return (place, value) => (all || line).setAttribute("transform", place + turn(value(shape.angle)));
    },
    spring(shape, layer) {
      const line = element("path", { fill: "none", stroke: INK, "stroke-width": 1.5, "stroke-linejoin": "round" }, layer);
      return (place, value, struck, from, to) => line.setAttribute("d", coil(from, to));
    },
    rod(shape, layer) {
      const line = element("path", { fill: "none", stroke: INK, "stroke-width": 3, "stroke-linecap": "round" }, layer);
      return (place, value, struck, from, to) => line.setAttribute("d", "M" + from + " L" + to);
    },
    trace(shape, layer) {
      element("polyline", { points: shape.path.map((point) => point.join(",")).join(" "), fill: "none",
        stroke: shape.colour, "stroke-width": 1.5, opacity: 0.7 }, layer);
      return () => {};
    },
    hinge(shape, layer) {
      const group = element("g", { stroke: INK, "stroke-width": 1.6, fill: "var(--card, #fff)" }, layer);
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

  // Points of a body's frame in pixels about its place.
  function pixels(points, scale) {
    return points.map(([x, y]) => (scale * x).toFixed(1) + "," + (-scale * y).toFixed(1)).join(" ");
  }

  // A coil from one place to another: straight ends, and windings that keep their number as it is drawn out.
  function coil([x0, y0], [x1, y1]) {
    const [dx, dy] = [x1 - x0, y1 - y0], length = Math.hypot(dx, dy) || 1;
    const point = (along, beside) => (x0 + along * dx - beside * dy / length).toFixed(1) + " " +
      (y0 + along * dy + beside * dx / length).toFixed(1);
    const windings = [...Array(11).keys()].map((k) => "L" + point(0.2 + 0.06 * k, k % 10 ? (k % 2 ? 7 : -7) : 0));
    return "M" + point(0, 0) + windings.join("") + "L" + point(1, 0);
  }

  // Where the points of links and the far ends of bars are, by name, at a time.
  function endsAt(shapes, value) {
    const ends = {};
    const where = (place) => typeof place === "string" ? ends[place] : place.map(value);
    for (const shape of shapes) {
      const [x, y] = where(shape.at);
      if (shape.kind === "bar") {
        const angle = value(shape.angle), length = value(shape.length);
        ends[shape.name] = [x + length * Math.cos(angle), y + length * Math.sin(angle)];
      }
      if (shape.points) {
        const angle = value(shape.angle), c = Math.cos(angle), s = Math.sin(angle);
        shape.points.forEach(([a, b], k) => { ends[shape.name + "." + k] = [x + c * a - s * b, y + s * a + c * b]; });
      }
    }
    return where;
  }

  function turn(angle) {
    return " rotate(" + (-angle * 180 / Math.PI).toFixed(3) + ")";
  }

  // The picture of a mechanism, one of them or all that there is (`panel` is `data`); returns draw(time, struck).
  function picture(svg, panel, data) {
    const [width, height] = panel.size || [MOST_WIDTH, MOST_HEIGHT];
    const { scale, across, down } = fit(svg, panel.view, width, height, MARGIN);
    for (const shape of panel.shapes.filter((shape) => shape.kind === "trace"))
      shape.path = data.time.map((_, frame) => {
        const value = (number) => typeof number === "number" ? number : number[1] * panel.columns[number[0]][frame];
        const [x, y] = endsAt(panel.shapes, value)(shape.at);
        return [across(x), down(y)];
      });
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
      const where = endsAt(panel.shapes, value);
      const spot = (place) => { const [x, y] = where(place); return [Number(across(x)), Number(down(y))]; };
      panel.shapes.forEach((shape, i) => {
        const from = spot(shape.at), to = shape.to && spot(shape.to);
        movers[i]("translate(" + from.join(" ") + ")", value, struck, from, to);
      });
    };
  }

  // Plays `data` in an element that has the controls of animation.py; `moved(time)` hears of each time that is shown.
  // Returns `take(data)`, which plays other data of as many panels and contacts on from the same time, `go(time)` and
  // `run(whether)`. Data that grow have `ahead(from, to)`, which sees to it that there are some up to the time `to`, and
  // gives up to when there are; `strike()`, which goes on to the next impact; and `grow()` is called when there are more.
  function animate(root, data, moved) {
    const find = (selector) => root.querySelector(selector);
    const slider = find("input"), play = find(".play"), speed = find("select"), marks = find(".marks");
    const lamps = [...root.querySelectorAll(".lamp")], svgs = [...root.querySelectorAll("svg")];
    let start, end, pictures, now = data.time[0];

    function hold(given) {
      data = given;
      start = data.time[0];
      end = data.end === undefined ? data.time[data.time.length - 1] : data.end;
      now = Math.min(Math.max(now, start), end);
      svgs.forEach((svg) => svg.replaceChildren());
      // Each picture flashes at its own impacts.
      pictures = (data.panels || [data]).map((panel, i) =>
        ({ impacts: panel.impacts, svg: svgs[i], draw: picture(svgs[i], panel, data) }));
      mark();
    }

    function mark() {
      marks.replaceChildren(...data.impacts.map((instant) => {
        const mark = document.createElement("i");
        mark.style.left = 100 * (instant - start) / (end - start || 1) + "%";
        mark.style.background = data.flash;
        return mark;
      }));
    }

    function grow() {
      [start, end] = [data.time[0], data.time[data.time.length - 1]];
      now = Math.min(Math.max(now, start), end);
      mark();
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
        return latest >= 0 && now - impacts[latest] <= Math.max(playing.playing ? FLASH * speed.value : 0, least);
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
      data.contacts.forEach((contact, i) => lamps[i].classList.toggle("lit", Number(contact.active[frame]) === 1));
      [...marks.children].forEach((mark, i) => mark.classList.toggle("now", struck && i === last));
      const text = now.toFixed(data.decimals) + " s";
      find(".time").textContent = "t = " + text;
      find(".struck").textContent = last < 0 ? "" :
        "impact " + (last + 1) + " of " + data.impacts.length + " at " + Number(data.impacts[last].toPrecision(7)) + " s" +
        whose(last);
      slider.value = Math.round(SLIDER * (now - start) / (end - start || 1));
      slider.setAttribute("aria-valuetext", text);
      if (moved) moved(now);
    }

    function advance(seconds) {
      if (data.ahead) {
        now = Math.max(now, data.ahead(now, now + speed.value * Math.min(seconds, LEAP)));
        return true;
      }
      now = Math.min(end, now + speed.value * seconds);
      return now < end;
    }

    const playing = player(play, advance, show);

    function go(time) {
      now = time;
      playing.set(false);
    }

    play.addEventListener("click", () => {
      if (!playing.playing && now >= end && !data.ahead) now = start;
      playing.set(!playing.playing);
    });
    slider.addEventListener("input", () => go(start + (end - start) * slider.value / SLIDER));
    if (find(".next"))
      find(".next").addEventListener("click", () => {
        if (data.strike && lastUpTo(data.impacts, now) === data.impacts.length - 1) data.strike();
        else if (data.impacts.length) go(data.impacts[(lastUpTo(data.impacts, now) + 1) % data.impacts.length]);
      });

    hold(data);
    show();
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) {
      // It plays by itself once, when the reader first sees it, unless they were faster.
      const seen = new IntersectionObserver((entries) => {
        if (!entries.some((entry) => entry.isIntersecting)) return;
        seen.disconnect();
        if (now === start && !playing.playing) playing.set(true);
      }, { threshold: 0.5 });
      seen.observe(find("svg"));
    }
    return { take: (given) => { hold(given); show(); }, go, grow, run: playing.set };
  }

  document.querySelectorAll(".animation").forEach((root) => {
    if (root.querySelector("script[type='application/json']")) animate(root, held(root));
  });
  return { animate };
})();
