"""A pytest plugin for runs of the engine as plain Python (NUMBA_DISABLE_JIT=1), which is a hundred times as slow.

Load it with `python -m pytest -p tests.plain_engine`. A law is tried on ten examples at most, without a search for the
simplest that fails.
"""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import Phase, settings

_MOST_EXAMPLES = 10
_PHASES = (Phase.explicit, Phase.generate)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Fewer examples than each law asks for itself."""
    for item in items:
        test: Any = getattr(item, "obj", None)
        asked = getattr(test, "_hypothesis_internal_use_settings", None)
        if asked is not None:
            most = min(asked.max_examples, _MOST_EXAMPLES)
            test._hypothesis_internal_use_settings = settings(asked, max_examples=most, phases=_PHASES)
