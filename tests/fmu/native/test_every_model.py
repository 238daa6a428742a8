"""Every model in every form: FMI 3.0 goes the way of FMI 2.0, and fmpy finds no fault in it."""

import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

import models
from mechanism_fmu.fmu.native.package import build_native_fmu
from tests.fmu.conformance.conftest import SUBJECTS


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name == "ratchet" else pytest.mark.slow) for name in sorted(models.available())],
)
def test_fmi3_goes_the_way_of_fmi2(name, request, built):
    second = request.getfixturevalue(f"native_{name}_fmu")
    third = built(name, build_native_fmu, fmi=3)
    assert validate_fmu(str(second)) == validate_fmu(str(third)) == []

    subject = SUBJECTS[name]
    variables = read_model_description(str(second)).modelVariables
    outputs = [v.name for v in variables if v.causality == "output"]

    def run(fmu, **options):
        start = dict(subject["rough"])
        return simulate_fmu(
            str(fmu), stop_time=subject["until"], output_interval=0.125, start_values=start, output=outputs, **options
        )

    expected, found = run(second), run(third)
    for output in outputs:
        assert list(found[output]) == list(expected[output]), output
    at_impacts = run(third, use_event_mode=True, early_return_allowed=True)
    if subject.get("impacts", True):
        assert at_impacts["impact_count"][-1] == expected["impact_count"][-1] > 0
    assert at_impacts["energy_lost"][-1] == pytest.approx(expected["energy_lost"][-1], rel=1e-9)
