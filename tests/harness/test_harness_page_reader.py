"""What a reader of a page does beyond values: cases, living, comparing, files; by its scripts in node."""

import math
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from page_in_node import in_node, needs_node

import models
from harness.page.page_data import page_data
from mechanism_fmu import codes
from mechanism_fmu.fmu.native.link import has_linker
from mechanism_fmu.fmu.native.web import WebModule
from mechanism_fmu.model.case_values import case_values
from mechanism_fmu.simulation import Simulation
from mechanism_fmu.stress import STEEL, WedgeTooth, maximum_stress

pytestmark = [pytest.mark.skipif(not has_linker(), reason="ziglang is not installed"), needs_node]
MODEL = models.load("ratchet").MODEL


def by_python(name: str) -> tuple[list[float], dict[str, float]]:
    """A case of the ratchet: times of its impacts, and its outputs in the end."""
    (case,) = (one for one in MODEL.cases if one.name == name)
    values, inputs = case_values(MODEL, case), {port.name for port in MODEL.mechanism(MODEL.values()).inputs}
    simulation = Simulation(MODEL.build(MODEL.values(**{n: v for n, v in values.items() if n not in inputs})))
    for port in inputs & set(values):
        simulation.set_input(port, values[port])
    stop, step = case.stop_time or MODEL.stop_time, case.step_size or MODEL.step_size
    struck, count = [], round(stop / step)
    for k in range(count):
        for port, signal in case.signals.items():
            simulation.set_input(port, signal.at(simulation.time))
        simulation.begin_step()
        while simulation.time < (k + 1) * stop / count:
            before = simulation.counters[codes.COUNT_IMPACTS]
            simulation.go_on((k + 1) * stop / count, codes.STOP_AT_IMPACT)
            if simulation.counters[codes.COUNT_IMPACTS] > before:
                struck.append(simulation.time)
    return struck, dict(simulation.read())


@pytest.mark.parametrize(("name", "clicks"), [("free", 0), ("indexing", 4), ("jam", 3)])
def test_a_case_is_that_of_python(name: str, clicks: int, page_of: Callable[[str], Path]) -> None:
    (run,) = in_node(["run", {}, name], of=page_of("ratchet"))
    struck, last = by_python(name)
    assert (run["refused"], run["finished"], run["picture"]) == (False, True, True)
    assert run["last"]["clicks"] == last["clicks"] == clicks
    assert run["struck"] == pytest.approx(struck, rel=0, abs=1e-9)
    for whole in ("impact_contact", "impact_tooth", "tooth_index", "event_count"):
        assert run["last"][whole] == last[whole], whole


def test_cases_are_kept_compared_and_taken_along(page_of: Callable[[str], Path]) -> None:
    steps: list[dict[str, Any]] = [
        {"set": ["drive_torque", "2"]},
        {"click": "#keep"},
        {"click": "#reset"},
        {"click": "#toml"},
        {"choose": "jam"},
        {"click": "#toml"},
        {"click": "#inputs-csv"},
        {"set": ["load_torque", "0"]},
        {"click": "#keep"},
        {"hash": "#kept=drive_torque%3D0.002"},
    ]
    (seen,) = in_node(["session", {}, steps], of=page_of("ratchet"))
    assert seen[-1]["errors"] == []
    start, strong, kept, compared, empty, jam, values, inputs, changed, dropped, opened = seen
    assert start["heads"][:4] == ["time [s]", "tooth", "contact", "stress [MPa]"]
    assert start["impacts"][0][1:3] == ["0", "face"]
    assert (start["kept"], kept["kept"], compared["kept"]) == (0, start["curves"], start["curves"])
    assert compared["hash"] == "#kept=drive_torque%3D0.002"
    assert compared["impacts"][0][0] == start["first"] + strong["first"]
    assert empty["texts"][-1].startswith(
        "# Ratchet, SI units: mechanism-fmu run build/Ratchet.fmu --parameters FILE.toml"
    )
    assert tomllib.loads(empty["texts"][-1]) == {}
    assert jam["hash"] == "#case=jam&kept=drive_torque%3D0.002"
    (case,) = (one for one in MODEL.cases if one.name == "jam")
    expected = case_values(MODEL, case)
    assert tomllib.loads(values["texts"][-1]) == pytest.approx(expected, rel=1e-15)
    lines = inputs["texts"][-1].split("\r\n")
    assert lines[0] == "time [s],load_torque [N.m],drive_angle [rad],drive_speed [rad/s]"
    assert [float(x) for x in lines[1 + 1000].split(",")] == pytest.approx(
        [20.0, *(case.signals[n].at(20.0) for n in ("load_torque", "drive_angle", "drive_speed"))], rel=1e-12
    )
    assert changed["hash"] == "#case=jam&load_torque=0&kept=drive_torque%3D0.002"
    assert (dropped["hash"], dropped["kept"]) == ("#case=jam&load_torque=0", 0)
    assert opened["impacts"] == compared["impacts"]
    assert opened["kept"] == compared["kept"]
    # each change by a field or a choice is a step back
    assert [len(one["steps"]) for one in seen[:4]] == [0, 1, 1, 1]


def test_it_lives_and_an_input_acts_at_once(page_of: Callable[[str], Path]) -> None:
    steps: list[dict[str, Any]] = [
        {"click": "#live"},
        {"click": ".play", "until": [".time", r"t = 0\.[3-9]"]},
        {"slide": ["drive_torque", 240]},
        {"click": ".play"},
        {"click": ".next", "until": [".struck", "impact 1 of 1"]},
        {"click": ".next", "until": ["#note", "No impact"]},
        {"set": ["crank_length", "20"], "until": ["#refusal", "too short"]},
        {"set": ["crank_length", "110"], "until": [".time", r"t = 0\.000"]},
        {"click": "#live"},
    ]
    (seen,) = in_node(["session", {}, steps], of=page_of("ratchet"))
    assert seen[-1]["errors"] == []
    whole, began, lived, moved, _, struck, none, refused, again, ended = seen
    assert (began["time"], began["count"]) == ("t = 0.000 s", "No impact in this run.")
    assert lived["time"] >= "t = 0.300 s"
    # it has not begun anew
    assert moved["time"] >= lived["time"]
    assert moved["hash"] == "#drive_torque=0.004"
    # a torque that was one, and four from 0.3 s on
    assert ended["first"] < struck["first"] < whole["first"]
    assert struck["struck"].startswith(f"impact 1 of 1 at {float(struck['first']):.7g} s")
    assert none["note"] == "No impact in the next 6 s."
    assert "give more than 0.066394 m" in refused["alert"]
    assert (again["alert"], again["time"], again["count"]) == ("", "t = 0.000 s", "No impact in this run.")


def test_an_input_that_had_a_signal_is_given_its_start_value(page_of: Callable[[str], Path]) -> None:
    steps: list[dict[str, Any]] = [
        {"choose": "jam"},
        {"click": "#live"},
        {"click": ".play", "until": [".time", r"t = (?!0\.0)"]},
        {"set": ["load_torque", "0"], "until": [".time", r"t = (?!0)"]},
        # node ends when nothing plays
        {"click": "#live"},
    ]
    (seen,) = in_node(["session", {}, steps], of=page_of("ratchet"))
    assert seen[-1]["errors"] == []
    *_, before, after, _ = ([one["inputs"] for one in step["asked"] if one["live"] == "go"] for step in seen)
    assert before
    assert not any(before)
    # once, and with the signals no more
    assert [[value for _, _, value in given] for given in after if given] == [[0]]


def test_what_is_refused_while_it_lives_stands_still(page_of: Callable[[str], Path]) -> None:
    steps: list[dict[str, Any]] = [
        {"click": "#live"},
        {"set": ["crank_length", "20"], "until": ["#refusal", "too short"]},
        {"click": ".play", "until": [".play", "Play"]},
        {"set": ["crank_length", "110"], "until": [".time", r"t = 0\.000"]},
    ]
    (seen,) = in_node(["session", {}, steps], of=page_of("ratchet"))
    assert seen[-1]["errors"] == []
    _, _, refused, played, again = seen
    assert "give more than 0.066394 m" in refused["alert"] == played["alert"]
    assert (played["asked"], again["alert"]) == ([], "")


def test_a_page_whose_first_run_is_refused_lives_and_ends(page_of: Callable[[str], Path]) -> None:
    steps: list[dict[str, Any]] = [{"click": "#live"}, {"click": "#live"}, {"set": ["crank_length", "110"]}]
    (seen,) = in_node(["session", {"hash": "#crank_length=0.02"}, steps], of=page_of("ratchet"))
    assert seen[-1]["errors"] == []
    assert ["too short" in one["alert"] for one in seen] == [True, True, True, False]


def test_what_is_kept_is_what_is_shown(page_of: Callable[[str], Path]) -> None:
    steps: list[dict[str, Any]] = [
        {"set": ["drive_torque", "2"]},
        {"set": ["crank_length", "20"]},
        {"click": "#keep"},
        {"click": "#toml"},
    ]
    (seen,) = in_node(["session", {}, steps], of=page_of("ratchet"))
    assert seen[-1]["errors"] == []
    assert "too short" in seen[2]["alert"]
    assert seen[3]["hash"].endswith("&kept=drive_torque%3D0.002")
    assert tomllib.loads(seen[4]["texts"][-1]) == {"drive_torque": 0.002}


def test_a_variable_may_be_called_as_keys_of_the_address() -> None:
    given = [{"name": name, "type": "Float64", "start": 1.0} for name in ("case", "kept", "length")]
    data = {"cases": [{"name": name, "values": {}, "signals": {}} for name in ("start", "fast")], "given": given}
    address = "#case=fast&~case=2&~kept=3&length=4&kept=~kept%3D5"
    (found,) = in_node(["hash", address, data])
    assert found == ["fast", {"case": 2, "kept": 3, "length": 4}, address]


def test_stress_follows_from_the_jump() -> None:
    stress = page_data(WebModule(MODEL, "", b"", b""))["stress"]
    for length, apex in ((0.02, 0.3), (0.05, 1.0)):
        expected = maximum_stress(WedgeTooth(length, apex), STEEL, 0.003).stress
        assert stress["per"] * 0.003 == pytest.approx(expected, rel=1e-9)
    assert (stress["jump"], stress["speed"], stress["impulse"]) == (
        "impact_velocity",
        "impact_closing_speed",
        "impact_impulse",
    )


def test_signals_are_those_of_python(page_of: Callable[[str], Path]) -> None:
    for model in (MODEL, models.load("motor").MODEL):
        for case in model.cases:
            for signal in case.signals.values():
                told = next(
                    one["signals"][name]
                    for one in page_data(WebModule(model, "", b"", b""))["cases"]
                    for name in one["signals"]
                    if case.signals.get(name) == signal and one["name"] == case.name
                )
                times = [0.0, 0.1, 0.2505, 16.2, 23.1, 40.0]
                answers = in_node(*(["signal", told, time] for time in times))
                assert answers == pytest.approx([signal.at(time) for time in times], rel=1e-12, abs=1e-15)
                assert math.isfinite(answers[0])
