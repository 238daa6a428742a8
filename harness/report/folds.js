// Unfolds what the reader goes to by a link, and everything for the printer.
(function () {
  "use strict";

  function unfoldLinked() {
    const section = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const fold = section && section.querySelector("details");
    if (fold) fold.open = true;
  }

  addEventListener("hashchange", unfoldLinked);
  addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((fold) => { fold.open = true; }));
  unfoldLinked();
})();
