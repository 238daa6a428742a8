"""A page that follows a file: built anew when the file is saved, and shown anew by a server of this machine alone."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from contextlib import suppress
from html import escape
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from mechanism_fmu.batch import MechanismError

#: Around the page, which stays as it is: it asks what there is, and loads the page anew with its address.
_AROUND = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline';
 style-src 'unsafe-inline'; frame-src 'self'; connect-src 'self'"><title>TITLE</title>
<style>html, body { height: 100%; margin: 0; }
body { display: flex; flex-direction: column; font: 15px/1.5 sans-serif; }
iframe { flex: 1; border: 0; width: 100%; } pre { margin: 0; padding: 8px 14px; white-space: pre-wrap; color: #fff;
background: #B3261E; max-height: 40vh; overflow-y: auto; }</style></head>
<body><pre role="alert" hidden></pre><iframe title="TITLE"></iframe><script>
const objection = document.querySelector("pre"), frame = document.querySelector("iframe");
let shown = 0;
async function look() {
  let state;
  try {
    state = await (await fetch("/state")).json();
  } catch {
    state = { version: shown, objection: "The watch has ended: nothing follows the file any more." };
  }
  if (objection.textContent !== state.objection) objection.textContent = state.objection;
  objection.hidden = !state.objection;
  if (state.version && state.version !== shown) {
    if (shown) frame.contentWindow.location.reload(); else frame.src = "/page";
    shown = state.version;
  }
  setTimeout(look, 500);
}
look();
</script></body></html>
"""


class Watched:
    """The newest page of a file, and what is wrong with the file, if anything.

    Args:
        file: that is followed; the other Python files of its folder are, too.
        make: builds the page, as HTML.

    Attributes:
        version: counts the pages from the time [ms] of the first: those of an earlier watch have others; 0 before.
        html: the newest one; "" before the first.
        objection: why the file as it is gives no page; "" where it does.
    """

    def __init__(self, file: Path, make: Callable[[], str]) -> None:
        self.version = 0
        self.html = ""
        self.objection = ""
        self._file, self._make = file, make
        self._seen: dict[Path, tuple[int, int]] | None = None

    def look(self) -> bool:
        """Build the page where a file has changed since the last look; whether one had.

        A file that gives no page leaves the last one.
        """
        found = self._stamps()
        if found == self._seen:
            return False
        self._seen = found
        try:
            self.html = self._make()
        except (MechanismError, OSError) as error:
            self.objection = str(error)
        else:
            self.objection = ""
            self.version = self.version + 1 if self.version else time.time_ns() // 10**6
        return True

    def _stamps(self) -> dict[Path, tuple[int, int]]:
        """When the files were written, and how long they are."""
        found = {}
        for path in self._file.absolute().parent.glob("*.py"):
            try:
                stat = path.stat()
            except OSError:  # it has gone meanwhile
                continue
            found[path] = (stat.st_mtime_ns, stat.st_size)
        return found


def server_of(watched: Watched, title: str, port: int) -> ThreadingHTTPServer:
    """A server of the page, for this machine alone.

    Args:
        watched: what it shows.
        title: of the page around it.
        port: 0 for a free one.

    Raises:
        OSError: the port is taken.
    """

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            with suppress(ConnectionError):  # whoever asked has gone
                self._answer()

        def _answer(self) -> None:
            # A page of elsewhere may have a name that leads here: it is not for it.
            if self.headers.get("Host", "").partition(":")[0] not in ("127.0.0.1", "localhost"):
                self.send_error(403)
            elif self.path == "/":
                self._send("text/html", _AROUND.replace("TITLE", escape(title)))
            elif self.path == "/page":
                self._send("text/html", watched.html)
            elif self.path == "/state":
                state = {"version": watched.version, "objection": watched.objection}
                self._send("application/json", json.dumps(state))
            else:
                self.send_error(404)

        def _send(self, kind: str, text: str) -> None:
            content = text.encode()
            self.send_response(200)
            self.send_header("Content-Type", f"{kind}; charset=utf-8")
            self.send_header("Content-Length", str(len(content)))
            self.send_header("Cache-Control", "no-store")
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: Any) -> None:
            """Say nothing."""

    return ThreadingHTTPServer(("127.0.0.1", port), Handler)
