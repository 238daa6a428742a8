"""Which process runs which tests, and when, if several run all of them (`--dist loadfile`).

A file is run by one process, as ever. What is new is their order, and that the files that compile parts of the engine
just in time are one piece: every process that compiles begins from nothing, so two would do the same work.

    1  that piece, in one process; meanwhile the engine of FMUs is compiled ahead of time, beside (conftest.py)
    2  in the others what needs no engine
    3  what needs FMUs or their engine, and waits for it if need be; long files first
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest

#: Files and folders whose tests compile a part of the engine just in time, whatever lies ready. The last one compiles
#: the whole of it, and needs an FMU beside.
JUST_IN_TIME = (
    "tests/unit/engine/test_contact_coordinates.py",
    "tests/unit/engine/test_curves.py",
    "tests/unit/engine/test_event_search.py",
    "tests/unit/engine/test_joint_oracle.py",
    "tests/unit/engine/test_joints.py",
    "tests/unit/engine/test_minimum_norm.py",
    "tests/unit/engine/test_root_refinement.py",
    "tests/unit/engine/test_strike.py",
    "tests/unit/engine/test_textbook.py",
    "tests/unit/engine/test_views.py",
    "tests/unit/kinematics/",
    "tests/unit/test_benchmarks.py",
    "tests/analytic/test_kinematics_cams.py",
    "tests/analytic/test_kinematics_linkages.py",
    "tests/analytic/test_slides_cam.py",
    "tests/convergence/test_orders.py",
    "tests/docs/test_kinematics_page.py",
    "tests/fmu/native/test_just_in_time_agrees.py",
)
#: Whose tests run the engine without saying so by a fixture.
_ENGINE = ("tests/analytic/", "tests/batch/", "tests/convergence/", "tests/docs/", "tests/fmu/", "tests/unit/engine/")
#: Long ones, which would otherwise stand alone at the end.
_LONG = ("tests/harness/test_harness_sweep_command.py",)


def compiles_just_in_time(nodeid: str) -> bool:
    """Whether a test belongs to the one piece."""
    return nodeid.startswith(JUST_IN_TIME)


def ordered(items: Iterable[pytest.Item]) -> list[pytest.Item]:
    """Tests in the order in which their files are to be begun; within a file as it has them."""
    kept = list(items)
    with_fmus = {_file(item) for item in kept if "built" in getattr(item, "fixturenames", ())}

    def place(item: pytest.Item) -> tuple[int, int]:
        file = _file(item)
        just_in_time = [k for k, name in enumerate(JUST_IN_TIME) if file.startswith(name)]
        if just_in_time:
            return 1, just_in_time[0]
        engine = file in with_fmus or file.startswith(_ENGINE)
        return (3 if engine else 2), int(file not in _LONG)

    return sorted(kept, key=place)


def _file(item: pytest.Item) -> str:
    return item.nodeid.partition("::")[0]


def scheduler(config: pytest.Config, log: Any) -> Any:
    """That of `--dist loadfile`, with the one piece."""
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):  # type: ignore[misc]
        def _split_scope(self, nodeid: str) -> str:
            return "just in time" if compiles_just_in_time(nodeid) else str(super()._split_scope(nodeid))

    return Scheduling(config, log)
