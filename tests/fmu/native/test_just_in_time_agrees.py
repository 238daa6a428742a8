"""The engine compiled just in time says what the native FMU says, after every step."""

import pytest

from mechanism_fmu.engine import run
from tests.fmu.conformance.host import Instance
from tests.fmu.native.scenes import InEngine, cycle, paper, steps


@pytest.mark.parametrize("scene", [paper, cycle], ids=lambda scene: scene.__name__)
def test_the_engine_compiled_just_in_time_agrees(native_ratchet, scene, monkeypatch):
    """Both FMUs hold the same object code; this one is made in another way, and its tables are by Python."""
    monkeypatch.setattr(run, "compiled_library", lambda: None)
    expected = steps(scene, InEngine())
    with Instance(native_ratchet) as one:
        found = steps(scene, one)
    for k, (mine, other) in enumerate(zip(found, expected, strict=True)):
        assert mine == pytest.approx({name: other[name] for name in mine}, rel=1e-12, abs=1e-12), k
