"""Modes, transitions and events as the harness reads and shows them."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from fake_slave import FakeFmu, FakeSlave, fake_description
from hypothesis import given, strategies as st

from harness.fmu.description import Value, Variable
from harness.report.modes_and_events import events_section, modes_section
from harness.run.experiment import Experiment, perform
from harness.run.logic import EventCollector, LogicFile, counts_of, default_parameters, read_logic
from harness.run.results import write_run
from mechanism_fmu.statechart import Definition, Logic, Region, Transition
from mechanism_fmu.statechart.records import decode, encode

LOGIC = Logic(
    (Definition("face.touches", "gap s <= 0", "m", "1e-9 m", "face.gap"),),
    (Region("face", "pawl on wheel", ("open", "closed"), "open", True),),
    (
        Transition("face", "open", "closed", "face.gap", ("face.touches",), reset="impact", impact=True),
        Transition("face", "closed", "open", "any", ("not face.pushes",)),
    ),
)
FILE = {
    "format": 1,
    "contacts": ["slope", "face"],
    "events": [{"guard": 0, "subject": 1, "name": "face.gap"}, {"guard": 6, "subject": -1, "name": "input"}],
    "switches": ["guided"],
    "choices": {"1": 0},
    "variants": [encode(LOGIC)],
}


def read(folder: Path, text: str) -> LogicFile:
    (folder / "resources").mkdir(exist_ok=True)
    (folder / "resources" / "logic.json").write_text(text, encoding="utf-8")
    return read_logic(folder)


class EventSlave(FakeSlave):
    """A fake with a step in which 18 events happen, of which it can tell two."""

    def __init__(self) -> None:
        super().__init__()
        fields = ("time", "guard", "subject", "old_mode", "new_mode", "impulse")
        names = [f"events[{slot}].{field}" for slot in (1, 2) for field in fields]
        names += ["events_in_step", "event_count"]
        more = {name: Variable(name, 500 + k, "Real", "output") for k, name in enumerate(names)}
        self.description = replace(self.description, variables={**self.description.variables, **more})
        self.values |= dict.fromkeys(names, 0)

    def step(self, time: float, size: float) -> None:
        super().step(time, size)
        now = time < 0.25 <= time + size
        self.values["events_in_step"] = 2 if now else 0
        if now:
            self.values["event_count"] = 18
            rows: list[list[Value]] = [[0.24, 0, 1, 1, 3, 0.5], [0.25, 6, -1, 3, 1, 0.0]]
            for slot, row in enumerate(rows, 1):
                for field, value in zip(
                    ("time", "guard", "subject", "old_mode", "new_mode", "impulse"), row, strict=True
                ):
                    self.values[f"events[{slot}].{field}"] = value


def test_a_file_is_read_as_it_was_written(tmp_path: Path) -> None:
    file = read(tmp_path, json.dumps(FILE))
    assert file.objection == ""
    assert file.chosen({"guided": True}) == LOGIC
    assert file.chosen({"guided": False}) is None
    assert (file.event(0, 1), file.event(6, -1), file.event(3, 9)) == ("face.gap", "input", "guard 3 of 9")
    assert [file.mode(n) for n in range(4)] == ["", "slope", "face", "slope+face"]


def test_an_fmu_without_the_file_is_no_trouble(tmp_path: Path) -> None:
    file = read_logic(tmp_path)
    assert file == LogicFile()
    assert file.chosen({}) is None
    assert (file.event(0, 0), file.mode(5)) == ("guard 0 of 0", "5")


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("{", "it is no JSON"),
        ("[" * 100_000, "it is no JSON"),
        ("[]", "no list of variants"),
        (json.dumps(FILE | {"format": 2}), "its format is 2, and this harness knows format 1"),
        (json.dumps(FILE | {"choices": {"1": 1}}), "variants that are not there"),
        (json.dumps(FILE | {"choices": {"1": True}}), "variants that are not there"),
        (json.dumps(FILE | {"contacts": [1]}), "no list of contacts"),
        (json.dumps(FILE | {"switches": None}), "no list of switches"),
        (json.dumps(FILE | {"events": [{"guard": "0"}]}), "an event has no guard"),
        (json.dumps(FILE | {"variants": [[]]}), "a variant is no object"),
        (json.dumps(FILE | {"variants": [{"definitions": []}]}), "no list of regions"),
        (
            json.dumps(FILE | {"variants": [encode(replace(LOGIC, regions=()))]}),
            "a transition of 'face' joins states that are not there",
        ),
    ],
)
def test_a_damaged_file_is_an_objection_and_a_note(tmp_path: Path, text: str, problem: str) -> None:
    file = read(tmp_path, text)
    assert problem in file.objection
    assert file.objection.endswith("Build the FMU again.")
    run = perform(FakeFmu(EventSlave(), tmp_path), Experiment(1.0, 0.1))  # type: ignore[arg-type]
    assert problem in modes_section(run).replace("&#x27;", "'")
    assert "guard 0 of 1" in events_section(run)


def test_a_file_that_cannot_be_read_is_an_objection(tmp_path: Path) -> None:
    (tmp_path / "resources" / "logic.json").mkdir(parents=True)
    assert "it cannot be read" in read_logic(tmp_path).objection


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.sampled_from(["face", "open", "any"]),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from([*FILE, "definitions", "regions", "transitions", *(f for f in LOGIC.regions[0].__dict__)]),
            inner,
            max_size=5,
        )
    ),
)


@given(changes=st.dictionaries(st.sampled_from(sorted(FILE)), JSON, min_size=1))
def test_no_content_is_a_traceback(tmp_path_factory: pytest.TempPathFactory, changes: dict[str, Any]) -> None:
    file = read(tmp_path_factory.mktemp("fmu"), json.dumps(FILE | changes))
    file.chosen({"guided": True})
    file.mode(2)


@given(key=st.sampled_from(["definitions", "regions", "transitions"]), entries=st.lists(JSON, max_size=3))
def test_no_variant_is_a_traceback(key: str, entries: list[object]) -> None:
    try:
        logic = decode(encode(LOGIC) | {key: entries})
    except ValueError:
        return
    assert len(getattr(logic, key)) == len(entries)


def test_default_parameters_are_the_fmu_s_start_values() -> None:
    values = default_parameters(fake_description(), {"tooth_count": 12, "guided": False})
    assert (values["guided"], values["tooth_count"], values["restitution"]) == (False, 12, 0.0)
    assert default_parameters(fake_description(), {})["guided"] is True


def test_events_are_collected_in_words_and_written(tmp_path: Path) -> None:
    read(tmp_path, json.dumps(FILE))
    run = perform(FakeFmu(EventSlave(), tmp_path), Experiment(1.0, 0.1))  # type: ignore[arg-type]
    assert run.events.to_numpy().tolist() == [
        [0.24, "face.gap", "slope", "slope+face", 0.5],
        [0.25, "input", "slope+face", "slope", 0.0],
    ]
    assert run.events_lost == 16
    assert dict(counts_of(LOGIC, run.events)) == {0: 1, 1: 1}
    assert "events.csv" in {path.name for path in write_run(run, tmp_path)}
    assert list(pd.read_csv(tmp_path / "events.csv")["guard"]) == ["face.gap", "input"]
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["events"] == {"collected": 2, "lost": 16}
    assert summary["units"]["events"]["impulse"] == "N.s"


def test_the_report_shows_the_chart_with_counts_and_the_events(tmp_path: Path) -> None:
    read(tmp_path, json.dumps(FILE))
    run = perform(
        FakeFmu(EventSlave(), tmp_path),  # type: ignore[arg-type]
        Experiment(1.0, 0.1, {"guided": True}),
    )
    html = modes_section(run)
    assert html.count("×1") == 2
    assert "16 events that the FMU could not report" in html
    table = events_section(run)
    assert "<td>slope+face</td>" in table
    assert "16 more did not fit" in table
    long = replace(run, events=pd.concat([run.events] * 60), events_lost=0)
    assert "The first 100 of 120; all are in events.csv." in events_section(long)


def test_an_fmu_that_tells_nothing_has_no_file_and_no_section(tmp_path: Path) -> None:
    run = perform(FakeFmu(FakeSlave()), Experiment(1.0, 0.1))  # type: ignore[arg-type]
    assert not EventCollector(run.description).reports
    assert (modes_section(run), events_section(run)) == ("", "")
    assert "events.csv" not in {path.name for path in write_run(run, tmp_path)}
