"""`watch`: the page of a file of the user's own, built anew whenever the file is saved."""

from __future__ import annotations

import time
import webbrowser
from threading import Thread

from mechanism_fmu.batch import MechanismError
from mechanism_fmu.fmu.native.objects import need_web_library
from mechanism_fmu.fmu.native.web import web_module
from mechanism_fmu.fmu.own.find import find
from mechanism_fmu.fmu.own.prepare import prepare

from ...errors import UsageError
from ...page.page_file import page
from ...page.watched import Watched, server_of
from ..terminal import console, show_error, show_note

#: How often the file is looked at [s].
_OFTEN = 0.3


def watch_file(text: str, port: int, opens: bool) -> int:
    """Show the page of a file until Ctrl-C; `opens` says whether in a browser."""
    try:
        file = find(text)
        need_web_library()
    except MechanismError as error:
        raise UsageError(str(error)) from error
    watched = Watched(file, lambda: page(web_module(prepare(text, True, show_note)[0])))
    try:
        server = server_of(watched, file.name, port)
    except (OSError, OverflowError) as error:
        raise UsageError(
            f"Port {port} cannot be had ({error}); give another one, or --port 0 for a free one."
        ) from error
    address = f"http://127.0.0.1:{server.server_address[1]}/"
    console.print(f"Building the page of {file.name} ...", markup=False)
    try:
        _look(watched)
        Thread(target=server.serve_forever, daemon=True).start()
        console.print(f"{address} follows {file.name}; Ctrl-C ends.", markup=False, soft_wrap=True)
        if opens:
            webbrowser.open(address)
        while True:
            time.sleep(_OFTEN)
            _look(watched)
    except KeyboardInterrupt:
        console.print("Ended.")
    finally:
        server.server_close()
    return 0


def _look(watched: Watched) -> None:
    if not watched.look():
        return
    if watched.objection:
        show_error(watched.objection)
    else:
        console.print(f"Page {watched.version}, {len(watched.html) / 1e3:.0f} kB.", markup=False)
