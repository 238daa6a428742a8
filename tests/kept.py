"""Texts and pages that are kept in tests/data/kept: any change of what is drawn or said is seen, and must be confirmed.

    KEPT=write python -m pytest tests/harness -k kept

writes them anew; `git diff` then shows what is different. They say that nothing has changed, not that it is right: what
numbers must be is said elsewhere. Numbers may differ in the last digits, as other processors and libraries have them.
"""

from __future__ import annotations

import inspect
import json
import math
import os
import re
from dataclasses import is_dataclass
from itertools import zip_longest
from pathlib import Path
from types import ModuleType
from typing import Any

from tests.public import listed_by
from tests.report_page import opened

FOLDER = Path(__file__).parent / "data" / "kept"

_NUMBER = re.compile(r"(?<![\w#.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])")
#: By how much numbers may differ: in parts of themselves, and what is nothing beside the largest of a line, or 1.
_RELATIVE, _NOTHING = 1e-6, 1e-12
#: In a curve, a line of more numbers than this, what is nothing beside the largest: after a hundred oscillations, the
#: last digit of a frequency, which each processor's linear algebra has its own, is 2e-8 of the stress.
_CURVE, _NOTHING_IN_A_CURVE = 50, 1e-7
#: Scripts and styles are files of their own; versions are those of this machine.
_LEFT_OUT = (
    (re.compile(r"<!--.*?-->", re.DOTALL), ""),
    (re.compile(r"<style>.*?</style>", re.DOTALL), "<style>…</style>"),
    (re.compile(r"<script>.*?</script>", re.DOTALL), "<script>…</script>"),
    (re.compile(r"<h2>Versions</h2>.*?</section>", re.DOTALL), "<h2>Versions</h2>…</section>"),
)


def same_as_kept(name: str, text: str) -> None:
    """Compare a text with the kept one, line by line: all but numbers to the letter.

    Raises:
        AssertionError: there is none, or it is different.
    """
    path = FOLDER / name
    if os.environ.get("KEPT") == "write":
        path.write_text(text, encoding="utf-8")
        return
    kept = path.read_text(encoding="utf-8")
    for number, (old, new) in enumerate(zip_longest(kept.splitlines(), text.splitlines()), start=1):
        how = f"{name}, line {number}, was\n{old}\nand is\n{new}\nIf this is meant: KEPT=write, see tests/kept.py."
        assert _alike(old, new), how


def plain_page(html: str) -> str:
    """A report's page in lines, with the data of its charts, and without what is in files of its own."""
    html = opened(html)
    for pattern, instead in _LEFT_OUT:
        html = pattern.sub(instead, html)
    html = re.sub(r'(<script type="application/json">)(.*?)(</script>)', _opened, html, flags=re.DOTALL)
    return re.sub(r"(?<=>)(?=<(?:section|div|h2|p>|table|tr|ul|li|svg|figure))", "\n", html)


def plain_data(data: Any) -> str:
    """What JSON can hold, in lines."""
    return _lines(json.loads(json.dumps(data)))


def defaults_of(package: ModuleType) -> dict[str, Any]:
    """Of what a package offers: fields of records and arguments of functions that have a default, and numbers."""
    told: dict[str, Any] = {}
    for name in sorted(listed_by(package) or ()):
        one = getattr(package, name)
        if isinstance(one, int | float) or (is_dataclass(one) and not isinstance(one, type)):
            told[name] = repr(one)
        elif inspect.isfunction(one) or is_dataclass(one):
            arguments = inspect.signature(one).parameters.values()
            told[name] = {each.name: _said(each.default) for each in arguments if each.default is not each.empty}
    return told


def _said(default: Any) -> str:
    return default.__name__ if inspect.isfunction(default) else repr(default)


def _opened(found: re.Match[str]) -> str:
    return f"{found[1]}\n{_lines(json.loads(found[2]))}\n{found[3]}"


def _lines(data: Any, indent: str = "") -> str:
    """JSON with a line for each key; lists of plain values, however long, stay in one."""
    if isinstance(data, dict):
        inside = [f"{indent} {json.dumps(key)}: {_lines(value, indent + ' ')}" for key, value in data.items()]
        return "{\n" + ",\n".join(inside) + f"\n{indent}}}" if inside else "{}"
    if isinstance(data, list) and any(isinstance(one, dict | list) for one in data):
        return "[\n" + ",\n".join(f"{indent} {_lines(one, indent + ' ')}" for one in data) + f"\n{indent}]"
    if isinstance(data, list):
        return f"[{', '.join(_lines(one) for one in data)}]"
    if isinstance(data, float):
        return f"{data:.9g}"
    return json.dumps(data, ensure_ascii=False)


def _alike(old: str | None, new: str | None) -> bool:
    """Of lines; None is the end of the text."""
    if old is None or new is None or old == new:
        return old == new
    if _NUMBER.split(old) != _NUMBER.split(new):
        return False
    were, are = ([float(text) for text in _NUMBER.findall(line)] for line in (old, new))
    nothing = _NOTHING * max((1.0, *map(abs, were)))
    if len(were) > _CURVE:
        nothing = max(nothing, _NOTHING_IN_A_CURVE * max(map(abs, were)))
    return all(
        math.isclose(one, other, rel_tol=_RELATIVE, abs_tol=nothing) for one, other in zip(were, are, strict=True)
    )
