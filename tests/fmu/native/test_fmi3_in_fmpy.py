"""FMI 3.0 with fmpy's own simulation loop as the host."""

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

from tests.fmu.native.scenes3 import AFTER, IMPACT


def test_fmpy_finds_no_problem(ratchet_fmi3, clocked_ratchet_fmi3):
    assert validate_fmu(str(ratchet_fmi3)) == validate_fmu(str(clocked_ratchet_fmi3)) == []


def test_fmpy_simulates_it(ratchet_fmi3):
    outputs = ["wheel_angle", "impact_count", "impact_time", "impacts[1].time"]
    result = simulate_fmu(str(ratchet_fmi3), stop_time=2, output_interval=0.01, output=outputs)

    assert result["time"][-1] == pytest.approx(2)
    assert result["impact_count"][-1] == 1
    assert result["impact_time"][-1] == IMPACT
    assert result["impacts[1].time"].max() == result["impact_time"][-1]


@pytest.mark.parametrize("form", ["ratchet_fmi3", "clocked_ratchet_fmi3"])
def test_fmpy_sees_both_sides_of_an_impact(form, request):
    outputs = ["wheel_angle", "wheel_speed", "impact_count", "impact_wheel_speed_before"]
    options = {"use_event_mode": True, "early_return_allowed": True}
    fmu = request.getfixturevalue(form)
    result = simulate_fmu(str(fmu), stop_time=2, output_interval=0.01, output=outputs, **options)

    (row,) = np.flatnonzero(np.diff(result["impact_count"])) + 1
    assert result["time"][row - 1] == result["time"][row] == IMPACT
    assert result["wheel_speed"][row - 1] == result["impact_wheel_speed_before"][row]
    assert result["wheel_speed"][row] == pytest.approx(AFTER["impact_wheel_speed"], rel=1e-7)
    assert result["time"][-1] == pytest.approx(2)
