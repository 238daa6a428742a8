// The page of a model inside a report: unpacked into a frame of its own when its section unfolds.
(function () {
  "use strict";

  const host = document.querySelector(".live-page"), fold = host.closest("details");
  const make = (tag, attributes) => Object.assign(document.createElement(tag), attributes);

  async function fill() {
    if (!fold.open || host.children.length) return;
    const said = make("p", { textContent: "Unpacking the engine ..." });
    host.append(said);
    try {
      const html = await PACKED.text("live");
      const frame = make("iframe", { title: "The mechanism, live", srcdoc: html });
      const save = make("button", { type: "button", textContent: "Save as a page of its own" });
      save.addEventListener("click", () => {
        const address = URL.createObjectURL(new Blob([html], { type: "text/html" }));
        make("a", { href: address, download: host.dataset.file }).click();
        setTimeout(() => URL.revokeObjectURL(address), 10000);
      });
      host.replaceChildren(frame, save);
    } catch (error) {
      said.textContent = "This browser cannot unpack the engine: " + error;
    }
  }

  fold.addEventListener("toggle", fill);
  fill();
})();
