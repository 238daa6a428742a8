"""Which process runs which tests, and when, if several run all of them (`--dist loadfile`).

A process takes one piece after the other, from the front. A piece is a file, but for those tests that take long each:
every one is a piece. And the files whose tests compile parts of the engine just in time are one piece together: each
process that compiles begins from nothing, so that two would do the same work. The order:

    1  that piece; meanwhile the engine of FMUs is compiled ahead of time, beside (conftest.py)
    2  what takes longest, or mostly waits: it would otherwise stand alone at the end
    3  what needs no engine
    4  what needs FMUs or their engine, and waits for it if need be; what takes longest first
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest

#: Files, folders and tests that compile a part of the engine just in time, whatever lies ready. The last one compiles
#: the whole of it, and needs an FMU beside.
JUST_IN_TIME = (
    "tests/unit/engine/test_contact_coordinates.py",
    "tests/unit/engine/test_curves.py",
    "tests/unit/engine/test_event_search.py",
    "tests/unit/engine/test_joint_oracle.py",
    "tests/unit/engine/test_joints.py",
    "tests/unit/engine/test_minimum_norm.py",
    "tests/unit/engine/test_pull_search.py",
    "tests/unit/engine/test_root_refinement.py",
    "tests/unit/engine/test_strike.py",
    "tests/unit/engine/test_textbook.py",
    "tests/unit/engine/test_views.py",
    "tests/unit/kinematics/",
    "tests/unit/elastodynamics/",
    "tests/unit/test_benchmarks.py",
    "tests/analytic/test_cam_dynamics.py",
    "tests/analytic/test_driven_motion.py",
    "tests/analytic/test_kinematics_cams.py",
    "tests/analytic/test_kinematics_linkages.py",
    "tests/analytic/test_slides_cam.py",
    "tests/convergence/test_orders.py",
    "tests/docs/test_elastodynamics_dynamics_page.py",
    "tests/docs/test_elastodynamics_page.py",
    "tests/docs/test_kinematics_page.py",
    "tests/harness/test_harness_reproduce.py::test_joints_are_closed_where_hands_place_their_bodies",
    "tests/fmu/native/test_just_in_time_agrees.py",
)
#: Whose tests run the engine without saying so by a fixture.
_ENGINE = tuple(
    f"tests/{name}/" for name in ("analytic", "convergence", "docs", "faults", "fmu", "fuzz", "unit/engine")
)
#: Tests that are to begin early, and files whose tests are a piece each.
_LONG = (
    "tests/harness/test_harness_sweep_command.py::test_twenty_thousand_designs_killed_ten_times",
    "tests/fmu/test_just_in_time.py",
    "tests/test_house.py::test_tool_has_no_complaint[mypy]",
    "tests/fmu/test_life_cycle.py::test_two_thousand_instances_do_not_grow",
)
_EACH = (
    "tests/docs/test_ked_page.py",
    "tests/fmu/conformance/test_alone.py",
    "tests/fmu/conformance/test_sequences.py",
    "tests/fmu/test_gallery.py",
    *_LONG,
)
#: Files that take long, of those that need FMUs: each would otherwise be at work when all others have ended.
_LONG_WITH_FMUS = (
    "tests/faults/test_faults.py",
    "tests/harness/machine/test_indexing_table.py",
    "tests/harness/test_harness_sweep_command.py",
    "tests/fmu/conformance/test_alone.py",
    "tests/fmu/conformance/test_sequences.py",
    "tests/fmu/test_gallery.py",
    "tests/docs/test_ked_page.py",
    "tests/analytic/test_million_impacts.py",
)


def compiles_just_in_time(nodeid: str) -> bool:
    """Whether a test belongs to the one piece."""
    return nodeid.startswith(JUST_IN_TIME)


def ordered(items: Iterable[pytest.Item]) -> list[pytest.Item]:
    """Tests in the order in which their files are to be begun; within a file as it has them."""
    kept = list(items)
    with_fmus = {_file(item) for item in kept if "built" in getattr(item, "fixturenames", ())}

    def place(item: pytest.Item) -> tuple[int, int]:
        file = _file(item)
        for group, names in enumerate((JUST_IN_TIME, _LONG), start=1):
            for k, name in enumerate(names):
                if item.nodeid.startswith(name):
                    return group, k
        if file in _LONG_WITH_FMUS:
            return 4, _LONG_WITH_FMUS.index(file)
        return (4, len(_LONG_WITH_FMUS)) if file in with_fmus or file.startswith(_ENGINE) else (3, 0)

    return sorted(kept, key=place)


def _file(item: pytest.Item) -> str:
    return item.nodeid.partition("::")[0]


def scheduler(config: pytest.Config, log: Any) -> Any:
    """That of `--dist loadfile`, with these pieces."""
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):  # type: ignore[misc]
        def _split_scope(self, nodeid: str) -> str:
            if compiles_just_in_time(nodeid):
                return "just in time"
            return nodeid if nodeid.startswith(_EACH) else str(super()._split_scope(nodeid))

    return Scheduling(config, log)
