"""The FMUs of the drives give the reference curves, and say what their mechanisms cannot do."""

import numpy as np
import pandas as pd
import pytest
from fmpy import simulate_fmu

import models
from tests.fmu.conformance.host import Instance

#: Start values with which the reference was made.
REFERENCES = {
    "gear_train": {"relative_tolerance": 1e-11},
    "motor": {"relative_tolerance": 1e-11},
    "rotary_table": {"relative_tolerance": 1e-11},
    "cam_drive": {"cam_inertia": 1e6, "drive_damping": 0.0, "relative_tolerance": 1e-11},
    "verge": {"relative_tolerance": 1e-12},
    "recoil_anchor": {"relative_tolerance": 1e-12},
    "graham": {"relative_tolerance": 1e-12},
    "pin_pallet": {"relative_tolerance": 1e-12},
    "lever_escapement": {"relative_tolerance": 1e-12},
}


@pytest.mark.parametrize("flavour", ["", "native_"])
@pytest.mark.parametrize("name", REFERENCES)
def test_a_run_gives_the_reference_curve(name, flavour, request):
    curve = pd.read_csv(models.available()[name] / "reference.csv")
    outputs = [column for column in curve if column not in ("time", "follower_acceleration")]
    result = simulate_fmu(
        str(request.getfixturevalue(f"{flavour}{name}_fmu")),
        stop_time=curve["time"].iloc[-1],
        output_interval=curve["time"].iloc[1],
        start_values=REFERENCES[name],
        output=outputs,
    )
    np.testing.assert_allclose(result["time"], curve["time"], rtol=0, atol=1e-12)
    for output in outputs:
        np.testing.assert_allclose(result[output], curve[output], rtol=1e-9, atol=1e-8, err_msg=output)


@pytest.mark.parametrize("flavour", ["", "native_"])
def test_the_slides_gears_accelerate_as_they_should(flavour, request):
    with Instance(request.getfixturevalue(f"{flavour}gear_train")) as one:
        one.begin().step(0.1)
        assert one["pinion_speed"] / 0.1 == pytest.approx(45.8259325044, abs=1e-9)
        assert one["wheel_speed"] / 0.1 == pytest.approx(-19.0941385435, abs=1e-9)
        assert one["mesh_force"] == pytest.approx(-11.6696269982, abs=1e-9)


@pytest.mark.parametrize("flavour", ["", "native_"])
def test_friction_that_locks_the_pawl_is_warned_of(flavour, request):
    with Instance(request.getfixturevalue(f"{flavour}ratchet")) as one:
        one.begin({"friction": 2.1})
        (message,) = [message for message in one.log if "locks the pawl on the slope" in message.text]
        assert "warning" in message.category.lower()
        one.reset().begin({"friction": 2.05})
        assert one["slope_sticks"]  # by the pawl's own mass, already
        assert one["self_locking_friction"] == pytest.approx(2.0653, abs=1e-4)


@pytest.mark.parametrize(
    ("values", "text"),
    [({"rise_angle": 0.9}, "The pressure angle reaches 49.25 deg"), ({"cam_speed_start": 45.0}, "contact")],
    ids=["steep", "pulls"],
)
@pytest.mark.parametrize("flavour", ["", "native_"])
def test_a_steep_cam_and_a_guided_roller_that_is_pulled_are_warned_of(values, text, flavour, request):
    with Instance(request.getfixturevalue(f"{flavour}cam_drive")) as one:
        one.begin({**values, "drive_damping": 0.0})
        one.step(0.2)
        assert [message.text for message in one.log if text in message.text and "warning" in message.category.lower()]
