"""What a page holds compressed: the figures of its charts, with every array once."""

from __future__ import annotations

import base64
import gzip
import json
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.floating]

#: Shorter lists are no shorter as references.
_LEAST = 16


def packed_figures(figures: Sequence[dict[str, Any]]) -> str:
    """The elements with the data of all charts, which `packed.js` opens to the same numbers, bit by bit.

    What is no number in a shorter list is None there; in an array it stays what it is.
    """
    arrays: dict[bytes, int] = {}
    shared = [_shared(figure, arrays) for figure in figures]
    lengths = [len(array) // 8 for array in arrays]
    text = json.dumps({"figures": shared, "lengths": lengths}, separators=(",", ":"), ensure_ascii=False)
    numbers = b"".join(_differences(np.frombuffer(array, "<f8")) for array in arrays)
    return _element("figures", text.encode()) + _element("arrays", numbers)


def packed_text(name: str, text: str) -> str:
    """An element with a text, which `PACKED.text(name)` of `packed.js` opens."""
    return _element(name, text.encode())


def _element(name: str, content: bytes) -> str:
    text = base64.b64encode(gzip.compress(content, mtime=0)).decode("ascii")
    return f'<script type="text/plain" id="packed-{name}">{text}</script>'


def _shared(data: Any, arrays: dict[bytes, int]) -> Any:
    """The same data with {"shared": number} for each array of floats; `arrays` has their bytes and numbers."""
    if isinstance(data, dict):
        return {key: _shared(value, arrays) for key, value in data.items()}
    if isinstance(data, list):
        if len(data) >= _LEAST and all(type(value) is float for value in data):
            return _reference(np.array(data), arrays)
        return [_shared(value, arrays) for value in data]
    return None if isinstance(data, float) and not math.isfinite(data) else data


def _reference(values: FloatArray, arrays: dict[bytes, int]) -> dict[str, int]:
    return {"shared": arrays.setdefault(values.astype("<f8").tobytes(), len(arrays))}


def _differences(values: FloatArray) -> bytes:
    """Differences of the bit patterns, their lowest bytes first, then their second, ...: smooth curves repeat bytes.

    Without a loss they then compress as well as single precision does.
    """
    differences = np.diff(values.view("<i8"), prepend=np.int64(0))
    return differences.view(np.uint8).reshape(-1, 8).T.tobytes()
