"""A pytest plugin for runs of the engine as plain Python (NUMBA_DISABLE_JIT=1), which is a hundred times as slow.

Load it before anything else: `python -m pytest -p tests.plain_engine`. Each view of a block is made once for the block
last looked at (nine tenths of the time go into that otherwise), and a law is tried on ten examples at most, without a
search for the simplest that fails.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import Phase, settings

from mechanism_fmu.engine.block import room

_MOST_EXAMPLES = 10
_PHASES = (Phase.explicit, Phase.generate)

_compilable = room._compilable


def _remembering(look: Callable[[Any], Any], name: str, entries: dict[str, Any]) -> Callable[[Any], Any]:
    last: Any = None
    view: Any = None

    def look_again(block: Any) -> Any:
        nonlocal last, view
        if block is not last:
            last, view = block, look(block)
        return view

    return _compilable(look_again, name, entries)


room._compilable = _remembering


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Fewer examples than each law asks for itself."""
    for item in items:
        test: Any = getattr(item, "obj", None)
        asked = getattr(test, "_hypothesis_internal_use_settings", None)
        if asked is not None:
            most = min(asked.max_examples, _MOST_EXAMPLES)
            test._hypothesis_internal_use_settings = settings(asked, max_examples=most, phases=_PHASES)
