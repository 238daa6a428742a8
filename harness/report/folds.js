// Unfolds what the reader goes to by a link, and everything for the printer; lets keys scroll what scrolls inside itself.
(function () {
  "use strict";

  function unfoldLinked() {
    const section = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    const fold = section && section.querySelector("details");
    if (fold) fold.open = true;
  }

  // Only what does scroll is a stop for the Tab key.
  function reachable() {
    for (const one of document.querySelectorAll(".scroll")) {
      if (one.scrollWidth > one.clientWidth || one.scrollHeight > one.clientHeight) one.tabIndex = 0;
      else one.removeAttribute("tabindex");
    }
  }
  addEventListener("resize", reachable);
  addEventListener("load", reachable);
  document.querySelectorAll("details").forEach((fold) => fold.addEventListener("toggle", reachable));

  // A link that is clicked again, when its section was folded meanwhile, changes no address.
  document.querySelectorAll("nav a").forEach((link) => link.addEventListener("click", () => setTimeout(unfoldLinked)));
  addEventListener("hashchange", unfoldLinked);
  addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((fold) => {
    // what computes is not printed
    if (!fold.querySelector(".live-page")) fold.open = true;
  }));
  unfoldLinked();
})();
