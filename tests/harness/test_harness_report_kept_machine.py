"""The whole page of a machine of exact wheels, beside what it was: see tests/kept.py."""

from dataclasses import replace
from typing import Any

import pytest
from test_harness_machine_report import BACK, run

from harness.errors import FmuError, LogMessage, Status
from harness.machine.connection import Connection
from harness.machine.file.machine_plan import BondPlan
from harness.machine.observers.bonds import BondEnergy
from harness.report.machine_report import machine_report
from tests.harness.machine.fakes import Wheel
from tests.kept import plain_page, same_as_kept

__all__ = ["run"]

BOND = BondPlan("shaft", Connection("one.drag", "two.torque"), BACK)


def steady(performed: Any) -> Any:
    """Without what the clock says."""
    rows = [[row[0], *("…" if place else cell for place, cell in enumerate(row[1:]))] for row in performed.rows]
    return replace(performed, wall_time=0.5, rows=rows)


def test_kept_page_of_a_machine(run: Any) -> None:
    whole = steady(run(Wheel("one", (0.25, 0.5)), Wheel("two", (0.75,)), Wheel("three", speed=-1.0), plain=["three"]))
    same_as_kept("machine.html", plain_page(machine_report(whole)))


def test_kept_page_of_a_machine_with_bonds_and_troubles(run: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def stuck(self: Wheel, time: float) -> None:
        if time >= 0.5:
            raise FmuError("the wheel is stuck")

    monkeypatch.setattr(Wheel, "_make_trouble", stuck)
    early = steady(run(Wheel("one", (0.1, 0.105, 0.107, 0.3)), Wheel("two", (0.2,)), form="csv"))
    said = LogMessage("one", 0.25, Status.WARNING, "", "the oil is <hot>")
    plan = early.machine.plan
    plan = replace(plan, bonds=(BOND,), connections=(BACK,), recording=replace(plan.recording, every=3))
    early = replace(
        early,
        machine=replace(early.machine, plan=replace(plan, policy=replace(plan.policy, tolerance=1e-4))),
        cautions=[replace(said, text="trust nobody")],
        messages=[said],
        bonds={"shaft": BondEnergy(2.0, 1.75, 2.5)},
    )
    same_as_kept("machine_early.html", plain_page(machine_report(early)))
