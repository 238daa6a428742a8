"""Escapements of the gallery: ticks, period and amplitude against another computation, tests/data/shapes.json."""

import json
from pathlib import Path

import numpy as np
import pytest
from gallery_examples import simulation

_CASES = json.loads((Path(__file__).parents[1] / "data" / "shapes.json").read_text(encoding="utf-8"))["cases"]
CASE = next(case for case in _CASES if case["kind"] == "pin_pallet")


def ticks(until: float, **values: float) -> tuple[list, list[dict[str, float]]]:
    """Impacts up to a time, and what is shown a hundred times a second."""
    running, found, shown = simulation("pin_pallet", **values), [], []
    for k in range(1, round(until * 100) + 1):
        running.advance(k / 100)
        found += running.impacts_in_step()
        shown.append(running.read())
    return found, shown


def test_it_ticks_as_another_computation_found() -> None:
    found, _ = ticks(0.6)
    for tick, wanted in zip(found, CASE["results"]["first_ticks"], strict=False):
        assert tick.time == pytest.approx(float(wanted["t"]), abs=1e-8)
        assert tick.contact.partition("_")[0] == wanted["contact"].partition("/")[0]


def test_its_limit_cycle_has_the_period_and_amplitudes_of_another_computation() -> None:
    found, shown = ticks(24.6)
    wanted = {name: float(value) for name, value in CASE["results"]["limit_cycle"].items()}
    entries = [tick.time for tick in found if tick.contact.startswith("entry")]
    assert entries[-1] - entries[-3] == pytest.approx(wanted["period"], abs=2e-9)
    lever = np.array([row["lever"] for row in shown[-200:]])
    assert lever.max() == pytest.approx(wanted["max_angle"], rel=2e-3)  # seen a hundred times a second
    assert lever.min() == pytest.approx(wanted["min_angle"], rel=2e-3)
    wheel = (shown[-1]["wheel"] - shown[-405]["wheel"]) / 4.04  # ten periods, in which ten teeth pass
    assert wheel == pytest.approx(-np.radians(24.0) / wanted["period"], rel=2e-3)


def test_a_weaker_spring_swings_less() -> None:
    spans = []
    for torque in (0.5e-3, 0.8e-3):
        _, shown = ticks(8.0, torque=torque)
        spans.append(np.ptp([row["lever"] for row in shown[-200:]]))
    assert spans[0] < spans[1]
