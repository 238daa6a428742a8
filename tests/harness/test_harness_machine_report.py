"""The report of a machine's run, from wheels that turn exactly."""

import json
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from harness.app.commands import machine_performed
from harness.app.commands.machine_run import summary
from harness.errors import FmuError
from harness.fmu import Fmu
from harness.fmu.instances.message_log import MessageHandler
from harness.machine import running
from harness.machine.connection import Connection
from harness.machine.file.machine_plan import BondPlan, ComponentPlan, Plan, Policy, Recording, Scheme, Source
from harness.machine.observers.component_impacts import cycles_of
from harness.machine.part import Extrapolation
from harness.machine.running import MachineRun, Prepared
from harness.machine.structure import structure_of
from harness.report import machine_signals
from harness.report.machine_report import machine_report
from harness.report.machine_signals import in_power_flow
from harness.run.master import Ending
from tests.harness.machine.fakes import Trouble, Wheel, description
from tests.report_page import opened

DRAWING = {
    "format": 1,
    "shapes": [
        {
            "kind": "wheel",
            "at": [0, 0],
            "name": "wheel",
            "angle": "angle",
            "count": 4,
            "outline": [[0.1, 0], [0.08, 1]],
        },
        {"kind": "striker", "at": ["tooth_length", 0]},
    ],
}
BACK = Connection("two.drag", "one.torque")
POLICY = Policy(1.0, 0.01, Scheme.JACOBI, Extrapolation.CONSTANT)


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Runs wheels of these names; all but `plain` ones bring a drawing."""

    def perform(
        *wheels: Wheel,
        plain: Sequence[str] = (),
        signals: tuple[str, ...] = ("*",),
        form: str = "parquet",
        bonds: tuple[BondPlan, ...] = (),
    ) -> MachineRun:
        parts = {wheel.name: wheel for wheel in wheels}

        @contextmanager
        def instantiated(_: Prepared, on_message: MessageHandler) -> Iterator[dict[str, Wheel]]:
            for wheel in wheels:
                wheel.on_message = on_message
            yield parts

        monkeypatch.setattr(machine_performed, "instantiated", instantiated)
        plan = Plan(
            "Two <wheels>",
            tuple(ComponentPlan(name, Source(Path(f"{name}.fmu")), values={"torque": 0.5}) for name in parts),
            tuple({bond.flow: None for bond in bonds} | {bond.effort: None for bond in bonds}),
            bonds,
            POLICY,
            Recording(signals, 1, form),
        )
        plan = replace(plan, components=tuple(replace(c, values=_free(c.name, plan)) for c in plan.components))
        fmus = {}
        for name in parts:
            folder = tmp_path / name
            (folder / "resources").mkdir(parents=True, exist_ok=True)
            if name not in plain:
                (folder / "resources" / "drawing.json").write_text(json.dumps(DRAWING))
            fmus[name] = Fmu(Path(f"{name}.fmu"), description(restores=True), folder)
        whole = structure_of({name: fmu.description for name, fmu in fmus.items()}, plan.connections).description
        return machine_performed.perform(Prepared(plan, fmus, whole, None), tmp_path)

    return perform


def _free(name: str, plan: Plan) -> dict[str, float]:
    """A start value for the torque, unless it is connected."""
    return {} if any(c.target == f"{name}.torque" for c in plan.connections) else {"torque": 0.5}


def held(html: str) -> list[dict[str, Any]]:
    """What charts and players get."""
    return [json.loads(text) for text in re.findall(r'<script type="application/json">(.*?)</script>', opened(html))]


def player(html: str) -> dict[str, Any]:
    return next(data for data in held(html) if "panels" in data)


def curves(html: str) -> dict[str, tuple[list[float], list[float]]]:
    drawn = [curve for data in held(html) for curve in data.get("curves", ())]
    return {curve["name"]: (curve["x"], curve["y"]) for curve in drawn}


def test_all_components_move_beside_each_other_with_one_player(run: Any) -> None:
    html = machine_report(run(Wheel("one", (0.25, 0.5)), Wheel("two", (0.75,)), Wheel("three"), plain=["three"]))
    data = player(html)
    assert [panel["impacts"] for panel in data["panels"]] == [[0.25, 0.5], [0.75]]
    assert data["impacts"] == [0.25, 0.5, 0.75]
    assert data["whose"] == ["one", "one", "two"]
    assert len(data["time"]) == len(data["panels"][0]["columns"][0]) == 101
    assert data["panels"][0]["columns"][0][-1] > data["panels"][1]["columns"][0][-1]
    assert html.count("<svg role") == 2
    assert "Its FMU has no picture." in html
    assert html.count('class="play"') == 1


def test_the_order_is_that_of_the_power(run: Any) -> None:
    """What drives stands left of what is driven, whatever the file's order."""
    bond = BondPlan("shaft", Connection("two.drag", "one.torque"), Connection("one.drag", "two.torque"))
    assert in_power_flow(run(Wheel("one"), Wheel("two"))) == ["one", "two"]
    plan = run(Wheel("one"), Wheel("two"))
    turned = replace(plan.machine.plan, bonds=(bond,))
    assert in_power_flow(replace(plan, machine=replace(plan.machine, plan=turned))) == ["two", "one"]


def test_impacts_stress_and_damage_stand_by_component(run: Any) -> None:
    html = machine_report(run(Wheel("one", (0.25, 0.5)), Wheel("two")))
    for heading in ("Fatigue damage per 1,000 cycles", "Stress in the tooth of one", "Impacts of one"):
        assert f"<h2>{heading}</h2>" in html
    assert "Impacts of two" not in html
    assert "damage per 1,000 runs like this one, one" in html
    assert "<title>Two &lt;wheels&gt;</title>" in html
    assert "<script src=" not in html


def test_the_summary_has_the_damage_by_cycles_too(run: Any) -> None:
    whole = run(Wheel("one", (0.25, 0.5)), Wheel("two"))
    told = summary(whole)["components"]
    fatigue = told["one"]["fatigue"]
    assert fatigue["cycles_in_run"] == 1
    assert fatigue["damage_per_1000_cycles"] == 1000 * fatigue["damage"] > 0.0
    assert told["two"]["fatigue"] is None


def test_the_summary_says_how_the_run_ended(run: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = run(Wheel("one"))
    assert (summary(whole)["ending"], summary(whole)["error"]) == ("completed", None)
    early = replace(whole, outcome=replace(whole.outcome, ending=Ending.FAILED, error=FmuError("the wheel is stuck")))
    assert (summary(early)["ending"], summary(early)["error"]) == ("failed", "the wheel is stuck")


def test_signals_are_drawn_by_component_and_unit_and_what_stands_still_is_a_table(run: Any) -> None:
    html = machine_report(run(Wheel("one", (0.5,)), Wheel("two")))
    assert html.count("<h2>Signals of ") == 2
    found = curves(html)
    assert found["angle"][0][-1] == 1.0
    assert found["speed"][1][-1] == pytest.approx(1.5, abs=1e-4)
    assert "torque" not in found
    assert "<h2>Recorded signals that did not change</h2>" in html
    assert "<td>two.torque</td>" in html


def test_curves_of_parquet_and_csv_are_the_same(run: Any) -> None:
    one, other = (machine_report(run(Wheel("one", (0.5,)), form=form)) for form in ("parquet", "csv"))
    assert curves(one) == curves(other)


def test_a_long_run_is_thinned_while_it_is_read_and_keeps_its_peaks(
    run: Any, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    rng = np.random.default_rng(7)
    table = pd.DataFrame({"time": np.arange(20_000) / 20_000, "one.speed": rng.normal(size=20_000)})
    table.loc[12_345, "one.speed"] = 9.0
    table.to_parquet(tmp_path / "long.parquet")
    for name, number in (("_ROWS", 700), ("_POINTS", 50), ("_WHILE_READING", 200)):
        monkeypatch.setattr(machine_signals, name, number)
    short = replace(
        run(Wheel("one")), results=tmp_path / "long.parquet", units={"results": {"time": "s", "one.speed": ""}}
    )
    times, values = curves(machine_report(replace(short, by_component={}, impacts=pd.DataFrame())))["speed"]
    assert len(times) <= 2 * 52  # it changes in steps
    assert times == sorted(times)
    assert max(values) == pytest.approx(9.0, abs=1e-3)


def test_warnings_of_components_are_kept(run: Any) -> None:
    html = machine_report(run(Wheel("one", trouble=Trouble(0.98, "warn"))))
    assert html.count("the oil is hot") == 2
    assert "the oil is hot" not in machine_report(run(Wheel("one")))


def test_nothing_recorded_is_said_and_the_machine_moves_nevertheless(run: Any) -> None:
    html = machine_report(run(Wheel("one"), signals=()))
    assert "No signal was recorded that has changed; [record] in the machine" in html
    assert len(player(html)["panels"]) == 1


def test_without_any_picture_the_report_says_so(run: Any) -> None:
    html = machine_report(run(Wheel("one"), plain=["one"]))
    assert "None of the components has a picture" in html
    assert 'class="play"' not in html


def test_what_is_no_number_is_not_drawn(run: Any) -> None:
    html = machine_report(run(Wheel("one", speed=float("nan")), signals=()))
    assert "None of the components has a picture" in html


def test_a_run_that_fails_has_its_report_up_to_there(run: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def stuck(self: Wheel, time: float) -> None:
        if time >= 0.5:
            raise FmuError("the wheel is stuck")

    monkeypatch.setattr(Wheel, "_make_trouble", stuck)
    html = machine_report(run(Wheel("one", trouble=Trouble(0.5))))
    assert "<h2>This run ended early, at 0.5 s</h2>" in html
    assert "the wheel is stuck" in html
    assert player(html)["time"][-1] == 0.5


def test_frames_are_few_whatever_the_number_of_steps_and_impacts(run: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(running, "FRAMES", 5)
    hits = tuple(k / 100 + 0.003 for k in range(42, 57))
    time = [round(t, 9) for t in run(Wheel("one", hits)).seen.table["time"]]
    assert time == [0.0, 0.2, 0.4, 0.43, 0.44, 0.45, 0.46, 0.47, 0.6, 0.8, 1.0]


@pytest.mark.parametrize(
    ("clicks", "count", "of"), [([3, 4, 7], 4, "strokes"), ([0, -2], 2, "strokes"), ([5, 5], 1, "runs like this one")]
)
def test_cycles_are_strokes_where_they_are_counted(clicks: list[int], count: int, of: str) -> None:
    cycles = cycles_of("ratchet", "clicks", pd.DataFrame({"time": range(len(clicks)), "ratchet.clicks": clicks}))
    assert (cycles.count, cycles.of) == (count, of)
    assert cycles.damage_of_thousand(2e-6) == pytest.approx(2e-3 / count)


def test_a_component_that_counts_nothing_has_the_run_as_its_cycle() -> None:
    assert cycles_of("wheel", "clicks", pd.DataFrame({"time": [0.0], "ratchet.clicks": [2]})).count == 1
    assert cycles_of("wheel", "", pd.DataFrame({"time": [0.0, 1.0], "wheel.": [2, 5]})).of == "runs like this one"
