"""modelDescription.xml as other tools see it: valid, complete, and true."""

import subprocess
import sys
import zipfile

import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

#: name: (causality, type, unit, start) of the contract.
CONTRACT = {
    "drive_torque": ("input", "Real", "N.m", 1e-3),
    "spring_preload": ("input", "Real", "N.m", 0),
    "load_torque": ("input", "Real", "N.m", 0),
    **{f"{body}_angle": ("output", "Real", "rad", None) for body in ("wheel", "crank", "pawl")},
    **{f"{body}_speed": ("output", "Real", "rad/s", None) for body in ("wheel", "crank", "pawl")},
    "contact_force": ("output", "Real", "N", None),
    "impact_count": ("output", "Integer", None, None),
    "impact": ("output", "Boolean", None, None),
    "impact_time": ("output", "Real", "s", None),
    "impact_velocity": ("output", "Real", "m/s", None),
    "impact_closing_speed": ("output", "Real", "m/s", None),
    "impact_impulse": ("output", "Real", "N.s", None),
    "impact_wheel_speed": ("output", "Real", "rad/s", None),
    "impact_tooth": ("output", "Integer", None, None),
    "impacts_in_step": ("output", "Integer", None, None),
    "impacts_lost": ("output", "Integer", None, None),
    **{
        f"impacts[{k}].{field}": ("output", kind, unit, None)
        for k in range(1, 9)
        for field, kind, unit in (
            ("time", "Real", "s"),
            ("velocity", "Real", "m/s"),
            ("closing_speed", "Real", "m/s"),
            ("impulse", "Real", "N.s"),
            ("wheel_speed", "Real", "rad/s"),
            ("tooth", "Integer", None),
        )
    },
    **dict.fromkeys(("kinetic_energy", "spring_energy", "work_done", "energy_lost"), ("output", "Real", "J", None)),
    "tooth_count": ("parameter", "Integer", None, 10),
    "tooth_slope_angle": ("parameter", "Real", "rad", 1.5707963267948966),
    "hinge_distance": ("parameter", "Real", "m", 0.130),
    "crank_length": ("parameter", "Real", "m", 0.110),
    "pawl_length": ("parameter", "Real", "m", 0.100),
    "wheel_inner_radius": ("parameter", "Real", "m", 0.100),
    "slope_ratio": ("parameter", "Real", "1", 1.115),
    "crank_mass": ("parameter", "Real", "kg", 0.1),
    "crank_inertia": ("parameter", "Real", "kg.m2", 0.09e-3),
    "pawl_mass": ("parameter", "Real", "kg", 0.0976),
    "pawl_inertia": ("parameter", "Real", "kg.m2", 0.0853e-3),
    "wheel_mass": ("parameter", "Real", "kg", 5.6264),
    "wheel_inertia": ("parameter", "Real", "kg.m2", 32.7948e-3),
    "spring_stiffness": ("parameter", "Real", "N.m/rad", 15e-3),
    "restitution": ("parameter", "Real", "1", 0),
    "crank_angle_start": ("parameter", "Real", "rad", 1.3439035240356338),
    "wheel_angle_start": ("parameter", "Real", "rad", 1.3089969389957472),
    "baumgarte_alpha": ("parameter", "Real", "1/s", 10),
    "baumgarte_beta": ("parameter", "Real", "1/s", 1),
    "relative_tolerance": ("parameter", "Real", "1", 1e-9),
    "guided": ("parameter", "Boolean", None, "true"),
}


def test_fmpy_finds_no_problem(ratchet_fmu):
    assert validate_fmu(str(ratchet_fmu)) == []


def test_the_command_fmpy_validate_finds_no_problem(ratchet_fmu):
    done = subprocess.run([sys.executable, "-m", "fmpy", "validate", str(ratchet_fmu)], capture_output=True, text=True)

    assert done.returncode == 0, done.stdout + done.stderr
    assert "No problems found" in done.stdout + done.stderr


@pytest.mark.parametrize("name", CONTRACT)
def test_variable_of_the_contract(ratchet, name):
    causality, kind, unit, start = CONTRACT[name]
    variable = ratchet.variables[name]
    declared = variable.unit or (variable.declaredType.unit if variable.declaredType else None)

    assert (variable.causality, variable.type) == (causality, kind)
    assert declared == unit or {declared, unit} == {None, "1"}
    assert variable.description
    if causality == "output":
        assert variable.start is None
        assert variable.variability == ("discrete" if kind != "Real" or name.startswith("impact") else "continuous")
    elif kind == "Boolean":
        assert variable.start == start
    else:
        assert float(variable.start) == pytest.approx(start, rel=1e-15)


def test_default_experiment_and_abilities(ratchet):
    experiment, slave = ratchet.description.defaultExperiment, ratchet.description.coSimulation

    assert float(experiment.stopTime) > 0
    assert float(experiment.stepSize) > 0
    assert slave.canGetAndSetFMUstate
    assert slave.canSerializeFMUstate
    assert slave.canHandleVariableCommunicationStepSize


def test_start_values_are_those_of_an_instance(ratchet, instance):
    one = instance().begin()
    for variable in ratchet.description.modelVariables:
        if variable.causality in ("input", "parameter"):
            assert one[variable.name] == ratchet.start(variable.name), variable.name


def test_documentation_and_picture_are_inside(ratchet_fmu):
    with zipfile.ZipFile(ratchet_fmu) as fmu:
        page = fmu.read("documentation/index.html").decode()
        picture = fmu.read("model.png")

    assert "data:image/svg+xml" in page
    assert all(name in page for name in ("drive_torque", "impact_velocity", "tooth_slope_angle"))
    assert picture.startswith(b"\x89PNG")


def test_fmpy_simulates_it(ratchet_fmu):
    result = simulate_fmu(
        str(ratchet_fmu),
        stop_time=2,
        output_interval=0.01,
        start_values={"tooth_count": 20},
        output=["wheel_angle", "wheel_speed", "impact_count", "impact_time"],
    )

    assert result["time"][-1] == pytest.approx(2)
    assert result["impact_count"][-1] == 1
    assert result["impact_time"][-1] == pytest.approx(0.9399211769, rel=1e-9)
