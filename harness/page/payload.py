"""What a file holds so that a model runs in it: the engine, the model and what scripts get to know, and the scripts."""

from __future__ import annotations

import base64
import gzip
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from mechanism_fmu.fmu.native.web import WebModule

from .page_data import page_data

#: Those of the engine, in the order in which they need each other; they run in the page, or in a worker made of them.
ENGINE_SCRIPTS = ("signals.js", "engine.js", "stepper.js", "runner.js")


@dataclass(frozen=True)
class Payload:
    """What a file holds of a model.

    Attributes:
        model: what scripts get to know, as JSON: `page_data.page_data`.
        wasm: the WebAssembly module, as gzip in base64: the same for all models.
        image: the model as data that the module loads, as gzip in base64.
    """

    model: dict[str, Any]
    wasm: str
    image: str

    @property
    def elements(self) -> str:
        """Three elements, with the ids `model`, `wasm` and `image`, for engine.js and its like."""
        # "<" could close the element
        model = json.dumps(self.model, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
        return (
            f'<script type="application/json" id="model">{model}</script>\n'
            f'<script type="text/plain" id="wasm">{self.wasm}</script>\n'
            f'<script type="text/plain" id="image">{self.image}</script>'
        )


def payload(web: WebModule) -> Payload:
    """What a file holds of a model: that is `web_model(model)`, `web_module(module)`, or `build_fmu.web(name)`.

    In JavaScript, `ENGINE.load({wasm, image, token: model.token, recorded})` of engine.js gives the engine.

    Args:
        web: the model for a page.

    Raises:
        MechanismError: its drawing names what it does not have, or a case cannot be.
    """
    return Payload(page_data(web), _packed(web.binary), _packed(web.image))


def script(name: str, folder: Path = Path(__file__).parent) -> str:
    """The element with a script; those of the engine are of class `engine`, by which a worker's code is found.

    Args:
        name: of the file.
        folder: of it.
    """
    code = (folder / name).read_text(encoding="utf-8").replace("</script", "<\\/script").replace("<!--", "<\\!--")
    marked = ' class="engine"' if name in ENGINE_SCRIPTS else ""
    return f"<script{marked}>{code}</script>"


@lru_cache(maxsize=4)  # the module is the same for all models
def _packed(contents: bytes) -> str:
    return base64.b64encode(gzip.compress(contents, mtime=0)).decode("ascii")
