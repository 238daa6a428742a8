"""Debian's chromium, driven over its DevTools protocol through a pipe: no driver, no port, no library."""

from __future__ import annotations

import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

#: Where a chromium may be; None when there is none.
PROGRAM = next(filter(None, map(shutil.which, ("chromium", "google-chrome"))), None)

_QUIET = [
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage"),
]
#: A machine that is busy with other tests may take long; nothing is measured by it [s].
_PATIENCE = 120.0


class Browser:
    """A chromium that answers commands and reports events.

    Args:
        commands, answers: file descriptors of its pipe.
    """

    def __init__(self, commands: int, answers: int) -> None:
        self._commands, self._answers = commands, answers
        self._rest = b""
        self._last = 0
        self.listeners: list[Callable[[dict[str, Any]], None]] = []

    def call(self, method: str, session: str | None = None, **parameters: Any) -> dict[str, Any]:
        """The result of a command of the protocol; events that come before it go to the listeners."""
        self._last += 1
        number = self._last
        message: dict[str, Any] = {"id": number, "method": method, "params": parameters}
        if session is not None:
            message["sessionId"] = session
        os.write(self._commands, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._next()
            if answer.get("id") == number:
                assert "error" not in answer, f"{method}: {answer['error']}"
                result: dict[str, Any] = answer["result"]
                return result
            for listener in self.listeners:
                listener(answer)

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._rest:
            ready, _, _ = select.select([self._answers], [], [], _PATIENCE)
            assert ready, f"chromium has said nothing for {_PATIENCE:g} s"
            read = os.read(self._answers, 1 << 20)
            assert read, "chromium has ended"
            self._rest += read
        message, _, self._rest = self._rest.partition(b"\0")
        answer: dict[str, Any] = json.loads(message)
        return answer


@dataclass
class Page:
    """One page in a tab of its own.

    Attributes:
        width: of the screen [CSS px].
        errors: what it has written to the console as an error, or thrown.
        requests: addresses that it has asked for.
    """

    browser: Browser
    session: str
    width: int
    errors: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def hear(self, event: dict[str, Any]) -> None:
        """Keep errors and requests."""
        if event.get("sessionId") != self.session:
            return
        method, event_data = event["method"], event["params"]
        if method == "Network.requestWillBeSent":
            self.requests.append(event_data["request"]["url"])
        elif method == "Runtime.exceptionThrown":
            self.errors.append(json.dumps(event_data["exceptionDetails"]))
        elif (method == "Runtime.consoleAPICalled" and event_data["type"] in ("error", "assert")) or (
            method == "Log.entryAdded" and event_data["entry"]["level"] == "error"
        ):
            self.errors.append(json.dumps(event_data))

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        """A command to this page."""
        return self.browser.call(method, self.session, **parameters)

    def value(self, script: str) -> Any:
        """What a JavaScript expression gives; a promise is waited for."""
        answer = self.call("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    def wait_until(self, script: str) -> None:
        """Look at an expression again and again until it is true."""
        end = time.monotonic() + _PATIENCE
        while not self.value(script):
            assert time.monotonic() < end, f"not in {_PATIENCE:g} s: {script}"
            time.sleep(0.02)  # the page needs the processor

    def click(self, selector: str) -> None:
        """Press the mouse on an element, as a reader does."""
        x, y = self.value(
            f"(() => {{ const e = document.querySelector({selector!r}); e.scrollIntoView({{block: 'center'}});"
            " const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()"
        )
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def screenshot(self, path: Path) -> None:
        """The whole page, from top to bottom, as PNG."""
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}
        image = self.call("Page.captureScreenshot", format="png", clip=clip, captureBeyondViewport=True)
        path.write_bytes(base64.b64decode(image["data"]))


def _far(descriptor: int) -> int:
    far = fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, 10)
    os.close(descriptor)
    return far


@contextmanager
def chromium(profile: Path) -> Iterator[Browser]:
    """A headless browser with a new profile in the folder `profile`; it ends with the block."""
    assert PROGRAM is not None
    # The browser reads from descriptor 3 and writes to 4: those of here must be others.
    (ours_in, theirs_out), (theirs_in, ours_out) = map(_far, os.pipe()), map(_far, os.pipe())
    start = "import os, sys; [os.dup2(int(sys.argv[n]), 2 + n) for n in (1, 2)]; os.execv(sys.argv[3], sys.argv[3:])"
    arguments = [PROGRAM, *_QUIET, "--remote-debugging-pipe", f"--user-data-dir={profile}"]
    with subprocess.Popen(
        [sys.executable, "-c", start, str(theirs_in), str(theirs_out), *arguments],
        pass_fds=(theirs_in, theirs_out),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as process:
        os.close(theirs_in)
        os.close(theirs_out)
        browser = Browser(ours_out, ours_in)
        try:
            yield browser
            browser.call("Browser.close")
        finally:
            os.close(ours_out)
            os.close(ours_in)
            process.terminate()
            try:
                process.wait(_PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()


@contextmanager
def opened(browser: Browser, file: Path, width: int, height: int = 800) -> Iterator[Page]:
    """A file in a new tab of `width` [CSS px]; a narrow one is a phone's. Nothing moves before it is asked to."""
    target = browser.call("Target.createTarget", url="about:blank")["targetId"]
    page = Page(browser, browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"], width)
    browser.listeners.append(page.hear)
    for domain in ("Page", "Runtime", "Log", "Network"):
        page.call(f"{domain}.enable")
    page.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
    page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
    page.call("Page.navigate", url=file.resolve().as_uri())
    page.wait_until("location.href !== 'about:blank' && document.readyState === 'complete'")
    yield page
    browser.listeners.remove(page.hear)
    browser.call("Target.closeTarget", targetId=target)
