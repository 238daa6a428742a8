"""The slider-crank with play of the gallery: impact and motion against another computation, shapes.json."""

import json
from pathlib import Path

import pytest
from gallery_examples import simulation

_CASES = json.loads((Path(__file__).parents[1] / "data" / "shapes.json").read_text(encoding="utf-8"))["cases"]
RESULTS = next(case for case in _CASES if case["kind"] == "slider_crank_pin_in_hole")["results"]


def test_its_pin_strikes_and_slides_as_another_computation_found() -> None:
    running = simulation("slider_crank_clearance", restitution=0.0)
    (wanted,) = RESULTS["impacts"]
    running.advance(0.001)
    (impact,) = running.impacts_in_step()
    assert impact.time == pytest.approx(float(wanted["t"]), abs=1e-9)
    assert impact.closing_speed == pytest.approx(-float(wanted["closing"]), abs=1e-8)
    for state in RESULTS["states"]:
        if float(state["t"]) > running.time:
            running.advance(float(state["t"]))
            shown = running.read()
            assert shown["angle"] == pytest.approx(float(state["q"][0]), abs=1e-7)
            assert shown["slider"] == pytest.approx(float(state["q"][2]), abs=1e-7)
