"""The FMUs of the linkages give the reference curves, which come from closed forms and scipy alone."""

import numpy as np
import pandas as pd
import pytest
from fmpy import simulate_fmu

import models
from tests.fmu.conformance.host import Instance


@pytest.mark.parametrize("flavour", ["", "native_"])
@pytest.mark.parametrize("name", ["slider_crank", "four_bar", "four_bar_path_generator"])
def test_the_default_run_gives_the_reference_curve(name, flavour, request):
    curve = pd.read_csv(models.available()[name] / "reference.csv")
    outputs = [column for column in curve if column != "time"]
    result = simulate_fmu(
        str(request.getfixturevalue(f"{flavour}{name}_fmu")),
        stop_time=curve["time"].iloc[-1],
        output_interval=curve["time"].iloc[1],
        output=outputs,
    )
    np.testing.assert_allclose(result["time"], curve["time"], rtol=0, atol=1e-12)
    for output in outputs:
        off = result[output] - curve[output]
        if output.endswith("_angle") and output != "crank_angle":
            off -= 2 * np.pi * np.round(off / (2 * np.pi))
        assert np.abs(off).max() < 1e-7, output


@pytest.mark.parametrize(
    ("name", "lengths", "text"),
    [
        ("slider_crank", {"rod_length": 0.05}, "Change point"),
        ("slider_crank", {"rod_length": 0.04}, "The crank cannot turn fully"),
        ("four_bar", {"coupler_length": 0.2, "rocker_length": 0.05, "crank_angle_start": 1.0}, "Change point"),
        ("four_bar", {"coupler_length": 0.11, "crank_angle_start": 0.5}, "The crank cannot turn fully"),
    ],
)
@pytest.mark.parametrize("flavour", ["", "native_"])
def test_what_the_crank_cannot_do_is_said_in_the_log(name, lengths, text, flavour, request):
    with Instance(request.getfixturevalue(f"{flavour}{name}")) as one:
        one.begin(lengths)
        assert [message.text for message in one.log if text in message.text]
        assert one["kinetic_energy"] > 0
