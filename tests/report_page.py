"""What a report's page holds, as its script opens it: the figures of its charts, decoded here on their own."""

from __future__ import annotations

import base64
import gzip
import json
import re
from typing import Any

import numpy as np

_PLACE = '<div class="chart"></div>'


def packed(html: str, name: str) -> bytes:
    """What the element packed-`name` holds."""
    [text] = re.findall(f'<script type="text/plain" id="packed-{name}">([^<]*)</script>', html)
    return gzip.decompress(base64.b64decode(text))


def figures(html: str) -> list[dict[str, Any]]:
    """The figure of each chart, as of `plot.interactive`; [] of a page without one."""
    if "packed-figures" not in html:
        return []
    held, stored = json.loads(packed(html, "figures")), packed(html, "arrays")
    assert len(stored) == 8 * sum(held["lengths"])
    arrays, begin = [], 0
    for length in held["lengths"]:
        lowest_first = np.frombuffer(stored, np.uint8, 8 * length, begin).reshape(8, length)
        differences = np.ascontiguousarray(lowest_first.T).view("<i8").ravel()
        arrays.append(np.cumsum(differences, dtype=np.int64).view(np.float64).tolist())
        begin += 8 * length

    def resolved(data: Any) -> Any:
        if isinstance(data, dict):
            return arrays[data["shared"]] if "shared" in data else {key: resolved(one) for key, one in data.items()}
        return [resolved(one) for one in data] if isinstance(data, list) else data

    return [resolved(figure) for figure in held["figures"]]


def opened(html: str) -> str:
    """The page with each figure where it is drawn, as JSON, and nothing compressed."""
    held = iter(figures(html))
    html = re.sub(r'<script type="text/plain" id="packed-.*?</script>', "", html)

    def whole(_: re.Match[str]) -> str:
        text = json.dumps(next(held)).replace("<", "\\u003c")
        return f'<div class="chart"><script type="application/json">{text}</script></div>'

    return re.sub(re.escape(_PLACE), whole, html)
