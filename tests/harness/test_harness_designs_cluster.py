"""What comes back from the workers of a cluster, without one."""

from types import SimpleNamespace
from typing import Any

import pytest

pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")

from cheap_designs import SQUARE
from distributed import KilledWorker

from harness.designs import cluster
from harness.designs.task import Design, Result, Task
from harness.designs.workers import Backend
from harness.run.master import TimeGrid

TASK = Task(TimeGrid.of(1.0, 0.1), {}, None, (SQUARE,))
DESIGN = Design(7, {})


TOOLS: Any = SimpleNamespace(task=TASK, way=Backend("cheap", lambda *_: []))


class Future:
    """Of a portion."""

    def __init__(self, result: Any) -> None:
        self._result = result

    def result(self) -> Any:
        if isinstance(self._result, Exception):
            raise self._result
        return self._result


def test_results_come_as_they_are() -> None:
    pairs = [(DESIGN, Result(7, "cheap", (4.0,)))]
    assert cluster._came(Future(pairs), [DESIGN], TOOLS) == pairs


def test_designs_that_killed_their_workers_have_failed() -> None:
    error = KilledWorker("portion", SimpleNamespace(address="tcp://a:1"), 3)
    [(design, result)] = cluster._came(Future(error), [DESIGN], TOOLS)
    assert design is DESIGN
    assert (result.number, result.way, result.values) == (7, "cheap", (None,))
    assert result.failure == str(error)
