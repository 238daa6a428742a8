"""FMPy's simulation loop sees both sides of an impact; the end values are in `test_matrix.py`."""

import numpy as np
import pytest
from fmpy import simulate_fmu

from tests.fmu.native.scenes3 import AFTER, IMPACT
from tests.importers.forms import FORMS


@pytest.mark.parametrize("form", [key for key, form in FORMS.items() if form.event_mode])
def test_fmpy_sees_both_sides_of_an_impact(form, built):
    outputs = ["wheel_angle", "wheel_speed", "impact_count", "impact_wheel_speed_before"]
    options = {"use_event_mode": True, "early_return_allowed": True}
    fmu = built("ratchet", FORMS[form].build, **FORMS[form].options)
    result = simulate_fmu(str(fmu), stop_time=2, output_interval=0.01, output=outputs, **options)

    (row,) = np.flatnonzero(np.diff(result["impact_count"])) + 1
    assert result["time"][row - 1] == result["time"][row] == IMPACT
    assert result["wheel_speed"][row - 1] == result["impact_wheel_speed_before"][row]
    assert result["wheel_speed"][row] == pytest.approx(AFTER["impact_wheel_speed"], rel=1e-7)
    assert result["time"][-1] == pytest.approx(2)


def test_without_event_mode_the_impact_is_in_the_buffer(built):
    outputs = ["impact_time", "impacts[1].time"]
    fmu = built("ratchet", FORMS["fmi3"].build, **FORMS["fmi3"].options)
    result = simulate_fmu(str(fmu), stop_time=2, output_interval=0.01, output=outputs)

    assert result["impact_time"][-1] == result["impacts[1].time"].max() == IMPACT
