"""A page in a browser: first frame, a slider until it is redrawn, frames and memory while it runs live. Needs chromium.

    python -m benchmarks.page [--model ratchet] [--minutes 5]

Times are of Chromium without a screen; what else the machine does is in them.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import tempfile
from importlib import import_module
from pathlib import Path
from typing import Any

import build_fmu
from harness.page.page_file import page

sys.path.append(str(Path(__file__).parents[1] / "tests" / "harness"))
_DRIVER = import_module("chromium")

_FIRST = """
(() => {
  const look = () => {
    if (document.querySelector(".animation svg > *")) window.firstFrame = performance.now();
    else requestAnimationFrame(look);
  };
  look();
})();
"""
#: Moves the slider of an input to one place after the other; milliseconds until each run is painted: it is drawn in a
#: frame, and what the next frame finds drawn has been painted by then.
_SLIDE = """
(async () => {
  const slider = document.querySelector("#inputs input[type=range]"), state = document.querySelector("#state");
  const found = [];
  const frame = () => new Promise((go) => requestAnimationFrame(go));
  for (let k = 0; k < 30; k++) {
    const since = performance.now();
    slider.value = 100 + 5 * k;
    slider.dispatchEvent(new Event("input"));
    while (state.textContent) await frame();
    found.push(performance.now() - since);
  }
  slider.dispatchEvent(new Event("change"));
  return found;
})()
"""
#: Intervals of frames [ms] for ten seconds in which the slider of an input is dragged thirty times a second.
_DRAG = """
(async () => {
  const slider = document.querySelector("#inputs input[type=range]"), found = [], begun = performance.now();
  const drag = setInterval(() => {
    slider.value = 150 + 100 * Math.sin(performance.now() / 500);
    slider.dispatchEvent(new Event("input"));
  }, 33);
  for (let last = begun; last < begun + 10000;) {
    await new Promise((go) => requestAnimationFrame(go));
    found.push(performance.now() - last);
    last = performance.now();
  }
  clearInterval(drag);
  return found;
})()
"""


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", default="ratchet")
    parser.add_argument("--minutes", type=int, default=5)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "page.html"
        file.write_text(page(build_fmu.web(asked.model)), encoding="utf-8")
        print(f"{asked.model}: {file.stat().st_size / 1000:.0f} kB")
        with _DRIVER.chromium(Path(folder) / "profile") as browser:
            _loads(browser, file)
            _lives(browser, file, asked.minutes)


def _loads(browser: Any, file: Path) -> None:
    with _DRIVER.opened(browser, file, 1200) as shown:
        shown.call("Page.addScriptToEvaluateOnNewDocument", source=_FIRST)
        found = []
        for _ in range(7):
            shown.call("Page.reload")
            shown.wait_until("window.firstFrame")
            found.append(shown.value("window.firstFrame"))
        print(f"first frame: {_said(found)}")
        shown.wait_until("!document.querySelector('#state').textContent")
        print(f"slider to redrawn: {_said(shown.value(_SLIDE))}")


def _lives(browser: Any, file: Path, minutes: int) -> None:
    with _DRIVER.opened(browser, file, 1200) as shown:
        shown.wait_until("!document.querySelector('#state').textContent")
        shown.click("#live")
        shown.wait_until("!document.querySelector('#state').textContent")
        shown.click(".play")
        print(f"frames of ten seconds with an input dragged: {_said(shown.value(_DRAG))}")
        for minute in range(minutes + 1):
            shown.call("HeapProfiler.collectGarbage")
            used = shown.call("Runtime.getHeapUsage")["usedSize"]
            nodes = shown.value("document.querySelectorAll('*').length")
            time = shown.value("document.querySelector('.time').textContent")
            print(f"after {minute} min, {time}: heap {used / 1e6:.1f} MB, {nodes} elements")
            if minute < minutes:
                shown.value("new Promise((go) => setTimeout(go, 60000))")


def _said(found: list[float]) -> str:
    ordered = sorted(found)
    worst = ordered[min(len(ordered) - 1, int(0.95 * len(ordered)))]
    return f"median {statistics.median(found):.1f} ms, 95 % {worst:.1f} ms, of {len(found)}"


if __name__ == "__main__":
    main()
